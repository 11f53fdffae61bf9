// SPDX-License-Identifier: MIT
// Rays by kind: those of pictures and paths, and random ones, as lists through octree and DAG.
#pragma once

#include "bench/bench_options.h"
#include "bench/ray_kind_rows.h"
#include "core/scene/camera.h"
#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <glm/glm.hpp>
#include <vector>

namespace zvo::cli
{

/// Measures those kinds that options name, of a picture of `size` pixels. dag: of the octree, or null.
std::vector<RayKindRow> measureRayKinds(vk::HeadlessDevice& device, const DeviceTree& octree, const DeviceTree* dag,
                                        const TraceCamera& camera, const glm::uvec2& size,
                                        const BenchRaysOptions& options);

} // namespace zvo::cli
