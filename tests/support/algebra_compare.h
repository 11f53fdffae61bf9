// SPDX-License-Identifier: MIT
// Algebra of octrees on the device against the same on dense grids.
#pragma once

#include "vk/headless.h"

#include <cstdint>
#include <random>
#include <string>

namespace zvo::test
{

/// Makes two random trees of a depth of 3 or more, octrees of boxes and single voxels or filled soups, and carries out
/// a random operation on them, on the device and on the host. Returns what differs, or "": voxels, the ones that have
/// attributes, these themselves as far as an operand has them, sizes of components, or what checkTree says.
std::string compareAlgebra(vk::HeadlessDevice& device, std::mt19937& random, std::uint32_t depth);

} // namespace zvo::test
