// SPDX-License-Identifier: MIT
// Input events as JSON, each with the frame before which it happens. Scripts are recorded and played.
//
//     {"schema": "zvo.input/1", "events": [
//         {"frame": 3, "key": "W", "pressed": true, "modifiers": ["shift"]},
//         {"frame": 4, "text": "a"},
//         {"frame": 4, "move": [320, 200]},
//         {"frame": 5, "button": "left", "pressed": true},
//         {"frame": 6, "wheel": [0, 1]},
//         {"frame": 7, "resize": [640, 360]},
//         {"frame": 8, "minimised": true},
//         {"frame": 9, "drop": ["scene.glb"]},
//         {"frame": 10, "close": true}]}
//
// Frames must not decrease; modifiers may be left out. Paths are relative to the working folder.
#pragma once

#include "demo/input/input_event.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::demo
{

/// An event, and the frame before which it happens.
struct ScriptedEvent
{
    std::uint64_t frame = 0;
    InputEvent event;

    bool operator==(const ScriptedEvent&) const = default;
};

/// The events in a script. Throws Error{Input}, one line that begins with file.
std::vector<ScriptedEvent> parseInputScript(std::string_view text, const std::filesystem::path& file);
std::vector<ScriptedEvent> readInputScript(const std::filesystem::path& file);

/// A script with these events, which parseInputScript() reads.
std::string inputScriptText(std::span<const ScriptedEvent> events);

/// Events of a script, frame by frame.
class InputReplay
{
public:
    explicit InputReplay(std::vector<ScriptedEvent> events) : m_events(std::move(events)) {}

    /// The events before a frame that were not taken yet.
    std::vector<InputEvent> take(std::uint64_t frame);

private:
    std::vector<ScriptedEvent> m_events;
    std::size_t m_next = 0;
};

} // namespace zvo::demo
