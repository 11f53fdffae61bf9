// SPDX-License-Identifier: MIT
// The demo window, run under its own X server. It shows what `zvo render` shows, whatever happens to the window, and
// the validation layers report nothing.
#include "common/names.h"
#include "demo/demo_window.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <vector>

namespace zvo::test
{
namespace
{

TEST_F(DemoWindow, EveryViewIsThePictureOfZvoRender)
{
    for (const cli::Named<View>& view : cli::kViews)
    {
        SCOPED_TRACE(view.name);
        const std::string common = kCube + kCamera + kSize + " --view " + std::string(view.name);
        EXPECT_EQ(shown(common, 2), render(common));
    }
}

TEST_F(DemoWindow, OtherPicturesAreThoseOfZvoRenderToo)
{
    for (const std::string options : {
             " --structure svdag --occlusion 4",
             " --exposure 0.5 --sun 1,1,0.2 --detail 3",
             " --attributes none --coverage conservative",
         })
    {
        const std::string common = kCube + kSize + kCamera + options;
        EXPECT_EQ(shown(common), render(common)) << options;
    }
    EXPECT_EQ(shown(kCube + kSize), render(kCube + kSize)) << "with the scene's camera";
    run("build cube.glb -o cube.zvo --resolution 64 --attributes block --device cpu");
    EXPECT_EQ(shown("cube.zvo" + kSize), render("cube.zvo" + kSize));
    run("convert cube.zvo -o cube.vox --device cpu");
    run("convert cube.vox -o other.zvo --device cpu");
    EXPECT_EQ(shown("cube.vox" + kSize), render("other.zvo" + kSize));
}

// While nothing changes, each frame adds a sample; what moves begins anew.
TEST_F(DemoWindow, PathsAddUpWhileNothingChanges)
{
    const std::string common = kCube + kCamera + kSize + " --integrator path";
    const std::string one = shown(common, 1);
    const std::string four = shown(common, 4);
    EXPECT_EQ(one, render(common + " --spp 1"));
    EXPECT_EQ(four, render(common + " --spp 4"));
    EXPECT_NE(one, four);
    EXPECT_EQ(shown(common + " --denoise", 2), render(common + " --denoise --spp 2"));
    const std::string lens = " --bounces 2 --aperture 0.2 --focus 4 --sun 1,0.1,0.2 --exposure 0.5";
    EXPECT_EQ(shown(common + lens, 1), render(common + lens + " --spp 1"));
    const std::string moving = "moving.scene.json --integrator path" + kCamera + kSize;
    const std::string third = shown(moving + " --json stats.json", 3);
    EXPECT_GT(jsonFile("stats.json")["mrays_per_second"], 0);
    run("render -o frame_#.png --frames 2..2 --spp 1 -f " + moving);
    EXPECT_EQ(third, file("frame_2.png"));
}

// The command line's later frames look through other points of pixels.
TEST_F(DemoWindow, RadianceCacheBeginsAsOnTheCommandLineAndGoesOn)
{
    const std::string common = kCube + kCamera + kSize + " --integrator cache";
    const std::string first = render(common + " --settle 0 --spp 1");
    EXPECT_TRUE(shown(common, 1) == first);
    EXPECT_FALSE(shown(common, 5) == first);
}

TEST_F(DemoWindow, ALowerResolutionShowsPixelsOfItsPicture)
{
    const std::string common = kCube + kCamera + " --exposure 0.5 --sun 1,1,0.2 --detail 3";
    show(common + kSteady + kSize + " --internal-scale 0.5 --frames 1 --screenshot shown.png");
    const Image shown = pixels("shown.png");
    run("render -o rendered.png --spp 1 --occlusion 4 --size 120x75 " + common);
    const Image traced = pixels("rendered.png");
    ASSERT_EQ(shown.width, 240U);
    ASSERT_EQ(shown.height, 150U);
    for (std::uint32_t y = 0; y < 150; ++y)
    {
        for (std::uint32_t x = 0; x < 240; ++x)
        {
            for (std::uint32_t channel = 0; channel < 4; ++channel)
            {
                ASSERT_EQ(shown.rgba[4 * (y * 240 + x) + channel], traced.rgba[4 * (y / 2 * 120 + x / 2) + channel]);
            }
        }
    }
}

// The picture of a window that nobody touches becomes that of `zvo render` with as many samples, in full size, though
// frames began at half of it; then the window draws no more.
TEST_F(DemoWindow, StandingStillItShowsTheFullPictureAndRests)
{
    show(kCube + kCamera + kSize + " --hide-ui --frames 800 --screenshot still.png --json stats.json");
    EXPECT_EQ(file("still.png"), render(kCube + kCamera + kSize + " --spp 16"));
    const json stats = jsonFile("stats.json");
    EXPECT_LT(stats["frames_drawn"], 400);
    EXPECT_EQ(stats["internal_scale"], 1);
}

TEST_F(DemoWindow, FliesAlongAPathAndThroughTheTimesOfAMovingSceneAsZvoRenderDoes)
{
    m_dir.write("path.json", std::string_view(R"({"schema": "zvo.camera_path/1", "keys": [
        {"time": 0, "eye": [3, 2, 6], "target": [0.5, 0.5, 0.5]},
        {"time": 0.5, "eye": [0, 3, 7], "target": [0.5, 1, 0.5], "fov": 60},
        {"time": 1.5, "eye": [-4, 1, 5], "target": [0.5, 0.5, 0.5]}]})"));
    for (const std::string structure : {"svo", "svdag"})
    {
        const std::string common = "moving.scene.json --camera-path path.json --structure " + structure + kSize;
        run("render -o frame_##.png --spp 1 --occlusion 4 --frames 0..9 -f " + common);
        std::set<std::string> pictures;
        for (const int frame : {0, 3, 9})
        {
            const std::string picture = shown(common, frame + 1);
            EXPECT_EQ(picture, file("frame_0" + std::to_string(frame) + ".png")) << frame;
            pictures.insert(picture);
        }
        EXPECT_EQ(pictures.size(), 3U);
    }
}

TEST_F(DemoWindow, AUserFliesResizesMinimizesAndComesBackToTheSamePicture)
{
    Script script;
    script.press(1, Key::Digit1, kControl).press(1, Key::F12); // a bookmark, and zvo-0001.png
    script.add(2, MouseMoveEvent{100, 70}).add(2, MouseButtonEvent{MouseButton::Right, true, {}});
    script.press(3, Key::W).add(3, MouseMoveEvent{130, 60}).add(3, demo::WheelEvent{0, 1});
    script.add(5, MouseButtonEvent{MouseButton::Right, false, {}}).press(5, Key::D, kShift);
    script.press(7, Key::F12); // zvo-0002.png, from another position
    script.add(8, demo::ResizeEvent{333, 201}).press(9, Key::F12);
    script.add(10, demo::ResizeEvent{0, 0}).press(11, Key::V).press(13, Key::V, kShift);
    script.add(16, demo::ResizeEvent{64, 480}).add(18, demo::MinimizeEvent{true}).add(20, demo::MinimizeEvent{false});
    script.add(22, demo::ResizeEvent{240, 150});
    script.press(23, Key::Digit1).press(25, Key::F12); // zvo-0004.png
    script.press(27, Key::F).press(28, Key::C, kControl).press(29, Key::V, kControl);
    script.press(30, Key::F12).press(31, Key::W).press(33, Key::F12); // zvo-0005.png, zvo-0006.png
    script.press(34, Key::V, kControl).press(35, Key::F12);           // zvo-0007.png
    show(kCube + kCamera + kSize + kSteady + playing(script) +
         " --frames 38 --json stats.json --record-input again.json --frames-in-flight 3");
    EXPECT_EQ(file("again.json"), file("script.json"));
    EXPECT_EQ(shot(1), render(kCube + kCamera + kSize));
    EXPECT_NE(shot(2), shot(1));
    EXPECT_EQ(pixels("zvo-0003.png").width, 333U);
    EXPECT_EQ(pixels("zvo-0003.png").height, 201U);
    EXPECT_EQ(shot(4), shot(1));
    EXPECT_NE(shot(6), shot(5));
    EXPECT_EQ(shot(7), shot(5)) << "the camera that was copied";
    const json stats = jsonFile("stats.json");
    EXPECT_EQ(stats["frames"], 38);
    EXPECT_EQ(stats["frames_drawn"], 38 - 6 - 2) << "none without an extent or while it was minimised";
    EXPECT_GE(stats["swapchains"], 4);
}

TEST_F(DemoWindow, PanelsShowEveryViewWithoutAWordFromTheLayers)
{
    Script script;
    script.press(1, Key::F1).press(3, Key::F1);
    for (std::uint64_t i = 0; i < cli::kViews.size(); ++i)
    {
        script.press(5 + 2 * i, Key::V).add(5 + 2 * i, MouseMoveEvent{300.0 + 10.0 * static_cast<double>(i), 200});
    }
    // Clicks in panels close and open headers.
    for (std::uint64_t i = 0; i < 10; ++i)
    {
        const double y = 20.0 + 25.0 * static_cast<double>(i);
        script.add(30 + 3 * i, MouseMoveEvent{60, y});
        script.add(31 + 3 * i, MouseButtonEvent{MouseButton::Left, true, {}});
        script.add(32 + 3 * i, MouseButtonEvent{MouseButton::Left, false, {}});
    }
    script.press(65, Key::H).press(67, Key::H).press(68, Key::F12).press(68, Key::F12, kShift);
    script.press(71, Key::F12, kShift);
    script.press(40, Key::R).press(60, Key::R).press(62, Key::P).press(63, Key::Space);
    script.press(64, Key::Period);
    show("moving.scene.json --size 500x400 --frames 76 --json stats.json --screenshot last.png" + playing(script));
    const json stats = jsonFile("stats.json");
    EXPECT_EQ(stats["schema"], "zvo.demo/1");
    EXPECT_EQ(stats["frames_drawn"], 76);
    EXPECT_GT(stats["first_frame_ms"], 0);
    EXPECT_GT(stats["frame"]["mean_ms"], 0);
    EXPECT_GE(stats["frame"]["p95_ms"], 0);
    EXPECT_GT(stats["mrays_per_second"], 0);
    EXPECT_EQ(stats["scene"]["movers"], 1);
    EXPECT_GT(stats["bytes"]["peak"], 0);
    std::set<std::string> passes;
    for (const json& pass : stats["passes"])
    {
        passes.insert(pass["name"]);
    }
    for (const char* pass : {"trace/primary", "trace/inspect", "trace/beam", "update/merge", "present/compose",
                             "present/panels", "present/show"})
    {
        EXPECT_TRUE(passes.contains(pass)) << pass;
    }
    EXPECT_NE(file("last.png"), shot(2)) << "with and without panels";
    EXPECT_FALSE(render("cube.glb --resolution 32 --camera-path zvo-path.json").empty());
}

// The reason in an error message, without the program's name.
std::string reasonOf(const std::string& err)
{
    const std::size_t at = err.find(": error: ");
    return at == std::string::npos ? "" : err.substr(at);
}

TEST_F(DemoWindow, GoodFilesThatAreDroppedAreShownAndBadOnesAreNot)
{
    m_dir.write("text.glb", std::string_view("this is no scene"));
    Script script;
    script.add(1, demo::DropEvent{{"broken.glb"}}).press(2, Key::F12);
    script.add(4, demo::DropEvent{{"missing.obj"}}).add(4, demo::DropEvent{{"text.glb"}}).press(5, Key::F12);
    script.add(7, demo::DropEvent{{"slab.glb"}}).press(8, Key::F12);
    script.add(10, demo::DropEvent{{"moving.scene.json"}}).add(12, demo::DropEvent{{"cube.glb", "slab.glb"}});
    const Outcome outcome = runDemo(kCube + kSize + kSteady + playing(script) + " --frames 15 --screenshot last.png");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::string expected;
    for (const std::string name : {"broken.glb", "missing.obj", "text.glb"})
    {
        const Outcome theirs = runZvo(m_dir.path(), "render " + name + " -o never.png");
        EXPECT_EQ(theirs.exit_code, 3);
        expected += "zvo-demo" + reasonOf(theirs.err);
    }
    EXPECT_EQ(outcome.err, expected) << "a line for each of them, and nothing else";
    EXPECT_EQ(shot(1), render(kCube + kSize));
    EXPECT_EQ(shot(2), shot(1));
    EXPECT_EQ(shot(3), render("slab.glb --resolution 64" + kSize));
    EXPECT_EQ(file("last.png"), render("cube.glb slab.glb --resolution 64" + kSize));
}

// Without fixed steps, worlds are made while the old one is shown. In the end, the last dropped one is shown. The first
// one has many frames for its failure, as the next drop takes its place.
TEST_F(DemoWindow, ScenesAreMadeInTheBackground)
{
    Script script;
    script.add(2, demo::DropEvent{{"broken.glb"}}).add(100, demo::DropEvent{{"slab.glb"}});
    script.add(101, demo::DropEvent{{"moving.scene.json"}}).add(102, demo::DropEvent{{"slab.glb"}});
    script.add(102, demo::ResizeEvent{300, 200}).press(103, Key::S, kControl); // refused now
    const Outcome outcome =
        runDemo(kCube + kSize + playing(script) +
                " --frames 250 --hide-ui --view albedo --internal-scale 1 --screenshot last.png --json stats.json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("broken.glb"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(jsonFile("stats.json")["scene"]["name"], "slab.glb");
    EXPECT_EQ(jsonFile("stats.json")["frames"], 250);
    EXPECT_EQ(file("last.png"), render("slab.glb --resolution 64 --size 300x200 --view albedo"));
}

// The program quits while a world is made, and does not wait for further ones.
TEST_F(DemoWindow, QuitsWhileAWorldIsMade)
{
    for (const std::uint64_t quit : {3U, 4U, 6U})
    {
        Script script;
        script.add(2, demo::DropEvent{{"moving.scene.json"}}).add(3, demo::DropEvent{{"slab.glb"}});
        script.add(quit, demo::CloseEvent{});
        show(kCube + kSize + playing(script) + " --hide-ui");
    }
}

// A copy of the project's shaders. One of them has a time in the future, so that every F5 compiles it.
class ChangedShaders
{
public:
    ChangedShaders(const TempDir& folder, const std::string& name, const std::string& from, const std::string& to)
        : m_path(folder.path() / "shaders")
    {
        fs::copy(ZVO_SOURCE_DIR "/shaders", m_path, fs::copy_options::recursive);
        const fs::path file = m_path / name;
        std::string text = contentOf(file);
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << name << " has changed, too";
        text.replace(at, from.size(), to);
        folder.write("shaders/" + name, text);
        for (const auto& entry : fs::recursive_directory_iterator(m_path))
        {
            fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(1));
        }
        fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));
    }

