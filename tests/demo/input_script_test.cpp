// SPDX-License-Identifier: MIT
// Scripts of input events.
#include "demo/input/input_script.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace zvo::demo
{
namespace
{

const std::vector<ScriptedEvent> kEvents = {
    {0, KeyEvent{Key::W, true, {true, false, false}}},
    {0, KeyEvent{Key::LeftControl, false, {true, true, true}}},
    {1, TextEvent{"a"}},
    {1, TextEvent{"\u00fc"}},
    {1, TextEvent{"\u20ac"}},
    {1, TextEvent{"\U0001F600"}},
    {2, MouseMoveEvent{0.1, -3.75}},
    {2, MouseButtonEvent{MouseButton::Middle, true, {false, false, true}}},
    {3, WheelEvent{0, -1.5}},
    {3, ResizeEvent{640, 0}},
    {7, MinimizeEvent{true}},
    {8, MinimizeEvent{false}},
    {900'000'000, DropEvent{{"a b.glb", "/c\"d.obj"}}},
    {900'000'000, CloseEvent{}},
};

TEST(InputScript, WhatIsWrittenIsRead)
{
    const std::string text = inputScriptText(kEvents);
    EXPECT_EQ(parseInputScript(text, "s.json"), kEvents);
    EXPECT_EQ(inputScriptText(parseInputScript(text, "s.json")), text);
    EXPECT_TRUE(parseInputScript(inputScriptText({}), "s.json").empty());
}

TEST(InputScript, EveryKeyHasANameOfItsOwn)
{
    for (std::size_t i = 0; i < kKeyCount; ++i)
    {
        const Key key = static_cast<Key>(i);
        ASSERT_FALSE(keyName(key).empty());
        EXPECT_EQ(keyOf(keyName(key)), key);
    }
    EXPECT_EQ(keyName(Key::Z), "Z");
    EXPECT_EQ(keyName(Key::Digit9), "9");
    EXPECT_EQ(keyName(Key::F12), "F12");
    EXPECT_EQ(keyName(Key::RightAlt), "RightAlt");
    EXPECT_FALSE(keyOf("w"));
}

TEST(InputScript, TheExampleInTheHeaderIsAScript)
{
    const std::vector<ScriptedEvent> events = parseInputScript(
        R"({"schema": "zvo.input/1", "events": [
            {"frame": 3, "key": "W", "pressed": true, "modifiers": ["shift"]},
            {"frame": 4, "text": "a"},
            {"frame": 4, "move": [320, 200]},
            {"frame": 5, "button": "left", "pressed": true},
            {"frame": 6, "wheel": [0, 1]},
            {"frame": 7, "resize": [640, 360]},
            {"frame": 8, "minimised": true},
            {"frame": 9, "drop": ["scene.glb"]},
            {"frame": 10, "close": true}]})",
        "s.json");
    ASSERT_EQ(events.size(), 9U);
    EXPECT_EQ(events[0], (ScriptedEvent{3, KeyEvent{Key::W, true, {true, false, false}}}));
    EXPECT_EQ(events[3], (ScriptedEvent{5, MouseButtonEvent{MouseButton::Left, true, {}}}));
    EXPECT_EQ(events[7], (ScriptedEvent{9, DropEvent{{"scene.glb"}}}));
}

TEST(InputScript, BadScriptsAreOneLineThatSaysWhere)
{
    const std::vector<std::pair<std::string, std::string>> bad = {
        {R"({"frame": 1})", "events[0]"},
        {R"({"key": "W", "pressed": true})", "frame"},
        {R"({"frame": -1, "text": "a"})", "events[0].frame"},
        {R"({"frame": 5, "text": "a"}, {"frame": 4, "text": "a"})", "events[1].frame"},
        {R"({"frame": 1, "key": "w", "pressed": true})", "events[0].key"},
        {R"({"frame": 1, "key": "W"})", "pressed"},
        {R"({"frame": 1, "key": "W", "pressed": true, "modifiers": ["meta"]})", "modifiers[0]"},
        {R"({"frame": 1, "key": "W", "pressed": true, "text": "a"})", "text"},
        {R"({"frame": 1, "text": ""})", "one character"},
        {R"({"frame": 1, "text": "ab"})", "one character"},
        {R"({"frame": 1, "move": [1]})", "two numbers"},
        {R"({"frame": 1, "move": [1, 1e30]})", "move[1]"},
        {R"({"frame": 1, "button": "side", "pressed": true})", "button"},
        {R"({"frame": 1, "resize": [10, 20, 30]})", "resize"},
        {R"({"frame": 1, "resize": [10, 20000]})", "resize[1]"},
        {R"({"frame": 1, "drop": "a.glb"})", "drop"},
        {R"({"frame": 1, "close": false})", "close"},
    };
    for (const auto& [events, part] : bad)
    {
        try
        {
            parseInputScript(R"({"schema": "zvo.input/1", "events": [)" + events + "]}", "s.json");
            ADD_FAILURE() << events;
        }
        catch (const Error& error)
        {
            const std::string what = error.what();
            EXPECT_EQ(error.code(), ErrorCode::Input);
            EXPECT_TRUE(what.starts_with("s.json")) << what;
            EXPECT_NE(what.find(part), std::string::npos) << events << ": " << what;
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        }
    }
    EXPECT_THROW(parseInputScript("{}", "s.json"), Error);
    EXPECT_THROW(readInputScript("/nowhere/s.json"), Error);
}

TEST(InputReplay, GivesEveryEventOnceBeforeItsFrame)
{
    InputReplay replay(kEvents);
    EXPECT_EQ(replay.take(0).size(), 2U);
    EXPECT_TRUE(replay.take(0).empty());
    EXPECT_EQ(replay.take(2).size(), 6U) << "those of a frame that was left out, too";
    EXPECT_EQ(replay.take(6).size(), 2U);
    EXPECT_EQ(replay.take(UINT64_MAX).size(), 4U);
    EXPECT_TRUE(replay.take(UINT64_MAX).empty());
}

} // namespace
} // namespace zvo::demo
