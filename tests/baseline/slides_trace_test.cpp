// SPDX-License-Identifier: MIT
// Rays through the slides' nodes against zvo's rays.
#include "baseline/slides_trace.h"

#include "baseline/slides_fixture.h"
#include "core/trace/trace.h"
#include "io/gltf/gltf_loader.h"
#include "support/param_names.h"
#include "support/scenes.h"
#include "support/trace_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

namespace zvo::baseline
{
namespace
{

using test::DeviceHit;
using test::slidesDevice;

constexpr std::uint32_t kWidth = 90;
constexpr std::uint32_t kHeight = 50;

using Hits = std::vector<gpu::Hit>;

// Of trace/primary. Rays begin at the camera.
Hits zvosHits(const DeviceTree& octree, const TraceCamera& camera)
{
    TraceBuffers buffers(slidesDevice().device(), kWidth, kHeight);
    const NodePaths paths(slidesDevice().device());
    slidesDevice().run([&](vk::FrameGraph& graph)
                       { tracePrimary(graph, octree, paths, camera, {.beam = false}, buffers); });
    Hits hits = slidesDevice().download(buffers.hits);
    const std::vector<float> starts = slidesDevice().download(buffers.starts);
    const std::uint32_t tiles_x = (kWidth + gpu::kTileEdge - 1) / gpu::kTileEdge;
    for (std::uint32_t i = 0; i < hits.size(); ++i)
    {
        const std::uint32_t tile = i / kWidth / gpu::kTileEdge * tiles_x + i % kWidth / gpu::kTileEdge;
        if (starts[tile] == gpu::kTileDead)
        {
            hits[i].index = gpu::kHitMiss;
        }
    }
    return hits;
}

Hits slidesHits(const SlidesTree& tree, const TraceCamera& camera, const SlidesTraceOptions& options)
{
    SlidesTraceBuffers buffers(slidesDevice().device(), kWidth, kHeight);
    slidesDevice().run([&](vk::FrameGraph& graph) { slidesTrace(graph, tree, camera, options, buffers); });
    EXPECT_EQ(slidesDevice().download(buffers.status)[0].capped_rays, 0U);
    return slidesDevice().download(buffers.hits);
}

// All combinations of form and tips.
std::vector<SlidesTraceOptions> allOptions()
{
    std::vector<SlidesTraceOptions> all;
    for (const bool push_children : {false, true})
    {
        for (const bool stop_at_far_side : {true, false})
        {
            for (const bool skip_behind : {true, false})
            {
                all.push_back({push_children, stop_at_far_side, skip_behind});
            }
        }
    }
    return all;
}

// The number of hits that are not the same. index: whether they have to have the same one.
std::size_t differences(const Hits& a, const Hits& b, bool index)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        const std::optional<DeviceHit> hit_a = test::unpack(a[i]);
        const std::optional<DeviceHit> hit_b = test::unpack(b[i]);
        const bool same = hit_a.has_value() == hit_b.has_value() &&
                          (!hit_a || (hit_a->t == hit_b->t && hit_a->face == hit_b->face &&
                                      hit_a->cell == hit_b->cell && (!index || hit_a->index == hit_b->index)));
        count += same ? 0 : 1;
    }
    return count;
}

// A ray of a picture in double precision.
struct PixelRay
{
    glm::dvec3 origin;
    glm::dvec3 direction;

    PixelRay(const TraceCamera& camera, std::uint32_t x, std::uint32_t y)
    {
        const glm::dvec3 offset = (2.0 * x + 1.0 - kWidth) * glm::dvec3(camera.rays.half_pixel_x) +
                                  (2.0 * y + 1.0 - kHeight) * glm::dvec3(camera.rays.half_pixel_y);
        origin = glm::dvec3(camera.rays.origin) + (camera.orthographic ? offset : glm::dvec3(0.0));
        direction = glm::dvec3(camera.rays.forward) + (camera.orthographic ? glm::dvec3(0.0) : offset);
    }

    // How much of the ray, in t, is inside of a voxel.
    [[nodiscard]] double lengthIn(const glm::uvec3& cell, const Grid& grid) const
    {
        const double size = 1.0 / grid.rootResolution();
        const glm::dvec3 a = (1.0 + glm::dvec3(cell) * size - origin) / direction;
        const glm::dvec3 b = (1.0 + (glm::dvec3(cell) + 1.0) * size - origin) / direction;
        const glm::dvec3 low = glm::min(a, b);
        const glm::dvec3 high = glm::max(a, b);
        return std::min({high.x, high.y, high.z}) - std::max({low.x, low.y, low.z});
    }
};

// Times of planes differ in their last bits from those that zvo computes.
constexpr double kTimeError = 2e-6; // in unit space, for a ray that crosses it
// So a ray may pass a voxel that it is inside of for no longer than this.
constexpr double kGrazing = 2 * kTimeError;

// Expects the same voxels at the same times. Where the voxels differ, the ray only grazes the first of the two.
void expectZvosHits(const Hits& hits, const Hits& expected, const TraceCamera& camera, const Grid& grid)
{
    std::size_t grazing = 0;
    std::size_t hit_count = 0;
    for (std::uint32_t i = 0; i < hits.size(); ++i)
    {
        const std::optional<DeviceHit> hit = test::unpack(hits[i]);
        const std::optional<DeviceHit> zvos = test::unpack(expected[i]);
        hit_count += hit ? 1 : 0;
        if (!hit && !zvos)
        {
            continue;
        }
        SCOPED_TRACE(testing::Message() << "pixel " << i % kWidth << ", " << i / kWidth);
        if (hit && zvos && hit->cell == zvos->cell)
        {
            EXPECT_EQ(hit->index, zvos->index);
            EXPECT_EQ(hit->level, zvos->level);
            EXPECT_NEAR(hit->t, zvos->t, kTimeError * std::max(1.0F, zvos->t));
            continue;
        }
        ++grazing;
        const DeviceHit& first = !zvos || (hit && hit->t < zvos->t) ? *hit : *zvos;
        EXPECT_LE(std::abs(PixelRay(camera, i % kWidth, i / kWidth).lengthIn(first.cell, grid)), kGrazing);
    }
    EXPECT_GT(hit_count, hits.size() / 20);
    EXPECT_LE(grazing, hits.size() / 1000);
}

