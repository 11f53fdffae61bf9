// SPDX-License-Identifier: MIT
// The light tree: what it sums up, and the probabilities with which lights are chosen.
#include "core/light/light_tree.h"

#include "core/base/kernels.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/light/kernels/light_test/choose.h"
#include "core/tree/tree_table.h"
#include "runtime/trees.h"
#include "support/light_device.h"
#include "support/lit_voxels.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::lightDevice;
using test::LitVoxel;

using Face = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>; // cell and direction

glm::ivec3 directionOf(std::uint32_t face)
{
    glm::ivec3 direction(0);
    direction[static_cast<int>(face % 3)] = face < 3 ? 1 : -1;
    return direction;
}

// Random voxels, of which a part gives off light.
std::vector<LitVoxel> randomVoxels(std::uint32_t depth, std::uint32_t count, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, LitVoxel> voxels;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const glm::uvec3 cell(random() % (1U << depth), random() % (1U << depth), random() % (1U << depth));
        LitVoxel voxel;
        voxel.cell = cell;
        if (random() % 3 == 0)
        {
            voxel.emission = glm::vec3(static_cast<float>(1 + random() % 500)) / 256.0F;
        }
        voxels[{cell.x, cell.y, cell.z}] = voxel;
    }
    std::vector<LitVoxel> result;
    for (const auto& [cell, voxel] : voxels)
    {
        result.push_back(voxel);
    }
    return result;
}

std::set<Face> exposedFaces(const std::vector<LitVoxel>& voxels)
{
    std::set<std::tuple<int, int, int>> occupied;
    for (const LitVoxel& voxel : voxels)
    {
        occupied.insert({voxel.cell.x, voxel.cell.y, voxel.cell.z});
    }
    std::set<Face> faces;
    for (const LitVoxel& voxel : voxels)
    {
        for (std::uint32_t face = 0; face < gpu::kLightFaces && voxel.emission != glm::vec3(0.0F); ++face)
        {
            const glm::ivec3 before = glm::ivec3(voxel.cell) + directionOf(face);
            if (!occupied.contains({before.x, before.y, before.z}))
            {
                faces.insert({voxel.cell.x, voxel.cell.y, voxel.cell.z, face});
            }
        }
    }
    return faces;
}

/// A tree of lit voxels with its light tree.
class Lights
{
public:
    Lights(const std::vector<LitVoxel>& voxels, std::uint32_t depth)
        : m_tree(test::litTree(lightDevice(), voxels, depth)), m_lights(lightDevice().device(), m_tree)
    {
        vk::BufferOf<gpu::TreeTable> table =
            lightDevice().makeBuffer<gpu::TreeTable>("table", std::array{treeTable(m_tree)});
        lightDevice().run([&](vk::FrameGraph& graph) { buildLightTree(graph, m_tree, table, m_lights); });
    }

    // For each place, what the kernel says of faces, of which each place has as many.
    std::vector<gpu::TestFace> ask(const std::vector<gpu::TestPlace>& places, const std::vector<gpu::TestFace>& faces,
                                   bool choose)
    {
        const vk::BufferOf<gpu::TestPlace> place_buffer =
            lightDevice().makeBuffer<gpu::TestPlace>("places", std::span(places));
        vk::BufferOf<gpu::TestFace> face_buffer = lightDevice().makeBuffer<gpu::TestFace>("faces", std::span(faces));
        lightDevice().run(
            [&](vk::FrameGraph& graph)
            {
                vk::Pass pass =
                    graph.addPass(gpu::light_test::Choose{.node_levels = m_tree.grid.nodeLevels(), .choose = choose});
                const gpu::ChooseParams params = {pass.read(m_lights.nodes),
                                                  pass.read(m_lights.bricks),
                                                  pass.read(place_buffer),
                                                  pass.readWrite(face_buffer),
                                                  static_cast<gpu::uint>(places.size()),
                                                  static_cast<gpu::uint>(faces.size() / places.size())};
                pass.dispatch(faces.size(), params);
            });
        return lightDevice().download(face_buffer);
    }

    [[nodiscard]] std::vector<gpu::LightNode> nodes() const { return lightDevice().download(m_lights.nodes); }
    [[nodiscard]] const Grid& grid() const { return m_tree.grid; }

private:
    DeviceTree m_tree;
    LightTree m_lights;
};

// Places in and around the grid.
std::vector<gpu::TestPlace> randomPlaces(const Grid& grid, std::uint32_t count)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> anywhere(1.0F, 1.0F + static_cast<float>(grid.resolution()) /
                                                                    static_cast<float>(grid.rootResolution()));
    std::vector<gpu::TestPlace> places;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        places.push_back({{anywhere(random), anywhere(random), anywhere(random)}, i % gpu::kLightFaces});
    }
    return places;
}

// Whether some point of the face can be seen from in front of the place.
bool canSee(const Grid& grid, const gpu::TestPlace& place, const Face& face)
{
    const auto [x, y, z, direction] = face;
    const float edge = 1.0F / static_cast<float>(grid.rootResolution());
    const glm::vec3 low = 1.0F + edge * glm::vec3(x, y, z);
    const glm::vec3 high = low + edge;
    const int axis = static_cast<int>(direction % 3);
    const bool before_face = direction < 3 ? place.position[axis] > high[axis] : place.position[axis] < low[axis];
    const int own = static_cast<int>(place.normal % 3);
    return before_face && (place.normal < 3 ? high[own] > place.position[own] : low[own] < place.position[own]);
}

