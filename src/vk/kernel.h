// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"
#include "vk/tuning.h"

#include <array>
#include <bit>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace zvo::vk
{

class Device;

/// A compute shader that the build compiled, checked and embedded.
struct EmbeddedKernel
{
    std::string_view name; // "<operation>/<kernel>", the shader's path without its ending
    std::span<const std::uint32_t> words;
    std::span<const std::uint32_t> bound_words{}; // of its form for descriptors (lib/bound.glsl); empty: it has none
};

/// How a kernel reaches its buffers.
enum class KernelForm : std::uint8_t
{
    Addressed, ///< all by their addresses
    Bound      ///< some through descriptors, if the kernel has that form
};

enum class ConstantType
{
    Bool,
    Uint,
    Int,
    Other
};

/// A specialization constant as a module declares it.
struct ModuleConstant
{
    std::uint32_t id = 0; // constant_id
    /// As in the shader's source; kLocalSizeX, Y or Z for a local size; empty in a module without names.
    std::string name;
    ConstantType type = ConstantType::Other;
    std::uint32_t value = 0; // default value

    bool operator==(const ModuleConstant&) const = default;
};

/// A buffer that a module reaches through a descriptor of set 0.
struct ModuleBinding
{
    /// In address_offset: the parameters do not have the buffer's address. The pass names the buffer (AnyPass::reach).
    static constexpr std::uint32_t kNoAddress = UINT32_MAX;

    std::uint32_t binding = 0;
    std::uint32_t texel_words = 0;    // of a uniform texel buffer: 32-bit words of a texel; 0: it is a storage buffer
    std::string name;                 // of the parameter that is the buffer's address, or that the pass gives it
    std::uint32_t address_offset = 0; // of the address in the push constants, in bytes

    bool operator==(const ModuleBinding&) const = default;
};

/// What the host needs to know of a SPIR-V compute module, read from the module itself.
struct KernelInterface
{
    static constexpr std::uint32_t kNotSpecialized = UINT32_MAX;

    std::array<std::uint32_t, 3> local_size{}; // threads of a workgroup, with the constants' default values
    std::array<std::uint32_t, 3> local_size_ids{kNotSpecialized, kNotSpecialized, kNotSpecialized}; // their SpecIds
    std::uint32_t push_constant_bytes = 0; // size of the push constant block, with its tail padding: sizeof in C++
    std::vector<ModuleConstant> constants; // by ascending id
    std::vector<ModuleBinding> bindings;   // by ascending number
};

/// Reads the interface of a SPIR-V 1.x compute module with one entry point. Throws Error{Other} if it is not one, has
/// specialization constants that are not 32 bits wide, or descriptors other than those of lib/bound.glsl.
KernelInterface reflectKernel(std::span<const std::uint32_t> words);

/// Values of specialization constants, in the order of constant ids from 0 on; booleans as 0 and 1.
using Specialization = std::vector<std::uint32_t>;

/// A type that stands for a kernel (GPU_KERNEL in shared/gpu.h), with values for its specialization constants.
template <typename K>
concept DeclaredKernel = requires
{
    typename K::Params;
    K::kName;
};

/// The values of all constants of a declared kernel.
template <DeclaredKernel K> Specialization specializationOf(const K& kernel)
{
    if constexpr (std::is_empty_v<K>)
    {
        return {};
    }
    else
    {
        const auto words = std::bit_cast<std::array<std::uint32_t, sizeof(K) / sizeof(std::uint32_t)>>(kernel);
        return {words.begin(), words.end()};
    }
}

/// A compute pipeline: one embedded kernel with one choice of specialization constants.
struct Kernel
{
    std::string name;
    Specialization specialization;
    KernelInterface interface; // local_size: as specialized
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
};

/// A kernel with one choice of specialization constants, in one form.
struct KernelChoice
{
    std::string name;
    Specialization specialization;
    KernelForm form = KernelForm::Addressed;

    auto operator<=>(const KernelChoice&) const = default;
};

class KernelCache;

/// A kernel on its way into a KernelCache, which must outlive it. It goes if it is not kept.
class PendingKernel
{
public:
    ~PendingKernel();
    PendingKernel(PendingKernel&& other) noexcept;
    PendingKernel(const PendingKernel&) = delete;
    PendingKernel& operator=(const PendingKernel&) = delete;

    [[nodiscard]] bool hasPipeline() const { return m_kernel.pipeline != VK_NULL_HANDLE; }

private:
    friend KernelCache;
    PendingKernel(KernelCache& cache, KernelChoice choice) : m_cache(cache), m_choice(std::move(choice)) {}

    KernelCache& m_cache;
    KernelChoice m_choice;
    Kernel m_kernel;
    double m_ms = 0; // that the pipeline took
};

/// Makes pipelines on demand and keeps them for the life of a device, or until their kernel is replaced. Not thread
/// safe, but for compile().
class KernelCache
{
public:
    /// loads: which kernels passes run in their bound form; not Auto.
    KernelCache(Device& device, std::span<const EmbeddedKernel> kernels, VkPipelineCache pipeline_cache,
                LoadForm loads);
    ~KernelCache();
    KernelCache(const KernelCache&) = delete;
    KernelCache& operator=(const KernelCache&) = delete;

    /// The pipeline of the kernel of that name with these constants; the reference stays valid. Constants that are not
    /// given keep their default values. Throws Error{Other} for a name that was not embedded, for constants that the
    /// kernel does not declare, and for a workgroup that the device cannot run.
    const Kernel& get(std::string_view name, const Specialization& specialization = {},
                      KernelForm form = KernelForm::Addressed);
    template <DeclaredKernel K> const Kernel& get(const K& kernel) { return get(K::kName, specializationOf(kernel)); }

    /// The form in which passes run the kernel of that name if its buffers allow it.
    [[nodiscard]] KernelForm usualForm(std::string_view name) const;

    /// Replaces the module of the kernel of that name, also in pipelines that get() has returned, except in those of
    /// bound forms, which get() no longer returns. Work that was recorded before uses the old pipelines, which are kept
    /// until releaseReplaced(). Throws Error{Other}, and changes nothing, for a name that was not embedded and for a
    /// module with other parameters or workgroups of another size.
    void replace(std::string_view name, std::vector<std::uint32_t> words);

    /// Frees replaced pipelines. The device must be done with all work that was recorded before replace().
    void releaseReplaced() noexcept;

    /// The names of all kernels.
    [[nodiscard]] std::vector<std::string> names() const;

    /// What get() has made so far.
    [[nodiscard]] std::vector<KernelChoice> made() const;

    /// What get() does, in three steps. Begins a kernel, without its pipeline; nothing, if get() has made it or could
    /// not: because of its name, its form, or the number of its constants. Throws as get().
    [[nodiscard]] std::optional<PendingKernel> begin(const KernelChoice& choice);

    /// Makes the pipeline. Several threads may do so at once, each for a kernel of its own, while another one uses the
    /// cache, but for replace(). Throws as get().
    void compile(PendingKernel& pending) const;

    /// Keeps a kernel that has its pipeline, unless get() has made the same one meanwhile.
    void keep(PendingKernel pending);

private:
    friend PendingKernel;

    [[nodiscard]] const EmbeddedKernel& find(std::string_view name) const;
    void create(const EmbeddedKernel& embedded, const KernelChoice& choice, Kernel& kernel);
    void layOut(const EmbeddedKernel& embedded, const KernelChoice& choice, Kernel& kernel);
    double makePipeline(const EmbeddedKernel& embedded, const KernelChoice& choice, Kernel& kernel) const;
    void tell(const KernelChoice& choice, double ms) const;
    void destroy(const Kernel& kernel) noexcept;

    Device& m_device;
    std::vector<EmbeddedKernel> m_embedded;
    std::set<std::string, std::less<>> m_bound; // kernels that passes run in their bound form
    std::map<std::string, std::vector<std::uint32_t>, std::less<>> m_modules; // of kernels that were replaced
    VkPipelineCache m_pipeline_cache;
    std::map<KernelChoice, Kernel> m_kernels;
    std::vector<Kernel> m_replaced;
};

} // namespace zvo::vk
