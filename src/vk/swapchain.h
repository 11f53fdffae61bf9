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

/// How finished pictures wait for the screen.
enum class PresentMode
{
    Fifo,      ///< one after the other at the screen's pace; every device has it
    Mailbox,   ///< at the screen's pace, the last one that is finished
    Immediate, ///< at once, maybe torn
};

/// How a Swapchain is made.
struct SwapchainOptions
{
    PresentMode mode = PresentMode::Fifo; // Fifo where the surface does not have it
    std::uint32_t frames_in_flight = 2;   // for which images are acquired before the device is done with the first
};

/// An image of the swapchain for one frame. The frame's submission waits for `available` before it writes the image, at
/// the stage that does so, leaves it in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR and signals `presentable`.
struct SwapchainImage
{
    std::uint32_t index = 0;
    VkImage image = VK_NULL_HANDLE; // its contents and its layout are undefined
    VkExtent2D extent{};
    VkSemaphore available = VK_NULL_HANDLE;
    VkSemaphore presentable = VK_NULL_HANDLE;
};

/// Whether writing linear colours to the format encodes them as sRGB.
bool encodesSrgb(VkFormat format);

/// The format to take for a picture of 8-bit sRGB codes: one that keeps codes as they are if there is any, with the
/// usual colour space. takes_blits: whether a format can be the target of a blit. Nothing if none of them can.
std::optional<VkSurfaceFormatKHR> chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> formats,
                                                      const std::function<bool(VkFormat)>& takes_blits);

/// The images that a window shows, as targets of blits. They are made anew when the window's size changes, when they
/// fit the surface no more, and when the surface was lost; old ones go when the device is done with their frames.
class Swapchain
{
public:
    using MakeSurface = std::function<VkSurfaceKHR(VkInstance)>;

    /// make_surface: makes the window's surface, again whenever it was lost; may throw. device was made with
    /// HeadlessOptions::window. Throws Error{Device} where the surface cannot be presented to.
    Swapchain(HeadlessDevice& device, MakeSurface make_surface, const SwapchainOptions& options);

    /// Waits for the device.
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// An image for the frame with this number, upwards from 0, in a window of that many pixels. Nothing for a window
    /// without pixels, and where none is to be had at the moment: the frame is not shown then. An image that was
    /// acquired has to be presented. The device is done with the frame frames_in_flight before. Throws as above, and
    /// Error{Other} on a lost device.
    std::optional<SwapchainImage> acquire(VkExtent2D framebuffer, std::uint64_t frame);

    /// Shows an image; its frame was submitted.
    void present(const SwapchainImage& image);

    /// The device is done with that frame and all before it.
    void frameDone(std::uint64_t frame) { m_deletion_queue.frameDone(frame); }

    /// From the next acquire() on.
    void setMode(PresentMode mode);

    /// The mode in use: Fifo where the surface does not have the one that was asked for.
    [[nodiscard]] PresentMode mode() const { return m_mode; }
    [[nodiscard]] VkFormat format() const { return m_format.format; }

    /// How often images were made.
    [[nodiscard]] std::uint32_t generation() const { return m_generation; }

private:
    struct Chain;

    void makeSurface();
    void loseSurface();
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
    bool m_is_stale = false;    // they are to be made anew
    bool m_is_lost = false;     // the surface
    std::uint32_t m_generation = 0;
    std::unique_ptr<Chain> m_chain;
    std::vector<VkSemaphore> m_available; // in turns
    DeletionQueue m_deletion_queue;
};

} // namespace zvo::vk
