// SPDX-License-Identifier: MIT
// Merging dynamic objects gives the same result as voxelizing everything anew.
#include "core/dynamic/dynamic_octree.h"
#include "support/dynamic_updates.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/octree_contents.h"
#include "support/scenes.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::Cell;

using test::device;

constexpr float kExtent = 16.0F;

// A static scene, dynamic objects, and their octree.
class MovingWorld
{
public:
    explicit MovingWorld(std::uint32_t depth, DynamicOptions options = {})
        : m_grid{.origin = glm::vec3(0.0F),
                 .voxel_size = kExtent / static_cast<float>(1U << std::min(depth, 6U)),
                 .depth = depth},
          m_static(test::materialsScene(kExtent)), m_object(test::materialsScene(kExtent / 3)), m_options(options)
    {
        m_scale = std::max(brightestEmission(m_static), brightestEmission(m_object));
        m_options.merge = MergeRule::Average;
        m_options.emission_scale = m_scale;
        const GpuScene scene = uploadScene(device(), m_static, true, m_scale);
        BuildOptions build{.coverage = m_options.coverage};
        build.keep_sums = true;
        m_octree =
            std::make_unique<DynamicOctree>(device(), buildOctree(device(), scene, m_grid, build).octree, m_options);
        m_mesh = uploadDynamicMesh(device(), m_object, true, m_scale);
    }

    DynamicOctree& octree() { return *m_octree; }
    const Grid& grid() const { return m_grid; }
    const std::shared_ptr<const DynamicMesh>& mesh() const { return m_mesh; }

    Pose poseAt(const glm::mat4& place) const
    {
        Pose pose;
        for (const Instance& instance : m_object.instances)
        {
            pose.transforms.push_back(place * instance.transform);
        }
        return pose;
    }

    UpdateReport update() { return test::updateAll(device(), *m_octree); }
    bool undo() { return test::undo(device(), *m_octree); }
    bool redo() { return test::redo(device(), *m_octree); }

    std::vector<Cell> shown() const { return test::cellsOf(device(), m_octree->tree()); }

    // Everything voxelized at once.
    std::vector<Cell> rebuilt(const std::vector<glm::mat4>& places) const
    {
        Scene scene = m_static;
        for (const glm::mat4& place : places)
        {
            Scene object = m_object;
            const std::vector<glm::mat4> transforms = poseAt(place).transforms;
            for (std::size_t i = 0; i < transforms.size(); ++i)
            {
                object.instances[i].transform = transforms[i];
            }
            scene.append(std::move(object));
        }
        const GpuScene uploaded = uploadScene(device(), scene, true, m_scale);
        return test::cellsOf(device(),
                             buildOctree(device(), uploaded, m_grid, {.coverage = m_options.coverage}).octree);
    }

private:
    Grid m_grid;
    Scene m_static;
    Scene m_object;
    DynamicOptions m_options;
    float m_scale = 0;
    std::shared_ptr<const DynamicMesh> m_mesh;
    std::unique_ptr<DynamicOctree> m_octree;
};

glm::mat4 moved(float x, float y, float z)
{
    return glm::translate(glm::mat4(1.0F), glm::vec3(x, y, z));
}

// Checks the functions by which the tests compare trees.
TEST(DynamicOctree, IsMadeOfTheCellsThatItHas)
{
    const MovingWorld world(6);
    const std::vector<Cell> cells = world.shown();
    ASSERT_GT(cells.size(), 1000U);
    const DeviceTree octree = test::octreeOf(device(), cells, world.grid(), 1.0F);
    EXPECT_EQ(test::difference(test::cellsOf(device(), octree), cells), "");
    EXPECT_GT(octree.emission.count(), 0U);
}

TEST(DynamicOctree, ShowsTheStaticOctreeWithoutObjects)
{
    MovingWorld world(6);
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({})), "");
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({})), "");
}

TEST(DynamicOctree, FollowsObjectsThatComeMoveAndGo)
{
    MovingWorld world(6);
    const DynamicObjectId first = world.octree().add(world.mesh(), world.poseAt(glm::mat4(1.0F)));
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(0, 0, 0)})), "");
    const DynamicObjectId second = world.octree().add(world.mesh(), world.poseAt(glm::mat4(1.0F)));
    world.octree().setPose(second, world.poseAt(moved(2, 1, 1))); // overlaps the first
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(0, 0, 0), moved(2, 1, 1)})), "");
    world.octree().setPose(first, world.poseAt(moved(9, 9, 9)));
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(9, 9, 9), moved(2, 1, 1)})), "");
    world.octree().remove(second);
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(9, 9, 9)})), "");
    world.octree().setPose(first, world.poseAt(moved(14, 9, 9))); // half outside
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(14, 9, 9)})), "");
    world.octree().setPose(first, world.poseAt(moved(100, 9, 9)));
    EXPECT_EQ(world.update().dynamic_count, 0U);
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({})), "");
}

