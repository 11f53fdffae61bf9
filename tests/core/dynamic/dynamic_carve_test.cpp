// SPDX-License-Identifier: MIT
// What objects that carve leave of a tree, against the oracle's coverage and winding numbers.
#include "core/base/morton.h"
#include "core/dynamic/dynamic_octree.h"
#include "oracle/winding.h"
#include "runtime/trees.h"
#include "support/dynamic_updates.h"
#include "support/engine_device.h"
#include "support/errors.h"
#include "support/fill_compare.h"
#include "support/octree_contents.h"
#include "support/properties.h"
#include "support/scenes.h"
#include "support/sweep.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::Cell;
using test::device;

using Codes = std::set<std::uint64_t>; // of voxels

struct Setting
{
    std::uint32_t depth = 5;
    Coverage coverage = Coverage::Thin;
    MergeRule merge = MergeRule::DynamicWins;
    bool attributes = true;
    bool has_static = true;
    bool filled = true;
    bool compressed = false; // not with filled
    bool minimal_capacities = false;
};

std::ostream& operator<<(std::ostream& out, const Setting& setting)
{
    return out << "depth " << setting.depth << ", coverage " << static_cast<int>(setting.coverage) << ", merge "
               << static_cast<int>(setting.merge) << ", attributes " << setting.attributes << ", static "
               << setting.has_static << ", filled " << setting.filled << ", compressed " << setting.compressed
               << ", minimal " << setting.minimal_capacities;
}

struct Solid
{
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const DynamicMesh> mesh;
    DynamicObjectInfo info;
    glm::mat4 transform{1.0F};
};

