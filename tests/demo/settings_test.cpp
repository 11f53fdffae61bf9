// SPDX-License-Identifier: MIT
// What the window keeps from run to run.
#include "demo/app/scene_memory.h"
#include "demo/app/settings.h"
#include "support/temp_dir.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace zvo::demo
{
namespace
{

SceneMemory memoryOf(const std::string& file, double x)
{
    SceneMemory memory;
    memory.files = {file};
    memory.camera = ViewCamera::lookAt({x, 2, 3}, {0, 0, 0.1}, 0.7);
    memory.bookmarks[4] = ViewCamera::lookAt({x, 2, 3}, {9, 0, 0.1}, 0.3);
    memory.bookmarks[8] = memory.camera;
    memory.bookmarks[8]->orthographic = true;
    memory.bookmarks[8]->half_height = 1.0 / 7.0;
    memory.to_sun = {x, 1, 0};
    memory.exposure = 1.3F;
    return memory;
}

Settings otherSettings()
{
    Settings settings;
    settings.window = {801, 603};
    settings.shows_panels = false;
    settings.shows_keys = true;
    settings.view.frame.trace.view = View::Bricks;
    settings.view.frame.trace.shadows = false;
    settings.view.frame.trace.occlusion_rays = 7;
    settings.view.frame.denoise = true;
    settings.view.frame.trace.to_sun = {0.1, 1.0 / 3.0, -2};
    settings.view.frame.exposure.factor = 1.3F;
    settings.view.frame.trace.detail_pixels = 2.6F;
    settings.view.internal_scale = 0.375;
    settings.view.present_mode = vk::PresentMode::Mailbox;
    settings.view.frame.path.bounces = 3;
    settings.view.map_sun = true;
    settings.brush = {Tool::Camera, BrushAction::Paint, BrushShape::Box, 3, {0.25F, 1.0F / 3.0F, 1.0F}};
    settings.brush.emission = 12.5F;
    settings.brush.form = BrushForm::Flood;
    settings.brush.tolerance = 255;
    settings.scenes = {memoryOf("/a/b.glb", 1.0 / 3.0), memoryOf("/c d.zvo", -7)};
    return settings;
}

TEST(Settings, WhatIsWrittenIsRead)
{
    for (const Settings& settings : {Settings{}, otherSettings()})
    {
        EXPECT_EQ(parseSettings(settingsText(settings), "s.json"), settings);
    }
    EXPECT_EQ(parseSettings(R"({"schema": "zvo.demo_settings/1"})", "s.json"), Settings{});
    Settings given = otherSettings();
    given.view.frame.exposure = {.automatic = false, .factor = 2.0F};
    EXPECT_EQ(parseSettings(settingsText(given), "s.json").view.frame.exposure, Exposure()) << "an option's";
    Settings latin = otherSettings();
    latin.scenes.front().files = {"/caf\xe9.glb"};
    EXPECT_EQ(parseSettings(settingsText(latin), "s.json").scenes.back(), latin.scenes.back());
}

TEST(Settings, AreWrittenToAFolderThatIsMade)
{
    const test::TempDir folder;
    const std::filesystem::path file = folder.path() / "a" / "b" / "demo.json";
    Settings first;
    first.is_first = true;
    EXPECT_EQ(readSettings(file), first);
    writeSettings(file, otherSettings());
    EXPECT_EQ(readSettings(file), otherSettings());
    writeSettings(file, Settings{});
    EXPECT_EQ(readSettings(file), Settings{});
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1) << "nothing beside it";
}

TEST(Settings, ADamagedFileIsNotUsed)
{
    const test::TempDir folder;
    const std::string good = settingsText(otherSettings());
    const std::vector<std::string> bad = {"",
                                          "{",
                                          good.substr(0, good.size() / 2),
                                          R"({"schema": "other"})",
                                          R"({"schema": "zvo.demo_settings/1", "window": {"width": 0, "height": 5}})",
                                          R"({"schema": "zvo.demo_settings/1", "view": {"view": "smell"}})",
                                          R"({"schema": "zvo.demo_settings/1", "view": {"sun": [0, 0, 0]}})",
                                          R"({"schema": "zvo.demo_settings/1", "view": {"exposure": -1}})",
                                          R"({"schema": "zvo.demo_settings/1", "brush": {"action": "smell"}})",
                                          R"({"schema": "zvo.demo_settings/1", "scenes": [{"files": ["a"]}]})",
                                          R"({"schema": "zvo.demo_settings/1", "more": 1})"};
    for (const std::string& text : bad)
    {
        EXPECT_THROW(parseSettings(text, "s.json"), Error) << text;
        testing::internal::CaptureStderr();
        EXPECT_EQ(readSettings(folder.write("demo.json", text)), Settings{}) << text;
        const std::string told = testing::internal::GetCapturedStderr();
        EXPECT_NE(told.find("warning: settings are not used"), std::string::npos) << told;
        EXPECT_EQ(std::ranges::count(told, '\n'), 1) << told;
    }
}

TEST(Settings, APlaceThatCannotBeWrittenToIsTold)
{
    testing::internal::CaptureStderr();
    writeSettings("/proc/nowhere/demo.json", Settings{});
    EXPECT_NE(testing::internal::GetCapturedStderr().find("warning: settings are not kept"), std::string::npos);
}

TEST(SceneMemory, TheLastSceneIsTheFirstAndTheOldestAreForgotten)
{
    std::vector<SceneMemory> memories;
    for (std::size_t i = 0; i < SceneMemory::kMost + 3; ++i)
    {
        remember(memories, memoryOf("/" + std::to_string(i), 1));
    }
    EXPECT_EQ(memories.size(), SceneMemory::kMost);
    EXPECT_EQ(recall(memories, {"/2"}), nullptr);
    remember(memories, memoryOf("/5", 2));
    EXPECT_EQ(memories.size(), SceneMemory::kMost) << "in place of the older one";
    EXPECT_EQ(memories.front(), memoryOf("/5", 2));
    ASSERT_NE(recall(memories, {"/7"}), nullptr);
    EXPECT_EQ(*recall(memories, {"/7"}), memoryOf("/7", 1));
    EXPECT_EQ(recall(memories, {"/7", "/8"}), nullptr) << "two files are another scene";
}

} // namespace
} // namespace zvo::demo
