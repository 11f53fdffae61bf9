// SPDX-License-Identifier: MIT
// The bridge: makes one struct declaration mean the same in C++ and in GLSL. Every shared header includes it first.
//
//   GPU_BUFFER(T, ALIGN)   declares that buffers of T exist; ALIGN is the alignment of T in bytes (scalar layout)
//   GPU_PTR(T)             device address of T[], writable:     .data[i] in GLSL, zvo::gpu::Ptr<T> in C++
//   GPU_CONST_PTR(T)       device address of T[], read only:    .data[i] in GLSL, zvo::gpu::ConstPtr<T> in C++
//   GPU_FUNCTION           before the definition of a function of both languages, such as one that packs bit fields
//
// Beside the parameters of a kernel stands its declaration: its specialization constants, each with its number, its
// type, its names in C++ and in GLSL and its default value, and the kernel.
//
//   #define UPDATE_EXPAND_CONSTANTS(CONSTANT)
//       CONSTANT(0, bool, wide_keys, kWideKeys, false)
//       CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 0u)
//   GPU_KERNEL(update, expand, Expand, ExpandParams, UPDATE_EXPAND_CONSTANTS)
//
// In C++, zvo::gpu::update::Expand then stands for update/expand; its members are the constants. In update/expand.comp,
//
//   GPU_ENTRY(ExpandParams, UPDATE_EXPAND_CONSTANTS);
//
// makes them, and `params`. A kernel without constants has GPU_NO_CONSTANTS.
//
//   GPU_ENUM(View)
//   #define GPU_TYPE_View uint
//
// make an enum class of C++, which the host defines where it needs it, a type of constants; in GLSL they are uints.
//
// Bindings of bound forms (lib/bound.glsl) need no declaration in C++: they have the names of parameters.
//
// This file holds the shared headers' only `#ifdef __cplusplus`; the others need none.
#ifndef ZVO_SHADERS_SHARED_GPU_H
#define ZVO_SHADERS_SHARED_GPU_H

#ifdef __cplusplus

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <type_traits>

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

/// A specialization constant of a kernel. It takes values of its own type only: no number is a bool.
template <typename T> class Constant
{
public:
    static_assert(std::is_same_v<T, bool> || std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::uint32_t> ||
                  (std::is_enum_v<T> && sizeof(T) == sizeof(std::uint32_t)));

    template <std::same_as<T> Value> constexpr Constant(Value value) : m_word(static_cast<std::uint32_t>(value)) {}

private:
    std::uint32_t m_word;
};

} // namespace zvo::gpu

#define GPU_NAMESPACE_BEGIN                                                                                            \
    namespace zvo::gpu                                                                                                 \
    {
#define GPU_NAMESPACE_END }
#define GPU_PTR(T) Ptr<T>
#define GPU_CONST_PTR(T) ConstPtr<T>
#define GPU_FUNCTION inline
#define GPU_BUFFER(T, ALIGN) static_assert(alignof(T) <= (ALIGN) && sizeof(T) % (ALIGN) == 0)

#define GPU_CONSTANT_MEMBER(ID, TYPE, NAME, SHADER_NAME, VALUE) Constant<TYPE> NAME = TYPE{VALUE};
#define GPU_CONSTANT_CHECK(ID, TYPE, NAME, SHADER_NAME, VALUE)                                                         \
    static_assert(offsetof(Self, NAME) == (ID) * sizeof(uint), #NAME " is not where its number says");
#define GPU_KERNEL(OPERATION, KERNEL, NAME, PARAMS, CONSTANTS)                                                         \
    namespace OPERATION                                                                                                \
    {                                                                                                                  \
    struct NAME                                                                                                        \
    {                                                                                                                  \
        using Params = PARAMS;                                                                                         \
        static constexpr std::string_view kName = #OPERATION "/" #KERNEL;                                              \
        CONSTANTS(GPU_CONSTANT_MEMBER)                                                                                 \
        static void checkNumbers()                                                                                     \
        {                                                                                                              \
            using Self [[maybe_unused]] = NAME;                                                                        \
            CONSTANTS(GPU_CONSTANT_CHECK)                                                                              \
        }                                                                                                              \
    };                                                                                                                 \
    }
#define GPU_ENUM(NAME)                                                                                                 \
    namespace zvo                                                                                                      \
    {                                                                                                                  \
    enum class NAME : std::uint32_t;                                                                                   \
    }

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
#define GPU_FUNCTION
#define GPU_BUFFER(T, ALIGN)                                                                                           \
    layout(buffer_reference, scalar, buffer_reference_align = ALIGN) buffer T##_Ptr                                    \
    {                                                                                                                  \
        T data[];                                                                                                      \
    };                                                                                                                 \
    layout(buffer_reference, scalar, buffer_reference_align = ALIGN) readonly buffer T##_ConstPtr                      \
    {                                                                                                                  \
        T data[];                                                                                                      \
    }

#define GPU_TYPE_bool bool
#define GPU_TYPE_int int
#define GPU_TYPE_uint uint
#define GPU_CONSTANT(ID, TYPE, NAME, SHADER_NAME, VALUE)                                                               \
    layout(constant_id = ID) const GPU_TYPE_##TYPE SHADER_NAME = VALUE;
#define GPU_ENTRY(PARAMS, CONSTANTS)                                                                                   \
    CONSTANTS(GPU_CONSTANT)                                                                                            \
    layout(push_constant, scalar) uniform Push                                                                         \
    {                                                                                                                  \
        PARAMS params;                                                                                                 \
    }
#define GPU_KERNEL(OPERATION, KERNEL, NAME, PARAMS, CONSTANTS)
#define GPU_ENUM(NAME)

#endif

#define GPU_NO_CONSTANTS(CONSTANT)

GPU_NAMESPACE_BEGIN

GPU_BUFFER(uint, 4);
GPU_BUFFER(float, 4);
GPU_BUFFER(ivec2, 4);
GPU_BUFFER(uvec2, 4);
GPU_BUFFER(uvec3, 4);
GPU_BUFFER(uvec4, 4);
GPU_BUFFER(vec2, 8);
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

/// Invocations of a workgroup of which only one writes DispatchArgs. One invocation would do, but in a workgroup of one
/// the validation layers check addresses wrongly on lavapipe.
const uint kArgsGroup = 8u;

GPU_NAMESPACE_END

#endif
