// SPDX-License-Identifier: MIT
#include "runtime/tree_algebra.h"

#include "core/upload/gpu_scene.h"
#include "runtime/run_job.h"

namespace zvo
{

DeviceTree applyAlgebra(vk::HeadlessDevice& device, const AlgebraInfo& info, const DeviceTree& a, const DeviceTree* b)
{
    const GpuScene color_tables = uploadColorTables(device);
    AlgebraJob job(device.device(), color_tables, info, a, b);
    runSteps(device, job);
    return job.take();
}

Components findComponents(vk::HeadlessDevice& device, const DeviceTree& octree, bool corners)
{
    return runJob(device, ComponentFinder(device.device(), octree, {.corners = corners}));
}

} // namespace zvo
