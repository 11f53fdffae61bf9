// SPDX-License-Identifier: MIT
#include "demo/input/input_script.h"

#include "core/base/read_file.h"
#include "io/file/json_cursor.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace zvo::demo
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* kInputSchema = "zvo.input/1";
constexpr std::uint32_t kFrameMax = 1'000'000'000;
constexpr std::uint32_t kEdgeMax = 16384; // of a window
constexpr double kWheelMax = 1000;
constexpr std::array<std::string_view, kMouseButtonCount> kButtonNames = {"left", "right", "middle"};

// Whether all bytes but one are further bytes of a character.
bool isOneCharacter(std::string_view utf8)
{
    const auto begins = [](char byte) { return (byte & 0xC0) != 0x80; };
    return std::ranges::count_if(utf8, begins) == 1;
}

Modifiers readModifiers(const JsonCursor& event)
{
    Modifiers modifiers;
    if (const auto names = event.find("modifiers"))
    {
        for (const JsonCursor& name : names->items())
        {
            const std::size_t which = name.oneOf({"shift", "ctrl", "alt"});
            (which == 0 ? modifiers.shift : which == 1 ? modifiers.control : modifiers.alt) = true;
        }
    }
    return modifiers;
}

std::array<double, 2> readPair(const JsonCursor& value, double most)
{
    const std::vector<JsonCursor> items = value.items();
    if (items.size() != 2)
    {
        throw value.mismatch("two numbers");
    }
    std::array<double, 2> pair{};
    for (std::size_t i = 0; i < 2; ++i)
    {
        pair[i] = items[i].number();
        if (pair[i] < -most || pair[i] > most)
        {
            throw items[i].mismatch("a smaller number");
        }
    }
    return pair;
}

struct Kind
{
    std::string_view name;
    bool is_pressed; // or released, with modifiers or without
    InputEvent (*read)(const JsonCursor& event, const JsonCursor& value);
};

constexpr Kind kKinds[] = {
    {"key", true,
     [](const JsonCursor& event, const JsonCursor& name) -> InputEvent
     {
         const std::optional<Key> key = keyOf(name.text());
         if (!key)
         {
             throw name.mismatch("the name of a key, such as W, 1, F5, Space or LeftCtrl");
         }
         return KeyEvent{*key, event.at("pressed").flag(), readModifiers(event)};
     }},
    {"button", true,
     [](const JsonCursor& event, const JsonCursor& name) -> InputEvent
     {
         const std::size_t button = name.oneOf(kButtonNames);
         return MouseButtonEvent{static_cast<MouseButton>(button), event.at("pressed").flag(), readModifiers(event)};
     }},
    {"text", false,
     [](const JsonCursor&, const JsonCursor& text) -> InputEvent
     {
         if (!isOneCharacter(text.text()))
         {
             throw text.mismatch("one character");
         }
         return TextEvent{text.text()};
     }},
    {"move", false,
     [](const JsonCursor&, const JsonCursor& place) -> InputEvent
     {
         const auto [x, y] = readPair(place, kEdgeMax);
         return MouseMoveEvent{x, y};
     }},
    {"wheel", false,
     [](const JsonCursor&, const JsonCursor& notches) -> InputEvent
     {
         const auto [x, y] = readPair(notches, kWheelMax);
         return WheelEvent{x, y};
     }},
    {"resize", false,
     [](const JsonCursor&, const JsonCursor& size) -> InputEvent
     {
         const std::vector<JsonCursor> items = size.items();
         if (items.size() != 2)
         {
             throw size.mismatch("a width and a height");
         }
         return ResizeEvent{items[0].whole(0, kEdgeMax), items[1].whole(0, kEdgeMax)};
     }},
    {"minimised", false,
     [](const JsonCursor&, const JsonCursor& minimized) -> InputEvent { return MinimizeEvent{minimized.flag()}; }},
    {"drop", false,
     [](const JsonCursor&, const JsonCursor& files) -> InputEvent
     {
         DropEvent drop;
         for (const JsonCursor& file : files.items())
         {
             drop.files.emplace_back(file.text());
         }
         return drop;
     }},
    {"close", false,
     [](const JsonCursor&, const JsonCursor& close) -> InputEvent
     {
         if (!close.flag())
         {
             throw close.mismatch("true");
         }
         return CloseEvent{};
     }},
};

