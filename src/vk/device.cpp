// SPDX-License-Identifier: MIT
#include "vk/device.h"

#include "vk/check.h"
#include "zvo/error.h"

#include <fmt/format.h>

namespace zvo::vk
{

namespace
{

// The host may have chosen another queue family than query() would.
void useQueueFamily(DeviceReport& report, const Functions& fn, std::uint32_t queue_family, float timestamp_period_ns)
{
    std::uint32_t count = 0;
    fn.vkGetPhysicalDeviceQueueFamilyProperties(report.physical_device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    fn.vkGetPhysicalDeviceQueueFamilyProperties(report.physical_device, &count, families.data());
    if (queue_family >= count || (families[queue_family].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
    {
        report.reasons.push_back(
            fmt::format("queue family {} cannot compute, {} can", queue_family, report.queue_family));
        return;
    }
    report.queue_family = queue_family;
    report.timestamp_valid_bits = families[queue_family].timestampValidBits;
    report.timestamp_period_ns = report.timestamp_valid_bits != 0 ? timestamp_period_ns : 0;
}

} // namespace

Device::Device(const DeviceHandles& handles, std::span<const EmbeddedKernel> kernels)
    : m_handles(handles),
      m_functions(Functions::ofDevice(handles.get_instance_proc_addr, handles.instance, handles.device)),
      m_report(query(handles.get_instance_proc_addr, handles.instance, handles.physical_device))
{
    VkPhysicalDeviceProperties properties{};
    m_functions.vkGetPhysicalDeviceProperties(handles.physical_device, &properties);
    m_limits = properties.limits;
    useQueueFamily(m_report, m_functions, handles.queue_family, m_limits.timestampPeriod);
    applyOverrides(handles.overrides, m_report, m_limits);
    if (!m_report.usable())
    {
        throw Error(ErrorCode::Device, fmt::format("zvo cannot use the Vulkan device {}: {}", m_report.name,
                                                   fmt::join(m_report.reasons, ", ")));
    }
    m_memory = std::make_unique<MemoryAllocator>(*this, handles.memory_budget_bytes, handles.memory_budget_name);
    m_kernels = std::make_unique<KernelCache>(*this, kernels, handles.pipeline_cache);
}

Device::~Device() = default;

void Device::setName(VkObjectType type, std::uint64_t object, const std::string& name) const noexcept
{
    if (!m_handles.debug_utils || m_functions.vkSetDebugUtilsObjectNameEXT == nullptr)
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
