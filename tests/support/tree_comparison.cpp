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

constexpr std::array kComparedViews = {View::Color, View::Albedo,     View::Normal, View::Depth,
                                       View::Level, View::Iterations, View::Voxel,  View::Bricks};
constexpr std::uint32_t kComparedWidth = 53;
constexpr std::uint32_t kComparedHeight = 41;

bool showsAttributes(View view)
{
    return view == View::Color || view == View::Albedo || view == View::Normal || view == View::Bricks ||
           view == View::Origin;
}

void expectSameHits(const std::vector<gpu::Hit>& expected, const HitAttributes& expected_attributes,
                    const std::vector<gpu::Hit>& hits, const HitAttributes& attributes, bool with_attributes)
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
            ASSERT_EQ(attributes.of(hits[i]), expected_attributes.of(expected[i])) << i;
        }
    }
}

} // namespace

HitAttributes::HitAttributes(vk::HeadlessDevice& device, const DeviceTree& tree)
    : voxels(device.download(tree.voxel_attributes)), nodes(device.download(tree.node_attributes)),
      levels(tree.grid.nodeLevels())
{
}

std::uint64_t HitAttributes::of(const gpu::Hit& hit) const
{
    const bool is_voxel = unpack(hit)->level == levels;
    const gpu::Attribute& look = (is_voxel ? voxels : nodes).at(hit.index);
    return look.color | std::uint64_t{look.normal} << 32;
}

TreeComparison::Subject::Subject(vk::HeadlessDevice& device, const DeviceTree& view)
    : tree(view), attributes(device, view), paths(device.device(), view.isDag())
{
    device.run([&](vk::FrameGraph& graph) { buildNodePaths(graph, tree, paths); });
}

TreeComparison::TreeComparison(vk::HeadlessDevice& device, const DeviceTree& expected, const DeviceTree& tree)
    : m_device(device), m_expected(device, expected), m_subject(device, tree),
      m_buffers(device.device(), kComparedWidth, kComparedHeight)
{
}

void TreeComparison::pictures(const ViewCamera& close)
{
    const std::vector<ViewCamera> views = manyCameras(m_subject.tree.grid);
    TraceOptions options;
    options.occlusion_rays = 2;
    for (const View shown : kComparedViews)
    {
        options.view = shown;
        picture(views.front(), options);
        picture(close, options);
    }
    options = {};
    for (std::size_t i = 1; i < views.size(); i += 3)
    {
        options.beam = i % 4 != 1;
        picture(views[i], options);
    }
    for (const std::uint32_t level : {1U, 2U, 3U, 4U, UINT32_MAX})
    {
        TraceOptions coarse;
        coarse.detail_level = level;
        coarse.detail_pixels = level == UINT32_MAX ? 6.0F : 0.0F;
        picture(views.front(), coarse);
        picture(close, coarse);
    }
}

void TreeComparison::rays(const Codes& codes) const
{
    const std::uint32_t resolution = m_subject.tree.grid.rootResolution();
    std::mt19937 random(resolution);
    std::vector<gpu::Ray> rays;
    for (int i = 0; i < 1001; ++i)
    {
        rays.push_back(deviceRay(pickRay(random, resolution, codes)));
    }
    for (const std::uint32_t level : {UINT32_MAX, 1U, 2U, 3U})
    {
        TraceOptions options;
        options.detail_level = level;
        expectSameHits(traceOnDevice(m_device, m_expected.tree, rays, options), m_expected.attributes,
                       traceOnDevice(m_device, m_subject.tree, rays, options), m_subject.attributes,
                       m_subject.tree.hasAttributes());
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

void TreeComparison::picture(const ViewCamera& view, const TraceOptions& options)
{
    const Grid& grid = m_subject.tree.grid;
    const TraceCamera camera = traceCamera(view, grid, kComparedHeight);
    const Picture expected = take(m_expected, camera, options);
    const Picture picture = take(m_subject, camera, options);
    EXPECT_EQ(picture.image, expected.image);
    EXPECT_EQ(picture.light, expected.light);
    EXPECT_EQ(picture.live_tiles, expected.live_tiles);
    EXPECT_EQ(picture.capped_rays, expected.capped_rays);
    const bool with_attributes = m_subject.tree.hasAttributes() && showsAttributes(options.view);
    ASSERT_NO_FATAL_FAILURE(
        expectSameHits(expected.hits, m_expected.attributes, picture.hits, m_subject.attributes, with_attributes));
}

} // namespace zvo::test
