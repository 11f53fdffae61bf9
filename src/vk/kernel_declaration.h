// SPDX-License-Identifier: MIT
// Compares what shared headers declare of kernels (GPU_KERNEL in shared/gpu.h) with what the modules say.
#pragma once

#include "shared/gpu.h"
#include "vk/kernel.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace zvo::vk
{

/// A kernel as its header declares it.
struct KernelDeclaration
{
    std::string_view name;
    std::string_view params_name;                    // empty: no push constants
    std::uint32_t params_bytes = 0;                  // sizeof
    std::vector<gpu::ConstantDescription> constants; // in order: the first has constant_id 0
};

/// The declaration of kernel K.
template <DeclaredKernel K> KernelDeclaration declarationOf()
{
    KernelDeclaration result;
    result.name = K::kName;
    if constexpr (!std::is_void_v<typename K::Params>)
    {
        result.params_name = K::kParamsName;
        result.params_bytes = sizeof(typename K::Params);
    }
    if constexpr (!std::is_empty_v<K>)
    {
        using Description = typename K::Description;
        constexpr std::size_t kCount = sizeof(Description) / sizeof(gpu::ConstantDescription);
        const auto constants = std::bit_cast<std::array<gpu::ConstantDescription, kCount>>(Description{});
        result.constants.assign(constants.begin(), constants.end());
    }
    return result;
}

/// The differences between declarations and modules, one line each: kernels that only one side has; numbers, names,
/// types and default values of specialization constants; names and sizes of parameters. The constant that C++ calls
/// wide_keys is kWideKeys in GLSL.
std::vector<std::string> differences(std::span<const KernelDeclaration> declarations,
                                     std::span<const EmbeddedKernel> kernels);

} // namespace zvo::vk
