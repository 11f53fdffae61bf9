// SPDX-License-Identifier: MIT
// The laws of voxel sets (docs/voxelization.md, "Laws"), tested on the device.
#include "io/gltf/gltf_loader.h"
#include "oracle/snap.h"
#include "runtime/octree_sha256.h"
#include "support/engine_device.h"
#include "support/lattice_sets.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using oracle::Int128;
using oracle::operator-;
using oracle::ThinRule;
using stress::LatticeTriangle;
using stress::Shape;
using test::LatticeTriangles;
using test::Symmetry;
using test::VoxelSet;

using test::device;

VoxelSet voxelsOf(std::span<const LatticeTriangle> triangles, std::uint32_t depth, Coverage coverage)
{
    return test::deviceVoxels(device(), triangles, depth, coverage);
}

/// Triangles of one grid, on which the laws are tested.
struct Sample
{
    std::string name;
    std::uint32_t depth = 1;
    LatticeTriangles triangles;
};

std::vector<Sample> randomSamples(std::size_t count_max)
{
    std::vector<Sample> samples;
    for (std::uint32_t shape = 0; shape < stress::kShapeCount; ++shape)
    {
        if (static_cast<Shape>(shape) == Shape::Huge) // single precision does not hold their mirrored coordinates
            continue;
        // For each grid a pile and, except for Border, triangles without common voxels.
        for (const std::uint64_t number : {0, 1})
        {
            stress::Batch batch = stress::makeBatch(77, static_cast<Shape>(shape), number, count_max);
            samples.push_back({std::string(stress::nameOf(batch.shape)) + std::to_string(number), batch.depth,
                               std::move(batch.triangles)});
        }
    }
    return samples;
}

/// A model on the lattice of the grid around it; nothing if the file is missing.
std::optional<Sample> modelSample(const char* file, std::uint32_t depth)
{
    const auto path = test::findScene(file);
    if (!path)
    {
        return std::nullopt;
    }
    const Scene scene = loadGltf(*path);
    const Grid grid = Grid::around(scene.bounds(), depth);
    Sample sample{file, depth, {}};
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const glm::uvec3& indices : primitive.triangles)
        {
            const oracle::SnappedTriangle snapped = oracle::snapTriangle(
                {primitive.positions[indices.x], primitive.positions[indices.y], primitive.positions[indices.z]},
                instance.transform, grid, Coverage::Conservative);
            LatticeTriangle triangle{};
            for (std::size_t i = 0; i < 3; ++i)
            {
                for (std::size_t k = 0; k < 3; ++k)
                {
                    triangle[i][static_cast<int>(k)] = static_cast<int>(snapped.triangle[i][k]);
                }
            }
            sample.triangles.push_back(triangle);
        }
    }
    return sample;
}

std::vector<Sample> samples(std::size_t count_max)
{
    std::vector<Sample> all = randomSamples(count_max);
    if (std::optional<Sample> model = modelSample("bunny_low.glb", 7))
    {
        all.push_back(std::move(*model));
    }
    return all;
}

LatticeTriangles moved(const LatticeTriangles& triangles, const std::function<glm::ivec3(const glm::ivec3&)>& place)
{
    LatticeTriangles result = triangles;
    for (LatticeTriangle& triangle : result)
    {
        for (glm::ivec3& p : triangle)
        {
            p = place(p);
        }
    }
    return result;
}

using CoverageLaws = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, CoverageLaws, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

