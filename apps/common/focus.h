// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <optional>

namespace zvo::cli
{

/// How far away, in world units along the camera's direction, what is at the middle of the picture stands: what its ray
/// meets, which one ray on the device finds out. Nothing where it meets nothing.
std::optional<float> distanceAtMiddle(vk::HeadlessDevice& device, const DeviceTree& tree, const TraceCamera& camera);

} // namespace zvo::cli
