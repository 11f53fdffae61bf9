// SPDX-License-Identifier: MIT
#include "common/host.h"

#include <atomic>
#include <cstdio>
#include <dlfcn.h>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace host
{

namespace
{

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

std::atomic<int> g_message_count = 0;

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void*)
{
    ++g_message_count;
    std::fprintf(stderr, "validation: %s\n", data->pMessage);
    return VK_FALSE;
}

PFN_vkGetInstanceProcAddr openLoader()
{
    // Never closed: drivers do not like it.
    void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    void* const symbol = library != nullptr ? dlsym(library, "vkGetInstanceProcAddr") : nullptr;
    if (symbol == nullptr)
    {
        throw std::runtime_error("there is no libvulkan.so.1");
    }
    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(symbol);
}

VkImageAspectFlags aspectOf(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

} // namespace

void check(VkResult result, const char* what)
{
    if (result != VK_SUCCESS)
    {
        throw std::runtime_error(std::string(what) + " failed: VkResult " + std::to_string(result));
    }
}

Instance::Instance(bool validation) : m_get(openLoader())
{
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = onMessage;
    const VkValidationFeatureEnableEXT synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = kApiVersion;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (validation)
    {
        m_extensions = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
        info.enabledExtensionCount = static_cast<std::uint32_t>(m_extensions.size());
        info.ppEnabledExtensionNames = m_extensions.data();
    }
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(m_get(nullptr, "vkCreateInstance"));
    check(create(&info, nullptr, &m_instance), validation ? "vkCreateInstance with validation" : "vkCreateInstance");
#define HOST_LOAD(name) m_fn.name = reinterpret_cast<PFN_##name>(m_get(m_instance, #name));
    HOST_INSTANCE_FUNCTIONS(HOST_LOAD)
#undef HOST_LOAD
    if (validation)
    {
        check(m_fn.vkCreateDebugUtilsMessengerEXT(m_instance, &messenger, nullptr, &m_messenger),
              "vkCreateDebugUtilsMessengerEXT");
    }
}

Instance::~Instance()
{
    if (m_messenger != VK_NULL_HANDLE)
    {
        m_fn.vkDestroyDebugUtilsMessengerEXT(m_instance, m_messenger, nullptr);
    }
    m_fn.vkDestroyInstance(m_instance, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physicalDevices(const std::string& wanted) const
{
    std::uint32_t count = 0;
    check(m_fn.vkEnumeratePhysicalDevices(m_instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> all(count);
    check(m_fn.vkEnumeratePhysicalDevices(m_instance, &count, all.data()), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        VkPhysicalDeviceProperties properties{};
        m_fn.vkGetPhysicalDeviceProperties(all[i], &properties);
        const std::string_view name = properties.deviceName;
        const bool is_cpu = wanted == "cpu" && properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
        if (wanted == std::to_string(i) || is_cpu || name.find(wanted) != std::string_view::npos)
        {
            devices.push_back(all[i]);
        }
    }
    return devices;
}

std::uint32_t Instance::queueFamily(VkPhysicalDevice device) const
{
    std::uint32_t count = 0;
    m_fn.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    m_fn.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (const VkQueueFlags flags :
         {VkQueueFlags{VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT}, VkQueueFlags{VK_QUEUE_COMPUTE_BIT}})
    {
        for (std::uint32_t i = 0; i < count; ++i)
        {
            if ((families[i].queueFlags & flags) == flags)
            {
                return i;
            }
        }
    }
    throw std::runtime_error("the device has no queue that computes");
}

int Instance::messageCount()
{
    return g_message_count;
}

Device::Device(const Instance& instance, VkPhysicalDevice physical_device, std::uint32_t family,
               VkDeviceCreateInfo info)
    : m_physical_device(physical_device), m_family(family), m_fn(instance.fn())
{
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    check(m_fn.vkCreateDevice(physical_device, &info, nullptr, &m_device), "vkCreateDevice");
#define HOST_LOAD(name) m_fn.name = reinterpret_cast<PFN_##name>(m_fn.vkGetDeviceProcAddr(m_device, #name));
    HOST_DEVICE_FUNCTIONS(HOST_LOAD)
#undef HOST_LOAD
    m_fn.vkGetDeviceQueue(m_device, family, 0, &m_queue);
    m_fn.vkGetPhysicalDeviceMemoryProperties(physical_device, &m_memory);
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = family;
    check(m_fn.vkCreateCommandPool(m_device, &pool, nullptr, &m_pool), "vkCreateCommandPool");
}

Device::~Device()
{
    m_fn.vkQueueWaitIdle(m_queue);
    m_fn.vkDestroyCommandPool(m_device, m_pool, nullptr);
    m_fn.vkDestroyDevice(m_device, nullptr);
}

VkCommandBuffer Device::makeCommands() const
{
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = m_pool;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(m_fn.vkAllocateCommandBuffers(m_device, &info, &commands), "vkAllocateCommandBuffers");
    return commands;
}

void Device::begin(VkCommandBuffer commands) const
{
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(m_fn.vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

void Device::submitAndWait(VkCommandBuffer commands) const
{
    check(m_fn.vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    buffer.commandBuffer = commands;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &buffer;
    check(m_fn.vkQueueSubmit2(m_queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
    check(m_fn.vkQueueWaitIdle(m_queue), "vkQueueWaitIdle");
}

VkDeviceMemory Device::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) const
{
    for (std::uint32_t type = 0; type < m_memory.memoryTypeCount; ++type)
    {
        const bool has_all = (m_memory.memoryTypes[type].propertyFlags & properties) == properties;
        if (has_all && ((needs.memoryTypeBits >> type) & 1U) != 0)
        {
            VkMemoryAllocateInfo info{};
            info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
            info.allocationSize = needs.size;
            info.memoryTypeIndex = type;
            VkDeviceMemory memory = VK_NULL_HANDLE;
            check(m_fn.vkAllocateMemory(m_device, &info, nullptr, &memory), "vkAllocateMemory");
            return memory;
        }
    }
    throw std::runtime_error("the device has no memory of a type that would do");
}

Buffer::Buffer(const Device& device, std::uint64_t bytes, VkBufferUsageFlags usage) : m_device(device)
{
    const Functions& fn = device.fn();
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = usage;
    check(fn.vkCreateBuffer(device.handle(), &info, nullptr, &m_buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    fn.vkGetBufferMemoryRequirements(device.handle(), m_buffer, &needs);
    m_memory = device.allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(fn.vkBindBufferMemory(device.handle(), m_buffer, m_memory, 0), "vkBindBufferMemory");
    check(fn.vkMapMemory(device.handle(), m_memory, 0, VK_WHOLE_SIZE, 0, &m_mapped), "vkMapMemory");
}

Buffer::~Buffer()
{
    m_device.fn().vkDestroyBuffer(m_device.handle(), m_buffer, nullptr);
    m_device.fn().vkFreeMemory(m_device.handle(), m_memory, nullptr);
}

Image::Image(const Device& device, VkFormat format, VkExtent2D size, VkImageUsageFlags usage)
    : m_device(device), m_format(format), m_size(size), m_aspect(aspectOf(format)),
      m_read_back(device, std::uint64_t{4} * size.width * size.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT)
{
    const Functions& fn = device.fn();
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    check(fn.vkCreateImage(device.handle(), &info, nullptr, &m_image), "vkCreateImage");
    VkMemoryRequirements needs{};
    fn.vkGetImageMemoryRequirements(device.handle(), m_image, &needs);
    m_memory = device.allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(fn.vkBindImageMemory(device.handle(), m_image, m_memory, 0), "vkBindImageMemory");
    constexpr VkImageUsageFlags kViewed =
        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if ((usage & kViewed) != 0)
    {
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = m_image;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format;
        view.subresourceRange = {m_aspect, 0, 1, 0, 1};
        check(fn.vkCreateImageView(device.handle(), &view, nullptr, &m_view), "vkCreateImageView");
    }
}

Image::~Image()
{
    m_device.fn().vkDestroyImageView(m_device.handle(), m_view, nullptr);
    m_device.fn().vkDestroyImage(m_device.handle(), m_image, nullptr);
    m_device.fn().vkFreeMemory(m_device.handle(), m_memory, nullptr);
}

void Image::barrier(VkCommandBuffer commands, const Edge& from, const Edge& to) const
{
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = from.stages;
    barrier.srcAccessMask = from.accesses;
    barrier.dstStageMask = to.stages;
    barrier.dstAccessMask = to.accesses;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = m_image;
    barrier.subresourceRange = {m_aspect, 0, 1, 0, 1};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    m_device.fn().vkCmdPipelineBarrier2(commands, &info);
}

void Image::readBack(VkCommandBuffer commands) const
{
    VkBufferImageCopy region{};
    region.imageSubresource = {m_aspect, 0, 0, 1};
    region.imageExtent = {m_size.width, m_size.height, 1};
    m_device.fn().vkCmdCopyImageToBuffer(commands, m_image, kRead.layout, m_read_back.handle(), 1, &region);
    VkMemoryBarrier2 barrier{}; // so that the host sees it when the device is done
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    m_device.fn().vkCmdPipelineBarrier2(commands, &info);
}

void Image::savePpm(const std::filesystem::path& path) const
{
    const auto* const pixels = static_cast<const char*>(m_read_back.mapped());
    const std::size_t count = std::size_t{m_size.width} * m_size.height;
    std::string rgb;
    for (std::size_t i = 0; i < count; ++i)
    {
        rgb.append(pixels + 4 * i, 3);
    }
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << m_size.width << ' ' << m_size.height << "\n255\n" << rgb;
    if (!file.flush())
    {
        throw std::runtime_error("cannot write " + path.string());
    }
}

} // namespace host