private:
    fs::path m_path;
};

constexpr const char* kPixelLine = "color = encodeSrgb(surface.albedo);";

const Script kPicturesAroundF5 = Script().press(1, Key::F12).press(3, Key::F5).press(5, Key::F12);
const std::string kOfTheseShaders = " --view albedo --frames 8 --shaders shaders";

TEST_F(DemoWindow, AShaderWithAnErrorLeavesTheOldOneAndSaysWhy)
{
    const ChangedShaders shaders(m_dir, "trace/views.comp", kPixelLine, "color = nonsense;");
    const Outcome outcome = runDemo(kCube + kCamera + kSize + kSteady + kOfTheseShaders + playing(kPicturesAroundF5));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("'nonsense' : undeclared identifier"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("views.comp"), std::string::npos) << outcome.err;
    EXPECT_EQ(shot(2), shot(1));
}

TEST_F(DemoWindow, AShaderThatWasChangedShowsAtOnce)
{
    const ChangedShaders shaders(m_dir, "trace/views.comp", kPixelLine, "color = vec3(1.0, 0.0, 1.0);");
    show(kCube + kCamera + kSize + kSteady + kOfTheseShaders + playing(kPicturesAroundF5));
    const Image before = pixels("zvo-0001.png");
    const Image after = pixels("zvo-0002.png");
    int changed = 0;
    for (std::size_t i = 0; i < before.rgba.size(); i += 4)
    {
        const bool hit = before.rgba[i] + before.rgba[i + 1] + before.rgba[i + 2] != 0;
        changed += hit ? 1 : 0;
        ASSERT_EQ(after.rgba[i], hit ? 255 : 0);
        ASSERT_EQ(after.rgba[i + 1], 0);
        ASSERT_EQ(after.rgba[i + 2], hit ? 255 : 0);
    }
    EXPECT_GT(changed, 1000);
}

