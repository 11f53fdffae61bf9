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

constexpr Modifiers kControlShift = {true, true, false};

/// Presses the left button at the first point, moves by one point a frame, and releases it. Returns the next frame.
std::uint64_t drag(Script& script, std::uint64_t frame, const std::vector<MouseMoveEvent>& points,
                   Modifiers modifiers = {})
{
    script.add(frame, points.front()).add(frame, MouseButtonEvent{MouseButton::Left, true, modifiers});
    for (std::size_t i = 1; i < points.size(); ++i)
    {
        script.add(++frame, points[i]);
    }
    script.add(++frame, MouseButtonEvent{MouseButton::Left, false, modifiers});
    return frame + 2; // the pixel under the pointer is known a frame later
}

class DemoEditing : public DemoWindow
{
protected:
    void play(const Script& script, std::uint64_t frames, const std::string& arguments) const
    {
        show(arguments + kSize + kSteady + playing(script) + " --frames " + std::to_string(frames));
    }

    /// The first screenshots, which are removed.
    [[nodiscard]] std::vector<std::string> takeShots(int count) const
    {
        std::vector<std::string> shots;
        for (int number = 1; number <= count; ++number)
        {
            shots.push_back(shot(number));
            fs::remove(m_dir.path() / shotName(number));
        }
        return shots;
    }
};

// The cube fills the middle of the picture.
const std::vector<MouseMoveEvent> kAcross = {{110, 70}, {118, 72}, {126, 76}};

TEST_F(DemoEditing, CarvesFillsAndPaintsAndUndoesToTheFirstPicture)
{
    for (const std::string structure : {"svo", "svdag"})
    {
        SCOPED_TRACE(structure);
        Script script;
        script.press(1, Key::F12).press(2, Key::B);
        std::uint64_t frame = 4;
        for (int action = 0; action < 3; ++action) // carve, fill, paint
        {
            frame = drag(script, frame, kAcross);
            script.press(frame, Key::F12).press(frame + 1, Key::N);
            frame += 3;
        }
        script.press(frame, Key::S, kControl);
        for (int i = 0; i < 4; ++i) // one more than there are strokes
        {
            frame += 2;
            script.press(frame, Key::Z, kControl).press(frame, Key::F12);
        }
        for (int i = 0; i < 3; ++i)
        {
            frame += 2;
            script.press(frame, Key::Z, kControlShift);
        }
        script.press(frame + 1, Key::F12);
        play(script, frame + 4, kCube + kCamera + " --structure " + structure);

        const std::vector<std::string> shots = takeShots(9);
        EXPECT_EQ(shots[0], render(kCube + kCamera + kSize));
        EXPECT_EQ((std::set{shots[0], shots[1], shots[2], shots[3]}).size(), 4U) << "each stroke shows";
        EXPECT_EQ(shots[4], shots[2]);
        EXPECT_EQ(shots[5], shots[1]);
        EXPECT_EQ(shots[6], shots[0]) << "undone to the start, bit for bit";
        EXPECT_EQ(shots[7], shots[0]) << "nothing is left to undo";
        EXPECT_EQ(shots[8], shots[3]) << "and done again";
        EXPECT_EQ(render("cube-edited.zvo" + kCamera + kSize), shots[3]);
        EXPECT_EQ(printedBy("inspect cube-edited.zvo --json")["structure"], structure);
        fs::remove(m_dir.path() / "cube-edited.zvo");
    }
}

// The camera looks straight onto a face of the cube.
const std::string kFront = " --camera 0.5,0.5,3,0.5,0.5,0.5,30";

TEST_F(DemoEditing, AStrokeOfOneStepHasNoGaps)
{
    Script script;
    script.press(1, Key::F12).press(2, Key::B).press(3, Key::N).press(5, Key::N);
    for (std::uint64_t i = 0; i < 7; ++i)
    {
        script.press(6 + 2 * i, Key::LeftBracket); // the radius is 1
    }
    const std::uint64_t frame = drag(script, 22, {{70, 40}, {170, 110}});
    script.press(frame + 4, Key::F12);
    play(script, frame + 8, kCube + kFront);
    const Image before = pixels(shotName(1));
    const Image after = pixels(shotName(2));
    const auto differs = [&](std::size_t x, std::size_t y)
    { return before.rgba[4 * (y * before.width + x)] != after.rgba[4 * (y * before.width + x)]; };
    std::size_t count = 0;
    for (std::size_t x = 70; x <= 170; ++x)
    {
        EXPECT_TRUE(differs(x, 40 + (x - 70) * 7 / 10)) << x;
    }
    for (std::size_t i = 0; i < after.rgba.size() / 4; ++i)
    {
        count += differs(i % before.width, i / before.width) ? 1 : 0;
    }
    EXPECT_LT(count, 2500U) << "a line, not more";
}

