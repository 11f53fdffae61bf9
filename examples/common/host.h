// SPDX-License-Identifier: MIT
// What a program that uses Vulkan has anyway, in as few words as the examples need: nothing of it knows zvo. Functions
// come from a loader that is opened at run time, as hosts have it that link no Vulkan.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace host
{

#define HOST_INSTANCE_FUNCTIONS(X)                                                                                     \
    X(vkCreateDevice)                                                                                                  \
    X(vkCreateDebugUtilsMessengerEXT)                                                                                  \
    X(vkDestroyDebugUtilsMessengerEXT)                                                                                 \
    X(vkDestroyInstance)                                                                                               \
    X(vkEnumeratePhysicalDevices)                                                                                      \
    X(vkGetDeviceProcAddr)                                                                                             \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                             \
    X(vkGetPhysicalDeviceProperties)                                                                                   \
    X(vkGetPhysicalDeviceQueueFamilyProperties)

#define HOST_DEVICE_FUNCTIONS(X)                                                                                       \
    X(vkAllocateCommandBuffers)                                                                                        \
    X(vkAllocateDescriptorSets)                                                                                        \
    X(vkAllocateMemory)                                                                                                \
    X(vkBeginCommandBuffer)                                                                                            \
    X(vkBindBufferMemory)                                                                                              \
    X(vkBindImageMemory)                                                                                               \
    X(vkCmdBeginRendering)                                                                                             \
    X(vkCmdBindDescriptorSets)                                                                                         \
    X(vkCmdBindIndexBuffer)                                                                                            \
    X(vkCmdBindPipeline)                                                                                               \
    X(vkCmdBindVertexBuffers)                                                                                          \
    X(vkCmdCopyImageToBuffer)                                                                                          \
    X(vkCmdDispatch)                                                                                                   \
    X(vkCmdDrawIndexed)                                                                                                \
    X(vkCmdEndRendering)                                                                                               \
    X(vkCmdPipelineBarrier2)                                                                                           \
    X(vkCmdPushConstants)                                                                                              \
    X(vkCmdSetScissor)                                                                                                 \
    X(vkCmdSetViewport)                                                                                                \
    X(vkCreateBuffer)                                                                                                  \
    X(vkCreateCommandPool)                                                                                             \
    X(vkCreateComputePipelines)                                                                                        \
    X(vkCreateDescriptorPool)                                                                                          \
    X(vkCreateDescriptorSetLayout)                                                                                     \
    X(vkCreateGraphicsPipelines)                                                                                       \
    X(vkCreateImage)                                                                                                   \
    X(vkCreateImageView)                                                                                               \
    X(vkCreatePipelineLayout)                                                                                          \
    X(vkCreateSemaphore)                                                                                               \
    X(vkCreateShaderModule)                                                                                            \
    X(vkDestroyBuffer)                                                                                                 \
    X(vkDestroyCommandPool)                                                                                            \
    X(vkDestroyDescriptorPool)                                                                                         \
    X(vkDestroyDescriptorSetLayout)                                                                                    \
    X(vkDestroyDevice)                                                                                                 \
    X(vkDestroyImage)                                                                                                  \
    X(vkDestroyImageView)                                                                                              \
    X(vkDestroyPipeline)                                                                                               \
    X(vkDestroyPipelineLayout)                                                                                         \
    X(vkDestroySemaphore)                                                                                              \
    X(vkDestroyShaderModule)                                                                                           \
    X(vkEndCommandBuffer)                                                                                              \
    X(vkFreeMemory)                                                                                                    \
    X(vkGetBufferMemoryRequirements)                                                                                   \
    X(vkGetDeviceQueue)                                                                                                \
    X(vkGetImageMemoryRequirements)                                                                                    \
    X(vkGetSemaphoreCounterValue)                                                                                      \
    X(vkMapMemory)                                                                                                     \
    X(vkQueueSubmit2)                                                                                                  \
    X(vkQueueWaitIdle)                                                                                                 \
    X(vkUpdateDescriptorSets)                                                                                          \
    X(vkWaitSemaphores)

/// Functions of an instance and of a device, by their names.
struct Functions
{
#define HOST_DECLARE(name) PFN_##name name = nullptr;
    HOST_INSTANCE_FUNCTIONS(HOST_DECLARE)
    HOST_DEVICE_FUNCTIONS(HOST_DECLARE)
#undef HOST_DECLARE
};

/// Throws std::runtime_error for what is not VK_SUCCESS.
void check(VkResult result, const char* what);

/// Vulkan 1.3, with the validation layers (core and synchronization) when asked for.
class Instance
{
public:
    static constexpr std::uint32_t kApiVersion = VK_API_VERSION_1_3;

    explicit Instance(bool validation);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] PFN_vkGetInstanceProcAddr getProcAddr() const { return m_get; }
    [[nodiscard]] VkInstance handle() const { return m_instance; }
    [[nodiscard]] std::span<const char* const> extensions() const { return m_extensions; }
    [[nodiscard]] const Functions& fn() const { return m_fn; }

    /// Physical devices, first to last: all, the one of a number, those whose names hold a text, or "cpu".
    [[nodiscard]] std::vector<VkPhysicalDevice> physicalDevices(const std::string& wanted) const;

    /// The first queue family that draws and computes, or else that computes.
    [[nodiscard]] std::uint32_t queueFamily(VkPhysicalDevice device) const;

    /// What the layers said so far, of all instances of the process.
    static int messageCount();

private:
    PFN_vkGetInstanceProcAddr m_get;
    VkInstance m_instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT m_messenger = VK_NULL_HANDLE;
    std::vector<const char*> m_extensions;
    Functions m_fn;
};

