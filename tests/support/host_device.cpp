// SPDX-License-Identifier: MIT
#include "support/host_device.h"

#include "vk/check.h"
#include "vk/instance.h"
#include "vk/owner_functions.h"
#include "zvo/error.h"

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <utility>

namespace zvo::test
{

namespace
{

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

template <typename Function> Function globalFunction(const char* name)
{
    return reinterpret_cast<Function>(vk::loadVulkan()(VK_NULL_HANDLE, name));
}

} // namespace

bool hasValidationLayer()
{
    const auto enumerate = globalFunction<PFN_vkEnumerateInstanceLayerProperties>("vkEnumerateInstanceLayerProperties");
    std::uint32_t count = 0;
    VK_CHECK(enumerate(&count, nullptr));
    std::vector<VkLayerProperties> layers(count);
    VK_CHECK(enumerate(&count, layers.data()));
    return std::ranges::any_of(layers, [](const VkLayerProperties& layer)
                               { return std::string_view(layer.layerName) == kValidationLayer; });
}

HostDevice::HostDevice(const HostOptions& options) : m_options(options), m_get(vk::loadVulkan())
{
    try
    {
        makeInstance();
        choosePhysicalDevice();
        makeDevice();
    }
    catch (...)
    {
        destroy();
        throw;
    }
}

HostDevice::~HostDevice()
{
    m_wait(m_queue);
    destroy();
}

vk::DeviceHandles HostDevice::handles() const
{
    return {.get_instance_proc_addr = m_options.zvo_functions != nullptr ? m_options.zvo_functions : m_get,
            .instance = m_instance,
            .physical_device = m_physical_device,
            .device = m_device,
            .queue_family = m_queue_family,
            .instance_api_version = m_options.api_version,
            .instance_extensions = m_instance_extensions,
            .device_extensions = {m_options.device_extensions.begin(), m_options.device_extensions.end()},
            .enabled_features = m_info.pNext,
            .enabled_core_features = m_info.pEnabledFeatures,
            .allocation_callbacks = m_options.allocation_callbacks,
            .pipeline_cache = m_options.pipeline_cache,
            .memory_budget_bytes = m_options.memory_budget_bytes,
            .memory = m_options.memory,
            .log = m_options.log};
}

vk::DeviceHandles HostDevice::ownerHandles() const
{
    vk::DeviceHandles result = handles();
    result.functions = &m_owner_functions;
    return result;
}

VkCommandBuffer HostDevice::begin()
{
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = m_pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VK_CHECK(m_functions.vkAllocateCommandBuffers(m_device, &info, &commands));
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    VK_CHECK(m_functions.vkBeginCommandBuffer(commands, &begin));
    return commands;
}

void HostDevice::submit(VkCommandBuffer commands)
{
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
    load<PFN_vkCmdPipelineBarrier>("vkCmdPipelineBarrier")(
        commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT,
        0, 1, &barrier, 0, nullptr, 0, nullptr);
    VK_CHECK(m_functions.vkEndCommandBuffer(commands));
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    VK_CHECK(m_submit(m_queue, 1, &info, VK_NULL_HANDLE));
}

void HostDevice::wait()
{
    VK_CHECK(m_wait(m_queue));
}

void HostDevice::run(const std::function<void(VkCommandBuffer)>& record)
{
    VkCommandBuffer commands = begin();
    record(commands);
    submit(commands);
    wait();
}

VkBool32 HostDevice::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                               const VkDebugUtilsMessengerCallbackDataEXT* data, void* host)
{
    HostDevice& self = *static_cast<HostDevice*>(host);
    ++self.m_message_count;
    if (self.m_options.message_counter != nullptr)
    {
        ++*self.m_options.message_counter;
    }
    std::fprintf(stderr, "validation of a host: %s\n", data->pMessage);
    return VK_FALSE;
}

void HostDevice::makeInstance()
{
    std::vector<const char*> extensions;
    if (m_options.debug_utils || m_options.validation)
    {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    if (m_options.validation)
    {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    m_instance_extensions.assign(extensions.begin(), extensions.end());

    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = onMessage;
    messenger.pUserData = this;
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "a host";
    application.apiVersion = m_options.api_version;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pNext = m_options.validation ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = m_options.validation ? 1 : 0;
    info.ppEnabledLayerNames = &kValidationLayer;
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VK_CHECK(globalFunction<PFN_vkCreateInstance>("vkCreateInstance")(&info, nullptr, &m_instance));
    m_functions = vk::ownerFunctions(m_get, m_instance);
    if (m_options.validation)
    {
        VK_CHECK(m_functions.vkCreateDebugUtilsMessengerEXT(m_instance, &messenger, nullptr, &m_messenger));
    }
}

void HostDevice::choosePhysicalDevice()
{
    std::uint32_t count = 0;
    VK_CHECK(m_functions.vkEnumeratePhysicalDevices(m_instance, &count, nullptr));
    std::vector<VkPhysicalDevice> devices(count);
    VK_CHECK(m_functions.vkEnumeratePhysicalDevices(m_instance, &count, devices.data()));
    std::vector<DeviceReport> reports;
    for (VkPhysicalDevice device : devices)
    {
        reports.push_back(query(m_get, m_instance, device, VK_API_VERSION_1_3));
    }
    const DeviceReport& chosen = vk::chooseDevice(reports, deviceOptions().device);
    m_physical_device = chosen.physical_device;
    m_queue_family = chosen.queue_family;
}

void HostDevice::makeDevice()
{
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = m_queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    m_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    m_info.queueCreateInfoCount = 1;
    m_info.pQueueCreateInfos = &queue;
    m_info.enabledExtensionCount = static_cast<std::uint32_t>(m_options.device_extensions.size());
    m_info.ppEnabledExtensionNames = m_options.device_extensions.data();
    if (m_options.prepare)
    {
        m_options.prepare(m_info);
    }
    if (m_options.patch)
    {
        patchFeatures(m_info, m_feature_storage, m_options.optional);
    }
    VK_CHECK(m_functions.vkCreateDevice(m_physical_device, &m_info, nullptr, &m_device));
    m_info.queueCreateInfoCount = 0; // from here on, m_info is only the declaration
    m_info.pQueueCreateInfos = nullptr;
    m_functions = vk::ownerFunctions(m_get, m_instance, m_device);
    m_owner_functions = vk::ownerFunctions(handles().get_instance_proc_addr, m_instance, m_device);
    m_submit = load<PFN_vkQueueSubmit>("vkQueueSubmit");
    m_wait = load<PFN_vkQueueWaitIdle>("vkQueueWaitIdle");
    m_functions.vkGetDeviceQueue(m_device, m_queue_family, 0, &m_queue);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = m_queue_family;
    VK_CHECK(m_functions.vkCreateCommandPool(m_device, &pool, nullptr, &m_pool));
}

void HostDevice::destroy() noexcept
{
    if (m_device != VK_NULL_HANDLE)
    {
        m_functions.vkDestroyCommandPool(m_device, m_pool, nullptr);
        m_functions.vkDestroyDevice(m_device, nullptr);
    }
    if (m_messenger != VK_NULL_HANDLE)
    {
        m_functions.vkDestroyDebugUtilsMessengerEXT(m_instance, m_messenger, nullptr);
    }
    if (m_instance != VK_NULL_HANDLE)
    {
        m_functions.vkDestroyInstance(m_instance, nullptr);
    }
}

template <typename Function> Function HostDevice::load(const char* name) const
{
    return reinterpret_cast<Function>(m_functions.vkGetDeviceProcAddr(m_device, name));
}

} // namespace zvo::test
