// SPDX-License-Identifier: MIT
// A file has the same bytes for any order of the scene's triangles and instances, in each format of attributes.
#include "core/file/zvo_file.h"
#include "io/file/sha256.h"
#include "runtime/tiled_build.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

namespace
{

using test::device;

std::string sha256Of(const TreeData& tree)
{
    std::vector<std::byte> file;
    writeZvo(tree, [&file](std::span<const std::byte> more) { file.insert(file.end(), more.begin(), more.end()); });
    return sha256Hex(file);
}

Scene shuffled(const Scene& scene, std::uint32_t seed)
{
    std::mt19937 random(seed);
    Scene result = scene;
    for (Primitive& primitive : result.primitives)
    {
        std::shuffle(primitive.triangles.begin(), primitive.triangles.end(), random);
    }
    std::shuffle(result.instances.begin(), result.instances.end(), random);
    return result;
}

struct Sums
{
    std::string svo;
    std::string svdag;
    std::string svdag_of_tiles;
};

Sums sumsOf(const Scene& scene, const Grid& grid, AttributeFormat format)
{
    const bool attributes = format != AttributeFormat::None;
    const GpuScene gpu_scene = uploadScene(device(), scene, attributes);
    DeviceTree octree = buildOctree(device(), gpu_scene, grid, {Coverage::Thin, attributes, {}}).octree;
    packTree(device(), format, octree);
    Sums sums;
    sums.svo = sha256Of(downloadTree(device(), octree));
    sums.svdag = sha256Of(downloadTree(device(), compress(device(), std::move(octree)).dag));
    const TiledOptions tiled{.attributes = format, .tile_depth = 4};
    sums.svdag_of_tiles = sha256Of(buildByTiles(device(), gpu_scene, grid, tiled).tree);
    return sums;
}

using ZvoBytes = testing::TestWithParam<AttributeFormat>;

INSTANTIATE_TEST_SUITE_P(Formats, ZvoBytes,
                         testing::Values(AttributeFormat::None, AttributeFormat::Bytes4, AttributeFormat::Bytes8,
                                         AttributeFormat::Blocks),
                         [](const auto& format) { return std::string("Format_") + formatName(format.param); });

TEST_P(ZvoBytes, DoNotDependOnTheOrderOfTrianglesAndInstances)
{
    const Scene scene = test::materialsScene(10.0F);
    const Grid grid = Grid::around(scene.bounds(), 6);
    const Sums expected = sumsOf(scene, grid, GetParam());
    EXPECT_NE(expected.svo, expected.svdag);
    EXPECT_EQ(expected.svdag_of_tiles, expected.svdag);
    for (std::uint32_t seed = 1; seed <= 3; ++seed)
    {
        const Sums sums = sumsOf(shuffled(scene, seed), grid, GetParam());
        EXPECT_EQ(sums.svo, expected.svo) << seed;
        EXPECT_EQ(sums.svdag, expected.svdag) << seed;
        EXPECT_EQ(sums.svdag_of_tiles, expected.svdag) << seed;
    }
}

} // namespace
} // namespace zvo
