// SPDX-License-Identifier: MIT
// Updates of dynamic octrees one at a time, each in a frame that is waited for.
#pragma once

#include "core/dynamic/dynamic_octree.h"
#include "vk/headless.h"

namespace zvo::test
{

/// Updates until everything is shown, and tells what the last update came to. Throws when it never is.
UpdateReport updateAll(vk::HeadlessDevice& device, DynamicOctree& octree);

/// What DynamicOctree::undo() and redo() return.
[[nodiscard]] bool undo(vk::HeadlessDevice& device, DynamicOctree& octree);
[[nodiscard]] bool redo(vk::HeadlessDevice& device, DynamicOctree& octree);

} // namespace zvo::test