// Everything that is there lies in the farthest corner of the grid, a window of at most 32^3 voxels.
class World
{
public:
    World(const Setting& setting, std::mt19937& random) : m_setting(setting), m_random(random)
    {
        m_grid = Grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = setting.depth};
        m_window = Grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = std::min(setting.depth, 5U)};
        m_corner = m_grid.resolution() - m_window.resolution();
        m_static = setting.has_static ? solidScene() : Scene();
        m_octree = octree(setting.minimal_capacities);
        m_first = test::cellsOf(device(), m_octree->tree());
        for (const Cell& cell : m_first)
        {
            if (cell.level == m_grid.nodeLevels())
            {
                m_static_looks.emplace(cell.code, cell.attribute);
            }
        }
    }

    [[nodiscard]] int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(m_random); }

    // Closed tetrahedra in the window, whose corners stand on the lattice.
    [[nodiscard]] Scene solidScene()
    {
        Scene scene = test::tetrahedra(m_random, m_window);
        place(scene, glm::mat4(1.0F));
        return scene;
    }

    Solid anySolid()
    {
        Solid solid;
        solid.info.carves = pick(0, 3) != 0;
        constexpr std::array kFills = {Fill::Solid, Fill::Solid, Fill::Solid, Fill::Parity, Fill::None};
        solid.info.fill = solid.info.carves ? kFills.at(static_cast<std::size_t>(pick(0, 4))) : Fill::None;
        auto scene = std::make_shared<Scene>(test::tetrahedra(m_random, m_window));
        solid.mesh = uploadDynamicMesh(device(), *scene, m_setting.attributes, 0.0F);
        solid.scene = std::move(scene);
        move(solid);
        return solid;
    }

    // Also across any side of the grid, or out of it.
    void move(Solid& solid)
    {
        const auto edge = static_cast<int>(m_window.resolution());
        const int step = std::array{1, 64, 128, 256}.at(static_cast<std::size_t>(pick(0, 3)));
        const auto along = [&]
        { return static_cast<float>(pick(solid.info.carves ? -edge : 0, edge) * 256 / step * step) / 256.0F; };
        glm::mat4 transform = glm::translate(glm::mat4(1.0F), glm::vec3(along(), along(), along()));
        if (pick(0, 2) == 0)
        {
            transform = glm::mat4(1.0F);
        }
        if (solid.info.carves && pick(0, 2) == 0)
        {
            const glm::vec3 middle(0.5F * static_cast<float>(edge));
            transform = glm::translate(transform, middle);
            transform = glm::rotate(transform, static_cast<float>(pick(0, 700)) * 0.01F, glm::vec3(1.0F, 2.0F, 3.0F));
            transform = glm::translate(transform, -middle);
        }
        // Voxels below the window, which those at its border touch, are not looked at.
        const std::uint32_t margin = !solid.info.carves && m_corner != 0 ? 1 : 0;
        solid.transform = glm::translate(glm::mat4(1.0F), glm::vec3(static_cast<float>(m_corner + margin))) * transform;
    }

    [[nodiscard]] Pose poseOf(const Solid& solid) const { return posed(*solid.scene, solid.transform); }

    [[nodiscard]] std::unique_ptr<DynamicOctree> octree(bool minimal) const
    {
        BuildOptions build;
        build.coverage = m_setting.coverage;
        build.attributes = m_setting.attributes;
        build.keep_sums = m_setting.attributes && m_setting.merge == MergeRule::Average;
        build.fill = m_setting.filled ? Fill::Solid : Fill::None;
        const GpuScene uploaded = uploadScene(device(), m_static, m_setting.attributes);
        BuildResult built = buildOctree(device(), uploaded, m_grid, build);
        DeviceTree fixed =
            m_setting.compressed ? compress(device(), std::move(built.octree)).dag : std::move(built.octree);
        DynamicOptions options;
        options.coverage = m_setting.coverage;
        options.merge = m_setting.merge;
        options.attributes = m_setting.attributes;
        options.minimal_capacities = minimal;
        options.history = {16, UINT64_MAX};
        return std::make_unique<DynamicOctree>(device(), std::move(fixed), options);
    }

    DynamicObjectId add(const Solid& solid) { return m_octree->add(solid.mesh, poseOf(solid), solid.info); }

    [[nodiscard]] DynamicOctree& octree() { return *m_octree; }

    // The voxels that should be there.
    [[nodiscard]] Codes expected(const std::map<DynamicObjectId, Solid>& solids)
    {
        Codes codes;
        for (const auto& [code, look] : m_static_looks)
        {
            codes.insert(code);
        }
        for (const auto& [id, solid] : solids)
        {
            if (solid.info.carves)
            {
                for (const std::uint64_t code : voxelsOf(solid))
                {
                    codes.erase(code);
                }
            }
        }
        m_cut.clear();
        for (const auto& [code, look] : m_static_looks)
        {
            if (!codes.contains(code))
            {
                m_cut.insert(code);
            }
        }
        m_added.clear();
        for (const auto& [id, solid] : solids)
        {
            if (!solid.info.carves)
            {
                m_added.merge(voxelsOf(solid));
            }
        }
        codes.insert(m_added.begin(), m_added.end());
        return codes;
    }

    // What is wrong with what is shown, after expected(); empty if nothing is.
    [[nodiscard]] std::string wrong(const Codes& expected) const
    {
        const std::vector<Cell> cells = test::cellsOf(device(), m_octree->tree());
        std::vector<Codes> nodes(m_grid.nodeLevels() + 1);
        for (std::uint32_t level = 0; level <= m_grid.nodeLevels(); ++level)
        {
            for (const std::uint64_t code : expected)
            {
                nodes[level].insert(code >> (6 * (m_grid.nodeLevels() - level)));
            }
        }
        std::vector<Codes> shown(nodes.size());
        std::ostringstream out;
        for (const Cell& cell : cells)
        {
            shown.at(cell.level).insert(cell.code);
            const auto look = m_static_looks.find(cell.code);
            if (m_setting.attributes && cell.level == m_grid.nodeLevels() && look != m_static_looks.end() &&
                !m_added.contains(cell.code))
            {
                const gpu::Attribute before = look->second;
                const bool was_inside = before.color == test::kInside.color;
                const bool is_same =
                    was_inside ? cell.attribute.normal == gpu::kNoNormal
                               : cell.attribute.color == before.color && cell.attribute.normal == before.normal;
                out << (is_same ? "" : "another look; ");
                if (cell.attribute.color == test::kInside.color && isLaidBare(cell.code))
                {
                    out << "laid bare without a look; ";
                }
            }
        }
        for (std::size_t level = 0; level < nodes.size(); ++level)
        {
            if (shown[level] != nodes[level])
            {
                out << "level " << level << " has " << shown[level].size() << " nodes or voxels, not "
                    << nodes[level].size() << "; ";
            }
        }
        return out.str();
    }

    [[nodiscard]] const std::vector<Cell>& first() const { return m_first; }