// The cube fills its grid. In front of its face there is nothing to fill, and what is hidden behind it stays empty.
TEST_F(DemoEditing, AStrokeThatChangesNothingIsNoEntry)
{
    Script script;
    script.press(1, Key::F12).press(2, Key::B);
    std::uint64_t frame = drag(script, 4, {{60, 50}, {80, 50}}); // carves
    script.press(frame, Key::N);
    frame = drag(script, frame + 2, {{140, 90}, {150, 90}}); // with a radius of 8
    for (std::uint64_t i = 0; i < 7; ++i)
    {
        script.press(frame + 2 * i, Key::LeftBracket);
    }
    frame = drag(script, frame + 16, {{140, 90}, {150, 90}});
    script.press(frame, Key::LeftBracket);
    frame = drag(script, frame + 2, {{140, 90}, {150, 90}});
    script.press(frame + 4, Key::Z, kControl).press(frame + 6, Key::F12);
    play(script, frame + 10, kCube + kFront);
    const std::vector<std::string> shots = takeShots(2);
    EXPECT_EQ(shots[1], shots[0]) << "undo takes back what was carved";
}

TEST_F(DemoEditing, TheColourIsThatUnderThePointerNow)
{
    Script script;
    script.press(1, Key::F12).press(2, Key::B).press(3, Key::N).press(5, Key::N).add(6, MouseMoveEvent{2, 2});
    script.add(8, MouseMoveEvent{120, 75}).press(8, Key::K); // at once
    script.press(drag(script, 12, {{100, 60}, {140, 90}}) + 2, Key::F12);
    play(script, 24, kCube + kFront);
    const std::vector<std::string> shots = takeShots(2);
    EXPECT_EQ(shots[1], shots[0]) << "painted in its own colour";
}

// Which pixels two screenshots of 240 x 150 have in common.
class Changes
{
public:
    Changes(const Image& before, const Image& after) : m_before(before), m_after(after) {}

    [[nodiscard]] bool at(std::size_t x, std::size_t y) const
    {
        const std::size_t first = 4 * (y * m_before.width + x);
        return !std::equal(m_before.rgba.begin() + static_cast<std::ptrdiff_t>(first),
                           m_before.rgba.begin() + static_cast<std::ptrdiff_t>(first + 3),
                           m_after.rgba.begin() + static_cast<std::ptrdiff_t>(first));
    }

    /// How many there are from one point to another one.
    [[nodiscard]] std::size_t within(std::size_t x0, std::size_t y0, std::size_t x1, std::size_t y1) const
    {
        std::size_t count = 0;
        for (std::size_t y = y0; y < y1; ++y)
        {
            for (std::size_t x = x0; x < x1; ++x)
            {
                count += at(x, y) ? 1 : 0;
            }
        }
        return count;
    }

private:
    Image m_before;
    Image m_after;
};

