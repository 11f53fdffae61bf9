// SPDX-License-Identifier: MIT
// Every value of every choice by device gives the same octree, the same picture and the same paths, bit for bit.
#include "core/base/kernels.h"
#include "core/base/lanes.h"
#include "core/base/tuning.h"
#include "core/path/path_tracer.h"
#include "core/trace/tree_tracer.h"
#include "core/upload/gpu_scene.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/same_bytes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

namespace zvo
{

namespace
{

struct TunedResults
{
    std::string octree;
    std::vector<gpu::uint> picture;
    std::vector<gpu::PixelSum> sums;
};

TunedResults resultsWith(const Scene& scene, const vk::TuningValues& tuning)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning = tuning;
    vk::HeadlessDevice device(options, zvoKernels());
    const GpuScene gpu_scene = uploadScene(device, scene, true);
    const Grid grid = Grid::around(scene.bounds(), 6);
    const DeviceTree octree = buildOctree(device, gpu_scene, grid, {}).octree;
    TreeTracer tracer(device.device());
    tracer.resize(40, 24);
    PathTracer paths(device.device());
    paths.resize(20, 12);
    DeviceEnvironment sky(device.device());
    const ViewCamera view = ViewCamera::framing(scene.bounds(), 40.0 / 24.0);
    device.run([&](vk::FrameGraph& graph) { tracer.trace(graph, octree, traceCamera(view, grid, 24), {}); });
    device.run([&](vk::FrameGraph& graph)
               { paths.addSample(graph, octree, sky, traceCamera(view, grid, 12), PathOptions()); });
    return {octreeSha256(device, octree), device.download(tracer.buffers().image),
            device.download(paths.picture().sums)};
}

TEST(TunedDevices, TakeWhatIsChosen)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning = parseTuning("", "node-lanes=4");
    vk::HeadlessDevice chosen(options, zvoKernels());
    EXPECT_EQ(lanesOn(chosen.device()), 4U);
    EXPECT_EQ(lanesOn(chosen.device(), 1ULL << 30), 4U);
    EXPECT_EQ(lanesOn(chosen.device(), (1ULL << 30) + 1), 1U) << "more threads than a dispatch can have";
    EXPECT_EQ(loneGroupOn(chosen.device()), 256U);
}

TEST(TunedResults, AreTheSameForEveryValueOfEveryChoice)
{
    const Scene scene = test::materialsScene(10.0F);
    const TunedResults expected = resultsWith(scene, {});
    const vk::DeviceReport& report = test::device().device().report();
    for (const TuningRow& row : tuningTable())
    {
        for (const TuningValue& value : row.values)
        {
            if (row.tunable == Tunable::SubgroupSize &&
                (value.value < report.min_subgroup_size || value.value > report.max_subgroup_size))
            {
                continue; // tests/vk/overrides_test.cpp: refused
            }
            const TunedResults results = resultsWith(scene, {{std::string(row.name), value.value}});
            EXPECT_EQ(results.octree, expected.octree) << row.name << " " << value.name;
            EXPECT_EQ(results.picture, expected.picture) << row.name << " " << value.name;
            EXPECT_TRUE(test::sameBytes(results.sums, expected.sums)) << row.name << " " << value.name;
        }
    }
}

} // namespace
} // namespace zvo
