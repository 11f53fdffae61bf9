// SPDX-License-Identifier: MIT
#include "demo/input/input_event.h"

#include <algorithm>
#include <array>

namespace zvo::demo
{

namespace
{

// In the order of Key.
constexpr std::array<std::string_view, kKeyCount> kNames = {
    // clang-format off
    "A", "B", "C", "D", "E", "F", "G", "H", "I", "J", "K", "L", "M", "N", "O", "P", "Q", "R", "S", "T", "U", "V", "W",
    "X", "Y", "Z", "0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8",
    "F9", "F10", "F11", "F12", "Space", "Comma", "Period", "Minus", "Equal", "LeftBracket", "RightBracket", "Escape",
    "Enter", "Tab", "Backspace", "Delete", "Insert", "Left", "Right", "Up", "Down", "Home", "End", "PageUp",
    "PageDown", "LeftShift", "RightShift", "LeftCtrl", "RightCtrl", "LeftAlt", "RightAlt",
    // clang-format on
};
static_assert(!kNames.back().empty());

} // namespace

std::string_view keyName(Key key)
{
    return kNames[static_cast<std::size_t>(key)];
}

std::optional<Key> keyOf(std::string_view name)
{
    const auto found = std::ranges::find(kNames, name);
    return found == kNames.end() ? std::nullopt : std::optional(static_cast<Key>(found - kNames.begin()));
}

} // namespace zvo::demo
