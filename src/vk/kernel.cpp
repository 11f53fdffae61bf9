// SPDX-License-Identifier: MIT
#include "vk/kernel.h"

#include "vk/check.h"
#include "vk/descriptor_sets.h"
#include "vk/device.h"
#include "vk/tuning.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

namespace zvo::vk
{

namespace
{

// Push constants whose layout C++ and the shader share have a size that is a multiple of four.
constexpr std::uint32_t kPushConstantUnit = 4;

void checkSpecialization(const EmbeddedKernel& kernel, const KernelInterface& interface,
                         const Specialization& specialization)
{
    std::vector<std::uint32_t> ids;
    std::ranges::transform(interface.constants, std::back_inserter(ids), &ModuleConstant::id);
    for (std::uint32_t id = 0; id < specialization.size(); ++id)
    {
        if (!std::ranges::binary_search(ids, id))
        {
            throw Error(ErrorCode::Other, fmt::format("kernel {} got {} specialization constants, but declares none "
                                                      "with constant_id = {} (only: {})",
                                                      kernel.name, specialization.size(), id, fmt::join(ids, ", ")));
        }
    }
}

void specializeLocalSize(KernelInterface& interface, const Specialization& specialization)
{
    for (std::size_t i = 0; i < interface.local_size.size(); ++i)
    {
        if (interface.local_size_ids[i] < specialization.size())
        {
            interface.local_size[i] = specialization[interface.local_size_ids[i]];
        }
    }
}

void checkLimits(const EmbeddedKernel& kernel, const KernelInterface& interface, const VkPhysicalDeviceLimits& limits)
{
    const auto [x, y, z] = interface.local_size;
    const std::uint64_t threads = std::uint64_t{x} * y * z;
    if (threads == 0 || threads > limits.maxComputeWorkGroupInvocations || x > limits.maxComputeWorkGroupSize[0] ||
        y > limits.maxComputeWorkGroupSize[1] || z > limits.maxComputeWorkGroupSize[2])
    {
        throw Error(
            ErrorCode::Other,
            fmt::format("kernel {} has workgroups of {} x {} x {} threads; this device allows 1 to {}, and {} x "
                        "{} x {}",
                        kernel.name, x, y, z, limits.maxComputeWorkGroupInvocations, limits.maxComputeWorkGroupSize[0],
                        limits.maxComputeWorkGroupSize[1], limits.maxComputeWorkGroupSize[2]));
    }
    const std::uint32_t bytes = interface.push_constant_bytes;
    if (bytes > limits.maxPushConstantsSize || bytes % kPushConstantUnit != 0)
    {
        throw Error(ErrorCode::Other,
                    fmt::format("kernel {} has {} bytes of push constants; it may have {} in multiples of {}",
                                kernel.name, bytes, limits.maxPushConstantsSize, kPushConstantUnit));
    }
}

// Whether the kernel's bound form has storage buffers, which are for atomics.
bool bindsStorage(const EmbeddedKernel& kernel)
{
    const std::vector<ModuleBinding> bindings = reflectKernel(kernel.bound_words).bindings;
    return std::ranges::any_of(bindings, [](const ModuleBinding& binding) { return binding.texel_words == 0; });
}

// The module of a choice.
std::span<const std::uint32_t> wordsOf(const EmbeddedKernel& embedded, const KernelChoice& choice)
{
    return choice.form == KernelForm::Bound ? embedded.bound_words : embedded.words;
}

std::string debugName(std::string_view name, const Specialization& specialization)
{
    return specialization.empty() ? std::string(name) : fmt::format("{}({})", name, fmt::join(specialization, ", "));
}

} // namespace

KernelCache::KernelCache(Device& device, std::span<const EmbeddedKernel> kernels, VkPipelineCache pipeline_cache,
                         LoadForm loads)
    : m_device(device), m_embedded(kernels.begin(), kernels.end()), m_pipeline_cache(pipeline_cache)
{
    for (const EmbeddedKernel& kernel : kernels)
    {
        if (!kernel.bound_words.empty() &&
            (loads == LoadForm::Descriptors || (loads == LoadForm::Atomics && bindsStorage(kernel))))
        {
            m_bound.emplace(kernel.name);
        }
    }
}

KernelForm KernelCache::usualForm(std::string_view name) const
{
    return m_bound.count(name) != 0 ? KernelForm::Bound : KernelForm::Addressed;
}

KernelCache::~KernelCache()
{
    releaseReplaced();
    for (const auto& [key, kernel] : m_kernels)
    {
        destroy(kernel);
    }
}

void KernelCache::destroy(const Kernel& kernel) noexcept
{
    const Functions& fn = m_device.fn();
    fn.vkDestroyPipeline(m_device.handle(), kernel.pipeline, m_device.allocationCallbacks());
    fn.vkDestroyPipelineLayout(m_device.handle(), kernel.layout, m_device.allocationCallbacks());
}

const EmbeddedKernel& KernelCache::find(std::string_view name) const
{
    const auto embedded = std::find_if(m_embedded.begin(), m_embedded.end(),
                                       [&](const EmbeddedKernel& kernel) { return kernel.name == name; });
    if (embedded == m_embedded.end())
    {
        throw Error(ErrorCode::Other, fmt::format("there is no kernel {}: {} kernels are embedded, none with that name",
                                                  name, m_embedded.size()));
    }
    return *embedded;
}

const Kernel& KernelCache::get(std::string_view name, const Specialization& specialization, KernelForm form)
{
    const EmbeddedKernel& embedded = find(name);
    const KernelChoice key{std::string(name), specialization,
                           embedded.bound_words.empty() ? KernelForm::Addressed : form};
    const auto known = m_kernels.find(key);
    if (known != m_kernels.end())
    {
        return known->second;
    }
    Kernel& kernel = m_kernels[key]; // the cache destroys its kernels, incomplete ones too
    try
    {
        create(embedded, key, kernel);
    }
    catch (...)
    {
        destroy(kernel);
        m_kernels.erase(key);
        throw;
    }
    return kernel;
}

void KernelCache::replace(std::string_view name, std::vector<std::uint32_t> words)
{
    const EmbeddedKernel old = find(name);
    const KernelInterface before = reflectKernel(old.words);
    const KernelInterface after = reflectKernel(words);
    if (after.push_constant_bytes != before.push_constant_bytes || after.local_size != before.local_size)
    {
        throw Error(ErrorCode::Other,
                    fmt::format("kernel {} takes other parameters, or other workgroups, than this program gives it: "
                                "build the program anew",
                                name));
    }
    const EmbeddedKernel embedded = {.name = old.name, .words = words};
    std::vector<Kernel> made;
    std::vector<Kernel*> targets;
    try
    {
        for (auto& [key, kernel] : m_kernels)
        {
            if (key.name == name && key.form == KernelForm::Addressed)
            {
                targets.push_back(&kernel);
                create(embedded, key, made.emplace_back());
            }
        }
    }
    catch (...)
    {
        for (const Kernel& kernel : made)
        {
            destroy(kernel);
        }
        throw;
    }
    for (std::size_t i = 0; i < made.size(); ++i)
    {
        std::swap(*targets[i], made[i]); // references to the kernel stay valid
    }
    m_replaced.insert(m_replaced.end(), made.begin(), made.end());
    std::vector<std::uint32_t>& kept = m_modules[std::string(name)];
    kept = std::move(words);
    m_bound.erase(std::string(name));
    *std::ranges::find(m_embedded, name, &EmbeddedKernel::name) = {.name = old.name, .words = kept};
}

void KernelCache::releaseReplaced() noexcept
{
    for (const Kernel& kernel : m_replaced)
    {
        destroy(kernel);
    }
    m_replaced.clear();
}

std::vector<std::string> KernelCache::names() const
{
    std::vector<std::string> names;
    for (const EmbeddedKernel& kernel : m_embedded)
    {
        names.emplace_back(kernel.name);
    }
    return names;
}

std::vector<KernelChoice> KernelCache::made() const
{
    std::vector<KernelChoice> choices;
    for (const auto& [choice, kernel] : m_kernels)
    {
        choices.push_back(choice);
    }
    return choices;
}

std::optional<PendingKernel> KernelCache::begin(const KernelChoice& choice)
{
    const auto embedded = std::ranges::find(m_embedded, choice.name, &EmbeddedKernel::name);
    if (embedded == m_embedded.end() || m_kernels.count(choice) != 0 ||
        (choice.form == KernelForm::Bound && embedded->bound_words.empty()) ||
        choice.specialization.size() != reflectKernel(wordsOf(*embedded, choice)).constants.size())
    {
        return std::nullopt;
    }
    PendingKernel pending(*this, choice);
    layOut(*embedded, choice, pending.m_kernel);
    return pending;
}

void KernelCache::compile(PendingKernel& pending) const
{
    pending.m_ms = makePipeline(find(pending.m_choice.name), pending.m_choice, pending.m_kernel);
}

void KernelCache::keep(PendingKernel pending)
{
    if (m_kernels.try_emplace(pending.m_choice, pending.m_kernel).second)
    {
        pending.m_kernel = {};
        tell(pending.m_choice, pending.m_ms);
    }
}

PendingKernel::~PendingKernel()
{
    m_cache.destroy(m_kernel);
}

PendingKernel::PendingKernel(PendingKernel&& other) noexcept
    : m_cache(other.m_cache), m_choice(std::move(other.m_choice)), m_kernel(std::exchange(other.m_kernel, {})),
      m_ms(other.m_ms)
{
}

void KernelCache::create(const EmbeddedKernel& embedded, const KernelChoice& choice, Kernel& kernel)
{
    layOut(embedded, choice, kernel);
    tell(choice, makePipeline(embedded, choice, kernel));
}

void KernelCache::tell(const KernelChoice& choice, double ms) const
{
    m_device.log(LogSeverity::Debug, "kernel {}: compiled in {:.1f} ms{}",
                 debugName(choice.name, choice.specialization), ms,
                 choice.form == KernelForm::Bound ? ", with descriptors" : "");
}

void KernelCache::layOut(const EmbeddedKernel& embedded, const KernelChoice& choice, Kernel& kernel)
{
    const Functions& fn = m_device.fn();
    kernel.name = embedded.name;
    kernel.specialization = choice.specialization;
    kernel.interface = reflectKernel(wordsOf(embedded, choice));
    checkSpecialization(embedded, kernel.interface, choice.specialization);
    specializeLocalSize(kernel.interface, choice.specialization);
    checkLimits(embedded, kernel.interface, m_device.limits());

    VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, kernel.interface.push_constant_bytes};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    if (!kernel.interface.bindings.empty())
    {
        set_layout = m_device.descriptors().layout(kernel.interface.bindings);
        layout.setLayoutCount = 1;
        layout.pSetLayouts = &set_layout;
    }
    layout.pushConstantRangeCount = range.size != 0 ? 1 : 0;
    layout.pPushConstantRanges = &range;
    VK_CHECK(fn.vkCreatePipelineLayout(m_device.handle(), &layout, m_device.allocationCallbacks(), &kernel.layout));
    m_device.setName(VK_OBJECT_TYPE_PIPELINE_LAYOUT, reinterpret_cast<std::uint64_t>(kernel.layout),
                     debugName(embedded.name, choice.specialization));
}

