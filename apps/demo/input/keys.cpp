// SPDX-License-Identifier: MIT
#include "demo/input/keys.h"

#include <fmt/format.h>

#include <algorithm>

namespace zvo::demo
{

const KeyBinding* bindingOf(const KeyEvent& event)
{
    const auto* const found =
        std::ranges::find_if(kKeyBindings,
                             [&](const KeyBinding& binding)
                             {
                                 return binding.action != Action::None && binding.key <= event.key &&
                                        event.key <= binding.last_key && binding.shift == event.modifiers.shift &&
                                        binding.control == event.modifiers.control && !event.modifiers.alt;
                             });
    return event.pressed && found != kKeyBindings.end() ? found : nullptr;
}

std::string keyTableText()
{
    std::string text = "| key | what it does |\n|---|---|\n";
    for (const KeyBinding& binding : kKeyBindings)
    {
        text += fmt::format("| {} | {} |\n", binding.keys, binding.what);
    }
    return text;
}

} // namespace zvo::demo
