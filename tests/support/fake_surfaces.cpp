// SPDX-License-Identifier: MIT
#include "support/fake_surfaces.h"

#include "vk/instance.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string_view>

namespace zvo::test
{

namespace
{

FakeSurfaces g_fake;
PFN_vkGetDeviceProcAddr g_device_proc_addr = nullptr; // the real one

// A fake swapchain: a few images without memory.
struct FakeSwapchain
{
    std::vector<VkImage> images;
    std::uint32_t next = 0;
};

VkResult take(std::deque<VkResult>& results)
{
    if (results.empty())
    {
        return VK_SUCCESS;
    }
    const VkResult result = results.front();
    results.pop_front();
    return result;
}

template <typename Function> Function real(VkDevice device, const char* name)
{
    return reinterpret_cast<Function>(g_device_proc_addr(device, name));
}

VkQueue queueOf(VkDevice device)
{
    VkQueue queue = VK_NULL_HANDLE;
    real<PFN_vkGetDeviceQueue>(device, "vkGetDeviceQueue")(device, 0, 0, &queue);
    return queue;
}

// Submits nothing but a signal or a wait of a semaphore.
void submit(VkDevice device, VkQueue queue, VkSemaphore wait, VkSemaphore signal)
{
    VkSemaphoreSubmitInfo semaphore{};
    semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    semaphore.semaphore = wait != VK_NULL_HANDLE ? wait : signal;
    semaphore.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSubmitInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    info.waitSemaphoreInfoCount = wait != VK_NULL_HANDLE ? 1 : 0;
    info.pWaitSemaphoreInfos = &semaphore;
    info.signalSemaphoreInfoCount = signal != VK_NULL_HANDLE ? 1 : 0;
    info.pSignalSemaphoreInfos = &semaphore;
    real<PFN_vkQueueSubmit2>(device, "vkQueueSubmit2")(queue, 1, &info, VK_NULL_HANDLE);
}

VkDevice g_swapchain_device = VK_NULL_HANDLE; // device of the last swapchain

template <typename Value> VkResult enumerate(const std::vector<Value>& all, std::uint32_t* count, Value* values)
{
    if (values != nullptr)
    {
        std::copy_n(all.begin(), *count, values);
    }
    *count = static_cast<std::uint32_t>(all.size());
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroySurface(VkInstance, VkSurfaceKHR, const VkAllocationCallbacks*)
{
    --g_fake.surfaces_alive;
}

VKAPI_ATTR VkResult VKAPI_CALL surfaceSupport(VkPhysicalDevice, std::uint32_t, VkSurfaceKHR, VkBool32* supported)
{
    *supported = g_fake.supported ? VK_TRUE : VK_FALSE;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL surfaceCapabilities(VkPhysicalDevice, VkSurfaceKHR, VkSurfaceCapabilitiesKHR* result)
{
    *result = {};
    result->minImageCount = 2;
    result->maxImageCount = g_fake.max_image_count;
    result->currentExtent = g_fake.extent;
    result->minImageExtent = {1, 1};
    result->maxImageExtent = {1000, 1000};
    result->maxImageArrayLayers = 1;
    result->supportedTransforms = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR;
    result->currentTransform = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR;
    result->supportedCompositeAlpha = VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    result->supportedUsageFlags = g_fake.usage;
    return take(g_fake.capabilities);
}

VKAPI_ATTR VkResult VKAPI_CALL surfaceFormats(VkPhysicalDevice, VkSurfaceKHR, std::uint32_t* count,
                                              VkSurfaceFormatKHR* formats)
{
    return enumerate(g_fake.formats, count, formats);
}

VKAPI_ATTR VkResult VKAPI_CALL surfacePresentModes(VkPhysicalDevice, VkSurfaceKHR, std::uint32_t* count,
                                                   VkPresentModeKHR* modes)
{
    return enumerate(g_fake.modes, count, modes);
}

VKAPI_ATTR VkResult VKAPI_CALL createSwapchain(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                               const VkAllocationCallbacks*, VkSwapchainKHR* swapchain)
{
    const VkResult result = take(g_fake.create);
    if (result != VK_SUCCESS)
    {
        return result;
    }
    g_swapchain_device = device;
    g_fake.last = *info;
    ++g_fake.swapchains_made;
    ++g_fake.swapchains_alive;
    auto* const made = new FakeSwapchain;
    VkImageCreateInfo image{};
    image.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    image.imageType = VK_IMAGE_TYPE_2D;
    image.format = info->imageFormat;
    image.extent = {info->imageExtent.width, info->imageExtent.height, 1};
    image.mipLevels = 1;
    image.arrayLayers = 1;
    image.samples = VK_SAMPLE_COUNT_1_BIT;
    image.usage = info->imageUsage;
    made->images.resize(info->minImageCount);
    for (VkImage& handle : made->images)
    {
        real<PFN_vkCreateImage>(device, "vkCreateImage")(device, &image, nullptr, &handle);
    }
    *swapchain = reinterpret_cast<VkSwapchainKHR>(made);
    return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL destroySwapchain(VkDevice device, VkSwapchainKHR swapchain, const VkAllocationCallbacks*)
{
    auto* const made = reinterpret_cast<FakeSwapchain*>(swapchain);
    if (made == nullptr)
    {
        return;
    }
    for (const VkImage image : made->images)
    {
        real<PFN_vkDestroyImage>(device, "vkDestroyImage")(device, image, nullptr);
    }
    delete made;
    --g_fake.swapchains_alive;
}

VKAPI_ATTR VkResult VKAPI_CALL swapchainImages(VkDevice, VkSwapchainKHR swapchain, std::uint32_t* count,
                                               VkImage* images)
{
    return enumerate(reinterpret_cast<FakeSwapchain*>(swapchain)->images, count, images);
}

VKAPI_ATTR VkResult VKAPI_CALL acquireNextImage(VkDevice device, VkSwapchainKHR swapchain, std::uint64_t,
                                                VkSemaphore semaphore, VkFence, std::uint32_t* index)
{
    const VkResult result = take(g_fake.acquire);
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR)
    {
        auto& made = *reinterpret_cast<FakeSwapchain*>(swapchain);
        *index = made.next;
        made.next = (made.next + 1) % static_cast<std::uint32_t>(made.images.size());
        submit(device, queueOf(device), VK_NULL_HANDLE, semaphore);
    }
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL queuePresent(VkQueue queue, const VkPresentInfoKHR* info)
{
    ++g_fake.presented;
    submit(g_swapchain_device, queue, info->pWaitSemaphores[0], VK_NULL_HANDLE); // also when presenting fails
    return take(g_fake.present);
}

// Does not pass the name on, as a driver would read the swapchain handle, which is fake.
VKAPI_ATTR VkResult VKAPI_CALL setName(VkDevice, const VkDebugUtilsObjectNameInfoEXT*)
{
    return VK_SUCCESS;
}

PFN_vkVoidFunction fakeOf(const char* name);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL fakeDeviceProcAddr(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction fake = fakeOf(name);
    return fake != nullptr ? fake : g_device_proc_addr(device, name);
}

template <typename Function> PFN_vkVoidFunction plain(Function function)
{
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction fakeOf(const char* name)
{
    static const std::map<std::string_view, PFN_vkVoidFunction> kFakes = {
        {"vkGetDeviceProcAddr", plain(fakeDeviceProcAddr)},
        {"vkDestroySurfaceKHR", plain(destroySurface)},
        {"vkGetPhysicalDeviceSurfaceSupportKHR", plain(surfaceSupport)},
        {"vkGetPhysicalDeviceSurfaceCapabilitiesKHR", plain(surfaceCapabilities)},
        {"vkGetPhysicalDeviceSurfaceFormatsKHR", plain(surfaceFormats)},
        {"vkGetPhysicalDeviceSurfacePresentModesKHR", plain(surfacePresentModes)},
        {"vkCreateSwapchainKHR", plain(createSwapchain)},
        {"vkDestroySwapchainKHR", plain(destroySwapchain)},
        {"vkGetSwapchainImagesKHR", plain(swapchainImages)},
        {"vkAcquireNextImageKHR", plain(acquireNextImage)},
        {"vkQueuePresentKHR", plain(queuePresent)},
        {"vkSetDebugUtilsObjectNameEXT", plain(setName)},
    };
    const auto found = kFakes.find(name);
    return found != kFakes.end() ? found->second : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL fakeInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkGetInstanceProcAddr get = vk::loadVulkan();
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    {
        g_device_proc_addr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(get(instance, name));
    }
    const PFN_vkVoidFunction fake = fakeOf(name);
    return fake != nullptr ? fake : get(instance, name);
}

} // namespace

FakeSurfaces& resetFakeSurfaces()
{
    g_fake = {};
    return g_fake;
}

FakeSurfaces& fakeSurfaces()
{
    return g_fake;
}

PFN_vkGetInstanceProcAddr vulkanWithFakeSurfaces()
{
    return fakeInstanceProcAddr;
}

vk::WindowSupport fakeWindow()
{
    return {{VK_KHR_SURFACE_EXTENSION_NAME}, [](VkInstance, VkPhysicalDevice, std::uint32_t) { return true; }};
}

VkSurfaceKHR makeFakeSurface(VkInstance)
{
    ++g_fake.surfaces_made;
    ++g_fake.surfaces_alive;
    return reinterpret_cast<VkSurfaceKHR>(&g_fake);
}

} // namespace zvo::test
