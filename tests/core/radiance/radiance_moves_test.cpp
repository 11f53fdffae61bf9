// SPDX-License-Identifier: MIT
// The radiance cache, while something moves.
#include "core/base/grid.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/frame/frame_renderer.h"
#include "support/dynamic_updates.h"
#include "support/engine_device.h"
#include "support/lit_voxels.h"
#include "support/radiance_cache.h"
#include "support/scenes.h"
#include "support/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::FaceLight;
using test::FaceName;
using test::facesOf;
using test::LitVoxel;

constexpr std::uint32_t kUp = 1; // number of the normal
constexpr std::uint32_t kEdge = 32;
constexpr double kSunlight = 2.0;
constexpr float kEmission = 1.0F; // the scale of all that has any

// A floor in the sun, above which a box moves: its shadow lies straight below it.
class Stage
{
public:
    explicit Stage(std::uint32_t picture_edge)
        : m_tree(device(), floor(), {.emission_scale = kEmission}), m_tracer(device().device())
    {
        m_sky.setSun({.direction = {0.0, 1.0, 0.0}, .irradiance = glm::dvec3(kSunlight), .angle = 0.001});
        m_tracer.resize(picture_edge, picture_edge);
        m_mover =
            m_tree.add(uploadDynamicMesh(device(), test::boxScene(glm::vec3(0.0F), glm::vec3(kBox)), true, kEmission),
                       poseAt(0.0F));
        test::updateAll(device(), m_tree);
    }

    // Moves the box to x, and runs a frame.
    void moveTo(float x)
    {
        m_tree.setPose(m_mover, poseAt(x));
        test::updateAll(device(), m_tree);
        run(1);
    }

    void run(std::uint32_t frames) { test::runFrames(m_tracer, m_tree.tree(), m_sky, m_view, frames, {}); }

    // The mean of the light of the floor's faces in the middle of the box's shadow at x, over that in the sun. The
    // shadow has none, but for the sun that the box and the floor reflect to each other.
    double lightBelow(float x)
    {
        double sum = 0.0;
        double count = 0.0;
        for (const auto& [name, face] : facesOf(m_tracer.cache()))
        {
            const glm::ivec3 cell(name.cell);
            const glm::ivec2 from_middle = glm::abs(glm::ivec2(cell.x - static_cast<int>(x) - 4, cell.z - 15));
            if (cell.y == 0 && name.normal == kUp && from_middle.x < 2 && from_middle.y < 2)
            {
                sum += face.radiance.g / kSunlight;
                ++count;
            }
        }
        EXPECT_GT(count, 4.0);
        return sum / count;
    }

    FrameRenderer& tracer() { return m_tracer; }

private:
    static constexpr float kBox = 8.0F;

    static DeviceTree floor()
    {
        std::vector<LitVoxel> voxels;
        test::addBox(voxels, {0, 0, 0}, {kEdge, 1, kEdge}, {{}, glm::uvec3(60), glm::vec3(0.0F)});
        return test::litTree(device(), voxels, 5);
    }

    static Pose poseAt(float x)
    {
        Pose pose;
        pose.transforms = {glm::translate(glm::mat4(1.0F), glm::vec3(x + 0.1F, 16.1F, 11.1F))};
        return pose;
    }

    DynamicOctree m_tree;
    DeviceEnvironment m_sky = test::constantSky(glm::vec3(0.0F));
    FrameRenderer m_tracer;
    ViewCamera m_view = ViewCamera::lookAt({16.0, 15.0, 40.0}, {16.0, 0.0, 14.0}, 1.0);
    DynamicObjectId m_mover = 0;
};

// The light that the box has blocked comes, and that which it blocks goes, within 24 frames, whether it has moved
// before or stood still.
TEST(RadianceMoves, ShadowsFollow)
{
    Stage stage(96);
    stage.run(200);
    EXPECT_LT(stage.lightBelow(0.0F), 0.03);
    EXPECT_GT(stage.lightBelow(20.0F), 0.97);
    stage.moveTo(20.0F);
    stage.run(23);
    EXPECT_GT(stage.lightBelow(0.0F), 0.9);
    EXPECT_LT(stage.lightBelow(20.0F), 0.1);
    stage.moveTo(0.0F);
    stage.run(23);
    EXPECT_LT(stage.lightBelow(0.0F), 0.1);
    EXPECT_GT(stage.lightBelow(20.0F), 0.9);
}

// Where the box is not, light stays as smooth as it was.
TEST(RadianceMoves, OtherLightKeepsItsSamples)
{
    Stage stage(64);
    stage.run(150);
    // The mean of a column of the floor's faces.
    const auto samplesAt = [&](std::uint32_t x)
    {
        double sum = 0.0;
        double count = 0.0;
        for (const auto& [name, face] : facesOf(stage.tracer().cache()))
        {
            if (name.cell.y == 0 && name.normal == kUp && name.cell.x == x && name.cell.z > 10 && name.cell.z < 20)
            {
                sum += face.samples;
                ++count;
            }
        }
        return sum / count;
    };
    const double before = samplesAt(30);
    EXPECT_GT(before, gpu::kTouchedSamples);
    for (float x = 1.0F; x < 6.0F; ++x)
    {
        stage.moveTo(x);
    }
    EXPECT_LE(samplesAt(6), gpu::kMovedSamples);
    EXPECT_GE(samplesAt(30), 0.75 * gpu::kTouchedSamples) << "some of its rays hit the box by chance";
}

