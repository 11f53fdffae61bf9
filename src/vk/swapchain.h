// SPDX-License-Identifier: MIT
#pragma once

#include "vk/deletion_queue.h"
#include "vk/functions.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace zvo::vk
{

class HeadlessDevice;

/// How finished pictures are passed to the screen.
enum class PresentMode
{
    Fifo,      ///< one after the other at the screen's pace; every device has it
    Mailbox,   ///< at the screen's pace, the last one that is finished
    Immediate, ///< at once, possibly with tearing
};

/// Options of a Swapchain.
struct SwapchainOptions
{
    PresentMode mode = PresentMode::Fifo; // Fifo where the surface does not have it
    std::uint32_t frames_in_flight = 2;   // images are acquired for so many frames at once
};

/// An image of the swapchain for one frame. The frame's submission must wait for `available` in the stage that writes
/// the image, leave the image in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, and signal `presentable`.
struct SwapchainImage
{
    std::uint32_t index = 0;
    VkImage image = VK_NULL_HANDLE; // its contents and its layout are undefined
    VkExtent2D extent{};
    VkSemaphore available = VK_NULL_HANDLE;
    VkSemaphore presentable = VK_NULL_HANDLE;
};

/// Whether linear colours are encoded as sRGB when they are written to an image of the format.
bool encodesSrgb(VkFormat format);

/// The format to choose for a picture of 8-bit sRGB codes, with the usual colour space: one that stores codes
/// unchanged, if there is any. takes_blits: tells whether a format can be the target of a blit. Nothing if no format
/// can.
std::optional<VkSurfaceFormatKHR> chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> formats,
                                                      const std::function<bool(VkFormat)>& takes_blits);

/// The images that a window shows, as targets of blits. They are made anew when the size of the window changes, when
/// they no longer fit the surface, and when the surface was lost. Old images are freed when the device is done with
/// their frames.
class Swapchain
{
public:
    using MakeSurface = std::function<VkSurfaceKHR(VkInstance)>;

    /// make_surface: makes the window's surface; called again whenever the surface was lost; may throw. device must
    /// have been made with HeadlessOptions::window. Throws Error{Device} if the device cannot present to the surface.
    Swapchain(HeadlessDevice& device, MakeSurface make_surface, const SwapchainOptions& options);

    /// Waits for the device.
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Acquires an image for a frame. Frame numbers ascend from 0; the device must be done with the frame that is
    /// frames_in_flight before this one. Returns nothing for a window without pixels, and when no image is available at
    /// the moment; such a frame is not shown. An image that was acquired must be presented before the next acquire();
    /// where its frame cannot be submitted, the Swapchain must be destroyed. Throws as the constructor, and
    /// Error{Other} on a lost device.
    std::optional<SwapchainImage> acquire(VkExtent2D framebuffer, std::uint64_t frame);

    /// Shows an image, after the frame was submitted.
    void present(const SwapchainImage& image);

    /// Tells that the device is done with a frame and all frames before it.
    void frameDone(std::uint64_t frame) { m_deletion_queue.frameDone(frame); }

    /// Sets the mode from the next acquire() on.
    void setMode(PresentMode mode);

    /// The mode in use: Fifo if the surface does not have the mode that was asked for.
    [[nodiscard]] PresentMode mode() const { return m_mode; }
    [[nodiscard]] VkFormat format() const { return m_format.format; }

    /// How often the images were made.
    [[nodiscard]] std::uint32_t generation() const { return m_generation; }

private:
    struct Chain;

    void makeSurface();
    void loseSurface();
    VkSwapchainCreateInfoKHR chainInfo(const VkSurfaceCapabilitiesKHR& capabilities, VkExtent2D extent);
    VkResult make(VkExtent2D framebuffer);
    VkResult tryAcquire(VkExtent2D framebuffer, std::uint64_t frame, std::optional<SwapchainImage>& image);
    void chooseFormat();
    [[nodiscard]] VkPresentModeKHR presentMode();
    void destroy();

    HeadlessDevice& m_device;
    MakeSurface m_make_surface;
    SwapchainOptions m_options;
    VkSurfaceKHR m_surface = VK_NULL_HANDLE;
    VkSurfaceFormatKHR m_format{};
    PresentMode m_mode = PresentMode::Fifo;
    VkExtent2D m_framebuffer{}; // that the images were made for
    bool m_is_stale = false;    // the images have to be made anew
    bool m_is_lost = false;     // the surface was lost
    std::uint32_t m_generation = 0;
    std::unique_ptr<Chain> m_chain;
    std::vector<VkSemaphore> m_available; // in turns
    DeletionQueue m_deletion_queue;
};

} // namespace zvo::vk