/// A device with one queue. What is made on it goes before it does.
class Device
{
public:
    /// info: as vkCreateDevice takes it, but for the queue, which is one of family.
    Device(const Instance& instance, VkPhysicalDevice physical_device, std::uint32_t family, VkDeviceCreateInfo info);

    /// Waits for the queue.
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] VkDevice handle() const { return m_device; }
    [[nodiscard]] VkPhysicalDevice physicalDevice() const { return m_physical_device; }
    [[nodiscard]] VkQueue queue() const { return m_queue; }
    [[nodiscard]] std::uint32_t queueFamily() const { return m_family; }
    [[nodiscard]] const Functions& fn() const { return m_fn; }

    /// A command buffer that lives as long as the device; begin() throws away what was recorded before.
    [[nodiscard]] VkCommandBuffer makeCommands() const;
    void begin(VkCommandBuffer commands) const;

    /// Ends it, submits it and waits: for what happens once. frames_in_flight shows what a renderer does.
    void submitAndWait(VkCommandBuffer commands) const;

    /// Bound memory of a type with these properties.
    [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags properties) const;

private:
    VkPhysicalDevice m_physical_device;
    std::uint32_t m_family;
    VkDevice m_device = VK_NULL_HANDLE;
    VkQueue m_queue = VK_NULL_HANDLE;
    VkCommandPool m_pool = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties m_memory{};
    Functions m_fn;
};

/// One side of a barrier: which accesses in which stages, and the layout that the image has there.
struct Edge
{
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 accesses = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// A buffer that the host sees.
class Buffer
{
public:
    Buffer(const Device& device, std::uint64_t bytes, VkBufferUsageFlags usage);
    ~Buffer();
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    [[nodiscard]] VkBuffer handle() const { return m_buffer; }
    [[nodiscard]] void* mapped() const { return m_mapped; }

private:
    const Device& m_device;
    VkBuffer m_buffer = VK_NULL_HANDLE;
    VkDeviceMemory m_memory = VK_NULL_HANDLE;
    void* m_mapped = nullptr;
};

/// An image of one level, and a view of it.
class Image
{
public:
    Image(const Device& device, VkFormat format, VkExtent2D size, VkImageUsageFlags usage);
    ~Image();
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    [[nodiscard]] VkImage handle() const { return m_image; }
    [[nodiscard]] VkImageView view() const { return m_view; }
    [[nodiscard]] VkFormat format() const { return m_format; }

    /// Records the barrier between two uses. What the image held is kept unless from.layout is UNDEFINED.
    void barrier(VkCommandBuffer commands, const Edge& from, const Edge& to) const;

    /// Records a copy of the picture, 4 bytes a pixel, for savePpm(). Edge of the image: kRead.
    static constexpr Edge kRead = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    void readBack(VkCommandBuffer commands) const;

    /// Writes what the copy brought, once the device is done with it: a PPM file (P6) of an R8G8B8A8 image.
    void savePpm(const std::filesystem::path& path) const;

private:
    const Device& m_device;
    VkFormat m_format;
    VkExtent2D m_size;
    VkImageAspectFlags m_aspect;
    Buffer m_read_back;
    VkImage m_image = VK_NULL_HANDLE;
    VkImageView m_view = VK_NULL_HANDLE;
    VkDeviceMemory m_memory = VK_NULL_HANDLE;
};

} // namespace host
