// SPDX-License-Identifier: MIT
#include "demo/app/window.h"

#include "vk/check.h"
#include "zvo/error.h"

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#define GLFW_INCLUDE_VULKAN
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>

namespace zvo::demo
{

namespace
{

std::string g_glfw_error; // the last error

void onError(int, const char* text)
{
    g_glfw_error = text;
}

[[noreturn]] void throwNoWindow(const char* what)
{
    throw Error(ErrorCode::Device, fmt::format("{}{}{}; zvo render makes pictures without a window", what,
                                               g_glfw_error.empty() ? "" : ": ", g_glfw_error));
}

// In the order of Key, from Space on; the keys before are ranges.
constexpr std::array kSingleKeys = {
    // clang-format off
    GLFW_KEY_SPACE, GLFW_KEY_COMMA, GLFW_KEY_PERIOD, GLFW_KEY_MINUS, GLFW_KEY_EQUAL, GLFW_KEY_LEFT_BRACKET,
    GLFW_KEY_RIGHT_BRACKET, GLFW_KEY_ESCAPE, GLFW_KEY_ENTER, GLFW_KEY_TAB, GLFW_KEY_BACKSPACE, GLFW_KEY_DELETE,
    GLFW_KEY_INSERT, GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_UP, GLFW_KEY_DOWN, GLFW_KEY_HOME, GLFW_KEY_END,
    GLFW_KEY_PAGE_UP, GLFW_KEY_PAGE_DOWN, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_KEY_LEFT_CONTROL,
    GLFW_KEY_RIGHT_CONTROL, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT,
    // clang-format on
};
static_assert(static_cast<std::size_t>(Key::Space) + kSingleKeys.size() == kKeyCount);

std::optional<Key> keyOfGlfw(int code)
{
    const auto inRange = [code](int first, int last, Key key) -> std::optional<Key>
    {
        return code >= first && code <= last ? std::optional(static_cast<Key>(static_cast<int>(key) + code - first))
                                             : std::nullopt;
    };
    for (const std::optional<Key>& key :
         {inRange(GLFW_KEY_A, GLFW_KEY_Z, Key::A), inRange(GLFW_KEY_0, GLFW_KEY_9, Key::Digit0),
          inRange(GLFW_KEY_F1, GLFW_KEY_F12, Key::F1)})
    {
        if (key)
        {
            return key;
        }
    }
    const auto* const single = std::ranges::find(kSingleKeys, code);
    return single == kSingleKeys.end()
               ? std::nullopt
               : std::optional(static_cast<Key>(static_cast<int>(Key::Space) + (single - kSingleKeys.begin())));
}

Modifiers modifiersOf(int bits)
{
    return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0, (bits & GLFW_MOD_ALT) != 0};
}

std::string utf8(unsigned code)
{
    const auto further = [code](int shift) { return static_cast<char>(0x80 | (code >> shift & 0x3F)); };
    const auto first = [code](unsigned marks, int shift) { return static_cast<char>(marks | code >> shift); };
    return code < 0x80      ? std::string{first(0, 0)}
           : code < 0x800   ? std::string{first(0xC0, 6), further(0)}
           : code < 0x10000 ? std::string{first(0xE0, 12), further(6), further(0)}
                            : std::string{first(0xF0, 18), further(12), further(6), further(0)};
}

Window& windowOf(GLFWwindow* window)
{
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void installCallbacks(GLFWwindow* window)
{
    glfwSetKeyCallback(window,
                       [](GLFWwindow* w, int code, int, int action, int modifiers)
                       {
                           const std::optional<Key> key = keyOfGlfw(code);
                           if (key && action != GLFW_REPEAT) // Dear ImGui repeats keys itself
                           {
                               windowOf(w).note(KeyEvent{*key, action != GLFW_RELEASE, modifiersOf(modifiers)});
                           }
                       });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned code) { windowOf(w).note(TextEvent{utf8(code)}); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { windowOf(w).note(MouseMoveEvent{x, y}); });
    glfwSetMouseButtonCallback(window,
                               [](GLFWwindow* w, int button, int action, int modifiers)
                               {
                                   if (button <= GLFW_MOUSE_BUTTON_MIDDLE)
                                   {
                                       windowOf(w).note(MouseButtonEvent{static_cast<MouseButton>(button),
                                                                         action == GLFW_PRESS, modifiersOf(modifiers)});
                                   }
                               });
    static_assert(static_cast<int>(MouseButton::Right) == GLFW_MOUSE_BUTTON_RIGHT &&
                  static_cast<int>(MouseButton::Middle) == GLFW_MOUSE_BUTTON_MIDDLE);
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) { windowOf(w).note(WheelEvent{x, y}); });
    glfwSetWindowSizeCallback(
        window,
        [](GLFWwindow* w, int width, int height) {
            windowOf(w).note(ResizeEvent{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)});
        });
    glfwSetWindowIconifyCallback(window,
                                 [](GLFWwindow* w, int iconified)
                                 {
                                     windowOf(w).noteMinimized(iconified != 0);
                                     windowOf(w).note(MinimizeEvent{iconified != 0});
                                 });
    glfwSetDropCallback(window,
                        [](GLFWwindow* w, int count, const char** paths) {
                            windowOf(w).note(DropEvent{{paths, paths + count}});
                        });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { windowOf(w).noteDamage(); });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { windowOf(w).note(CloseEvent{}); });
}