// From outside, and from inside of the scene's box.
std::vector<ViewCamera> viewsOf(const Scene& scene)
{
    constexpr double kAspect = static_cast<double>(kWidth) / kHeight;
    const Bounds bounds = scene.bounds();
    const glm::dvec3 center = glm::dvec3(bounds.min + bounds.max) * 0.5;
    const glm::dvec3 size = bounds.max - bounds.min;
    ViewCamera orthographic = ViewCamera::framing(bounds, kAspect);
    orthographic.orthographic = true;
    orthographic.half_height = 0.6 * glm::length(size);
    return {ViewCamera::framing(bounds, kAspect), orthographic,
            ViewCamera::lookAt(center + size * glm::dvec3(0.13, 0.07, -0.11),
                               center - size * glm::dvec3(0.4, 0.17, 0.05), 1.3)};
}

using SlidesTraces = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Scenes, SlidesTraces, testing::ValuesIn(test::slidesScenes()), test::paramName<std::string>);

// Traces a picture in all forms through all trees of the same voxels. Expects the hits that zvo finds in octree.
void expectAllFormsHit(const std::vector<SlidesTree>& trees, const DeviceTree& octree, const ViewCamera& view)
{
    SCOPED_TRACE(testing::Message() << "depth " << octree.grid.depth << (view.orthographic ? ", orthographic" : ""));
    const TraceCamera camera = traceCamera(view, octree.grid, kHeight);
    const Hits hits = slidesHits(trees[0], camera, {});
    expectZvosHits(hits, zvosHits(octree, camera), camera, octree.grid);
    for (const SlidesTraceOptions& options : view.orthographic ? std::vector<SlidesTraceOptions>{} : allOptions())
    {
        EXPECT_EQ(differences(slidesHits(trees[0], camera, options), hits, true), 0U);
    }
    for (const SlidesTree& tree : trees)
    {
        const bool has_sums = tree.node_words == SlidesNodes::WithSums;
        EXPECT_EQ(differences(slidesHits(tree, camera, {}), hits, has_sums), 0U);
    }
}

// Octrees or DAGs, the one with sums first.
std::vector<SlidesTree> bothTrees(const GpuScene& scene, const Grid& grid, bool dag)
{
    std::vector<SlidesTree> trees;
    for (const SlidesNodes nodes : {SlidesNodes::WithSums, SlidesNodes::Plain})
    {
        trees.push_back(test::buildSlides(scene, grid, {.attributes = false, .dag = dag, .nodes = nodes}).tree);
    }
    return trees;
}

TEST_P(SlidesTraces, HitZvosVoxelsInAllForms)
{
    const auto path = test::findScene(GetParam());
    if (!path)
    {
        GTEST_SKIP() << GetParam() << " is not there";
    }
    const Scene scene = loadGltf(*path);
    const GpuScene uploaded = uploadScene(slidesDevice(), scene, false);
    for (const std::uint32_t depth : {7U, 8U})
    {
        const Grid grid = Grid::around(scene.bounds(), depth);
        const DeviceTree octree = buildOctree(slidesDevice(), uploaded, grid, {Coverage::Thin, false, {}}).octree;
        const std::vector<SlidesTree> trees = bothTrees(uploaded, grid, depth == 8);
        for (const ViewCamera& view : viewsOf(scene))
        {
            expectAllFormsHit(trees, octree, view);
        }
    }
}

// A ray's stack has room for the deepest tree.
TEST(SlidesTrace, TheDeepestTreeIsHitInAllForms)
{
    constexpr float kFar = 8192.0F;
    const Scene sphere = test::sphereScene(glm::vec3(4096.0F), 40.0F, 12);
    Scene scene = test::triangleSoup({{0, 1, 2}, {kFar, kFar, kFar - 3}, {kFar, kFar - 9, kFar}});
    scene.primitives.push_back(sphere.primitives[0]);
    scene.instances.push_back({1, glm::mat4(1.0F)});
    const GpuScene uploaded = uploadScene(slidesDevice(), scene, false);
    const Grid grid{.origin = glm::vec3(0.0F), .voxel_size = 1.0F, .depth = gpu::kSlidesDepthMax};
    const DeviceTree octree = buildOctree(slidesDevice(), uploaded, grid, {Coverage::Thin, false, {}}).octree;
    const ViewCamera view = ViewCamera::lookAt({4210.0, 4180.0, 4250.0}, {4096.0, 4096.0, 4096.0}, 0.6);
    expectAllFormsHit(bothTrees(uploaded, grid, true), octree, view);
}

TEST(SlidesTrace, OfNothingHitsNothing)
{
    SlidesTree tree;
    tree.grid.depth = 4;
    const TraceCamera camera = traceCamera(ViewCamera(), tree.grid, kHeight);
    for (const gpu::Hit& hit : slidesHits(tree, camera, {}))
    {
        EXPECT_FALSE(test::unpack(hit));
    }
}

} // namespace
} // namespace zvo::baseline
