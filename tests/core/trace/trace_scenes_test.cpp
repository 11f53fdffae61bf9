// SPDX-License-Identifier: MIT
// Rays through the octrees of whole scenes against the reference, bit for bit.
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/param_names.h"
#include "support/scenes.h"
#include "support/trace_rays.h"

#include <gtest/gtest.h>

namespace zvo
{
namespace
{

constexpr std::uint32_t kRayCount = 100000;

using test::device;

using TraceScenes = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Scenes, TraceScenes,
                         testing::Values("bunny.glb", "dragon.glb", "buddha_113k.glb", "atrium.glb"),
                         test::paramName<std::string>);

TEST_P(TraceScenes, HitsEqualTheReference)
{
    const auto path = test::findScene(GetParam());
    if (!path)
    {
        GTEST_SKIP() << GetParam() << " is not there";
    }
    const Scene scene = loadGltf(*path);
    const GpuScene gpu_scene = uploadScene(device(), scene, false);
    for (const std::uint32_t depth : {7U, 8U})
    {
        for (const Coverage coverage : {Coverage::Thin, Coverage::Conservative})
        {
            const Grid grid = Grid::around(scene.bounds(), depth);
            const DeviceTree octree = buildOctree(device(), gpu_scene, grid, {coverage, false, {}}).octree;
            test::expectEqualsReference(device(), octree, voxelCodes(device(), octree), kRayCount, {}, false);
        }
    }
}

} // namespace
} // namespace zvo