TEST(DynamicOctree, UndoAndRedoShowEarlierEntries)
{
    MovingWorld world(6, {.history = {16, UINT64_MAX}});
    const DynamicObjectId object = world.octree().add(world.mesh(), world.poseAt(glm::mat4(1.0F)));
    std::vector<std::vector<Cell>> shown = {world.shown()};
    for (int i = 0; i < 4; ++i)
    {
        world.octree().setPose(object, world.poseAt(moved(2.5F * static_cast<float>(i), 3, 1)));
        world.update();
        shown.push_back(world.shown());
        EXPECT_EQ(test::difference(shown.back(), world.rebuilt({moved(2.5F * static_cast<float>(i), 3, 1)})), "");
    }
    for (int i = 3; i >= 0; --i)
    {
        EXPECT_TRUE(world.undo());
        EXPECT_EQ(test::difference(world.shown(), shown[static_cast<std::size_t>(i)]), "");
    }
    EXPECT_FALSE(world.undo());
    EXPECT_TRUE(world.redo());
    EXPECT_TRUE(world.redo());
    EXPECT_EQ(test::difference(world.shown(), shown[2]), "");
    const DynamicObjectId second = world.octree().add(world.mesh(), world.poseAt(glm::mat4(1.0F)));
    EXPECT_NE(second, object);
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(2.5F, 3, 1), moved(0, 0, 0)})), "");
    EXPECT_FALSE(world.redo());
}

TEST(DynamicOctree, SpreadsAnUpdateOverFramesAndShowsTheLastRootMeanwhile)
{
    MovingWorld world(6);
    const DynamicObjectId object = world.octree().add(world.mesh(), world.poseAt(moved(3, 4, 5)));
    world.update();
    const std::vector<Cell> before = world.rebuilt({moved(3, 4, 5)});
    world.octree().setPose(object, world.poseAt(moved(6, 2, 5)));
    std::uint32_t frame_count = 0;
    for (bool complete = false; !complete; ++frame_count)
    {
        ASSERT_LT(frame_count, 1000U);
        EXPECT_EQ(test::difference(world.shown(), before), "");
        if (frame_count == 2)
        {
            world.octree().setPose(object, world.poseAt(moved(1, 1, 1))); // counts for the next update
        }
        const std::uint64_t frame = world.octree().beginFrame();
        const std::vector<vk::PassTime> passes =
            device().run([&](vk::FrameGraph& graph) { complete = world.octree().update(graph, 1e-6); });
        world.octree().frameDone(frame, passes);
        EXPECT_EQ(world.octree().isUpdating(), !complete);
    }
    EXPECT_GT(frame_count, 10U);
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(6, 2, 5)})), "");
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(1, 1, 1)})), "");
}

TEST(DynamicOctree, KeepsSeveralFramesInFlight)
{
    MovingWorld world(6, {.frames_in_flight = 3});
    const DynamicObjectId object = world.octree().add(world.mesh(), world.poseAt(moved(3, 4, 5)));
    world.update();
    struct Flight
    {
        std::uint64_t frame;
        vk::Submission submission;
    };
    std::deque<Flight> flights;
    for (int i = 0; i < 12; ++i)
    {
        world.octree().setPose(object, world.poseAt(moved(static_cast<float>(i), 2, 5)));
        const std::uint64_t frame = world.octree().beginFrame();
        flights.push_back({frame, device().submit(
                                      [&](vk::FrameGraph& graph)
                                      {
                                          world.octree().update(graph);
                                          graph.releaseToHost();
                                      })});
        if (flights.size() == 3)
        {
            flights.front().submission.wait();
            for (const UpdateReport& report : world.octree().frameDone(flights.front().frame))
            {
                EXPECT_EQ(report.failed, 0U);
            }
            flights.pop_front();
        }
    }
    for (Flight& flight : flights)
    {
        flight.submission.wait();
        world.octree().frameDone(flight.frame);
    }
    if (world.octree().needsUpdate())
    {
        world.update();
    }
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(11, 2, 5)})), "");
}

TEST(DynamicOctree, StartsWithRoomForOne)
{
    MovingWorld world(6, {.minimal_capacities = true});
    const DynamicObjectId object = world.octree().add(world.mesh(), world.poseAt(glm::mat4(1.0F)));
    world.octree().setPose(object, world.poseAt(moved(3, 4, 5)));
    world.update();
    EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(3, 4, 5)})), "");
}

TEST(DynamicOctree, OneObjectGivesWhatARebuildGives)
{
    for (const std::uint32_t depth : {5U, 1U, 2U, 6U, 13U})
    {
        SCOPED_TRACE(depth);
        MovingWorld world(depth);
        const DynamicObjectId object = world.octree().add(world.mesh(), world.poseAt(glm::mat4(1.0F)));
        world.octree().setPose(object, world.poseAt(moved(3, 4, 5)));
        const UpdateReport report = world.update();
        EXPECT_EQ(report.failed, 0U);
        EXPECT_GT(report.dynamic_count, 0U);
        EXPECT_EQ(test::difference(world.shown(), world.rebuilt({moved(3, 4, 5)})), "");
    }
}

} // namespace
} // namespace zvo