TEST_F(DemoWindow, SettingsAreKeptButForRunsOfSoManyFrames)
{
    Script script;
    script.press(1, Key::V).press(2, Key::F1).press(4, Key::Q, kControl);
    const std::string play = playing(script);
    show(kCube + kSize + play + " --frames 3");
    EXPECT_FALSE(fs::exists(m_dir.path() / "config/zvo/demo.json"));
    show(kCube + kSize + play);
    const json kept = jsonFile("config/zvo/demo.json");
    EXPECT_EQ(kept["window"]["width"], 240);
    EXPECT_EQ(kept["view"]["view"], "albedo");
    EXPECT_EQ(kept["keys"], true);
    show(kCube + play); // in a window of that size, flying from that view to the next
    EXPECT_EQ(jsonFile("config/zvo/demo.json")["window"]["width"], 240);
    EXPECT_EQ(jsonFile("config/zvo/demo.json")["view"]["view"], "normal");
    EXPECT_EQ(jsonFile("config/zvo/demo.json")["scenes"].size(), 1U) << "the camera of the scene";
    m_dir.write("config/zvo/demo.json", std::string_view("{\"schema\": 7"));
    const Outcome outcome = runDemo(kCube + kSize + play);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("zvo-demo: warning: settings are not used"), std::string::npos) << outcome.err;
    EXPECT_EQ(jsonFile("config/zvo/demo.json")["view"]["view"], "albedo");
}

