// SPDX-License-Identifier: MIT
// The demo window under an X server of its own, played by a script.
#pragma once

#include "cli/cli_folder.h"
#include "demo/input/input_script.h"
#include "demo/xvfb.h"
#include "support/device.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace zvo::test
{

namespace fs = std::filesystem;
using demo::Key;
using demo::KeyEvent;
using demo::Modifiers;
using demo::MouseButton;
using demo::MouseButtonEvent;
using demo::MouseMoveEvent;
using demo::ScriptedEvent;

inline constexpr Modifiers kShift = {true, false, false};
inline constexpr Modifiers kControl = {false, true, false};

// Options of the window and of zvo render.
inline const std::string kCamera = " --camera 3,2.5,4,0.5,0.5,0.5,40";
inline const std::string kSize = " --size 240x150";
inline const std::string kCube = "cube.glb --resolution 64";

// Frames one after the other, each at its own time, without panels.
inline const std::string kSteady = " --fixed-step 1/10 --hide-ui";

/// A script in the order of its frames.
class Script
{
public:
    Script& add(std::uint64_t frame, demo::InputEvent event)
    {
        m_events.push_back({frame, std::move(event)});
        return *this;
    }

    /// Presses a key before a frame, and lets it go before the next one.
    Script& press(std::uint64_t frame, Key key, Modifiers modifiers = {})
    {
        return add(frame, KeyEvent{key, true, modifiers}).add(frame + 1, KeyEvent{key, false, modifiers});
    }

    [[nodiscard]] std::string text() const
    {
        std::vector<ScriptedEvent> sorted = m_events;
        std::ranges::stable_sort(sorted, {}, &ScriptedEvent::frame);
        return inputScriptText(sorted);
    }

private:
    std::vector<ScriptedEvent> m_events;
};

/// A folder with cube.glb, slab.glb, broken.glb and moving.scene.json, and a display to show them on.
class DemoWindow : public CliFolder
{
protected:
    void SetUp() override
    {
        if (m_server.display().empty())
        {
            GTEST_SKIP() << "no Xvfb: install the package xvfb";
        }
        GltfBuilder slab = coloredCube();
        slab.document["nodes"][0]["scale"] = {0.25, 0.5, 1.5};
        m_dir.write("slab.glb", slab.glb());
        const std::vector<std::uint8_t> whole = coloredCube().glb();
        m_dir.write("broken.glb", std::span(whole).first(whole.size() / 2));
        m_dir.write("moving.scene.json", std::string_view(R"({"seconds": 2, "frames_per_second": 10,
            "grid": {"depth": 6, "bounds": {"min": [-1.625, -1, -1], "max": [2.375, 3, 3]}},
            "objects": [{"file": "cube.glb"},
                        {"file": "slab.glb", "motion": {"line": {"from": [-2, 0, 0], "to": [2, 0, 0]}}}]})"));
    }

    Outcome runDemo(const CommandLine& arguments) const
    {
        std::vector<std::string> command = onTestDevice(arguments, "cpu");
        command.insert(command.begin(), "zvo-demo");
        return ZvoProcess(ZVO_DEMO_PROGRAM, m_dir.path(), command,
                          {"DISPLAY=" + m_server.display(),
                           "WAYLAND_DISPLAY=", "XDG_CONFIG_HOME=" + (m_dir.path() / "config").string()})
            .wait();
    }

    /// Runs it to its end, which is good and silent.
    void show(const std::string& arguments) const
    {
        const Outcome outcome = runDemo(arguments);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }

    /// The last picture of so many steady frames.
    [[nodiscard]] std::string shown(const std::string& arguments, int frames = 1) const
    {
        show(arguments + kSteady + " --screenshot shown.png -f --frames " + std::to_string(frames));
        return file("shown.png");
    }

    /// The picture of `zvo render`. By primary rays it has one sample and four occlusion rays, like a steady frame.
    [[nodiscard]] std::string render(const std::string& arguments) const
    {
        const auto given = [&](std::string_view option) { return arguments.find(option) != std::string::npos; };
        const bool is_lit = !given("--integrator") && (!given("--view") || given("--view color"));
        run("render -o rendered.png -f " + arguments + (is_lit && !given("--spp") ? " --spp 1" : "") +
            (is_lit && !given("--occlusion") ? " --occlusion 4" : ""));
        return file("rendered.png");
    }

    /// Writes a script, and returns the option that plays it.
    [[nodiscard]] std::string playing(const Script& script) const
    {
        m_dir.write("script.json", script.text());
        return " --input-script script.json";
    }

    /// A screenshot that a key has asked for.
    [[nodiscard]] static std::string shotName(int number) { return fmt::format("zvo-{:04}.png", number); }
    [[nodiscard]] std::string shot(int number) const { return file(shotName(number)); }

    Xvfb m_server;
};

} // namespace zvo::test
