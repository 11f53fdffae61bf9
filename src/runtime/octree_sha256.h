// SPDX-License-Identifier: MIT
#pragma once

#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <string>

namespace zvo
{

/// SHA-256, in hexadecimal, of everything in tree: grid, counts, nodes, attributes, emission. Equal trees have equal
/// digests, however they were made.
std::string octreeSha256(vk::HeadlessDevice& device, const DeviceTree& tree);

} // namespace zvo
