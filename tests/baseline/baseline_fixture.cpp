// SPDX-License-Identifier: MIT
#include "baseline/baseline_fixture.h"

#include "baseline/baseline_kernels.h"
#include "core/trace/trace.h"
#include "support/device.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace zvo::test
{

namespace
{

constexpr std::uint32_t kWidth = 75; // no whole number of tiles
constexpr std::uint32_t kHeight = 52;

std::vector<gpu::Hit> zvoHits(const DeviceTree& tree, const TraceCamera& camera)
{
    vk::HeadlessDevice& device = baselineDevice();
    NodePaths paths(device.device());
    TraceBuffers buffers(device.device(), kWidth, kHeight);
    device.run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(buffers.hits, gpu::kHitMiss); // in dead tiles, too
            buildNodePaths(graph, tree, paths);
            tracePrimary(graph, tree, paths, camera, {}, buffers);
        });
    return device.download(buffers.hits);
}

bool isHit(const gpu::Hit& hit)
{
    return hit.index != gpu::kHitMiss;
}

// Pixels in which time, voxel or face differ.
std::uint32_t countDifferences(std::span<const gpu::Hit> hits, std::span<const gpu::Hit> expected)
{
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
        const bool same = isHit(hits[i]) && isHit(expected[i])
                              ? hits[i].t == expected[i].t && hits[i].where == expected[i].where
                              : isHit(hits[i]) == isHit(expected[i]);
        count += same ? 0 : 1;
    }
    return count;
}

} // namespace

vk::HeadlessDevice& baselineDevice()
{
    return sharedDevice(baseline::allKernels());
}

DenseCells cellsOf(const PosedGpuScene& scene, const Grid& grid, const ThesisWay& way)
{
    vk::HeadlessDevice& device = baselineDevice();
    baseline::ThesisTriangles triangles(device.device(), scene.uploaded());
    triangles.cells_per_part = way.cells_per_part;
    const baseline::ThesisJob job = {scene, grid, way.coverage, triangles, way.bounds};
    DenseCells result{{device.device(), grid, way.target == baseline::ThesisTarget::Sums}, {}};
    baseline::voxelizeThesis(device, job, way.target, result.cells, &result.range);
    return result;
}

baseline::PointerOctree thesisOctree(const PosedGpuScene& scene, const Grid& grid, const ThesisWay& way)
{
    vk::HeadlessDevice& device = baselineDevice();
    const DenseCells dense = cellsOf(scene, grid, way);
    baseline::ThesisLevels levels(device.device(), grid);
    baseline::ThesisBuildOptions options{.numbering = way.numbering};
    if (way.bounds)
    {
        options.range = dense.range;
    }
    return baseline::buildThesis(device, dense.cells, options, levels).octree;
}

baseline::PointerOctree crassinGreenOctree(const GpuScene& scene, const Grid& grid, Coverage coverage)
{
    vk::HeadlessDevice& device = baselineDevice();
    baseline::ThesisTriangles triangles(device.device(), scene);
    triangles.cells_per_part = kCellsPerPart;
    const baseline::FragmentList list = baseline::listFragments(device, {scene, grid, coverage, triangles});
    baseline::CrassinGreenBuffers buffers(device.device());
    return baseline::buildTopDown(device, scene, grid, list.fragments, buffers).octree;
}

void expectSameCodes(std::span<const std::uint64_t> codes, std::span<const std::uint64_t> expected)
{
    EXPECT_EQ(codes.size(), expected.size());
    const auto [first, other] = std::ranges::mismatch(codes, expected);
    EXPECT_TRUE(first == codes.end() && other == expected.end())
        << "voxel " << first - codes.begin() << " of " << expected.size() << " is the first that differs";
}

void expectSameHits(std::initializer_list<const baseline::PointerOctree*> octrees, const DeviceTree& expected,
                    const std::vector<ViewCamera>& cameras)
{
    vk::HeadlessDevice& device = baselineDevice();
    baseline::PointerPicture picture(device.device(), kWidth, kHeight);
    std::uint32_t hit_count = 0;
    for (const ViewCamera& view : cameras)
    {
        const TraceCamera camera = traceCamera(view, expected.grid, kHeight);
        const std::vector<gpu::Hit> zvo_hits = zvoHits(expected, camera);
        for (const baseline::PointerOctree* octree : octrees)
        {
            device.run([&](vk::FrameGraph& graph) { baseline::tracePicture(graph, *octree, camera, picture); });
            const std::vector<gpu::Hit> hits = device.download(picture.hits);
            EXPECT_EQ(device.download(picture.status).front().capped_rays, 0U);
            EXPECT_EQ(countDifferences(hits, zvo_hits), 0U)
                << "of " << hits.size() << " pixels, camera " << &view - cameras.data();
        }
        hit_count += static_cast<std::uint32_t>(std::ranges::count_if(zvo_hits, isHit));
    }
    EXPECT_GT(hit_count, 0U);
}

std::vector<ViewCamera> fewCameras(const Bounds& bounds)
{
    const glm::dvec3 center = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    const double size = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    ViewCamera orthographic = ViewCamera::lookAt(center + size * glm::dvec3(-0.7, 0.4, -0.6), center, 0.5);
    orthographic.orthographic = true;
    orthographic.half_height = 0.4 * size;
    return {ViewCamera::framing(bounds, static_cast<double>(kWidth) / kHeight),
            ViewCamera::lookAt(center, center + glm::dvec3(1.0, 0.2, 0.3), 1.3), orthographic};
}

} // namespace zvo::test
