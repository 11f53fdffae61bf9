// SPDX-License-Identifier: MIT
#include "demo/input/keys.h"

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

} // namespace zvo::demo
