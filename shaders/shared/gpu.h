// SPDX-License-Identifier: MIT
// The bridge: makes one struct declaration mean the same in C++ and in GLSL. Every shared header includes it first.
//
//   GPU_BUFFER(T, ALIGN)   declares that buffers of T exist; ALIGN is the alignment of T in bytes (scalar layout)
//   GPU_PTR(T)             device address of T[], writable:     .data[i] in GLSL, zvo::gpu::Ptr<T> in C++
//   GPU_CONST_PTR(T)       device address of T[], read only:    .data[i] in GLSL, zvo::gpu::ConstPtr<T> in C++
//   GPU_FUNCTION           before the definition of a function of both languages, such as one that packs bit fields
//
// Beside the parameters of a kernel stands its declaration, which C++ alone reads. The build compares it with the
// SPIR-V (vk/kernel_declaration.h):
//
//   GPU_KERNEL_BEGIN(update, expand, Expand, ExpandParams)   zvo::gpu::update::Expand stands for update/expand, which
//       GPU_CONSTANT(bool, wide_keys, false)                 takes ExpandParams. Its specialization constants are
//       GPU_CONSTANT(uint, entries_per_word, 0u)             kWideKeys and kEntriesPerWord, with the constant_ids 0 and
//   GPU_KERNEL_END                                           1 and these default values
//
//   GPU_KERNEL(octree, scan, Scan, ScanParams)               the same without constants
//   GPU_ENUM(View, std::uint32_t)                            zvo::View is an enum class, defined where the host needs
//                                                            it, and a type of constants. In GLSL they are uints
//
// Bound forms (lib/bound.glsl) need no declaration of their own: their bindings have the names of parameters.
//
// This file holds the project's only `#ifdef __cplusplus`; the other shared headers need none.
#ifndef ZVO_SHADERS_SHARED_GPU_H
#define ZVO_SHADERS_SHARED_GPU_H

#ifdef __cplusplus

#include <concepts>
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

    constexpr Constant(std::string_view /*name*/, T value) : m_word(static_cast<std::uint32_t>(value)) {}
    template <std::same_as<T> Value> constexpr Constant(Value value) : m_word(static_cast<std::uint32_t>(value)) {}

private:
    std::uint32_t m_word;
};

/// What a declaration says of a constant: its name in C++, its type and its default value.
struct ConstantDescription
{
    std::string_view name;
    bool is_bool;
    bool is_signed;
    std::uint32_t value;
};

/// Stands where a Constant<T> stands in the same kernel.
template <typename T> struct DescribedConstant : ConstantDescription
{
    constexpr DescribedConstant(std::string_view constant_name, T default_value)
        : ConstantDescription{constant_name, std::is_same_v<T, bool>, std::is_same_v<T, std::int32_t>,
                              static_cast<std::uint32_t>(default_value)}
    {
    }
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

#define GPU_KERNEL_BEGIN(OPERATION, KERNEL, NAME, PARAMS)                                                              \
    namespace OPERATION                                                                                                \
    {                                                                                                                  \
    template <template <typename> typename ConstantOf> struct NAME##Kernel;                                            \
    using NAME = NAME##Kernel<Constant>;                                                                               \
    template <template <typename> typename ConstantOf> struct NAME##Kernel                                             \
    {                                                                                                                  \
        using Params = PARAMS;                                                                                         \
        using Description = NAME##Kernel<DescribedConstant>;                                                           \
        static constexpr std::string_view kName = #OPERATION "/" #KERNEL;                                              \
        static constexpr std::string_view kParamsName = #PARAMS;
#define GPU_CONSTANT(TYPE, NAME, VALUE) ConstantOf<TYPE> NAME = {#NAME, TYPE{VALUE}};
#define GPU_KERNEL_END                                                                                                 \
    }                                                                                                                  \
    ;                                                                                                                  \
    }
#define GPU_KERNEL(OPERATION, KERNEL, NAME, PARAMS)                                                                    \
    GPU_KERNEL_BEGIN(OPERATION, KERNEL, NAME, PARAMS)                                                                  \
    GPU_KERNEL_END
#define GPU_ENUM(NAME, TYPE)                                                                                           \
    namespace zvo                                                                                                      \
    {                                                                                                                  \
    enum class NAME : TYPE;                                                                                            \
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

#define GPU_KERNEL_BEGIN(OPERATION, KERNEL, NAME, PARAMS)
#define GPU_CONSTANT(TYPE, NAME, VALUE)
#define GPU_KERNEL_END
#define GPU_KERNEL(OPERATION, KERNEL, NAME, PARAMS)
#define GPU_ENUM(NAME, TYPE)

#endif

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
