// SPDX-License-Identifier: MIT
#pragma once

#include "core/algebra/algebra_job.h"
#include "vk/headless.h"

namespace zvo
{

/// Makes an octree of one or two others (core/algebra/algebra_job.h). Waits. Throws as AlgebraJob.
DeviceTree applyAlgebra(vk::HeadlessDevice& device, const AlgebraInfo& info, const DeviceTree& a,
                        const DeviceTree* b = nullptr);

/// The components of an octree's voxels. corners: all 26 neighbours belong together, else the 6 across faces. Waits.
Components findComponents(vk::HeadlessDevice& device, const DeviceTree& octree, bool corners);

} // namespace zvo