InputEvent readEvent(const JsonCursor& event)
{
    for (const Kind& kind : kKinds)
    {
        if (const auto value = event.find(kind.name))
        {
            const std::array<std::string_view, 4> keys = {"frame", kind.name, "pressed", "modifiers"};
            event.allowKeys(std::span(keys).first(kind.is_pressed ? 4 : 2));
            return kind.read(event, *value);
        }
    }
    throw event.mismatch("an event: key, button, text, move, wheel, resize, minimised, drop or close");
}

void addModifiers(Json& json, const Modifiers& modifiers)
{
    for (const auto& [name, held] :
         {std::pair("shift", modifiers.shift), {"ctrl", modifiers.control}, {"alt", modifiers.alt}})
    {
        if (held)
        {
            json["modifiers"].push_back(name);
        }
    }
}

struct Write
{
    Json& json;

    void operator()(const KeyEvent& event) const
    {
        json["key"] = keyName(event.key);
        json["pressed"] = event.pressed;
        addModifiers(json, event.modifiers);
    }
    void operator()(const TextEvent& event) const { json["text"] = event.text; }
    void operator()(const MouseMoveEvent& event) const { json["move"] = {event.x, event.y}; }
    void operator()(const MouseButtonEvent& event) const
    {
        json["button"] = kButtonNames[static_cast<std::size_t>(event.button)];
        json["pressed"] = event.pressed;
        addModifiers(json, event.modifiers);
    }
    void operator()(const WheelEvent& event) const { json["wheel"] = {event.x, event.y}; }
    void operator()(const ResizeEvent& event) const { json["resize"] = {event.width, event.height}; }
    void operator()(const MinimizeEvent& event) const { json["minimised"] = event.minimized; }
    void operator()(const DropEvent& event) const
    {
        json["drop"] = Json::array();
        for (const std::filesystem::path& file : event.files)
        {
            json["drop"].push_back(file.string());
        }
    }
    void operator()(const CloseEvent&) const { json["close"] = true; }
};

} // namespace

std::vector<ScriptedEvent> parseInputScript(std::string_view text, const std::filesystem::path& file)
{
    const nlohmann::json document = parseJsonStrictly(text, file);
    const JsonCursor script(document, file);
    script.allowKeys({"schema", "events"});
    static_cast<void>(script.at("schema").oneOf({kInputSchema}));
    std::vector<ScriptedEvent> events;
    for (const JsonCursor& event : script.at("events").items())
    {
        const std::uint64_t last = events.empty() ? 0 : events.back().frame;
        events.push_back({event.at("frame").whole(static_cast<std::uint32_t>(last), kFrameMax), readEvent(event)});
    }
    return events;
}

std::vector<ScriptedEvent> readInputScript(const std::filesystem::path& file)
{
    const std::vector<std::uint8_t> bytes = readFile(file);
    return parseInputScript(asText(bytes), file);
}

std::string inputScriptText(std::span<const ScriptedEvent> events)
{
    // One line for each event.
    std::string text = fmt::format("{{\"schema\": \"{}\", \"events\": [", kInputSchema);
    for (const ScriptedEvent& event : events)
    {
        Json json = {{"frame", event.frame}};
        std::visit(Write{json}, event.event);
        text += &event == events.data() ? "\n" : ",\n";
        text += json.dump(-1, ' ', false, Json::error_handler_t::replace);
    }
    return text + "\n]}\n";
}

std::vector<InputEvent> InputReplay::take(std::uint64_t frame)
{
    std::vector<InputEvent> events;
    for (; m_next < m_events.size() && m_events[m_next].frame <= frame; ++m_next)
    {
        events.push_back(m_events[m_next].event);
    }
    return events;
}

} // namespace zvo::demo