// Returns the milliseconds that it took.
double KernelCache::makePipeline(const EmbeddedKernel& embedded, const KernelChoice& choice, Kernel& kernel) const
{
    const Functions& fn = m_device.fn();
    const std::span<const std::uint32_t> words = wordsOf(embedded, choice);
    const Specialization& specialization = choice.specialization;
    const std::string name = debugName(embedded.name, specialization);
    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t id = 0; id < specialization.size(); ++id)
    {
        entries.push_back({id, id * static_cast<std::uint32_t>(sizeof(std::uint32_t)), sizeof(std::uint32_t)});
    }
    VkSpecializationInfo constants{};
    constants.mapEntryCount = static_cast<std::uint32_t>(entries.size());
    constants.pMapEntries = entries.data();
    constants.dataSize = specialization.size() * sizeof(std::uint32_t);
    constants.pData = specialization.data();

    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = words.size_bytes();
    module_info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    VK_CHECK(fn.vkCreateShaderModule(m_device.handle(), &module_info, m_device.allocationCallbacks(), &module));

    VkPipelineShaderStageRequiredSubgroupSizeCreateInfo subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_REQUIRED_SUBGROUP_SIZE_CREATE_INFO;
    subgroup.requiredSubgroupSize = m_device.requiredSubgroupSize();
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.flags = VK_PIPELINE_CREATE_DISPATCH_BASE_BIT;
    info.stage.pNext = subgroup.requiredSubgroupSize != 0 ? &subgroup : nullptr;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = specialization.empty() ? nullptr : &constants;
    info.layout = kernel.layout;
    const auto start = std::chrono::steady_clock::now();
    const VkResult result = fn.vkCreateComputePipelines(m_device.handle(), m_pipeline_cache, 1, &info,
                                                        m_device.allocationCallbacks(), &kernel.pipeline);
    fn.vkDestroyShaderModule(m_device.handle(), module, m_device.allocationCallbacks());
    if (result != VK_SUCCESS)
    {
        throwFailedCall(result, ("vkCreateComputePipelines for " + name).c_str(), __FILE_NAME__, __LINE__);
    }
    m_device.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(kernel.pipeline), name);
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    return wall.count();
}

} // namespace zvo::vk
