// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::vk
{

class Device;

/// A compute shader that the build compiled, checked and embedded.
struct EmbeddedKernel
{
    std::string_view name; // "<operation>/<kernel>", the shader's path without its ending
    std::span<const std::uint32_t> words;
};

/// What the host needs to know of a SPIR-V compute module, read from the module itself.
struct KernelInterface
{
    static constexpr std::uint32_t kNotSpecialized = UINT32_MAX;

    std::array<std::uint32_t, 3> local_size{}; // threads of a workgroup, with the constants' default values
    std::array<std::uint32_t, 3> local_size_ids{kNotSpecialized, kNotSpecialized, kNotSpecialized}; // their SpecIds
    std::uint32_t push_constant_bytes = 0; // size of the push constant block, with its tail padding: sizeof in C++
    std::vector<std::uint32_t> specialization_ids; // SpecId decorations, ascending
};

/// Reads the interface of a SPIR-V 1.x compute module with one entry point. Throws Error{Other} if it is not one, or
/// has specialization constants that are not 32 bits wide.
KernelInterface reflectKernel(std::span<const std::uint32_t> words);

/// Values of specialization constants, by their index from 0: booleans as 0 and 1.
using Specialization = std::vector<std::uint32_t>;

/// A compute pipeline: one embedded kernel with one choice of specialization constants.
struct Kernel
{
    std::string name;
    KernelInterface interface;                // local_size: as specialized
    VkPipelineLayout layout = VK_NULL_HANDLE; // push constants only: buffers are reached by address
    VkPipeline pipeline = VK_NULL_HANDLE;
};

/// Creates pipelines on demand and keeps them for the life of a device, or until their kernel is replaced. Not thread
/// safe.
class KernelCache
{
public:
    KernelCache(Device& device, std::span<const EmbeddedKernel> kernels, VkPipelineCache pipeline_cache);
    ~KernelCache();
    KernelCache(const KernelCache&) = delete;
    KernelCache& operator=(const KernelCache&) = delete;

    /// The kernel of that name with these constants; the reference stays valid. Constants that are not given keep their
    /// default values. Throws Error{Other} for a name that was not embedded, for constants that the kernel does not
    /// declare and for a workgroup that the device cannot run.
    const Kernel& get(std::string_view name, const Specialization& specialization = {});

    /// The kernel of that name is this module from now on, also where get() has returned it before; work that was
    /// recorded before goes on with the old one until releaseReplaced(). Throws Error{Other}, and changes nothing, for
    /// a name that was not embedded and for a module that does not take the same parameters, in the same workgroups.
    void replace(std::string_view name, std::vector<std::uint32_t> words);

    /// The device is done with all work that was recorded before replace().
    void releaseReplaced() noexcept;

    /// The names of all kernels.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    using Key = std::pair<std::string, Specialization>;

    [[nodiscard]] const EmbeddedKernel& find(std::string_view name) const;
    void create(const EmbeddedKernel& embedded, const Specialization& specialization, Kernel& kernel);
    void destroy(const Kernel& kernel) noexcept;

    Device& m_device;
    std::vector<EmbeddedKernel> m_embedded;
    std::map<std::string, std::vector<std::uint32_t>, std::less<>> m_modules; // of kernels that were replaced
    VkPipelineCache m_pipeline_cache;
    std::map<Key, Kernel> m_kernels;
    std::vector<Kernel> m_replaced;
};

} // namespace zvo::vk
