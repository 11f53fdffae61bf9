// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "demo/input/input_event.h"
#include "demo/world/compose.h"
#include "vk/headless.h"

#include <array>
#include <functional>
#include <string>
#include <utility>

namespace zvo::demo
{

class Window;

/// Dear ImGui: its context, and its Vulkan backend, which allocates for itself beside the device's memory limit. Input
/// comes from events alone, so that a script does all that a user does. One in a process.
class Ui
{
public:
    /// The state of a mouse button or key as Dear ImGui sees it: down for at least one frame, however short it was.
    class Button
    {
    public:
        void take(bool pressed)
        {
            m_is_down = pressed;
            m_was_pressed = m_was_pressed || pressed;
        }
        bool forFrame() { return std::exchange(m_was_pressed, false) || m_is_down; }

    private:
        bool m_is_down = false;
        bool m_was_pressed = false; // since the last frame
    };

    /// frames_in_flight: frames that are drawn before the device is done with the first of them. Waits for the device.
    Ui(vk::HeadlessDevice& device, const ComposePass& pass, Window& window, std::uint32_t frames_in_flight);

    /// The device must be done with all frames.
    ~Ui();
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;

    /// Handles an event. Returns whether it was meant for the panels, so that nobody else handles it.
    bool handle(const InputEvent& event);

    /// Builds a frame of the panels by calling `panels`, in a window of this size. seconds: since the last frame.
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
    std::array<Button, kMouseButtonCount> m_buttons;
    std::array<Button, kKeyCount> m_keys;
    std::string m_clipboard; // last text given to Dear ImGui
};

} // namespace zvo::demo
