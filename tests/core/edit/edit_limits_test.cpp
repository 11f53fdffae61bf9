// SPDX-License-Identifier: MIT
// A thousand strokes on a scene, all undone and redone. Pictures and the static tree stay the same, and memory stays
// within its limit.
#include "core/base/morton.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/tree/device_tree.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/dynamic_updates.h"
#include "support/engine_device.h"
#include "support/pictures.h"
#include "support/scenes.h"
#include "support/tree_words.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::uint32_t kDepth = 9;
constexpr std::uint32_t kManyStrokes = 1000;
constexpr std::uint32_t kStrokesPerFrame = 20;
constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 96;
constexpr std::uint64_t kMiB = 1U << 20;

using test::device;

// The atrium, and strokes around its voxels.
class World
{
public:
    World(bool compressed, const HistoryBounds& bounds, std::size_t center_count)
    {
        const Scene scene = loadGltf(test::ownScene("atrium.glb"));
        const Grid grid = Grid::around(scene.bounds(), kDepth);
        BuildOptions build;
        build.keep_sums = true;
        const float emission_scale = brightestEmission(scene);
        BuildResult built = buildOctree(device(), uploadScene(device(), scene, true, emission_scale), grid, build);
        const std::vector<std::uint64_t> codes = voxelCodes(device(), built.octree);
        for (std::size_t i = 0; i < center_count; ++i)
        {
            m_centers.push_back(codes[i * codes.size() / center_count]);
        }
        DynamicOptions options;
        options.merge = MergeRule::Average;
        options.emission_scale = emission_scale;
        options.edits = bounds;
        DeviceTree fixed = compressed ? compress(device(), std::move(built.octree)).dag : std::move(built.octree);
        m_octree = std::make_unique<DynamicOctree>(device(), std::move(fixed), options);
        const glm::dvec3 center = glm::dvec3(scene.bounds().min + scene.bounds().max) / 2.0;
        const glm::dvec3 size = scene.bounds().max - scene.bounds().min;
        m_camera =
            traceCamera(ViewCamera::lookAt(center + size * glm::dvec3(0.3, 0.1, 0.05), center, 1.2), grid, kHeight);
    }

    DynamicOctree& octree() { return *m_octree; }

    void strokes(std::uint32_t count)
    {
        for (std::uint32_t done = 0, attempt = 0; done < count; ++attempt)
        {
            ASSERT_LT(attempt, 3 * count);
            test::runFrame(device(), *m_octree,
                           [&](vk::FrameGraph& graph)
                           {
                               bool has_room = true;
                               for (std::uint32_t i = 0; i < kStrokesPerFrame && done < count && has_room; ++i)
                               {
                                   has_room = m_octree->edit(graph, brush(m_stroke_count));
                                   m_octree->endStroke();
                                   done += has_room ? 1 : 0;
                                   m_stroke_count += has_room ? 1 : 0;
                               }
                           });
        }
    }

    void move(bool undo, std::size_t count)
    {
        for (std::size_t done = 0; done < count;)
        {
            test::runFrame(device(), *m_octree,
                           [&](vk::FrameGraph& graph)
                           {
                               for (std::uint32_t i = 0; i < kStrokesPerFrame && done < count; ++i, ++done)
                               {
                                   ASSERT_TRUE(undo ? m_octree->undoEdit(graph) : m_octree->redoEdit(graph));
                               }
                           });
        }
    }

    std::vector<gpu::uint> picture()
    {
        return test::takePicture(device(), m_octree->tree(), m_camera, kWidth, kHeight, {}).image;
    }

    // Words of nodes, lists and attributes, without the slot of the root that is shown.
    std::vector<gpu::uint> staticWords()
    {
        std::vector<gpu::uint> words;
        const DeviceTree& octree = m_octree->tree();
        test::addWords(words, device(), octree.nodes, 1, m_octree->staticRoot());
        test::addWords(words, device(), octree.node_attributes, 1, octree.octreeNodeCount());
        test::addWords(words, device(), octree.voxel_attributes, 0, octree.voxel_count);
        return words;
    }

private:
    // A brush around a voxel of the scene, of radius 4, sometimes 8.
    [[nodiscard]] Brush brush(std::uint32_t number) const
    {
        std::mt19937 random(number);
        const std::uint64_t code = m_centers[random() % m_centers.size()];
        Brush brush;
        brush.action = static_cast<BrushAction>(number % 3);
        brush.shape = number % 5 == 0 ? BrushShape::Box : BrushShape::Sphere;
        brush.center = gpu::ivec3(cellOfCode(code));
        brush.radius = number % 10 == 0 ? 8 : 4;
        brush.color = random() % (1U << 24);
        return brush;
    }

