// SPDX-License-Identifier: MIT
// Brush and hand in the demo window: edits can be undone back to the first picture, and saved files have what was
// shown.
#include "demo/demo_window.h"

#include <set>
#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

constexpr Modifiers kControl = {false, true, false};
constexpr Modifiers kControlShift = {true, true, false};

/// Presses the left button at the first point, moves by one point a frame, and releases it. Returns the next frame.
std::uint64_t drag(Script& script, std::uint64_t frame, const std::vector<MouseMoveEvent>& points)
{
    script.add(frame, points.front()).add(frame, MouseButtonEvent{MouseButton::Left, true, {}});
    for (std::size_t i = 1; i < points.size(); ++i)
    {
        script.add(++frame, points[i]);
    }
    script.add(++frame, MouseButtonEvent{MouseButton::Left, false, {}});
    return frame + 2; // the pixel under the pointer is known a frame later
}

class DemoEditing : public DemoWindow
{
protected:
    void play(const Script& script, std::uint64_t frames, const std::vector<std::string>& arguments)
    {
        m_dir.write("script.json", script.text());
        show(arguments + kSize + kSteady +
             std::vector<std::string>{"--frames", std::to_string(frames), "--input-script", "script.json"});
    }
};

// The cube fills the middle of the picture.
const std::vector<MouseMoveEvent> kAcross = {{110, 70}, {118, 72}, {126, 76}};

TEST_F(DemoEditing, CarvesFillsAndPaintsAndUndoesToTheFirstPicture)
{
    for (const char* structure : {"svo", "svdag"})
    {
        SCOPED_TRACE(structure);
        Script script;
        script.add(keyStroke(1, Key::F12)).add(keyStroke(2, Key::B));
        std::uint64_t frame = 4;
        for (int action = 0; action < 3; ++action) // carve, fill, paint
        {
            frame = drag(script, frame, kAcross);
            script.add(keyStroke(frame, Key::F12)).add(keyStroke(frame + 1, Key::N));
            frame += 3;
        }
        script.add(keyStroke(frame, Key::S, kControl));
        for (int i = 0; i < 4; ++i) // one more than there are strokes
        {
            frame += 2;
            script.add(keyStroke(frame, Key::Z, kControl)).add(keyStroke(frame, Key::F12));
        }
        for (int i = 0; i < 3; ++i)
        {
            frame += 2;
            script.add(keyStroke(frame, Key::Z, kControlShift));
        }
        script.add(keyStroke(frame + 1, Key::F12));
        play(script, frame + 4, kCube + kCamera + std::vector<std::string>{"--structure", structure});

        const auto shot = [&](int number) { return file("zvo-000" + std::to_string(number) + ".png"); };
        EXPECT_EQ(shot(1), render(kCube + kCamera + kSize));
        EXPECT_EQ((std::set{shot(1), shot(2), shot(3), shot(4)}).size(), 4U) << "each stroke shows";
        EXPECT_EQ(shot(5), shot(3));
        EXPECT_EQ(shot(6), shot(2));
        EXPECT_EQ(shot(7), shot(1)) << "undone to the start, bit for bit";
        EXPECT_EQ(shot(8), shot(1)) << "nothing is left to undo";
        EXPECT_EQ(shot(9), shot(4)) << "and done again";
        EXPECT_EQ(render(std::vector<std::string>{"cube-edited.zvo"} + kCamera + kSize), shot(4));
        const Outcome told = runZvo(m_dir.path(), {"inspect", "cube-edited.zvo", "--json"});
        EXPECT_EQ(json::parse(told.out)["structure"], structure);
        for (int number = 1; number <= 9; ++number)
        {
            fs::remove(m_dir.path() / ("zvo-000" + std::to_string(number) + ".png"));
        }
        fs::remove(m_dir.path() / "cube-edited.zvo");
    }
}

TEST_F(DemoEditing, WhatMovesGoesOnThroughWhatWasEdited)
{
    const std::vector<std::string> scene_file = {"moving.scene.json", "--camera", "3,2.5,4,0.5,0.5,0.5,40"};
    // Four pictures: the first, carved, moved on, and undone; or the same without the stroke.
    const auto pictures = [&](bool edits)
    {
        Script script;
        script.add(keyStroke(1, Key::Space)); // stops
        script.add(keyStroke(2, Key::F12)).add(keyStroke(3, Key::B));
        Script stroke;
        const std::uint64_t frame = drag(edits ? script : stroke, 5, kAcross);
        script.add(keyStroke(frame, Key::F12));
        script.add(keyStroke(frame + 1, Key::Space)).add(keyStroke(frame + 6, Key::Space));
        script.add(keyStroke(frame + 8, Key::F12)).add(keyStroke(frame + 10, Key::Z, kControl));
        script.add(keyStroke(frame + 12, Key::F12));
        play(script, frame + 15, scene_file);
        std::vector<std::string> shots;
        for (int number = 1; number <= 4; ++number)
        {
            const std::string name = "zvo-000" + std::to_string(number) + ".png";
            shots.push_back(file(name));
            fs::remove(m_dir.path() / name);
        }
        return shots;
    };
    const std::vector<std::string> plain = pictures(false);
    const std::vector<std::string> edited = pictures(true);
    EXPECT_EQ(edited[0], plain[0]);
    EXPECT_EQ(plain[1], plain[0]);
    EXPECT_NE(edited[1], plain[1]);
    EXPECT_NE(plain[2], plain[1]) << "it moves";
    EXPECT_NE(edited[2], plain[2]) << "through what was carved";
    EXPECT_EQ(edited[3], plain[3]) << "undone, where it is by then";
}

TEST_F(DemoEditing, TheHandDragsWhatMovesAndNothingElse)
{
    const std::vector<std::string> scene_file = {"moving.scene.json", "--camera", "0,1,8,0,1,0,40", "--time", "0.5"};
    const auto lastAfter = [&](const std::vector<MouseMoveEvent>& points)
    {
        Script script;
        script.add(keyStroke(1, Key::Space)).add(keyStroke(2, Key::M));
        const std::uint64_t frame = drag(script, 4, points);
        script.add(keyStroke(frame, Key::F12));
        play(script, frame + 3, scene_file);
        const std::string shot = file("zvo-0001.png");
        fs::remove(m_dir.path() / "zvo-0001.png");
        return shot;
    };
    const std::string before = lastAfter({{5, 5}, {20, 20}, {40, 40}}); // the sky cannot be dragged
    std::set<std::string> pictures;
    for (int x = 85; x < 125; x += 6) // the moving slab is somewhere here
    {
        const auto at = static_cast<double>(x);
        pictures.insert(lastAfter({{at, 94}, {at, 80}, {at, 60}}));
    }
    EXPECT_TRUE(pictures.contains(before)) << "the cube, and nothing, cannot be dragged";
    EXPECT_GE(pictures.size(), 2U) << "the slab can";
}

} // namespace
} // namespace zvo::test
