// SPDX-License-Identifier: MIT
#include "support/tree_comparison.h"

#include "support/trace_rays.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <random>

namespace zvo::test
{

namespace
{

constexpr std::array kComparedViews = {View::Color,      View::Albedo, View::Normal, View::Depth, View::Level,
                                       View::Iterations, View::Voxel,  View::Bricks, View::Origin};

bool showsAttributes(View view)
{
    return view == View::Color || view == View::Albedo || view == View::Normal || view == View::Bricks ||
           view == View::Origin;
}

} // namespace

TreeComparison::Subject::Subject(vk::HeadlessDevice& device, const DeviceTree& view, bool rank_table)
    : tree(view), voxels(device.download(view.voxel_attributes)), nodes(device.download(view.node_attributes)),
      paths(device.device(), view.isDag() && rank_table)
{
    device.run([&](vk::FrameGraph& graph) { buildNodePaths(graph, tree, paths); });
}

std::uint64_t TreeComparison::Subject::attributeOf(const gpu::Hit& hit) const
{
    const bool is_voxel = unpack(hit)->level == tree.grid.nodeLevels();
    if (hit.index >= gpu::kInteriorIndex)
    {
        return UINT64_MAX; // inside of a filled tree
    }
    const gpu::Attribute& look = (is_voxel ? voxels : nodes).at(hit.index);
    return look.color | std::uint64_t{look.normal} << 32;
}

TreeComparison::TreeComparison(vk::HeadlessDevice& device, const DeviceTree& expected, const DeviceTree& tree,
                               const glm::uvec2& size, bool rank_table)
    : m_device(device), m_expected(device, expected, rank_table), m_subject(device, tree, rank_table),
      m_buffers(device.device(), size.x, size.y)
{
}

void TreeComparison::pictures(const ViewCamera& close)
{
    for (const ViewCamera& view : {manyCameras(m_subject.tree.grid).front(), close})
    {
        views(view);
        detail(view);
    }
    cameras(3);
}

void TreeComparison::views(const ViewCamera& view, bool must_hit)
{
    const bool has_updates = m_subject.tree.hasOverlays() != m_expected.tree.hasOverlays();
    for (const View shown : kComparedViews)
    {
        if (shown == View::Origin && has_updates) // shows which leaves updates have made: what was rebuilt has none
        {
            continue;
        }
        TraceOptions options;
        options.view = shown;
        options.occlusion_rays = 2;
        EXPECT_TRUE(picture(view, options) != 0 || !must_hit);
    }
}

void TreeComparison::cameras(std::size_t n, TraceOptions options)
{
    const std::vector<ViewCamera> views = manyCameras(m_subject.tree.grid);
    for (std::size_t i = n / 2; i < views.size(); i += n)
    {
        options.beam = i / n % 2 == 0;
        picture(views[i], options);
    }
}

void TreeComparison::detail(const ViewCamera& view, bool must_hit)
{
    for (const std::uint32_t level : {0U, 1U, 2U, 3U, 4U, UINT32_MAX})
    {
        TraceOptions coarse;
        coarse.detail_level = level;
        coarse.detail_pixels = level == UINT32_MAX ? 6.0F : 0.0F;
        EXPECT_TRUE(picture(view, coarse) != 0 || !must_hit);
        coarse.view = View::Level;
        picture(view, coarse);
    }
}

void TreeComparison::rays(const Codes& codes, TraceOptions options, std::uint32_t count) const
{
    std::mt19937 random(m_subject.tree.grid.rootResolution());
    const std::vector<gpu::Ray> rays = pickRays(random, m_subject.tree.grid.rootResolution(), codes, count);
    for (const std::uint32_t level : {UINT32_MAX, 1U, 2U, 3U})
    {
        options.detail_level = level;
        expectSameHits(traceOnDevice(m_device, m_expected.tree, rays, options),
                       traceOnDevice(m_device, m_subject.tree, rays, options), m_subject.tree.hasAttributes());
    }
}

Picture TreeComparison::take(const Subject& subject, const TraceCamera& camera, const TraceOptions& options)
{
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(m_buffers.hits, gpu::kHitMiss);
            graph.fill(m_buffers.light, 0);
            trace(graph, subject.tree, subject.paths, camera, options, m_buffers);
        });
    const gpu::TraceStatus status = m_device.download(m_buffers.status).front();
    return {m_device.download(m_buffers.image), m_device.download(m_buffers.hits), m_device.download(m_buffers.light),
            status.live_tiles, status.capped_rays};
}

std::uint32_t TreeComparison::picture(const ViewCamera& view, const TraceOptions& options)
{
    const TraceCamera camera = traceCamera(view, m_subject.tree.grid, m_buffers.height);
    const Picture expected = take(m_expected, camera, options);
    const std::vector<float> expected_starts = m_device.download(m_buffers.starts);
    const Picture picture = take(m_subject, camera, options);
    EXPECT_EQ(picture.image, expected.image);
    EXPECT_EQ(picture.light, expected.light);
    EXPECT_EQ(picture.live_tiles, expected.live_tiles);
    EXPECT_EQ(picture.capped_rays, expected.capped_rays);
    EXPECT_EQ(m_device.download(m_buffers.starts), expected_starts);
    expectSameHits(expected.hits, picture.hits, m_subject.tree.hasAttributes() && showsAttributes(options.view));
    return hitCount(expected);
}

void TreeComparison::expectSameHits(const std::vector<gpu::Hit>& expected, const std::vector<gpu::Hit>& hits,
                                    bool with_attributes) const
{
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        ASSERT_EQ(hits[i].index == gpu::kHitMiss, expected[i].index == gpu::kHitMiss) << i;
        if (hits[i].index == gpu::kHitMiss)
        {
            continue;
        }
        ASSERT_EQ(std::bit_cast<std::uint32_t>(hits[i].t), std::bit_cast<std::uint32_t>(expected[i].t)) << i;
        ASSERT_EQ(hits[i].where, expected[i].where) << i;
        if (with_attributes)
        {
            ASSERT_EQ(m_subject.attributeOf(hits[i]), m_expected.attributeOf(expected[i])) << i;
        }
    }
}

} // namespace zvo::test