    std::vector<std::uint64_t> m_centers; // of brushes
    std::unique_ptr<DynamicOctree> m_octree;
    TraceCamera m_camera;
    std::uint32_t m_stroke_count = 0;
};

class EditLimits : public testing::TestWithParam<bool>
{
};

TEST_P(EditLimits, AThousandStrokesAreUndoneAndRedone)
{
    constexpr std::uint64_t kBytesMax = 64 * kMiB;
    vk::MemoryAllocator& memory = device().device().memory();
    World world(GetParam(), {kManyStrokes, kBytesMax}, kManyStrokes);
    const std::uint64_t used_before = memory.usedBytes();
    const std::vector<gpu::uint> words = world.staticWords();
    const std::vector<gpu::uint> first = world.picture();
    memory.resetPeak();

    world.strokes(kManyStrokes);
    EXPECT_EQ(world.octree().edits().undoCount(), kManyStrokes);
    EXPECT_LE(world.octree().edits().heldBytes(), kBytesMax);
    const std::vector<gpu::uint> last = world.picture();
    EXPECT_NE(last, first);
    const std::uint64_t used = memory.usedBytes();

    world.move(true, kManyStrokes);
    EXPECT_EQ(world.octree().edits().undoCount(), 0U);
    EXPECT_EQ(world.picture(), first);
    EXPECT_EQ(world.staticWords(), words);
    world.move(false, kManyStrokes);
    EXPECT_EQ(world.octree().edits().redoCount(), 0U);
    EXPECT_EQ(world.picture(), last);
    EXPECT_EQ(world.staticWords(), words);
    // Beside the held region there may be one to move to, and half as much again. While buffers grow, the old ones
    // stay, too, until the frame is done.
    EXPECT_LE(used, used_before + 3 * world.octree().edits().heldBytes());
    EXPECT_LE(memory.peakBytes(), 2 * used);
    EXPECT_LE(memory.usedBytes(), used) << "to show other steps takes no memory";
}

// What is shown stays, even if little of its history does.
TEST_P(EditLimits, WithLittleRoomEntriesAreDroppedAndMemoryStaysBounded)
{
    constexpr std::uint64_t kBytesMax = 2 * kMiB;
    vk::MemoryAllocator& memory = device().device().memory();
    World world(GetParam(), {kManyStrokes, kBytesMax}, 12);
    const std::vector<gpu::uint> words = world.staticWords();
    world.strokes(200);
    const std::uint64_t used = memory.usedBytes();
    memory.resetPeak();
    const Edits& edits = world.octree().edits();
    for (std::uint32_t i = 0; i < 8; ++i)
    {
        world.strokes(100);
        EXPECT_LE(edits.heldBytes(), kBytesMax);
        EXPECT_LE(edits.shownBytes(), edits.heldBytes());
    }
    EXPECT_LE(memory.usedBytes(), used);
    EXPECT_LE(memory.peakBytes(), used + kBytesMax) << "but for what a compaction works in";
    EXPECT_LT(edits.undoCount(), kManyStrokes);
    EXPECT_GT(edits.undoCount(), 10U);
    const std::vector<gpu::uint> last = world.picture();
    const std::size_t undo_count = edits.undoCount();
    world.move(true, undo_count);
    world.move(false, undo_count);
    EXPECT_EQ(world.picture(), last);
    EXPECT_EQ(world.staticWords(), words);
}

INSTANTIATE_TEST_SUITE_P(Trees, EditLimits, testing::Bool(),
                         [](const auto& which) { return which.param ? "Dag" : "Octree"; });

} // namespace
} // namespace zvo
