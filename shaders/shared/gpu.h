// SPDX-License-Identifier: MIT
// The bridge: makes one struct declaration mean the same in C++ and in GLSL. Every shared header includes it first.
//
//   GPU_BUFFER(T, ALIGN)   declares that buffers of T exist; ALIGN is the alignment of T in bytes (scalar layout)
//   GPU_PTR(T)             device address of T[], writable:     .data[i] in GLSL, zvo::gpu::Ptr<T> in C++
//   GPU_CONST_PTR(T)       device address of T[], read only:    .data[i] in GLSL, zvo::gpu::ConstPtr<T> in C++
//
// This file holds the project's only `#ifdef __cplusplus`; the other shared headers need none.
#ifndef ZVO_SHADERS_SHARED_GPU_H
#define ZVO_SHADERS_SHARED_GPU_H

#ifdef __cplusplus

#include <cstdint>
#include <glm/glm.hpp>

namespace zvo::gpu
{

using uint = std::uint32_t;
using glm::ivec2;
using glm::ivec3;
using glm::mat3;
using glm::mat4x3;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

/// Address of a T[] in device memory that a kernel may only read.
template <typename T> struct ConstPtr
{
    std::uint64_t address = 0;
};

/// Address of a T[] in device memory that a kernel may read and write.
template <typename T> struct Ptr
{
    std::uint64_t address = 0;
};

} // namespace zvo::gpu

#define GPU_NAMESPACE_BEGIN                                                                                            \
    namespace zvo::gpu                                                                                                 \
    {
#define GPU_NAMESPACE_END }
#define GPU_PTR(T) Ptr<T>
#define GPU_CONST_PTR(T) ConstPtr<T>
#define GPU_BUFFER(T, ALIGN) static_assert(alignof(T) <= (ALIGN) && sizeof(T) % (ALIGN) == 0)

#else

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_control_flow_attributes : require

#define GPU_NAMESPACE_BEGIN
#define GPU_NAMESPACE_END
#define GPU_PTR(T) T##_Ptr
#define GPU_CONST_PTR(T) T##_ConstPtr
#define GPU_BUFFER(T, ALIGN)                                                                                           \
    layout(buffer_reference, scalar, buffer_reference_align = ALIGN) buffer T##_Ptr                                    \
    {                                                                                                                  \
        T data[];                                                                                                      \
    };                                                                                                                 \
    layout(buffer_reference, scalar, buffer_reference_align = ALIGN) readonly buffer T##_ConstPtr                      \
    {                                                                                                                  \
        T data[];                                                                                                      \
    }

#endif

GPU_NAMESPACE_BEGIN

GPU_BUFFER(uint, 4);
GPU_BUFFER(ivec2, 4);
GPU_BUFFER(uvec2, 4);
GPU_BUFFER(uvec3, 4);
GPU_BUFFER(uvec4, 4);
GPU_BUFFER(vec3, 4);
GPU_BUFFER(uint64_t, 8);

/// Arguments of one indirect dispatch, laid out as VkDispatchIndirectCommand.
struct DispatchArgs
{
    uint x; // workgroups along x
    uint y; // workgroups along y
    uint z; // workgroups along z
};
GPU_BUFFER(DispatchArgs, 4);

/// Invocations of a workgroup of which one writes DispatchArgs. On lavapipe, the validation layers look addresses up
/// wrongly in a workgroup of one.
const uint kArgsGroup = 8u;

GPU_NAMESPACE_END

#endif