TEST(LightTree, GivesEveryFaceItsChance)
{
    std::size_t seen = 0;
    for (const std::uint32_t depth : {1U, 2U, 3U, 5U, 7U})
    {
        const std::vector<LitVoxel> voxels = randomVoxels(depth, 60, depth);
        const std::set<Face> exposed = exposedFaces(voxels);
        ASSERT_GT(exposed.size(), 3U);
        Lights lights(voxels, depth);
        const std::vector<gpu::TestPlace> places = randomPlaces(lights.grid(), 40);
        std::vector<gpu::TestFace> asked;
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            for (const auto& [x, y, z, face] : exposed)
            {
                asked.push_back({{x, y, z}, face, -1.0F});
            }
        }
        const std::vector<gpu::TestFace> told = lights.ask(places, asked, false);
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            double sum = 0.0;
            bool sees_any = false;
            std::size_t k = i * exposed.size();
            for (const Face& face : exposed)
            {
                const float probability = told[k++].probability;
                EXPECT_GE(probability, 0.0F);
                sum += probability;
                if (canSee(lights.grid(), places[i], face))
                {
                    EXPECT_GT(probability, 0.0F) << depth;
                    sees_any = true;
                    ++seen;
                }
            }
            if (sees_any || sum > 0.0)
            {
                EXPECT_NEAR(sum, 1.0, 1e-5) << depth;
            }
        }
    }
    EXPECT_GT(seen, 1000U);
}

// What is chosen has the probability that is told, and is chosen that often.
TEST(LightTree, ChoosesAsItTells)
{
    constexpr std::size_t kChoices = 1 << 14;
    const std::vector<LitVoxel> voxels = randomVoxels(5, 60, 9);
    const std::set<Face> exposed = exposedFaces(voxels);
    Lights lights(voxels, 5);
    const std::vector<gpu::TestPlace> places = randomPlaces(lights.grid(), 12);
    const std::vector<gpu::TestFace> chosen =
        lights.ask(places, std::vector<gpu::TestFace>(places.size() * kChoices), true);
    const std::vector<gpu::TestFace> told = lights.ask(places, chosen, false);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
        std::map<Face, std::pair<std::size_t, double>> counts;
        for (std::size_t k = i * kChoices; k < (i + 1) * kChoices; ++k)
        {
            const Face face = {chosen[k].cell.x, chosen[k].cell.y, chosen[k].cell.z, chosen[k].face};
            ASSERT_TRUE(exposed.contains(face));
            ASSERT_NEAR(told[k].probability, chosen[k].probability, 1e-5F * chosen[k].probability);
            ++counts[face].first;
            counts[face].second = told[k].probability;
        }
        for (const auto& [face, count] : counts)
        {
            const double expected = count.second * kChoices;
            EXPECT_NEAR(static_cast<double>(count.first), expected, 5.0 * std::sqrt(expected) + 2.0);
        }
    }
}

TEST(LightTree, SumsUpWhatVoxelsGive)
{
    const std::vector<LitVoxel> voxels = randomVoxels(5, 300, 4);
    double expected = 0.0;
    for (const auto& [x, y, z, face] : exposedFaces(voxels))
    {
        for (const LitVoxel& voxel : voxels)
        {
            expected += voxel.cell == glm::uvec3(x, y, z) ? double{voxel.emission.x} : 0.0;
        }
    }
    const Lights lights(voxels, 5);
    EXPECT_NEAR(lights.nodes().front().power, expected, 1e-5 * expected);
}

// A solid ball that glows, and a voxel that a brush makes beside it: the leaves of the ball are copies of leaf words
// then.
TEST(LightTree, HasTheLampsOfFilledTreesThatWereEdited)
{
    Scene scene = test::sphereScene(glm::vec3(24.5F), 12.0F, 12);
    scene.materials.front().emission = glm::vec3(2.0F);
    const GpuScene uploaded = uploadScene(lightDevice(), scene, true);
    const Grid grid = {glm::vec3(0), 1.0F, 6};
    DynamicOctree octree(lightDevice(), buildOctree(lightDevice(), uploaded, grid, {.fill = Fill::Solid}).octree,
                         {.merge = MergeRule::DynamicWins, .emission_scale = uploaded.emission_scale});
    const auto power = [&]
    {
        LightTree lights(lightDevice().device(), octree.tree());
        vk::BufferOf<gpu::TreeTable> table =
            lightDevice().makeBuffer<gpu::TreeTable>("table", std::array{treeTable(octree.tree())});
        lightDevice().run([&](vk::FrameGraph& graph) { buildLightTree(graph, octree.tree(), table, lights); });
        return lightDevice().download(lights.nodes).front().power;
    };
    const auto frame = [&](const auto& record)
    {
        const std::uint64_t number = octree.beginFrame();
        lightDevice().run(record);
        octree.frameDone(number);
    };
    frame([&](vk::FrameGraph& graph) { octree.update(graph); });
    const float before = power();
    EXPECT_GT(before, 1000.0F);
    frame(
        [&](vk::FrameGraph& graph) {
            octree.edit(graph, {.action = BrushAction::Fill, .center = {39, 24, 24}, .color = 0xFFFFFF});
        });
    EXPECT_EQ(octree.edits().voxelCount(), octree.tree().occupiedCount() + 1);
    EXPECT_NEAR(power(), before, 1e-5F * before);
}

} // namespace
} // namespace zvo
