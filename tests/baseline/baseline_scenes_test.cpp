// SPDX-License-Identifier: MIT
// The octrees of both sources against zvo's, on whole scenes: the same voxels, and the same hits.
#include "baseline/baseline_fixture.h"
#include "io/gltf/gltf_loader.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <string>

namespace zvo
{
namespace
{

void expectBothAreZvos(const GpuScene& scene, const Grid& grid, Coverage coverage,
                       const std::vector<ViewCamera>& cameras)
{
    vk::HeadlessDevice& device = test::baselineDevice();
    const DeviceTree tree = buildOctree(device, scene, grid, {coverage, false, {}}).octree;
    const std::vector<std::uint64_t> codes = voxelCodes(device, tree);

    const test::ThesisWay way = {.coverage = coverage, .numbering = baseline::TileNumbering::Atomic};
    const baseline::PointerOctree thesis = test::thesisOctree(scene, grid, way);
    test::expectSameCodes(baseline::listCodes(device, thesis), codes);

    const baseline::PointerOctree crassin_green = test::crassinGreenOctree(scene, grid, coverage);
    test::expectSameCodes(baseline::listCodes(device, crassin_green), codes);
    test::expectSameHits({&thesis, &crassin_green}, tree, cameras);
    EXPECT_EQ(thesis.node_count, crassin_green.node_count);
}

using BaselineScenes = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Scenes, BaselineScenes,
                         testing::Values("bunny_low.glb", "dragon.glb", "buddha_113k.glb", "sponza.glb", "atrium.glb",
                                         "cornell_box.glb", "cube.glb", "knot.glb"),
                         test::paramName<std::string>);

TEST_P(BaselineScenes, VoxelsAndHitsAreZvos)
{
    const auto path = test::findScene(GetParam());
    if (!path)
    {
        GTEST_SKIP() << GetParam() << " is not there";
    }
    const Scene scene = loadGltf(*path);
    const GpuScene gpu_scene = uploadScene(test::baselineDevice(), scene, false);
    const bool is_own = *path == test::ownScene(GetParam());
    for (std::uint32_t depth = 7; depth <= (is_own ? 7U : 8U); ++depth)
    {
        for (const Coverage coverage : {Coverage::Conservative, Coverage::Thin})
        {
            SCOPED_TRACE(std::to_string(depth) + " " + test::nameOf(coverage));
            expectBothAreZvos(gpu_scene, Grid::around(scene.bounds(), depth), coverage,
                              test::fewCameras(scene.bounds()));
        }
    }
}

} // namespace
} // namespace zvo