TEST_P(CoverageLaws, TranslationByWholeVoxelsShiftsTheSet)
{
    std::mt19937 random(1);
    for (Sample& sample : samples(1500))
    {
        SCOPED_TRACE(sample.name);
        const int resolution = 1 << sample.depth;
        for (int i = 0; i < 4; ++i)
        {
            glm::ivec3 shift{};
            for (int axis = 0; axis < 3; ++axis)
            {
                const int reach = i == 0 ? 1 : resolution / 2; // changes how bricks are cut, in most cases
                shift[axis] = static_cast<int>(random() % static_cast<std::uint32_t>(2 * reach + 1)) - reach;
            }
            // Triangles in the grid's upper face are left out: the thin rule has an exception there, which does not
            // move with them.
            LatticeTriangles triangles = sample.triangles;
            std::erase_if(triangles,
                          [&](const LatticeTriangle& t)
                          {
                              for (int axis = 0; axis < 3; ++axis)
                              {
                                  const bool level = t[0][axis] == t[1][axis] && t[0][axis] == t[2][axis];
                                  const int top = resolution * 256;
                                  if (GetParam() == Coverage::Thin && level &&
                                      (t[0][axis] == top || t[0][axis] + 256 * shift[axis] == top))
                                  {
                                      return true;
                                  }
                              }
                              return false;
                          });
            const VoxelSet before = voxelsOf(triangles, sample.depth, GetParam());
            const VoxelSet after = voxelsOf(moved(triangles, [&](const glm::ivec3& p) { return p + 256 * shift; }),
                                            sample.depth, GetParam());
            // Voxels that move out of the grid are lost, and those that move in were not in the first set. So only the
            // common part is compared.
            const VoxelSet there = test::mapped(before, sample.depth, [&](const glm::ivec3& v) { return v + shift; });
            const VoxelSet back = test::mapped(after, sample.depth, [&](const glm::ivec3& v) { return v - shift; });
            const VoxelSet again = test::mapped(back, sample.depth, [&](const glm::ivec3& v) { return v + shift; });
            EXPECT_EQ(test::difference(there, again).size(), 0U) << shift.x << " " << shift.y << " " << shift.z;
        }
    }
}

// Expects that the set of each image of a sample's triangles is the image of the set that expected(symmetry) gives.
template <typename Expected> void expectSymmetric(const Sample& sample, Coverage coverage, const Expected& expected)
{
    const int resolution = 1 << sample.depth;
    for (const Symmetry& symmetry : test::symmetries())
    {
        const VoxelSet image =
            voxelsOf(moved(sample.triangles, [&](const glm::ivec3& p) { return symmetry(p, resolution * 256); }),
                     sample.depth, coverage);
        ASSERT_EQ(image, test::mapped(expected(symmetry), sample.depth,
                                      [&](const glm::ivec3& v) { return symmetry(v, resolution - 1); }));
    }
}

TEST(CoverageLaw, ConservativeSetHasThe48SymmetriesOfItsTriangles)
{
    for (const Sample& sample : samples(400))
    {
        SCOPED_TRACE(sample.name);
        const VoxelSet original = voxelsOf(sample.triangles, sample.depth, Coverage::Conservative);
        expectSymmetric(sample, Coverage::Conservative, [&](const Symmetry&) { return original; });
    }
}

/// The thin rule with the conventions that symmetry turns the default into.
ThinRule ruleUnder(const Symmetry& symmetry)
{
    ThinRule rule;
    rule.border_below = symmetry.mirrored;
    for (std::uint32_t i = 0; i < 3; ++i)
    {
        rule.tie_order[static_cast<std::size_t>(symmetry.axis[i])] = i;
    }
    return rule;
}

VoxelSet oracleThin(const LatticeTriangles& triangles, std::uint32_t depth, const ThinRule& rule)
{
    VoxelSet voxels;
    for (const LatticeTriangle& triangle : triangles)
    {
        oracle::forEachCoveredVoxel(
            stress::exact(triangle), 1U << depth, Coverage::Thin,
            [&](const glm::uvec3& voxel) { voxels.push_back(oracle::mortonEncode(voxel)); }, rule);
    }
    std::sort(voxels.begin(), voxels.end());
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
    return voxels;
}

/// Whether no convention matters: the major axis is the only largest one, and at no column's centre the plane is at a
/// border between layers.
bool isGeneric(const LatticeTriangle& triangle, std::uint32_t resolution)
{
    const oracle::Triangle t = stress::exact(triangle);
    const oracle::Vec n = oracle::normalOf(t);
    const std::size_t w = oracle::majorAxis(n);
    const std::size_t u = (w + 1) % 3;
    const std::size_t v = (w + 2) % 3;
    const Int128 size = oracle::absolute(n[w]);
    if (size == oracle::absolute(n[u]) || size == oracle::absolute(n[v]))
    {
        return false;
    }
    const auto cells = [&](std::size_t axis)
    {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        return std::array<Int128, 2>{std::max(oracle::floorDivide(low - 1, 256), Int128{0}),
                                     std::min(oracle::floorDivide(high, 256), Int128{resolution} - 1)};
    };
    const auto columns = cells(u);
    const auto rows = cells(v);
    for (Int128 column = columns[0]; column <= columns[1]; ++column)
    {
        for (Int128 row = rows[0]; row <= rows[1]; ++row)
        {
            const Int128 rise = n[u] * (column * 256 + 128 - t[0][u]) + n[v] * (row * 256 + 128 - t[0][v]);
            if ((t[0][w] * n[w] - rise) % (256 * n[w]) == 0)
            {
                return false;
            }
        }
    }
    return true;
}