// Faces that the box has left are forgotten, so that the table does not fill up while something moves.
TEST(RadianceMoves, WhatHasMovedOnTakesNoRoom)
{
    Stage stage(32);
    const auto boxFacesAtTheLeft = [&]
    {
        const auto faces = facesOf(stage.tracer().cache());
        return std::ranges::count_if(faces,
                                     [](const auto& face) { return face.first.cell.y > 0 && face.first.cell.x < 16; });
    };
    for (std::uint32_t frame = 0; frame < 40; ++frame)
    {
        stage.moveTo(static_cast<float>(frame % 8));
    }
    EXPECT_GT(boxFacesAtTheLeft(), 100);
    for (std::uint32_t frame = 0; frame < 400; ++frame)
    {
        stage.moveTo(20.0F + static_cast<float>(frame % 2));
    }
    EXPECT_EQ(boxFacesAtTheLeft(), 0);
}

// A closed room below an even sky, seen from inside. A hole in its ceiling lets light in.
class Room
{
public:
    Room() : m_tree(device(), test::litTree(device(), test::roomOf({{}, glm::uvec3(188), glm::vec3(0.0F)}, 16), 4), {})
    {
        m_tracer.resize(48, 48);
    }

    void carve()
    {
        const Brush hole = {.action = BrushAction::Carve, .center = {8, 15, 8}, .radius = 2};
        for (bool is_done = false; !is_done;)
        {
            frame([&](vk::FrameGraph& graph) { is_done = m_tree.edit(graph, hole); });
        }
        m_tree.endStroke();
        m_tracer.cache().noteChange();
    }

    void undo()
    {
        frame([&](vk::FrameGraph& graph) { EXPECT_TRUE(m_tree.undoEdit(graph)); });
        m_tracer.cache().noteChange();
    }

    void run(std::uint32_t frames) { test::runFrames(m_tracer, m_tree.tree(), m_sky, m_view, frames, {}); }

    // The mean over the faces of the floor below the hole.
    double lightOnFloor()
    {
        double sum = 0.0;
        double count = 0.0;
        for (const auto& [name, face] : faces())
        {
            const glm::ivec2 from_middle = glm::abs(glm::ivec2(name.cell.x, name.cell.z) - 8);
            if (name.cell.y == 0 && name.normal == kUp && from_middle.x < 4 && from_middle.y < 4)
            {
                sum += face.radiance.g;
                ++count;
            }
        }
        EXPECT_GT(count, 40.0);
        return sum / count;
    }

    std::map<FaceName, FaceLight> faces() { return facesOf(m_tracer.cache()); }

private:
    template <typename Record> void frame(const Record& record)
    {
        const std::uint64_t number = m_tree.beginFrame();
        device().run(record);
        m_tree.frameDone(number);
    }

    DynamicOctree m_tree;
    DeviceEnvironment m_sky = test::constantSky(glm::vec3(1.0F));
    FrameRenderer m_tracer{device().device()};
    ViewCamera m_view = ViewCamera::lookAt({8.3, 13.0, 12.4}, {8.0, 0.0, 7.0}, 1.2);
};

TEST(RadianceEdits, AHoleLetsLightInUntilItIsUndone)
{
    Room room;
    room.run(64);
    EXPECT_EQ(room.lightOnFloor(), 0.0);
    room.carve();
    room.run(32);
    const double lit = room.lightOnFloor();
    EXPECT_GT(lit, 0.01);
    room.undo();
    room.run(32);
    EXPECT_LT(room.lightOnFloor(), 0.15 * lit);
    room.run(96);
    EXPECT_LT(room.lightOnFloor(), 0.01 * lit);
}

TEST(RadianceEdits, TheSameEditsLeaveTheSameBytes)
{
    const auto tell = []
    {
        Room room;
        room.run(16);
        room.carve();
        room.run(16);
        room.undo();
        room.run(16);
        return room.faces();
    };
    const auto expected = tell();
    const auto isSame = [](const auto& a, const auto& b)
    {
        const auto& [name, face] = a;
        return name.cell == b.first.cell && name.normal == b.first.normal && face.words == b.second.words;
    };
    EXPECT_GT(expected.size(), 100U);
    EXPECT_TRUE(std::ranges::equal(tell(), expected, isSame));
}

// A box moves on and on. Memory stays what it was, faces do not get more, and even light stays the same. 10,000 frames
// with ZVO_TEST_FULL=1.
TEST(RadianceMoves, NothingGrowsOrDrifts)
{
    const std::uint32_t frames = test::isFull() ? 10000 : 800;
    const std::uint32_t settled = std::min(500U, frames / 2);
    Stage stage(32);
    std::uint64_t bytes = 0;
    std::size_t faces = 0;
    for (std::uint32_t frame = 0; frame < frames; ++frame)
    {
        stage.moveTo(static_cast<float>(frame % 12));
        if (frame < settled)
        {
            bytes = stage.tracer().cache().bytes();
            faces = std::max(faces, frame % 50 == 49 ? facesOf(stage.tracer().cache()).size() : 0);
        }
    }
    EXPECT_EQ(stage.tracer().cache().bytes(), bytes);
    EXPECT_LE(facesOf(stage.tracer().cache()).size(), faces);
    EXPECT_NEAR(stage.lightBelow(25.0F), 1.0, 0.02);
}

} // namespace
} // namespace zvo