private:
    // Whether a neighbour of a voxel by a face is cut.
    [[nodiscard]] bool isLaidBare(std::uint64_t code) const
    {
        const glm::ivec3 cell(cellOfCode(code));
        for (int axis = 0; axis < 3; ++axis)
        {
            for (const int way : {-1, 1})
            {
                glm::ivec3 beside = cell;
                beside[axis] += way;
                if (beside[axis] >= 0 && m_cut.contains(codeOfCell(glm::uvec3(beside))))
                {
                    return true;
                }
            }
        }
        return false;
    }

    static Pose posed(const Scene& scene, const glm::mat4& transform)
    {
        Pose pose;
        for (const Instance& instance : scene.instances)
        {
            pose.transforms.push_back(transform * instance.transform);
        }
        pose.joint_matrices.resize(scene.instances.size());
        pose.morph_weights.resize(scene.instances.size());
        return pose;
    }

    void place(Scene& scene, const glm::mat4& transform) const
    {
        const glm::mat4 to_corner = glm::translate(glm::mat4(1.0F), glm::vec3(static_cast<float>(m_corner)));
        for (Instance& instance : scene.instances)
        {
            instance.transform = to_corner * transform * instance.transform;
        }
    }

    [[nodiscard]] Codes voxelsOf(const Solid& solid) const
    {
        Scene scene = *solid.scene;
        for (Instance& instance : scene.instances)
        {
            instance.transform = solid.transform * instance.transform;
        }
        std::vector<oracle::Triangle> triangles = test::latticeTriangles(scene, m_grid);
        for (oracle::Triangle& triangle : triangles)
        {
            for (oracle::Vec& corner : triangle)
            {
                for (std::size_t axis = 0; axis < 3; ++axis)
                {
                    corner[axis] -= std::int64_t{256} * m_corner;
                }
            }
        }
        const std::uint32_t edge = m_window.resolution();
        Codes codes;
        const auto insert = [&](const glm::uvec3& cell) { codes.insert(codeOfCell(cell + m_corner)); };
        for (const oracle::Triangle& triangle : triangles)
        {
            // A carver's lattice goes on above the grid.
            oracle::forEachCoveredVoxel(triangle, solid.info.carves ? 2 * edge : edge, m_setting.coverage,
                                        [&](const glm::uvec3& cell)
                                        {
                                            if (glm::all(glm::lessThan(cell, glm::uvec3(edge))))
                                            {
                                                insert(cell);
                                            }
                                        });
        }
        if (solid.info.fill != Fill::None)
        {
            EXPECT_TRUE(oracle::isClosed(triangles));
            const std::vector<std::int16_t> winding = oracle::windingNumbers(triangles, edge);
            for (std::uint32_t i = 0; i < winding.size(); ++i)
            {
                const int number = winding[i];
                if (solid.info.fill == Fill::Parity ? number % 2 != 0 : number != 0)
                {
                    insert({i % edge, i / edge % edge, i / edge / edge});
                }
            }
        }
        return codes;
    }

    Setting m_setting;
    std::mt19937& m_random;
    Grid m_grid;
    Grid m_window;
    std::uint32_t m_corner = 0;
    Scene m_static;
    std::unique_ptr<DynamicOctree> m_octree;
    std::vector<Cell> m_first; // without objects
    std::map<std::uint64_t, gpu::Attribute> m_static_looks;
    Codes m_cut;   // voxels that are carved, as of the last expected()
    Codes m_added; // voxels of other objects
};