TEST(CoverageLaw, ThinSetHasThe48SymmetriesOfItsTrianglesWhereNoConventionDecides)
{
    std::size_t generic_count = 0;
    for (Sample& sample : samples(400))
    {
        SCOPED_TRACE(sample.name);
        std::erase_if(sample.triangles, [&](const LatticeTriangle& t) { return !isGeneric(t, 1U << sample.depth); });
        generic_count += sample.triangles.size();
        const VoxelSet original = voxelsOf(sample.triangles, sample.depth, Coverage::Thin);
        expectSymmetric(sample, Coverage::Thin, [&](const Symmetry&) { return original; });
    }
    EXPECT_GT(generic_count, 2000U);
}

TEST(CoverageLaw, ThinSetOfAnImageIsTheImageUnderTheMirroredRule)
{
    std::size_t changed_count = 0; // images that differ from the set's
    for (Sample& sample : samples(150))
    {
        SCOPED_TRACE(sample.name);
        sample.triangles.resize(std::min<std::size_t>(sample.triangles.size(), 600)); // the oracle is slow
        const VoxelSet original = oracleThin(sample.triangles, sample.depth, {});
        expectSymmetric(sample, Coverage::Thin,
                        [&](const Symmetry& symmetry)
                        {
                            VoxelSet expected = oracleThin(sample.triangles, sample.depth, ruleUnder(symmetry));
                            changed_count += expected != original ? 1 : 0;
                            return expected;
                        });
    }
    EXPECT_GT(changed_count, 100U) << "the samples have few borders and ties";
}

/// Triangles, each cut in two at the middle of its first edge, which is on the lattice.
struct Halves
{
    LatticeTriangles whole;
    LatticeTriangles first;
    LatticeTriangles second;
};

Halves halved(const LatticeTriangles& triangles)
{
    Halves halves;
    for (LatticeTriangle t : triangles)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            t[1][axis] -= (t[0][axis] + t[1][axis]) & 1;
        }
        const glm::ivec3 middle((t[0] + t[1]) / 2);
        halves.whole.push_back(t);
        halves.first.push_back({t[0], middle, t[2]});
        halves.second.push_back({middle, t[1], t[2]});
    }
    return halves;
}

TEST(CoverageLaw, HalvesOfATriangleCoverItsConservativeSet)
{
    for (const Sample& sample : samples(2000))
    {
        SCOPED_TRACE(sample.name);
        const Halves halves = halved(sample.triangles);
        EXPECT_EQ(voxelsOf(halves.whole, sample.depth, Coverage::Conservative),
                  test::united(voxelsOf(halves.first, sample.depth, Coverage::Conservative),
                               voxelsOf(halves.second, sample.depth, Coverage::Conservative)));
    }
}

/// Whether the triangle covers the centre of the voxel's column along its major axis.
bool overColumnCenter(const LatticeTriangle& triangle, const glm::uvec3& voxel)
{
    const oracle::Triangle t = stress::exact(triangle);
    const oracle::Vec n = oracle::normalOf(t);
    const std::size_t w = oracle::majorAxis(n);
    const std::size_t u = (w + 1) % 3;
    const std::size_t v = (w + 2) % 3;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const oracle::Vec edge = t[(i + 1) % 3] - t[i];
        const Int128 to_u = Int128{voxel[static_cast<int>(u)]} * 256 + 128 - t[i][u];
        const Int128 to_v = Int128{voxel[static_cast<int>(v)]} * 256 + 128 - t[i][v];
        if ((edge[u] * to_v - edge[v] * to_u) * (n[w] < 0 ? -1 : 1) < 0)
        {
            return false;
        }
    }
    return true;
}

