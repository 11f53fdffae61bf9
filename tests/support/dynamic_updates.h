// SPDX-License-Identifier: MIT
// Updates of dynamic octrees, each in a frame of its own that is waited for.
#pragma once

#include "core/dynamic/dynamic_octree.h"
#include "vk/headless.h"

#include <functional>
#include <vector>

namespace zvo::test
{

/// Runs a frame, and returns the reports of its updates.
std::vector<UpdateReport> runFrame(vk::HeadlessDevice& device, DynamicOctree& octree,
                                   const std::function<void(vk::FrameGraph&)>& record);

/// Updates until everything is shown, and returns the last report. Throws if that takes too long.
UpdateReport updateAll(vk::HeadlessDevice& device, DynamicOctree& octree);

/// These return what DynamicOctree::undo() and redo() return.
[[nodiscard]] bool undo(vk::HeadlessDevice& device, DynamicOctree& octree);
[[nodiscard]] bool redo(vk::HeadlessDevice& device, DynamicOctree& octree);

} // namespace zvo::test
