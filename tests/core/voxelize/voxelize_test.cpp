// SPDX-License-Identifier: MIT
// The voxels of the device against the exact oracle, bit for bit.
#include "io/gltf/gltf_loader.h"
#include "oracle/voxelizer.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/param_names.h"
#include "support/scenes.h"
#include "support/voxel_compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

void expectEqualsOracle(const Scene& scene, const Grid& grid, Coverage coverage)
{
    test::expectEqualsOracle(device(), scene, grid, coverage);
}

using VoxelizeBothCoverages = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, VoxelizeBothCoverages, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

TEST_P(VoxelizeBothCoverages, EmptySceneGivesAnEmptyOctree)
{
    expectEqualsOracle(test::triangleSoup({}), {}, GetParam());
}

TEST_P(VoxelizeBothCoverages, RandomTrianglesEqualTheOracleAtEveryDepth)
{
    for (std::uint32_t depth = 1; depth <= 8; ++depth)
    {
        const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = depth};
        SCOPED_TRACE(depth);
        expectEqualsOracle(test::randomTriangles(depth, 400, static_cast<float>(grid.resolution())), grid, GetParam());
    }
}

TEST_P(VoxelizeBothCoverages, HugeTrianglesFarBeyondTheGridEqualTheOracle)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 5};
    Scene scene = test::randomTriangles(7, 300, 2.0e6F);
    scene.instances[0].transform[3] = glm::vec4(-1.0e6F, -1.0e6F, -1.0e6F, 1.0F);
    const std::vector<glm::vec3> crossing = {{-2e6F, 3, -1e6F}, {2e6F, 7, -2e6F}, {31, 12, 2e6F},
                                             {-1e6F, -1e6F, 9}, {1e6F, 1e6F, 11}, {1e6F, -1e6F, 2}};
    scene.append(test::triangleSoup(crossing));
    EXPECT_GT(oracle::voxelize(scene, grid, GetParam()).codes.size(), 1000U) << "few of them cross the grid";
    expectEqualsOracle(scene, grid, GetParam());
}

TEST_P(VoxelizeBothCoverages, FacesOnCellBordersEqualTheOracle)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 0.5F, .depth = 5};
    expectEqualsOracle(test::boxScene(glm::vec3(0.0F), glm::vec3(16.0F)), grid, GetParam());
    expectEqualsOracle(test::boxScene(glm::vec3(1.5F), glm::vec3(8.0F)), grid, GetParam());
    expectEqualsOracle(test::sphereScene(glm::vec3(8.0F), 8.0F, 24), grid, GetParam());
    expectEqualsOracle(test::triangleSoup({{0, 4, 0}, {16, 4, 0}, {16, 4, 16}}), grid, GetParam());
}

TEST_P(VoxelizeBothCoverages, SegmentsAndPointsEqualTheOracle)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 6};
    expectEqualsOracle(test::triangleSoup({{1, 2, 3},
                                           {1, 2, 3},
                                           {1, 2, 3},
                                           {0.5F, 0.5F, 0.5F},
                                           {60, 50, 40},
                                           {0.5F, 0.5F, 0.5F},
                                           {0, 5, 0},
                                           {64, 5, 0},
                                           {32, 5, 0},
                                           {-10, 3.3F, 5},
                                           {200, 60, 70},
                                           {95, 31.65F, 37.5F}}),
                       grid, GetParam());
}

TEST_P(VoxelizeBothCoverages, LongSegmentsInAllDirectionsEqualTheOracle)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 10};
    std::vector<glm::vec3> corners;
    for (int direction = 1; direction < 27; ++direction) // each sum of axes, some of them shortened
    {
        const glm::vec3 extent(static_cast<float>(direction % 3) * 511.5F,
                               static_cast<float>(direction / 3 % 3) * 511.5F,
                               static_cast<float>(direction / 9) * 511.5F);
        const glm::vec3 start = (glm::vec3(1023.25F) - extent) * 0.5F;
        corners.insert(corners.end(), {start, start + extent, start});
    }
    expectEqualsOracle(test::triangleSoup(corners), grid, GetParam());
}

TEST_P(VoxelizeBothCoverages, BadVerticesAreDroppedAndCounted)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 4};
    expectEqualsOracle(test::triangleSoup({{nan, 0, 0},
                                           {1, 2, 3},
                                           {4, 5, 6},
                                           {0, inf, 0},
                                           {1, 2, 3},
                                           {4, 5, 6},
                                           {0, 0, 3e38F},
                                           {1, 2, 3},
                                           {4, 5, 6},
                                           {-9, -9, -9},
                                           {-8, -9, -9},
                                           {-9, -8, -9},
                                           {1, 2, 3},
                                           {4, 5, 6},
                                           {1, 9, 6}}),
                       grid, GetParam());
}

TEST_P(VoxelizeBothCoverages, TooSmallBuffersGrowUntilEverythingFits)
{
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = 7};
    const Scene scene = test::randomTriangles(3, 500, 128.0F);
    const GpuScene gpu_scene = uploadScene(device(), scene, true);
    const BuildResult roomy = buildOctree(device(), gpu_scene, grid, {GetParam(), true, {}});
    const BuildResult cramped =
        buildOctree(device(), gpu_scene, grid, {GetParam(), true, VoxelizeCapacities{1, 1, 1, 1, 1}});
    EXPECT_GT(cramped.retry_count, 2U);
    EXPECT_EQ(octreeSha256(device(), cramped.octree), octreeSha256(device(), roomy.octree));
}

struct MeshCase
{
    const char* file;
    std::uint32_t depth;
    Coverage coverage;
};

using VoxelizeMesh = testing::TestWithParam<MeshCase>;

void PrintTo(const MeshCase& mesh, std::ostream* out)
{
    *out << mesh.file << ", depth " << mesh.depth << ", " << test::nameOf(mesh.coverage);
}

std::vector<MeshCase> meshCases()
{
    std::vector<MeshCase> cases;
    for (const char* file : {"bunny.glb", "dragon.glb", "buddha_113k.glb", "atrium.glb"})
    {
        for (const std::uint32_t depth : {7U, 8U})
        {
            for (const Coverage coverage : {Coverage::Conservative, Coverage::Thin})
            {
                cases.push_back({file, depth, coverage});
            }
        }
    }
    cases.push_back({"alpha_blend_mode_test.glb", 8, Coverage::Thin});
    cases.push_back({"milk_truck.glb", 8, Coverage::Thin});
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Meshes, VoxelizeMesh, testing::ValuesIn(meshCases()),
                         [](const auto& test_case)
                         {
                             std::string name = test_case.param.file;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name + std::to_string(1U << test_case.param.depth) +
                                    test::nameOf(test_case.param.coverage);
                         });

TEST_P(VoxelizeMesh, EqualsTheOracle)
{
    const auto path = test::findScene(GetParam().file);
    if (!path)
    {
        GTEST_SKIP() << GetParam().file << " is not there";
    }
    const Scene scene = loadGltf(*path);
    expectEqualsOracle(scene, Grid::around(scene.bounds(), GetParam().depth), GetParam().coverage);
}

} // namespace
} // namespace zvo
