// SPDX-License-Identifier: MIT
#include "bench/baseline_comparisons.h"
#include "common/report.h"
#include "runtime/trees.h"

#include <utility>

namespace zvo::cli
{

BaselineSubject::BaselineSubject(const BenchBaselinesOptions& options, vk::HeadlessDevice& device, std::string name,
                                 const Scene& scene, const GpuScene& uploaded, const Grid& grid,
                                 const ViewCamera& camera)
    : m_options(options), m_device(device), m_scene(scene),
      m_uploaded(uploaded), m_build{options.coverage, options.attributes, {}},
      m_camera(traceCamera(camera, grid, kBaselineHeight))
{
    m_build.capacities = buildOctree(device, uploaded, grid, m_build).capacities;
    m_octree = buildOctree(device, uploaded, grid, m_build).octree;
    m_case = {std::move(name), grid.resolution(), m_octree.voxel_count, std::nullopt};
}

double BaselineSubject::buildMs(bool voxelize, bool build)
{
    const BuildResult result = buildOctree(m_device, m_uploaded, grid(), m_build);
    return (voxelize ? result.operationMs("voxelize") : 0.0) + (build ? result.operationMs("octree") : 0.0);
}

double BaselineSubject::dagMs()
{
    BuildResult result = buildOctree(m_device, m_uploaded, grid(), m_build);
    const double ms = result.operationMs("voxelize") + result.operationMs("octree");
    return ms + compress(m_device, std::move(result.octree)).ms();
}

double BaselineSubject::geometryBuildMs()
{
    const BuildResult result = buildOctree(m_device, m_uploaded, grid(), m_geometry_build);
    m_geometry_build.capacities = result.capacities;
    return result.operationMs("octree");
}

std::function<double()> BaselineSubject::rays()
{
    if (!m_tracer)
    {
        m_tracer.emplace(m_device.device());
        m_tracer->resize(kBaselineWidth, kBaselineHeight);
        m_rays.emplace(m_device, m_octree, m_camera, *m_tracer);
    }
    return [this] { return sumMs(m_rays->trace()); };
}

TreeData geometryOf(const BaselineSubject& subject)
{
    BuildOptions options;
    options.coverage = subject.options().coverage;
    options.attributes = false;
    return downloadTree(subject.device(),
                        buildOctree(subject.device(), subject.uploaded(), subject.grid(), options).octree);
}

} // namespace zvo::cli