Setting anySetting(std::mt19937& random)
{
    const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
    Setting setting;
    setting.depth = std::array{5U, 5U, 4U, 3U, 2U, 1U, 6U, 7U, 10U, 12U, 13U}.at(static_cast<std::size_t>(pick(0, 10)));
    setting.coverage = pick(0, 1) != 0 ? Coverage::Thin : Coverage::Conservative;
    setting.merge = std::array{MergeRule::Average, MergeRule::DynamicWins, MergeRule::StaticWins}.at(
        static_cast<std::size_t>(pick(0, 2)));
    setting.attributes = pick(0, 4) != 0;
    setting.has_static = pick(0, 9) != 0;
    setting.filled = setting.depth >= 3 && pick(0, 2) != 0;
    setting.compressed = !setting.filled && pick(0, 1) != 0;
    setting.minimal_capacities = pick(0, 2) == 0;
    return setting;
}

// Objects come, move and go, at random.
void runRandomSequence(std::uint32_t seed)
{
    std::mt19937 random(seed);
    const Setting setting = anySetting(random);
    std::ostringstream trace;
    trace << "seed " << seed << ": " << setting;
    SCOPED_TRACE(trace.str());
    World world(setting, random);
    std::map<DynamicObjectId, Solid> solids;
    Codes before;
    for (int step = 0; step < 6; ++step)
    {
        const int action = solids.empty() ? 0 : world.pick(0, 4);
        if (action <= 1 && solids.size() < 4)
        {
            const Solid solid = world.anySolid();
            solids.emplace(world.add(solid), solid);
        }
        else
        {
            auto& [id, solid] = *std::next(solids.begin(), world.pick(0, static_cast<int>(solids.size()) - 1));
            if (action == 4)
            {
                world.octree().remove(id);
                solids.erase(id);
            }
            else
            {
                world.move(solid);
                world.octree().setPose(id, world.poseOf(solid));
            }
        }
        test::updateAll(device(), world.octree());
        const Codes expected = world.expected(solids);
        ASSERT_EQ(world.wrong(expected), "") << "step " << step;
    }
    // The same objects in another order give the same tree.
    const std::vector<Cell> shown = test::cellsOf(device(), world.octree().tree());
    const std::unique_ptr<DynamicOctree> other = world.octree(!setting.minimal_capacities);
    std::for_each(solids.rbegin(), solids.rend(),
                  [&](const auto& entry)
                  { other->add(entry.second.mesh, world.poseOf(entry.second), entry.second.info); });
    test::updateAll(device(), *other);
    ASSERT_EQ(test::difference(test::cellsOf(device(), other->tree()), shown), "");
    for (const auto& [id, solid] : solids)
    {
        world.octree().remove(id);
    }
    test::updateAll(device(), world.octree());
    ASSERT_EQ(test::difference(test::cellsOf(device(), world.octree().tree()), world.first()), "");
    if (!solids.empty())
    {
        ASSERT_TRUE(test::undo(device(), world.octree()));
        ASSERT_EQ(test::difference(test::cellsOf(device(), world.octree().tree()), shown), "");
    }
}

TEST(DynamicCarve, LeavesWhatTheOracleLeaves)
{
    const std::uint32_t count = test::isFull() ? 400 : 8;
    for (std::uint32_t seed = 0; seed < count && !HasFatalFailure(); ++seed)
    {
        runRandomSequence(seed);
    }
}

} // namespace
} // namespace zvo
