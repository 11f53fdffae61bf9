// SPDX-License-Identifier: MIT
// Parts of the demo that need no window: keys, sun, statistics, time, shader sources.
#include "demo/app/shader_sources.h"
#include "demo/input/elapsed.h"
#include "demo/input/keys.h"
#include "demo/input/pointer_ray.h"
#include "demo/input/sun_control.h"
#include "demo/input/timeline.h"
#include "demo/panels/brush_cursor.h"
#include "demo/panels/file_dialog.h"
#include "demo/panels/frame_stats.h"
#include "demo/panels/notices.h"
#include "support/temp_dir.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace zvo::demo
{
namespace
{

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(Keys, TheDocumentationHasTheTableOfTheProgram)
{
    const std::string page = contentOf(ZVO_SOURCE_DIR "/docs/window.md");
    std::string table = "\n| key | what it does |\n|---|---|\n";
    for (const KeyBinding& binding : kKeyBindings)
    {
        table += "| " + std::string(binding.keys) + " | " + std::string(binding.what) + " |\n";
    }
    EXPECT_NE(page.find(table + "\n"), std::string::npos) << "it should have\n" << table;
}

TEST(ShaderSources, AreThoseThatWereInstalledWithTheProgram)
{
    const test::TempDir dir;
    const std::filesystem::path program = dir.path() / "bin" / "zvo-demo";
    const std::filesystem::path installed = dir.path() / "share" / "zvo" / "shaders";
    EXPECT_EQ(shadersOf(program), ZVO_SOURCE_DIR "/shaders");
    EXPECT_EQ(shadersOf({}), ZVO_SOURCE_DIR "/shaders");
    std::filesystem::create_directories(installed);
    EXPECT_EQ(shadersOf(program), installed);
    EXPECT_EQ(shadersOf(thisProgram()), ZVO_SOURCE_DIR "/shaders") << "this one was not installed";
}

TEST(Keys, NoKeyDoesTwoThings)
{
    std::set<std::tuple<Key, bool, bool>> keys;
    std::set<Action> actions;
    for (const KeyBinding& binding : kKeyBindings)
    {
        EXPECT_FALSE(binding.what.empty());
        if (binding.action == Action::None)
        {
            continue;
        }
        EXPECT_TRUE(actions.insert(binding.action).second) << binding.what;
        for (int key = static_cast<int>(binding.key); key <= static_cast<int>(binding.last_key); ++key)
        {
            EXPECT_TRUE(keys.insert({static_cast<Key>(key), binding.shift, binding.control}).second) << binding.keys;
        }
    }
    for (const Key key : {Key::W, Key::A, Key::S, Key::D, Key::E, Key::Q})
    {
        EXPECT_FALSE(keys.contains({key, false, false})) << "the camera has it";
    }
}

TEST(Keys, PressesFindTheirRow)
{
    const auto actionOf = [](Key key, Modifiers modifiers, bool pressed = true)
    {
        const KeyBinding* const binding = bindingOf({key, pressed, modifiers});
        return binding != nullptr ? binding->action : Action::None;
    };
    EXPECT_EQ(actionOf(Key::F12, {}), Action::Screenshot);
    EXPECT_EQ(actionOf(Key::F12, {true, false, false}), Action::ScreenshotOfPicture);
    EXPECT_EQ(actionOf(Key::F12, {}, false), Action::None);
    EXPECT_EQ(actionOf(Key::V, {false, true, false}), Action::Paste);
    EXPECT_EQ(actionOf(Key::V, {false, false, true}), Action::None);
    EXPECT_EQ(actionOf(Key::Digit1, {}), Action::RecallBookmark);
    EXPECT_EQ(actionOf(Key::Digit9, {false, true, false}), Action::StoreBookmark);
    EXPECT_EQ(actionOf(Key::Digit0, {}), Action::None);
    EXPECT_EQ(actionOf(Key::W, {}), Action::None);
}

TEST(SunControl, TheMouseMovesTheSunWhileLIsHeld)
{
    for (const glm::dvec3& to_sun : {glm::dvec3(-0.6, 0.75, 0.45), glm::dvec3(3, 0.1, -1)})
    {
        EXPECT_LT(glm::distance(toSun(sunAngles(to_sun)), glm::normalize(to_sun)), 1e-12);
    }
    EXPECT_NEAR(sunAngles({1, 1, 0}).azimuth, 90, 1e-9) << "x is east";
    EXPECT_NEAR(sunAngles({1, 1, 0}).elevation, 45, 1e-9);
    glm::dvec3 sun = {1, 1, 0};
    SunControl control;
    EXPECT_FALSE(control.handle(MouseMoveEvent{10, 10}, sun));
    EXPECT_FALSE(control.handle(MouseMoveEvent{90, 10}, sun));
    EXPECT_FALSE(control.handle(KeyEvent{Key::L, true, {}}, sun));
    EXPECT_TRUE(control.handle(MouseMoveEvent{130, 30}, sun));
    EXPECT_NEAR(sunAngles(sun).azimuth, 100, 1e-9);
    EXPECT_NEAR(sunAngles(sun).elevation, 40, 1e-9);
    control.handle(MouseMoveEvent{130, -9000}, sun);
    EXPECT_NEAR(sunAngles(sun).azimuth, 100, 1e-6) << "not lost at the top";
    control.handle(KeyEvent{Key::L, false, {}}, sun);
    EXPECT_FALSE(control.handle(MouseMoveEvent{0, 0}, sun));
}

TEST(FileDialog, ListsFoldersFirstAndOnlyWhatCanBeRead)
{
    const test::TempDir folder;
    for (const char* name : {"b.glb", "a.VOX", "text.txt", ".hidden.glb"})
    {
        folder.write(name, std::string_view("x"));
    }
    std::filesystem::create_directories(folder.path() / "z.folder");
    const std::vector<FileEntry> expected = {{"z.folder", true}, {"a.VOX", false}, {"b.glb", false}};
    EXPECT_EQ(listFolder(folder.path(), {".glb", ".vox"}), expected);
    EXPECT_EQ(listFolder(folder.path(), {}).size(), 4U);
    EXPECT_TRUE(listFolder(folder.path() / "nowhere", {}).empty());
}

// The grid's voxels are of size 1; the camera looks along -z onto the face of a voxel at z = 3.
TEST(BrushPlace, FollowsThePointerAlongTheFaceThatWasFound)
{
    Grid grid;
    grid.depth = 4;
    grid.origin = {0, 0, 0};
    grid.voxel_size = 1;
    PointerView view;
    view.camera.position = {8.5, 8.5, 24};
    view.camera.vertical_fov = 0.8;
    view.size = {200, 100};
    InspectedPixel found;
    EXPECT_FALSE(brushPlace(view, grid, found));
    found.report.hit = 1;
    found.report.level = grid.nodeLevels();
    found.report.cell = {8, 8, 3};
    found.report.face = 2;
    const auto pointAt = [&](const glm::dvec3& point)
    { view.pointer = pointOf(view.camera, point, view.size).value(); };
    pointAt({8.5, 8.5, 4});
    ASSERT_TRUE(brushPlace(view, grid, found));
    EXPECT_EQ(brushPlace(view, grid, found)->voxel, glm::ivec3(8, 8, 3));
    EXPECT_EQ(brushPlace(view, grid, found)->step, glm::ivec3(0, 0, 1));
    pointAt({11.2, 6.7, 4});
    EXPECT_EQ(brushPlace(view, grid, found)->voxel, glm::ivec3(11, 6, 3));
    found.report.face = gpu::kFaceInside;
    EXPECT_EQ(brushPlace(view, grid, found)->voxel, glm::ivec3(8, 8, 3));
}

TEST(History, TellsMeanAndTheValueThat95OfAHundredDoNotExceed)
{
    History history;
    EXPECT_EQ(history.mean(), 0);
    EXPECT_EQ(history.p95(), 0);
    history.add(3);
    EXPECT_EQ(history.p95(), 3);
    History hundred;
    for (int i = 100; i >= 1; --i)
    {
        hundred.add(i);
    }
    EXPECT_EQ(hundred.mean(), 50.5);
    EXPECT_EQ(hundred.p95(), 95);
    EXPECT_EQ(hundred.last(), 1);
    for (int i = 0; i < 1000; ++i)
    {
        hundred.add(i);
    }
    EXPECT_EQ(hundred.values().size(), History::kLength);
    EXPECT_EQ(hundred.values().front(), 1000 - static_cast<int>(History::kLength)) << "the oldest went";
}

TEST(FrameStats, PassesOfAnOperationAreAddedUp)
{
    EXPECT_EQ(operationOf("trace/primary"), "trace");
    EXPECT_EQ(operationOf("fill update/bricks"), "update");
    EXPECT_EQ(operationOf("copy edit/states to edit/reports"), "edit");
    EXPECT_EQ(operationOf("fill image"), "other");
    FrameStats stats;
    stats.addPasses(std::vector<vk::PassTime>{{"trace/beam", 1.0}, {"edit/find", 0.5}, {"trace/shade", 2.0}}, {100});
    stats.addPasses(std::vector<vk::PassTime>{{"trace/beam", 5.0}}, {100});
    EXPECT_EQ(stats.operations(), (std::vector<std::string>{"trace", "edit"}));
    EXPECT_EQ(stats.operation("trace").values(), (std::vector<float>{3.0F, 5.0F}));
    EXPECT_EQ(stats.operation("edit").values(), (std::vector<float>{0.5F, 0.0F}));
}

TEST(FrameStats, PassesOfTheSameNameCountTogetherAndMissingOnesAsNothing)
{
    FrameStats stats;
    stats.addPasses(std::vector<vk::PassTime>{{"trace/beam", 1}, {"a", 2}, {"a", 3}, {"trace/primary", 4}}, {10'000});
    stats.addPasses(std::vector<vk::PassTime>{{"b", 6}, {"a", 1}}, {10'000});
    EXPECT_EQ(stats.names(), (std::vector<std::string>{"trace/beam", "a", "trace/primary", "b"}));
    EXPECT_EQ(stats.pass("a").values(), (std::vector<float>{5, 1}));
    EXPECT_EQ(stats.pass("trace/beam").values(), (std::vector<float>{1, 0}));
    EXPECT_EQ(stats.pass("b").values(), (std::vector<float>{6}));
    EXPECT_EQ(stats.gpuMs().values(), (std::vector<float>{10, 7}));
    EXPECT_DOUBLE_EQ(stats.megaraysPerSecond(), 2.0) << "10,000 rays in 5 ms";
    stats.addFrame(20);
    stats.addFrame(30);
    EXPECT_DOUBLE_EQ(stats.framesPerSecond(), 40);
}

TEST(FrameStats, RaysOfPathsCountInTheTimeOfWhatFollowsPaths)
{
    FrameStats stats;
    stats.addPasses(std::vector<vk::PassTime>{{"trace/primary", 1}}, {5'000});
    EXPECT_EQ(stats.integrator(), Integrator::Primary);
    EXPECT_DOUBLE_EQ(stats.megaraysPerSecond(), 5.0);
    // The first pass finds the hit of the pixel under the pointer.
    stats.addPasses(std::vector<vk::PassTime>{{"trace/primary", 100},
                                              {"fill path/lists", 0.5},
                                              {"trace/rays", 2},
                                              {"path/shade", 1},
                                              {"trace/rays", 1},
                                              {"path/finish", 0.5},
                                              {"denoise/filter", 100},
                                              {"path/meter", 100},
                                              {"path/expose", 100},
                                              {"path/develop", 100}},
                    {10'000, Integrator::Path});
    EXPECT_EQ(stats.integrator(), Integrator::Path);
    EXPECT_DOUBLE_EQ(stats.megaraysPerSecond(), 2.0) << "10,000 rays in 5 ms, and nothing of primary rays";
}

TEST(Elapsed, FixedStepsAreWhatMultiplyingSays)
{
    Elapsed thirtieths{FixedStep{1, 30}};
    for (int i = 1; i <= 1000; ++i)
    {
        thirtieths.add(99.0);
        ASSERT_EQ(thirtieths.seconds(), i / 30.0);
    }
    Elapsed clock{std::nullopt};
    clock.add(0.25);
    clock.add(0.5);
    EXPECT_EQ(clock.seconds(), 0.75);
}

TEST(Timeline, StopsStepsAndLoops)
{
    AnimatedScene animated;
    animated.seconds = 2;
    animated.frames_per_second = 10;
    Timeline timeline{FixedStep{1, 10}};
    timeline.start(0.5);
    for (int i = 0; i < 4; ++i)
    {
        timeline.advance(99);
    }
    EXPECT_DOUBLE_EQ(timeline.secondsIn(animated), 0.9);
    timeline.nextFrame(animated);
    timeline.advance(99);
    EXPECT_DOUBLE_EQ(timeline.secondsIn(animated), 1.0) << "it stands still";
    timeline.play(true);
    timeline.setSpeed(3);
    timeline.advance(99);
    EXPECT_DOUBLE_EQ(timeline.secondsIn(animated), 1.3);
    timeline.advance(99);
    timeline.advance(99);
    timeline.advance(99);
    EXPECT_NEAR(timeline.secondsIn(animated), 0.2, 1e-12);
}

TEST(Notices, GoAfterAWhileAndAreNotManyAtOnce)
{
    Notices notices;
    for (int i = 0; i < 20; ++i)
    {
        notices.add(std::to_string(i));
    }
    ASSERT_EQ(notices.all().size(), Notices::kMost);
    EXPECT_EQ(notices.all().back().text, "19");
    notices.advance(Notices::kSeconds - 1);
    notices.add("late");
    notices.advance(1.5);
    ASSERT_EQ(notices.all().size(), 1U);
    EXPECT_EQ(notices.all().front().text, "late");
}

TEST(ShaderSources, IncludesAreFound)
{
    EXPECT_EQ(includesOf("#version 460\n  #include \"a/b.h\"\n// #include \"no\"\n#include <no>\n#include \"c.glsl\""),
              (std::vector<std::string>{"a/b.h", "c.glsl"}));
    EXPECT_TRUE(includesOf("#include \"open\n").empty());
}

/// A folder of two kernels; one of them includes a file that includes another one.
class SourceFolder
{
public:
    SourceFolder()
    {
        write("op/a.comp", "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"lib/x.glsl\"\n"
                           "layout(local_size_x = 1) in;\nvoid main() { twice(1); }\n");
        write("op/b.comp", "#version 460\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
        write("lib/x.glsl", "#include \"lib/y.glsl\"\nint twice(int n) { return kTwo * n; }\n");
        write("lib/y.glsl", "const int kTwo = 2;\n");
    }

    void write(const std::string& file, const std::string& text)
    {
        const std::filesystem::path path = m_folder.path() / file;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
        std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
    }

    /// Writes a file with a time later than that of all others.
    void change(const std::string& file, const std::string& text)
    {
        write(file, text);
        std::filesystem::last_write_time(m_folder.path() / file, std::filesystem::file_time_type::clock::now());
    }

    [[nodiscard]] const std::filesystem::path& path() const { return m_folder.path(); }

private:
    test::TempDir m_folder;
};

const std::vector<std::string> kNames = {"op/a", "op/b", "op/missing"};
using Names = std::vector<std::string>;

TEST(ShaderSources, ChangesAreThoseOfIncludedFilesToo)
{
    SourceFolder folder;
    ShaderSources sources(folder.path());
    EXPECT_TRUE(sources.exist());
    EXPECT_EQ(sources.takeChanged(kNames), Names{});
    folder.change("op/b.comp", "#version 460\n");
    EXPECT_EQ(sources.takeChanged(kNames), Names{"op/b"});
    EXPECT_EQ(sources.takeChanged(kNames), Names{}) << "once";
    folder.change("lib/y.glsl", "#include \"lib/x.glsl\"\nconst int kTwo = 3;\n"); // the includes are circular
    EXPECT_EQ(sources.takeChanged(kNames), Names{"op/a"});
    EXPECT_FALSE(ShaderSources("/nowhere/shaders").exist());
}

TEST(ShaderSources, CompilesOrTellsWhatTheCompilerSays)
{
    SourceFolder folder;
    ShaderSources sources(folder.path());
    const std::vector<CompiledShader> good = sources.compile({"op/a", "op/b"});
    ASSERT_EQ(good.size(), 2U);
    for (const CompiledShader& shader : good)
    {
        ASSERT_FALSE(shader.words.empty()) << shader.message;
        EXPECT_EQ(shader.words.front(), 0x07230203U) << "SPIR-V begins with it";
    }
    folder.change("op/b.comp", "#version 460\nlayout(local_size_x = 1) in;\nvoid main() { nonsense; }\n");
    EXPECT_EQ(sources.takeChanged(kNames), Names{"op/b"});
    const std::vector<CompiledShader> bad = sources.compile({"op/a", "op/b"});
    EXPECT_FALSE(bad[0].words.empty());
    EXPECT_TRUE(bad[1].words.empty());
    EXPECT_NE(bad[1].message.find("b.comp:3: 'nonsense'"), std::string::npos) << bad[1].message;
    EXPECT_EQ(sources.takeChanged(kNames), Names{"op/b"}) << "what does not compile is tried again";
    folder.write("op/b.comp", "#version 460\nlayout(local_size_x = 1) in;\nvoid main() {}\n");
    EXPECT_FALSE(sources.compile({"op/b"})[0].words.empty());
    EXPECT_EQ(sources.takeChanged(kNames), Names{});
}

} // namespace
} // namespace zvo::demo
