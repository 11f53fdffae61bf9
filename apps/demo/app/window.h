// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "demo/input/input_event.h"
#include "vk/window_support.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace zvo::demo
{

/// A window of the window system, by GLFW. One in a process.
class Window
{
public:
    /// Of size in the window's units; scales: times the system's scale, and not larger than the screen. Throws
    /// Error{Device} where there is no display.
    Window(PictureSize size, bool scales, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// What Vulkan needs to present to it.
    [[nodiscard]] vk::WindowSupport support() const;

    /// A surface for swapchains. Throws Error{Device}.
    [[nodiscard]] VkSurfaceKHR makeSurface(VkInstance instance) const;

    /// What has happened since the last call. seconds: how long to wait until something does; 0: not at all.
    std::vector<InputEvent> takeEvents(double seconds);

    /// Size in the window's units; nothing while it is minimised.
    [[nodiscard]] PictureSize size() const;

    /// size() without the system's scale, for another window that has one.
    [[nodiscard]] PictureSize unscaledSize() const;

    /// Size in pixels.
    [[nodiscard]] PictureSize framebufferSize() const;

    /// How much larger than usual the system wants things to be shown, in the window's units.
    [[nodiscard]] float uiScale() const;

    /// Asks for another size and waits for it, but not for long: the window system has the last word. Without an
    /// extent, size() is that from now on, whatever the system shows.
    void resize(PictureSize size);

    /// As if the system had minimised or restored it, which it is asked to do.
    void minimize(bool minimized);

    void setTitle(const std::string& title);

    [[nodiscard]] std::string clipboard() const;
    void setClipboard(const std::string& text);

    /// Callbacks of the window system put events here.
    template <typename Event> void note(Event event) { m_events.emplace_back(std::move(event)); }
    void noteMinimized(bool minimized) { m_is_minimized = minimized; }
    void noteDamage() { m_is_damaged = true; }

    /// Whether the window system has asked for the contents since the last call.
    bool takeDamage() { return std::exchange(m_is_damaged, false); }

private:
    GLFWwindow* m_window = nullptr;
    std::vector<InputEvent> m_events;
    bool m_is_damaged = false;
    bool m_is_minimized = false;
    bool m_has_no_extent = false; // because resize() said so
};

} // namespace zvo::demo
