// SPDX-License-Identifier: MIT
// Events of the window, in order, from the window system or from a script.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace zvo::demo
{

/// The keys that the program or text fields use.
enum class Key : std::uint8_t
{
    // clang-format off
    A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z,
    Digit0, Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9,
    F1, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12,
    Space, Comma, Period, Minus, Equal, LeftBracket, RightBracket,
    Escape, Enter, Tab, Backspace, Delete, Insert, Left, Right, Up, Down, Home, End, PageUp, PageDown,
    LeftShift, RightShift, LeftControl, RightControl, LeftAlt, RightAlt,
    // clang-format on
};
inline constexpr std::size_t kKeyCount = static_cast<std::size_t>(Key::RightAlt) + 1;

/// The key's name in scripts and in the table of keys: "W", "1", "F5", "Space".
std::string_view keyName(Key key);
std::optional<Key> keyOf(std::string_view name);

/// Modifier keys that are held while another key or a button is pressed.
struct Modifiers
{
    bool shift = false;
    bool control = false;
    bool alt = false;

    bool operator==(const Modifiers&) const = default;
};

enum class MouseButton : std::uint8_t
{
    Left,
    Right,
    Middle
};
inline constexpr std::size_t kMouseButtonCount = 3;

struct KeyEvent
{
    Key key = Key::Escape;
    bool pressed = false; // or released
    Modifiers modifiers = {};

    bool operator==(const KeyEvent&) const = default;
};

/// A character that was typed.
struct TextEvent
{
    std::string text; // UTF-8

    bool operator==(const TextEvent&) const = default;
};

/// The pointer's position, from the window's top left corner, in the window's units. On high-density screens a unit has
/// several pixels.
struct MouseMoveEvent
{
    double x = 0;
    double y = 0;

    bool operator==(const MouseMoveEvent&) const = default;
};

struct MouseButtonEvent
{
    MouseButton button = MouseButton::Left;
    bool pressed = false;
    Modifiers modifiers = {};

    bool operator==(const MouseButtonEvent&) const = default;
};

struct WheelEvent
{
    double x = 0; // notches to the right
    double y = 0; // notches away from the user

    bool operator==(const WheelEvent&) const = default;
};

/// The window's new size in its own units. Without an extent nothing is drawn.
struct ResizeEvent
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    bool operator==(const ResizeEvent&) const = default;
};

struct MinimizeEvent
{
    bool minimized = false;

    bool operator==(const MinimizeEvent&) const = default;
};

struct DropEvent
{
    std::vector<std::filesystem::path> files;

    bool operator==(const DropEvent&) const = default;
};

/// A request to close the window.
struct CloseEvent
{
    bool operator==(const CloseEvent&) const = default;
};

using InputEvent = std::variant<KeyEvent, TextEvent, MouseMoveEvent, MouseButtonEvent, WheelEvent, ResizeEvent,
                                MinimizeEvent, DropEvent, CloseEvent>;

} // namespace zvo::demo