PictureSize sizeOf(int width, int height)
{
    return {static_cast<std::uint32_t>(std::max(width, 0)), static_cast<std::uint32_t>(std::max(height, 0))};
}

// The size times the first screen's scale, as far as that has room.
PictureSize fitted(PictureSize size)
{
    GLFWmonitor* const screen = glfwGetPrimaryMonitor();
    if (screen == nullptr)
    {
        return size;
    }
    float scale = 1;
    glfwGetMonitorContentScale(screen, &scale, nullptr);
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    glfwGetMonitorWorkarea(screen, &x, &y, &width, &height);
    const auto fit = [scale](std::uint32_t length, int room)
    {
        const auto wanted = static_cast<std::uint32_t>(static_cast<float>(length) * std::max(scale, 1.0F));
        return std::min(wanted, std::max(length, static_cast<std::uint32_t>(std::max(room, 1))));
    };
    return {fit(size.width, width), fit(size.height, height)};
}

} // namespace

Window::Window(PictureSize size, bool scales, const std::string& title)
{
    glfwSetErrorCallback(onError);
    if (glfwInit() == GLFW_FALSE)
    {
        throwNoWindow("there is no display for a window");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    const PictureSize first = scales ? fitted(size) : size;
    m_window = glfwCreateWindow(static_cast<int>(first.width), static_cast<int>(first.height), title.c_str(), nullptr,
                                nullptr);
    if (m_window == nullptr)
    {
        glfwTerminate();
        throwNoWindow("the window system opens no window");
    }
    if (uiScale() == 1.0F) // GLFW tells the scale of screens, too, whose units are larger than pixels
    {
        glfwSetWindowSize(m_window, static_cast<int>(size.width), static_cast<int>(size.height));
    }
    glfwSetWindowUserPointer(m_window, this);
    installCallbacks(m_window);
}

Window::~Window()
{
    glfwDestroyWindow(m_window);
    glfwTerminate();
}

vk::WindowSupport Window::support() const
{
    std::uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr)
    {
        throwNoWindow("the Vulkan drivers cannot present to this window system");
    }
    return {{names, names + count}, [](VkInstance instance, VkPhysicalDevice device, std::uint32_t queue_family) {
                return glfwGetPhysicalDevicePresentationSupport(instance, device, queue_family) == GLFW_TRUE;
            }};
}

VkSurfaceKHR Window::makeSurface(VkInstance instance) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    const VkResult result = glfwCreateWindowSurface(instance, m_window, nullptr, &surface);
    if (result != VK_SUCCESS)
    {
        throwNoWindow(fmt::format("no surface for the window ({})", vk::resultName(result)).c_str());
    }
    return surface;
}

std::vector<InputEvent> Window::takeEvents(double seconds)
{
    if (seconds > 0)
    {
        glfwWaitEventsTimeout(seconds);
    }
    else
    {
        glfwPollEvents();
    }
    return std::exchange(m_events, {});
}

PictureSize Window::size() const
{
    int width = 0;
    int height = 0;
    glfwGetWindowSize(m_window, &width, &height);
    return m_is_minimized || m_has_no_extent ? PictureSize{} : sizeOf(width, height);
}

PictureSize Window::unscaledSize() const
{
    const PictureSize size = this->size();
    const float scale = uiScale();
    const auto unscaled = [scale](std::uint32_t length)
    { return static_cast<std::uint32_t>(static_cast<float>(length) / scale + 0.5F); };
    return {unscaled(size.width), unscaled(size.height)};
}

PictureSize Window::framebufferSize() const
{
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(m_window, &width, &height);
    return m_is_minimized || m_has_no_extent ? PictureSize{} : sizeOf(width, height);
}

float Window::uiScale() const
{
    float scale = 1;
    glfwGetWindowContentScale(m_window, &scale, nullptr);
    int window_width = 0;
    int pixel_width = 0;
    glfwGetWindowSize(m_window, &window_width, nullptr);
    glfwGetFramebufferSize(m_window, &pixel_width, nullptr);
    // Units that are larger than pixels already contain a part of the scale.
    const float unit = window_width > 0 ? static_cast<float>(pixel_width) / static_cast<float>(window_width) : 1.0F;
    return std::clamp(scale / std::max(unit, 1.0F), 1.0F, 4.0F);
}

void Window::resize(PictureSize size)
{
    m_has_no_extent = size.width == 0 || size.height == 0;
    if (m_has_no_extent) // the window system may refuse it, so only size() changes
    {
        return;
    }
    glfwSetWindowSize(m_window, static_cast<int>(size.width), static_cast<int>(size.height));
    constexpr std::chrono::seconds kPatience(1);
    const auto start = std::chrono::steady_clock::now();
    while (this->size() != size && std::chrono::steady_clock::now() - start < kPatience)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        glfwPollEvents();
    }
}

void Window::minimize(bool minimized)
{
    (minimized ? glfwIconifyWindow : glfwRestoreWindow)(m_window);
    m_is_minimized = minimized;
}

void Window::setTitle(const std::string& title)
{
    glfwSetWindowTitle(m_window, title.c_str());
}

std::string Window::clipboard() const
{
    const char* const text = glfwGetClipboardString(m_window);
    return text != nullptr ? text : "";
}

void Window::setClipboard(const std::string& text)
{
    glfwSetClipboardString(m_window, text.c_str());
}

} // namespace zvo::demo