TEST(CoverageLaw, HalvesOfATriangleDifferFromItsThinSetOnlyBesideIt)
{
    std::size_t differing_count = 0;
    for (const Shape shape : {Shape::Random, Shape::Sliver, Shape::Needle, Shape::Tiny, Shape::Aligned})
    {
        for (const std::uint64_t number : {1, 2, 4}) // without common voxels
        {
            const stress::Batch batch = stress::makeBatch(78, shape, number, 3000);
            ASSERT_TRUE(batch.disjoint);
            const Halves halves = halved(batch.triangles);
            const VoxelSet whole = voxelsOf(halves.whole, batch.depth, Coverage::Thin);
            const VoxelSet conservative = voxelsOf(halves.whole, batch.depth, Coverage::Conservative);
            const VoxelSet parts = test::united(voxelsOf(halves.first, batch.depth, Coverage::Thin),
                                                voxelsOf(halves.second, batch.depth, Coverage::Thin));
            EXPECT_TRUE(std::includes(conservative.begin(), conservative.end(), parts.begin(), parts.end()));
            const VoxelSet differing = test::difference(whole, parts);
            differing_count += differing.size();
            for (const std::uint64_t code : differing)
            {
                const glm::uvec3 voxel = oracle::mortonDecode(code);
                const auto covers = [&](const LatticeTriangle& t)
                { return oracle::overlaps(stress::exact(t), oracle::voxelBox(voxel, voxel)); };
                const auto triangle = std::find_if(halves.whole.begin(), halves.whole.end(), covers);
                ASSERT_NE(triangle, halves.whole.end());
                EXPECT_FALSE(overColumnCenter(*triangle, voxel)) << stress::toText(*triangle);
            }
        }
    }
    EXPECT_GT(differing_count, 0U);
}

TEST_P(CoverageLaws, AnyOrderOfTrianglesAndTheirCornersGivesTheSameBytes)
{
    std::mt19937 random(3);
    for (const Sample& sample : samples(3000))
    {
        SCOPED_TRACE(sample.name);
        std::string sum;
        LatticeTriangles triangles = sample.triangles;
        VoxelSet voxels;
        for (int i = 0; i < 3; ++i)
        {
            const GpuScene scene = uploadScene(device(), stress::latticeScene(triangles, {}), true);
            const BuildResult result =
                buildOctree(device(), scene, test::latticeGrid(sample.depth), {GetParam(), true, {}});
            const std::string order_sum = octreeSha256(device(), result.octree);
            EXPECT_TRUE(sum.empty() || order_sum == sum);
            sum = order_sum;
            std::shuffle(triangles.begin(), triangles.end(), random);
            voxels = voxelCodes(device(), result.octree);
        }
        for (LatticeTriangle& triangle : triangles)
        {
            std::shuffle(triangle.begin(), triangle.end(), random);
        }
        EXPECT_EQ(voxelsOf(triangles, sample.depth, GetParam()), voxels);
    }
}

TEST_P(CoverageLaws, PartsOfAMeshUniteToTheWhole)
{
    std::mt19937 random(4);
    for (const Sample& sample : samples(3000))
    {
        SCOPED_TRACE(sample.name);
        const VoxelSet whole = voxelsOf(sample.triangles, sample.depth, GetParam());
        std::vector<LatticeTriangles> parts(1 + random() % 5);
        for (const LatticeTriangle& triangle : sample.triangles)
        {
            parts[random() % parts.size()].push_back(triangle);
        }
        VoxelSet sum;
        Scene instances; // the same parts, as primitives of one scene
        for (const LatticeTriangles& part : parts)
        {
            sum = test::united(sum, voxelsOf(part, sample.depth, GetParam()));
            instances.append(stress::latticeScene(part, {}));
        }
        EXPECT_EQ(sum, whole);
        const GpuScene scene = uploadScene(device(), instances, false);
        const BuildResult result =
            buildOctree(device(), scene, test::latticeGrid(sample.depth), {GetParam(), false, {}});
        EXPECT_EQ(voxelCodes(device(), result.octree), whole);
    }
}

TEST(CoverageLaw, ThinIsASubsetOfConservative)
{
    std::vector<Sample> all = samples(4000);
    const stress::Batch huge = stress::makeBatch(79, Shape::Huge, 3, 200);
    all.push_back({"huge", huge.depth, huge.triangles});
    for (const Sample& sample : all)
    {
        SCOPED_TRACE(sample.name);
        const VoxelSet thin = voxelsOf(sample.triangles, sample.depth, Coverage::Thin);
        const VoxelSet conservative = voxelsOf(sample.triangles, sample.depth, Coverage::Conservative);
        EXPECT_TRUE(std::includes(conservative.begin(), conservative.end(), thin.begin(), thin.end()));
        EXPECT_LE(thin.size(), conservative.size());
    }
}

} // namespace
} // namespace zvo
