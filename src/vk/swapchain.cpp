// SPDX-License-Identifier: MIT
#include "vk/swapchain.h"

#include "vk/check.h"
#include "vk/headless.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo::vk
{

namespace
{

constexpr std::uint64_t kAcquireNs = 1'000'000'000; // after this time the frame gets no image
constexpr std::uint32_t kNoExtent = UINT32_MAX;     // the surface takes the size of its images

VkSemaphore makeSemaphore(Device& device, const char* name)
{
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    VK_CHECK(device.fn().vkCreateSemaphore(device.handle(), &info, device.allocationCallbacks(), &semaphore));
    device.setName(VK_OBJECT_TYPE_SEMAPHORE, reinterpret_cast<std::uint64_t>(semaphore), name);
    return semaphore;
}

bool isRecoverable(VkResult result)
{
    return result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR;
}

VkPresentModeKHR vulkanMode(PresentMode mode)
{
    switch (mode)
    {
    case PresentMode::Mailbox:
        return VK_PRESENT_MODE_MAILBOX_KHR;
    case PresentMode::Immediate:
        return VK_PRESENT_MODE_IMMEDIATE_KHR;
    case PresentMode::Fifo:
        break;
    }
    return VK_PRESENT_MODE_FIFO_KHR;
}

VkExtent2D extentFor(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D framebuffer)
{
    if (capabilities.currentExtent.width != kNoExtent)
    {
        return capabilities.currentExtent;
    }
    return {std::clamp(framebuffer.width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
            std::clamp(framebuffer.height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
}

VkCompositeAlphaFlagBitsKHR compositeAlpha(const VkSurfaceCapabilitiesKHR& capabilities)
{
    for (const VkCompositeAlphaFlagBitsKHR alpha :
         {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
          VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR})
    {
        if ((capabilities.supportedCompositeAlpha & alpha) != 0)
        {
            return alpha;
        }
    }
    return VK_COMPOSITE_ALPHA_POST_MULTIPLIED_BIT_KHR;
}

} // namespace

// A VkSwapchainKHR with its images.
struct Swapchain::Chain
{
    explicit Chain(Device& owner) : device(owner) {}
    ~Chain()
    {
        for (const VkSemaphore semaphore : presentable)
        {
            device.fn().vkDestroySemaphore(device.handle(), semaphore, device.allocationCallbacks());
        }
        device.fn().vkDestroySwapchainKHR(device.handle(), handle, device.allocationCallbacks());
    }
    Chain(const Chain&) = delete;
    Chain& operator=(const Chain&) = delete;

    void takeImages()
    {
        std::uint32_t count = 0;
        VK_CHECK(device.fn().vkGetSwapchainImagesKHR(device.handle(), handle, &count, nullptr));
        images.resize(count);
        VK_CHECK(device.fn().vkGetSwapchainImagesKHR(device.handle(), handle, &count, images.data()));
        for (const VkImage image : images)
        {
            device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(image), "swapchain image");
            presentable.push_back(makeSemaphore(device, "swapchain image is presentable"));
        }
    }

    Device& device;
    VkSwapchainKHR handle = VK_NULL_HANDLE;
    VkExtent2D extent{};
    std::vector<VkImage> images;
    std::vector<VkSemaphore> presentable; // [image] free again when the image is
};

bool encodesSrgb(VkFormat format)
{
    constexpr VkFormat kSrgb[] = {VK_FORMAT_R8G8B8_SRGB, VK_FORMAT_B8G8R8_SRGB, VK_FORMAT_R8G8B8A8_SRGB,
                                  VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_A8B8G8R8_SRGB_PACK32};
    return std::ranges::find(kSrgb, format) != std::end(kSrgb);
}

std::optional<VkSurfaceFormatKHR> chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> formats,
                                                      const std::function<bool(VkFormat)>& takes_blits)
{
    // The lowest rank is the best.
    const auto rank = [](const VkSurfaceFormatKHR& format)
    {
        constexpr VkFormat kPlain[] = {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM,
                                       VK_FORMAT_A8B8G8R8_UNORM_PACK32};
        const bool is_plain = std::ranges::find(kPlain, format.format) != std::end(kPlain);
        const bool has_usual_space = format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
        return (has_usual_space ? 0 : 4) + (is_plain ? 0 : encodesSrgb(format.format) ? 2 : 1);
    };
    std::optional<VkSurfaceFormatKHR> best;
    for (VkSurfaceFormatKHR format : formats)
    {
        // Old drivers report UNDEFINED if any format is allowed.
        format.format = format.format == VK_FORMAT_UNDEFINED ? VK_FORMAT_B8G8R8A8_UNORM : format.format;
        if (takes_blits(format.format) && (!best || rank(format) < rank(*best)))
        {
            best = format;
        }
    }
    return best;
}

Swapchain::Swapchain(HeadlessDevice& device, MakeSurface make_surface, const SwapchainOptions& options)
    : m_device(device), m_make_surface(std::move(make_surface)), m_options(options)
{
    try
    {
        for (std::uint32_t i = 0; i <= options.frames_in_flight; ++i)
        {
            m_available.push_back(makeSemaphore(device.device(), "swapchain image is available"));
        }
        makeSurface();
    }
    catch (...)
    {
        destroy();
        throw;
    }
}

Swapchain::~Swapchain()
{
    destroy();
}

void Swapchain::destroy()
{
    Device& device = m_device.device();
    device.fn().vkDeviceWaitIdle(device.handle());
    m_deletion_queue.frameDone(UINT64_MAX);
    m_chain = nullptr;
    for (const VkSemaphore semaphore : m_available)
    {
        device.fn().vkDestroySemaphore(device.handle(), semaphore, device.allocationCallbacks());
    }
    if (m_surface != VK_NULL_HANDLE)
    {
        device.fn().vkDestroySurfaceKHR(device.handles().instance, m_surface, nullptr);
    }
}

void Swapchain::makeSurface()
{
    const Device& device = m_device.device();
    m_surface = m_make_surface(device.handles().instance);
    VkBool32 presents = VK_FALSE;
    VK_CHECK(device.fn().vkGetPhysicalDeviceSurfaceSupportKHR(device.handles().physical_device,
                                                              device.handles().queue_family, m_surface, &presents));
    if (presents == VK_FALSE)
    {
        throw Error(ErrorCode::Device, fmt::format("the Vulkan device {} cannot show pictures in this window: choose "
                                                   "another one with --device",
                                                   device.report().name));
    }
    chooseFormat();
}

// Drops the surface; the next acquire() makes another one.
void Swapchain::loseSurface()
{
    Device& device = m_device.device();
    device.fn().vkDeviceWaitIdle(device.handle());
    m_deletion_queue.frameDone(UINT64_MAX);
    m_chain = nullptr;
    device.fn().vkDestroySurfaceKHR(device.handles().instance, std::exchange(m_surface, VK_NULL_HANDLE), nullptr);
    m_is_lost = false;
    makeSurface();
}

void Swapchain::chooseFormat()
{
    const Device& device = m_device.device();
    const VkPhysicalDevice physical = device.handles().physical_device;
    std::uint32_t count = 0;
    VK_CHECK(device.fn().vkGetPhysicalDeviceSurfaceFormatsKHR(physical, m_surface, &count, nullptr));
    std::vector<VkSurfaceFormatKHR> formats(count);
    VK_CHECK(device.fn().vkGetPhysicalDeviceSurfaceFormatsKHR(physical, m_surface, &count, formats.data()));
    const auto takes_blits = [&](VkFormat format)
    {
        VkFormatProperties properties{};
        device.fn().vkGetPhysicalDeviceFormatProperties(physical, format, &properties);
        return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_BLIT_DST_BIT) != 0;
    };
    const std::optional<VkSurfaceFormatKHR> chosen = chooseSurfaceFormat(formats, takes_blits);
    if (!chosen)
    {
        throw Error(ErrorCode::Device,
                    fmt::format("the Vulkan device {} has no format in which this window can show pictures: choose "
                                "another one with --device",
                                device.report().name));
    }
    m_format = *chosen;
}

void Swapchain::setMode(PresentMode mode)
{
    m_is_stale = m_is_stale || mode != m_options.mode;
    m_options.mode = mode;
}

VkPresentModeKHR Swapchain::presentMode()
{
    const Device& device = m_device.device();
    std::uint32_t count = 0;
    VK_CHECK(device.fn().vkGetPhysicalDeviceSurfacePresentModesKHR(device.handles().physical_device, m_surface, &count,
                                                                   nullptr));
    std::vector<VkPresentModeKHR> modes(count);
    VK_CHECK(device.fn().vkGetPhysicalDeviceSurfacePresentModesKHR(device.handles().physical_device, m_surface, &count,
                                                                   modes.data()));
    const VkPresentModeKHR wanted = vulkanMode(m_options.mode);
    const bool has_it = std::ranges::find(modes, wanted) != modes.end();
    m_mode = has_it ? m_options.mode : PresentMode::Fifo;
    return vulkanMode(m_mode);
}

VkSwapchainCreateInfoKHR Swapchain::chainInfo(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D extent)
{
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = m_surface;
    info.minImageCount = std::max(capabilities.minImageCount, m_options.frames_in_flight + 1);
    if (capabilities.maxImageCount != 0)
    {
        info.minImageCount = std::min(info.minImageCount, capabilities.maxImageCount);
    }
    info.imageFormat = m_format.format;
    info.imageColorSpace = m_format.colorSpace;
    info.imageExtent = extent;
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.preTransform = capabilities.currentTransform;
    info.compositeAlpha = compositeAlpha(capabilities);
    info.presentMode = presentMode();
    info.clipped = VK_TRUE;
    return info;
}

// Images for a window of that many pixels. Leaves m_chain empty where the window has none at the moment.
VkResult Swapchain::make(VkExtent2D framebuffer)
{
    Device& device = m_device.device();
    VkSurfaceCapabilitiesKHR capabilities{};
    const VkResult result = device.fn().vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.handles().physical_device,
                                                                                  m_surface, &capabilities);
    if (isRecoverable(result))
    {
        return result;
    }
    VK_CHECK(result);
    if ((capabilities.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) == 0)
    {
        throw Error(ErrorCode::Device, fmt::format("the window's images cannot be copied to by the Vulkan device {}: "
                                                   "choose another one with --device",
                                                   device.report().name));
    }
    const VkExtent2D extent = extentFor(capabilities, framebuffer);
    if (extent.width == 0 || extent.height == 0)
    {
        return VK_ERROR_OUT_OF_DATE_KHR;
    }
    VkSwapchainCreateInfoKHR info = chainInfo(capabilities, extent);
    // The old one is retired whether or not there is a new one.
    if (m_chain != nullptr)
    {
        info.oldSwapchain = m_chain->handle;
        m_deletion_queue.keep(std::move(m_chain));
    }
    auto chain = std::make_unique<Chain>(device);
    chain->extent = extent;
    const VkResult made =
        device.fn().vkCreateSwapchainKHR(device.handle(), &info, device.allocationCallbacks(), &chain->handle);
    if (isRecoverable(made))
    {
        return made;
    }
    VK_CHECK(made);
    device.setName(VK_OBJECT_TYPE_SWAPCHAIN_KHR, reinterpret_cast<std::uint64_t>(chain->handle), "window");
    chain->takeImages();
    m_chain = std::move(chain);
    m_framebuffer = framebuffer;
    m_is_stale = false;
    ++m_generation;
    return VK_SUCCESS;
}

