// SPDX-License-Identifier: MIT
#include "runtime/stage_octree.h"

#include "core/headless/compress.h"
#include "core/upload/gpu_scene.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kAttemptsMax = 64; // everything doubles in two attempts at most

} // namespace

float brightestEmission(const Stage& stage)
{
    float brightest = brightestEmission(stage.fixed);
    for (const Mover& mover : stage.movers)
    {
        brightest = std::max(brightest, brightestEmission(mover.scene));
    }
    return brightest;
}

StageOctree::StageOctree(vk::HeadlessDevice& device, const Stage& stage, const Grid& grid,
                         const StageOctreeOptions& options)
    : m_device(device), m_stage(stage)
{
    const float emission_scale = brightestEmission(stage);
    DynamicOptions dynamic;
    dynamic.coverage = options.coverage;
    dynamic.merge = stage.merge;
    dynamic.attributes = options.attributes;
    dynamic.history = options.history;
    dynamic.emission_scale = emission_scale;
    m_dynamic = std::make_unique<DynamicOctree>(device, makeStaticPart(grid, options, emission_scale), dynamic);
    for (const Mover& mover : stage.movers)
    {
        m_mover_triangle_count += mover.scene.triangleCount();
        m_movers.push_back(m_dynamic->add(uploadMover(device, mover.scene, options.attributes, emission_scale),
                                          moverPose(mover, 0.0)));
    }
}

DeviceTree StageOctree::makeStaticPart(const Grid& grid, const StageOctreeOptions& options, float emission_scale)
{
    BuildOptions build;
    build.coverage = options.coverage;
    build.attributes = options.attributes;
    build.keep_sums = options.attributes && m_stage.merge == MergeRule::Average;
    BuildResult built =
        buildOctree(m_device, uploadScene(m_device, m_stage.fixed, options.attributes, emission_scale), grid, build);
    StaticPart& part = m_static_part;
    part.triangle_count = m_stage.fixed.triangleCount();
    part.voxel_count = built.octree.voxel_count;
    part.node_count = built.octree.node_count;
    part.geometry_bytes = built.octree.geometryBytes();
    part.dropped = built.dropped;
    part.passes = built.passes;
    if (options.structure == TreeStructure::Svo)
    {
        return std::move(built.octree);
    }
    CompressResult compressed = compress(m_device, std::move(built.octree));
    part.node_count = compressed.dag.node_count;
    part.geometry_bytes = compressed.dag.geometryBytes();
    part.compress_passes = std::move(compressed.passes);
    return std::move(compressed.dag);
}

StageUpdate StageOctree::update(double seconds)
{
    for (std::size_t i = 0; i < m_movers.size(); ++i)
    {
        m_dynamic->place(m_movers[i], moverPose(m_stage.movers[i], seconds));
    }
    StageUpdate result;
    for (; result.retry_count < kAttemptsMax; ++result.retry_count)
    {
        const std::uint64_t frame = m_dynamic->beginFrame();
        try
        {
            result.passes = m_device.run([&](vk::FrameGraph& graph) { m_dynamic->update(graph); });
        }
        catch (...)
        {
            m_dynamic->frameLost();
            throw;
        }
        const std::vector<UpdateReport> reports = m_dynamic->frameDone(frame);
        if (!m_dynamic->needsUpdate())
        {
            result.report = reports.empty() ? UpdateReport{} : reports.back();
            return result;
        }
    }
    throw Error(ErrorCode::Memory,
                fmt::format("movers found no room in {} attempts; lower the resolution", kAttemptsMax));
}

} // namespace zvo