// The cube's front is a square of 140 units in the middle. Each edit is undone before the next one.
TEST_F(DemoEditing, BoxesMirrorsFloodsAndTheSelectionAreEditsThatAreUndone)
{
    Script script;
    script.press(1, Key::F12).press(2, Key::B).press(3, Key::O); // boxes
    for (std::uint64_t i = 0; i < 7; ++i)
    {
        script.press(4 + 2 * i, Key::LeftBracket); // the radius is 1
    }
    std::uint64_t frame = 20;
    const auto edit = [&](const std::vector<MouseMoveEvent>& points)
    {
        frame = drag(script, frame, points) + 3;
        script.press(frame, Key::F12).press(frame + 2, Key::Z, kControl);
        frame += 4;
    };
    for (const MouseMoveEvent& point : {MouseMoveEvent{80, 70}, MouseMoveEvent{150, 70}}) // before there are answers
    {
        script.add(frame, point).add(frame, MouseButtonEvent{MouseButton::Left, true, {}});
        script.add(frame, MouseMoveEvent{point.x + 10, 90}).add(frame, MouseButtonEvent{MouseButton::Left, false, {}});
    }
    script.press(frame + 5, Key::F12).press(frame + 7, Key::Z, kControl).press(frame + 9, Key::Z, kControl); // 2
    frame += 11;
    edit({{80, 40}, {160, 60}}); // 3
    script.press(frame, Key::X); // mirrors along x
    edit({{80, 40}, {90, 60}});  // 4
    script.press(frame, Key::X).press(frame + 2, Key::X).press(frame + 4, Key::X).press(frame + 6, Key::O);
    script.press(frame + 8, Key::N).press(frame + 10, Key::N); // a flood that paints
    frame += 12;
    edit({{100, 50}}); // 5
    script.press(frame, Key::O);
    frame = drag(script, frame + 2, {{85, 45}, {105, 55}});
    script.press(frame + 2, Key::F12).press(frame + 3, Key::T); // 6: painted
    frame = drag(script, frame + 5, {{80, 40}, {110, 60}});
    script.press(frame, Key::C, kControl).add(frame + 2, MouseMoveEvent{140, 100}).press(frame + 3, Key::V, kControl);
    script.press(frame + 8, Key::F12);                                      // 7: pasted on the face
    script.press(frame + 10, Key::Delete).press(frame + 14, Key::F12);      // 8: what was pasted is selected
    script.press(frame + 16, Key::Z, kControl).press(frame + 18, Key::F12); // 9
    script.press(frame + 20, Key::Z, kControl).press(frame + 22, Key::Z, kControl).press(frame + 24, Key::F12);
    frame = drag(script, frame + 26, {{80, 40}, {110, 60}});
    frame = drag(script, frame + 3, {{180, 75}, {60, 75}}, kShift); // out of the grid
    script.press(frame + 2, Key::F12);
    play(script, frame + 6, kCube + " --margin 8" + kFront);

    const Image first = pixels(shotName(1));
    const auto changes = [&](int number) { return Changes(first, pixels(shotName(number))); };
    const Changes two = changes(2);
    EXPECT_EQ(two.within(82, 72, 88, 88), 6U * 16U);
    EXPECT_EQ(two.within(152, 72, 158, 88), 6U * 16U);
    EXPECT_EQ(two.within(100, 0, 140, 150), 0U) << "nothing between two boxes";
    const Changes box = changes(3);
    EXPECT_EQ(box.within(82, 42, 158, 58), 76U * 16U) << "all of the box";
    EXPECT_EQ(box.within(0, 90, 240, 150), 0U);
    const Changes mirrored = changes(4);
    EXPECT_EQ(mirrored.within(82, 42, 88, 58), 6U * 16U);
    EXPECT_EQ(mirrored.within(152, 42, 158, 58), 6U * 16U);
    EXPECT_EQ(mirrored.within(100, 0, 140, 150), 0U);
    EXPECT_GE(changes(5).within(70, 20, 170, 130), 2000U) << "a face's worth of one colour";
    const Changes pasted(pixels(shotName(6)), pixels(shotName(7)));
    EXPECT_GE(pasted.within(120, 80, 160, 120), 100U) << "the painted voxels";
    EXPECT_EQ(pasted.within(70, 30, 110, 60), 0U) << "nothing where they were copied";
    EXPECT_EQ(shot(8), shot(6));
    EXPECT_EQ(shot(9), shot(7)) << "the deletion is undone";
    EXPECT_EQ(shot(10), shot(1)) << "all is undone";
    EXPECT_EQ(shot(11), shot(1)) << "what would leave the grid is not moved";
}

TEST_F(DemoEditing, WhatMovesGoesOnThroughWhatWasEdited)
{
    // Four pictures: the first, carved, moved on, and undone; or the same without the stroke.
    const auto pictures = [&](bool edits)
    {
        Script script;
        script.press(1, Key::Space); // stops
        script.press(2, Key::F12).press(3, Key::B);
        Script stroke;
        const std::uint64_t frame = drag(edits ? script : stroke, 5, kAcross);
        script.press(frame, Key::F12);
        script.press(frame + 1, Key::Space).press(frame + 6, Key::Space);
        script.press(frame + 8, Key::F12).press(frame + 10, Key::Z, kControl);
        script.press(frame + 12, Key::F12);
        play(script, frame + 15, "moving.scene.json" + kCamera);
        return takeShots(4);
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
    std::set<std::string> undone;
    const auto lastAfter = [&](const std::vector<MouseMoveEvent>& points)
    {
        Script script;
        script.press(1, Key::Space).press(2, Key::M);
        const std::uint64_t frame = drag(script, 4, points);
        script.press(frame, Key::F12).press(frame + 2, Key::Z, kControl).press(frame + 3, Key::F12);
        play(script, frame + 6, "moving.scene.json --camera 0,1,8,0,1,0,40 --time 0.5");
        const std::vector<std::string> shots = takeShots(2);
        undone.insert(shots[1]);
        return shots[0];
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
    EXPECT_EQ(undone, std::set{before}) << "and is taken back";
}

} // namespace
} // namespace zvo::test
