// SPDX-License-Identifier: MIT
// The camera under mouse and keyboard.
#include "demo/input/camera_control.h"

#include "common/view.h"
#include "demo/input/camera_flight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zvo::demo
{
namespace
{

constexpr double kHeight = 500; // of the window
const Bounds kSubject = {glm::vec3(-1.0F), glm::vec3(1.0F)};

ViewCamera start()
{
    return ViewCamera::lookAt({0, 0, 5}, {0, 0, 0}, 0.8);
}

CameraControl control()
{
    return {start(), kSubject};
}

void press(CameraControl& camera, Key key, bool pressed, Modifiers modifiers = {})
{
    camera.handle(KeyEvent{key, pressed, modifiers}, false, kHeight);
}

void drag(CameraControl& camera, MouseButton button, double dx, double dy, bool has_tool = false,
          Modifiers modifiers = {})
{
    camera.handle(MouseMoveEvent{100, 100}, has_tool, kHeight);
    camera.handle(MouseButtonEvent{button, true, modifiers}, has_tool, kHeight);
    camera.handle(MouseMoveEvent{100 + dx, 100 + dy}, has_tool, kHeight);
    camera.handle(MouseButtonEvent{button, false, modifiers}, has_tool, kHeight);
    camera.handle(MouseMoveEvent{300, 300}, has_tool, kHeight); // after the button was released
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9)
{
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

void expectUpright(const ViewCamera& camera)
{
    EXPECT_NEAR(glm::length(camera.forward), 1, 1e-12);
    EXPECT_NEAR(glm::length(camera.right), 1, 1e-12);
    EXPECT_NEAR(glm::dot(camera.forward, camera.right), 0, 1e-12);
    expectNear(camera.up, glm::cross(camera.right, camera.forward), 1e-12);
    EXPECT_NEAR(camera.right.y, 0, 1e-12);
    EXPECT_GT(camera.up.y, 0);
}

TEST(CameraControl, ShowsTheCameraThatItWasGivenUntilItIsMoved)
{
    ViewCamera rolled = start();
    rolled.right = {0, 1, 0};
    rolled.up = {-1, 0, 0};
    CameraControl camera(rolled, kSubject);
    camera.advance(1);
    camera.handle(MouseMoveEvent{10, 20}, false, kHeight);
    camera.handle(MouseMoveEvent{30, 20}, false, kHeight);
    EXPECT_EQ(camera.camera().right, rolled.right);
    EXPECT_EQ(camera.camera().position, rolled.position);
    drag(camera, MouseButton::Right, 1, 0);
    expectUpright(camera.camera());
}

TEST(CameraControl, KeysMoveAlongTheCamerasAxes)
{
    const std::pair<Key, glm::dvec3> kWays[] = {{Key::W, {0, 0, -1}}, {Key::S, {0, 0, 1}}, {Key::A, {-1, 0, 0}},
                                                {Key::D, {1, 0, 0}},  {Key::E, {0, 1, 0}}, {Key::Q, {0, -1, 0}}};
    for (const auto& [key, way] : kWays)
    {
        CameraControl camera = control();
        camera.setSpeed(3);
        press(camera, key, true);
        camera.advance(0.5);
        expectNear(camera.camera().position, glm::dvec3(0, 0, 5) + 1.5 * way);
        press(camera, key, false);
        camera.advance(0.5);
        expectNear(camera.camera().position, glm::dvec3(0, 0, 5) + 1.5 * way);
    }
}

TEST(CameraControl, ShiftIsFasterAndKeysWithCtrlDoNotMove)
{
    CameraControl camera = control();
    camera.setSpeed(1);
    press(camera, Key::LeftShift, true, {true, false, false});
    press(camera, Key::W, true, {true, false, false});
    camera.advance(0.25);
    expectNear(camera.camera().position, {0, 0, 4});
    camera.release();
    press(camera, Key::A, true, {false, true, false});
    camera.advance(1);
    expectNear(camera.camera().position, {0, 0, 4});
}

TEST(CameraControl, TheRightButtonLooksAroundFromWhereItStands)
{
    CameraControl camera = control();
    drag(camera, MouseButton::Right, kHeight / 2, 0); // a quarter of a turn to the right
    expectNear(camera.camera().position, {0, 0, 5});
    expectNear(camera.camera().forward, {1, 0, 0});
    expectUpright(camera.camera());
    drag(camera, MouseButton::Right, 0, -10 * kHeight); // up, but never quite vertical
    EXPECT_GT(camera.camera().forward.y, 0.999);
    expectUpright(camera.camera());
    drag(camera, MouseButton::Right, 0, 20 * kHeight);
    EXPECT_LT(camera.camera().forward.y, -0.999);
    expectUpright(camera.camera());
}

TEST(CameraControl, TheLeftButtonOrbitsAroundThePivot)
{
    CameraControl camera = control();
    expectNear(camera.pivot(), {0, 0, 0});
    drag(camera, MouseButton::Left, kHeight / 2, 0);
    expectNear(camera.camera().position, {-5, 0, 0});
    expectNear(camera.camera().forward, {1, 0, 0});
    drag(camera, MouseButton::Left, 13, 57);
    expectNear(camera.pivot(), {0, 0, 0});
    EXPECT_NEAR(glm::length(camera.camera().position), 5, 1e-9);
    expectUpright(camera.camera());
}

TEST(CameraControl, AToolHasTheLeftButtonUnlessAltIsHeld)
{
    CameraControl camera = control();
    drag(camera, MouseButton::Left, 50, 20, true);
    EXPECT_EQ(camera.camera().position, start().position);
    EXPECT_EQ(camera.camera().forward, start().forward);
    drag(camera, MouseButton::Left, 50, 20, true, {false, false, true});
    EXPECT_NE(camera.camera().position, start().position);
}

TEST(CameraControl, TheMiddleButtonMovesWhatIsAtThePivotWithThePointer)
{
    CameraControl camera = control();
    drag(camera, MouseButton::Middle, 50, 25);
    // A tenth and a twentieth of the visible height at the pivot.
    const double seen = 2 * 5 * std::tan(0.4);
    expectNear(camera.camera().position, {-seen * 0.1, seen * 0.05, 5});
}

TEST(CameraControl, TheWheelGoesNearerOrChangesTheSpeed)
{
    CameraControl camera = control();
    camera.handle(WheelEvent{0, 2}, false, kHeight);
    expectNear(camera.camera().position, {0, 0, 5 * 0.85 * 0.85});
    camera.handle(WheelEvent{0, -2}, false, kHeight);
    expectNear(camera.camera().position, {0, 0, 5});
    const double speed = camera.speed();
    camera.handle(MouseButtonEvent{MouseButton::Right, true, {}}, false, kHeight);
    camera.handle(WheelEvent{0, 1}, false, kHeight);
    EXPECT_NEAR(camera.speed(), 1.25 * speed, 1e-12);
    expectNear(camera.camera().position, {0, 0, 5});
    camera.handle(WheelEvent{0, -1000}, false, kHeight);
    EXPECT_GT(camera.speed(), 0);
}

TEST(CameraControl, AnOrthographicCameraShowsThingsLarger)
{
    ViewCamera flat = start();
    flat.orthographic = true;
    flat.half_height = 2;
    CameraControl camera(flat, kSubject);
    camera.handle(WheelEvent{0, 1}, false, kHeight);
    EXPECT_NEAR(camera.camera().half_height, 1.7, 1e-12);
    EXPECT_TRUE(camera.camera().orthographic);
    EXPECT_FALSE(cameraText(camera.camera(), 1));
}

TEST(CameraText, IsWhatTheCommandLineTakes)
{
    const ViewCamera camera = ViewCamera::lookAt({0.1, 2, -3.5}, {4, 0.25, 1e-3}, 0.7);
    const std::optional<std::string> text = cameraText(camera, 2.5);
    ASSERT_TRUE(text);
    const ViewCamera theirs = cli::chooseCamera(*text, Scene(), kSubject, 1.0);
    const std::optional<ViewCamera> ours = cameraOfText("  " + *text + "\n");
    ASSERT_TRUE(ours);
    EXPECT_EQ(ours->position, theirs.position);
    EXPECT_EQ(ours->forward, theirs.forward);
    EXPECT_EQ(ours->vertical_fov, theirs.vertical_fov);
    expectNear(ours->position, camera.position, 1e-6);
    expectNear(ours->forward, camera.forward, 1e-6);
    EXPECT_NEAR(ours->vertical_fov, camera.vertical_fov, 1e-6);
    // A pasted camera is copied unchanged, up to single precision.
    const std::optional<ViewCamera> again = cameraOfText(*cameraText(*ours, 2.5));
    expectNear(again->forward, ours->forward, 1e-6);
}

TEST(CameraText, OtherTextsAreNoCameras)
{
    for (const char* text :
         {"", " ", "auto", "1,2,3", "1,2,3,4,5,6,7,8", "1,2,3,1,2,3", "1,2,3,4,5,6,180", "1,2,3,4,5,x"})
    {
        EXPECT_FALSE(cameraOfText(text)) << text;
    }
}

TEST(CameraFlight, FliesFromTheBeginningAndEndsWithThePath)
{
    const CameraPath path({{0, {0, 0, 5}, {0, 0, 0}, 50}, {0.3, {3, 0, 5}, {0, 0, 0}, 50}});
    for (const bool stays : {false, true})
    {
        CameraControl camera = control();
        CameraFlight flight{FixedStep{1, 10}};
        EXPECT_FALSE(flight.toggle()) << "there is no path";
        flight.fly(path, stays);
        for (int frame = 0; frame <= 3; ++frame)
        {
            flight.advance(99, frame == 0, camera);
            EXPECT_EQ(camera.camera().position, path.at(frame / 10.0).position);
        }
        EXPECT_EQ(flight.flies(), stays);
        EXPECT_EQ(flight.toggle(), true);
        EXPECT_EQ(flight.flies(), !stays);
    }
}

TEST(CameraFlight, RecordsAKeyEveryQuarterOfASecond)
{
    CameraControl camera = control();
    CameraFlight flight{FixedStep{1, 16}};
    EXPECT_FALSE(flight.toggleRecording());
    camera.setSpeed(1);
    press(camera, Key::D, true);
    for (int frame = 0; frame < 17; ++frame)
    {
        flight.advance(99, false, camera);
        camera.advance(1.0 / 16);
    }
    const std::optional<CameraPath> path = flight.toggleRecording();
    ASSERT_TRUE(path);
    ASSERT_EQ(path->keys().size(), 5U);
    for (std::size_t i = 0; i < 5; ++i)
    {
        EXPECT_EQ(path->keys()[i].seconds, 0.25 * static_cast<double>(i));
        expectNear(path->keys()[i].eye, {0.25 * static_cast<double>(i), 0, 5});
        EXPECT_NEAR(path->keys()[i].fov_degrees, glm::degrees(0.8), 1e-9);
    }
    EXPECT_TRUE(flight.toggle()) << "what was recorded can be flown";
    EXPECT_FALSE(flight.toggleRecording());
    EXPECT_FALSE(flight.toggleRecording()) << "nothing was recorded";
}

} // namespace
} // namespace zvo::demo
