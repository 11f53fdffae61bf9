// SPDX-License-Identifier: MIT
// The demo window under an X server of its own, played by a script.
#pragma once

#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "demo/input/input_script.h"
#include "demo/xvfb.h"
#include "io/image/image_io.h"
#include "support/device.h"
#include "support/temp_dir.h"

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

inline const std::vector<std::string> kCamera = {"--camera", "3,2.5,4,0.5,0.5,0.5,40"};
inline const std::vector<std::string> kSize = {"--size", "240x150"};

inline std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// What a key does, pressed before a frame and let go before the next one.
inline std::vector<ScriptedEvent> keyStroke(std::uint64_t frame, Key key, Modifiers modifiers = {})
{
    return {{frame, KeyEvent{key, true, modifiers}}, {frame + 1, KeyEvent{key, false, modifiers}}};
}

/// A script in the order of its frames.
class Script
{
public:
    Script& add(std::vector<ScriptedEvent> events)
    {
        m_events.insert(m_events.end(), events.begin(), events.end());
        return *this;
    }
    Script& add(std::uint64_t frame, demo::InputEvent event) { return add({{frame, std::move(event)}}); }

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
class DemoWindow : public testing::Test
{
protected:
    void SetUp() override
    {
        if (m_server.display().empty())
        {
            GTEST_SKIP() << "no Xvfb: install the package xvfb";
        }
        m_dir.write("cube.glb", coloredCube().glb());
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

    Outcome runDemo(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), "zvo-demo");
        if (std::ranges::find(arguments, "--device") == arguments.end())
        {
            arguments.insert(arguments.end(), {"--device", "cpu"});
        }
        if (deviceOptions().validation)
        {
            arguments.emplace_back("--validation");
        }
        return ZvoProcess(ZVO_DEMO_PROGRAM, m_dir.path(), arguments,
                          {"DISPLAY=" + m_server.display(),
                           "WAYLAND_DISPLAY=", "XDG_CONFIG_HOME=" + (m_dir.path() / "config").string()})
            .wait();
    }

    /// Runs it to its end, which is good and silent.
    void show(const std::vector<std::string>& arguments)
    {
        const Outcome outcome = runDemo(arguments);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }

    std::string render(const std::vector<std::string>& arguments)
    {
        const Outcome outcome = runZvo(m_dir.path(), std::vector<std::string>{"render"} + arguments +
                                                         std::vector<std::string>{"-o", "rendered.png", "-f"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return file("rendered.png");
    }

    [[nodiscard]] std::string file(const std::string& name) const { return contentOf(m_dir.path() / name); }
    [[nodiscard]] bool has(const std::string& name) const { return fs::exists(m_dir.path() / name); }

    /// Pixels of a picture, with its size in front.
    [[nodiscard]] Image picture(const std::string& name) const
    {
        const std::string png = file(name);
        return decodeImage({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()}, name, name);
    }

    Xvfb m_server;
    TempDir m_dir;
};

// Frames one after the other, each at its own time, without panels.
inline const std::vector<std::string> kSteady = {"--fixed-step", "1/10", "--hide-ui"};
inline const std::vector<std::string> kCube = {"cube.glb", "--resolution", "64"};

} // namespace zvo::test