TEST_F(DemoWindow, WithoutASceneItWaitsForOne)
{
    Script script;
    script.add(3, demo::DropEvent{{"cube.glb"}}).press(1, Key::F12);
    show("--resolution 64 --frames 6 --screenshot last.png" + kSize + kSteady + playing(script));
    EXPECT_NE(shot(1), file("last.png"));
    EXPECT_EQ(file("last.png"), render(kCube + kSize));
}

TEST_F(DemoWindow, ErrorsAreThoseOfTheCommandLine)
{
    const auto expectError = [this](const CommandLine& arguments, int exit_code, const std::string& part)
    { expectErrorLine(runDemo(arguments), exit_code, {part}, "zvo-demo"); };
    expectError("--nonsense", 2, "zvo-demo --help");
    expectError("cube.glb --view smell", 2, "--view smell");
    expectError("cube.glb --internal-scale 2", 2, "at most 1");
    expectError("cube.glb --screenshot a.png", 2, "--frames");
    expectError("broken.glb", 3, "broken.glb");
    expectError("cube.glb --input-script missing.json", 3, "missing.json");
    expectError("cube.glb --frames 1 --screenshot nowhere/a.png", 4, "nowhere");
    expectError("cube.glb --frames 1 --json cube.glb -f", 2, "is an input");
    expectError("cube.glb --frames 1 --record-input ./cube.glb -f", 2, "is an input");
    expectError("cube.glb --frames 1 --json a.png --screenshot a.png", 2, "two outputs");
    expectError("cube.glb --frames 1 --screenshot cube.glb -f", 2, ".png");
    expectError("cube.glb --frames 1 --json broken.glb", 4, "broken.glb");
    expectError({"cube.glb", "--device", "no such device"}, 5, "no such device");
    expectError("cube.glb --memory-limit 1M", 6, "--memory-limit");
}

TEST(DemoWithoutADisplay, PointsToZvoRender)
{
    const TempDir dir;
    const Outcome outcome =
        ZvoProcess(ZVO_DEMO_PROGRAM, dir.path(), {"zvo-demo"}, {"DISPLAY=", "WAYLAND_DISPLAY="}).wait();
    expectErrorLine(outcome, 5, {"error: there is no display", "zvo render"}, "zvo-demo");
    const Outcome help = ZvoProcess(ZVO_DEMO_PROGRAM, dir.path(), {"zvo-demo", "--help"}, {"DISPLAY="}).wait();
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.out.find("--camera-path"), std::string::npos);
}

} // namespace
} // namespace zvo::test