VkResult Swapchain::tryAcquire(VkExtent2D framebuffer, std::uint64_t frame, std::optional<SwapchainImage>& image)
{
    const bool fits = framebuffer.width == m_framebuffer.width && framebuffer.height == m_framebuffer.height;
    if (m_chain == nullptr || m_is_stale || !fits)
    {
        const VkResult made = make(framebuffer);
        if (made != VK_SUCCESS)
        {
            return made;
        }
    }
    const Device& device = m_device.device();
    const VkSemaphore available = m_available[frame % m_available.size()];
    std::uint32_t index = 0;
    const VkResult result = device.fn().vkAcquireNextImageKHR(device.handle(), m_chain->handle, kAcquireNs, available,
                                                              VK_NULL_HANDLE, &index);
    if (result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR)
    {
        m_is_stale = m_is_stale || result == VK_SUBOPTIMAL_KHR; // the images still fit this frame
        image = SwapchainImage{index, m_chain->images[index], m_chain->extent, available, m_chain->presentable[index]};
    }
    return result;
}

std::optional<SwapchainImage> Swapchain::acquire(VkExtent2D framebuffer, std::uint64_t frame)
{
    constexpr int kAttempts = 3; // a window that is being resized can be out of date again at once
    m_deletion_queue.beginFrame(frame);
    std::optional<SwapchainImage> image;
    if (framebuffer.width == 0 || framebuffer.height == 0)
    {
        return image;
    }
    for (int attempt = 0; attempt < kAttempts && !image; ++attempt)
    {
        if (m_is_lost)
        {
            loseSurface();
        }
        const VkResult result = tryAcquire(framebuffer, frame, image);
        if (result == VK_TIMEOUT || result == VK_NOT_READY)
        {
            break;
        }
        m_is_lost = result == VK_ERROR_SURFACE_LOST_KHR;
        m_is_stale = m_is_stale || result == VK_ERROR_OUT_OF_DATE_KHR;
        if (!isRecoverable(result))
        {
            VK_CHECK(result);
        }
    }
    return image;
}

void Swapchain::present(const SwapchainImage& image)
{
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &image.presentable;
    info.swapchainCount = 1;
    info.pSwapchains = &m_chain->handle;
    info.pImageIndices = &image.index;
    const VkResult result = m_device.device().fn().vkQueuePresentKHR(m_device.queue(), &info);
    m_is_stale = m_is_stale || result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR;
    m_is_lost = m_is_lost || result == VK_ERROR_SURFACE_LOST_KHR;
    if (!isRecoverable(result))
    {
        VK_CHECK(result);
    }
}

} // namespace zvo::vk
