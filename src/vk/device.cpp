// SPDX-License-Identifier: MIT
#include "vk/device.h"

#include "vk/check.h"
#include "vk/descriptor_sets.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace zvo::vk
{

namespace
{

// Enters the host's queue family, which may differ from that of query(), into report. Returns the family's flags.
VkQueueFlags useQueueFamily(DeviceReport& report, const Functions& fn, std::uint32_t queue_family,
                            float timestamp_period_ns)
{
    std::uint32_t count = 0;
    fn.vkGetPhysicalDeviceQueueFamilyProperties(report.physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    fn.vkGetPhysicalDeviceQueueFamilyProperties(report.physical_device, &count, families.data());
    if (queue_family >= count || (families[queue_family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
    {
        report.reasons.push_back(
            fmt::format("queue family {} cannot compute, {} can", queue_family, report.queue_family));
        return 0;
    }
    report.queue_family = queue_family;
    report.timestamp_valid_bits = families[queue_family].timestampValidBits;
    report.timestamp_period_ns = report.timestamp_valid_bits != 0 ? timestamp_period_ns : 0;
    return families[queue_family].queueFlags;
}

const DeviceHandles& complete(const DeviceHandles& handles)
{
    std::vector<const char*> missing;
    const auto need = [&](bool there, const char* name)
    {
        if (!there)
        {
            missing.push_back(name);
        }
    };
    need(handles.get_instance_proc_addr != nullptr, "vkGetInstanceProcAddr");
    need(handles.instance != VK_NULL_HANDLE, "VkInstance");
    need(handles.physical_device != VK_NULL_HANDLE, "VkPhysicalDevice");
    need(handles.device != VK_NULL_HANDLE, "VkDevice");
    if (!missing.empty())
    {
        throw Error(ErrorCode::Usage, fmt::format("zvo got no {}: hand over what the Vulkan device was created with",
                                                  fmt::join(missing, ", no ")));
    }
    if (handles.memory.allocate != nullptr && handles.memory.release == nullptr)
    {
        throw Error(ErrorCode::Usage, "zvo got MemoryCallbacks with allocate and without release: set both");
    }
    return handles;
}

bool contains(const std::vector<std::string>& names, std::string_view name)
{
    return std::ranges::find(names, name) != names.end();
}

} // namespace

Device::Device(const DeviceHandles& handles, std::span<const EmbeddedKernel> kernels)
    : m_handles(complete(handles)),
      m_functions(handles.functions != nullptr
                      ? *handles.functions
                      : Functions::ofDevice(handles.get_instance_proc_addr, handles.instance, handles.device)),
      m_report(query(handles.get_instance_proc_addr, handles.instance, handles.physical_device,
                     handles.instance_api_version))
{
    VkPhysicalDeviceProperties properties{};
    m_functions.vkGetPhysicalDeviceProperties(handles.physical_device, &properties);
    m_limits = properties.limits;
    m_queue_flags = useQueueFamily(m_report, m_functions, handles.queue_family, m_limits.timestampPeriod);
    applyOverrides(handles.overrides, m_report, m_limits);
    takeDeclaration();
    chooseSubgroupSize();
    if (!m_report.usable())
    {
        throw Error(ErrorCode::Device, fmt::format("zvo cannot use the Vulkan device {}: {}", m_report.name,
                                                   fmt::join(m_report.reasons, ", ")));
    }
    tellWhatIsMissing();
    m_memory = std::make_unique<MemoryAllocator>(*this, handles.memory_budget_bytes, handles.memory_budget_name);
    m_descriptors = std::make_unique<DescriptorSets>(*this);
    const auto asked_loads = static_cast<LoadForm>(tuned(kLoadsName));
    const LoadForm loads = asked_loads != LoadForm::Auto ? asked_loads : usualLoadForm(m_report);
    m_kernels = std::make_unique<KernelCache>(*this, kernels, handles.pipeline_cache, loads);
}

Device::~Device() = default;

void Device::takeDeclaration()
{
    const std::vector<std::string> declared =
        enabledFeatures(m_handles.enabled_features, m_handles.enabled_core_features);
    std::vector<std::string> undeclared;
    for (const Feature& feature : knownFeatures())
    {
        const bool needed = feature.use == FeatureUse::Required ||
                            (feature.name == "subgroupSizeControl" && tuned(kSubgroupSizeName) != 0);
        const bool enabled = contains(declared, feature.name);
        if (!contains(m_report.present, feature.name))
        {
            continue; // query() has already reported it
        }
        m_features[feature] = enabled ? VK_TRUE : VK_FALSE;
        if (enabled)
        {
            m_enabled.emplace_back(feature.name);
        }
        else if (needed)
        {
            undeclared.emplace_back(feature.name);
        }
    }
    if (!undeclared.empty())
    {
        m_report.reasons.push_back(fmt::format("was created without {} (call zvo::patchFeatures before vkCreateDevice, "
                                               "and declare VkDeviceCreateInfo's pNext and pEnabledFeatures)",
                                               fmt::join(undeclared, ", ")));
    }
    m_handles.enabled_features = &m_features.core;
    m_handles.enabled_core_features = nullptr;
    m_has_debug_utils = contains(m_handles.instance_extensions, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
}

// What the owner chooses; 0: nothing.
std::uint32_t Device::tuned(const char* name) const
{
    const auto asked = m_handles.tuning.find(name);
    return asked != m_handles.tuning.end() ? asked->second : 0;
}

void Device::chooseSubgroupSize()
{
    const std::uint32_t asked = tuned(kSubgroupSizeName);
    if (asked == 0)
    {
        m_required_subgroup_size = isEnabled("subgroupSizeControl") ? usualSubgroupSize(m_report) : 0;
    }
    else if (!contains(m_report.present, "subgroupSizeControl") || asked < m_report.min_subgroup_size ||
             asked > m_report.max_subgroup_size || !std::has_single_bit(asked))
    {
        m_report.reasons.push_back(fmt::format("cannot run kernels in subgroups of {}, only of {} to {}", asked,
                                               m_report.min_subgroup_size, m_report.max_subgroup_size));
    }
    else
    {
        m_required_subgroup_size = asked;
    }
    if (m_required_subgroup_size != 0)
    {
        m_report.subgroup_size = m_required_subgroup_size;
        limitWorkgroups();
    }
}

// Workgroups of subgroups of a required size have so many subgroups at most.
void Device::limitWorkgroups()
{
    VkPhysicalDeviceVulkan13Properties properties13{};
    properties13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &properties13;
    m_functions.vkGetPhysicalDeviceProperties2(m_handles.physical_device, &properties);
    const std::uint64_t threads_max =
        std::uint64_t{m_required_subgroup_size} * properties13.maxComputeWorkgroupSubgroups;
    m_limits.maxComputeWorkGroupInvocations =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(m_limits.maxComputeWorkGroupInvocations, threads_max));
    if (m_limits.maxComputeWorkGroupInvocations < kGroupThreads)
    {
        m_report.reasons.push_back(fmt::format("has workgroups of {} threads at most in subgroups of {}; zvo needs {}",
                                               threads_max, m_required_subgroup_size, kGroupThreads));
    }
}

void Device::tellWhatIsMissing() const
{
    if (!isEnabled("hostQueryReset"))
    {
        log(LogSeverity::Info, "hostQueryReset is not enabled: passes are not timed");
    }
    else if (m_report.timestamp_period_ns == 0)
    {
        log(LogSeverity::Info, "queue family {} has no timestamps: passes are not timed", m_report.queue_family);
    }
}

void Device::logText(LogSeverity severity, fmt::string_view format, fmt::format_args arguments) const noexcept
{
    try
    {
        m_handles.log.function(m_handles.log.user, severity, fmt::vformat(format, arguments).c_str());
    }
    catch (...)
    {
        // A message that cannot be made is dropped, so that its cause does not fail.
    }
}

bool Device::isEnabled(std::string_view feature) const
{
    return contains(m_enabled, feature);
}

void Device::setName(VkObjectType type, std::uint64_t object, const std::string& name) const noexcept
{
    if (!m_has_debug_utils || m_functions.vkSetDebugUtilsObjectNameEXT == nullptr)
    {
        return;
    }
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = name.c_str();
    m_functions.vkSetDebugUtilsObjectNameEXT(m_handles.device, &info);
}

} // namespace zvo::vk
