// SPDX-License-Identifier: MIT
#pragma once

#include "core/present.h"
#include "demo/compose.h"
#include "demo/input_event.h"
#include "vk/headless.h"

#include <functional>
#include <string>

namespace zvo::demo
{

class Window;

/// Dear ImGui: its context, and its Vulkan backend, which allocates for itself beside the device's memory limit. Input
/// comes from events alone, so that a script does all that a user does. One in a process.
class Ui
{
public:
    /// frames_in_flight: that are drawn before the device is done with the first. Waits for the device.
    Ui(vk::HeadlessDevice& device, const ComposePass& pass, Window& window, std::uint32_t frames_in_flight);

    /// The device is done with all frames.
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    /// Takes an event. Whether it was meant for the panels, and for nobody else.
    bool handle(const InputEvent& event);

    /// A frame of the panels that panels builds, in a window of this size. seconds: since the last one.
    void build(PictureSize window, PictureSize framebuffer, double seconds, const std::function<void()>& panels);

    /// Draws the frame that was built last.
    void draw(VkCommandBuffer commands);

private:
    void setUpKeys();
    void makeDescriptorPool();

    vk::HeadlessDevice& m_device;
    Window& m_window;
    VkDescriptorPool m_descriptors = VK_NULL_HANDLE;
    float m_scale;
    std::string m_clipboard; // that Dear ImGui was given last
};

} // namespace zvo::demo
