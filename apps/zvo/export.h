// SPDX-License-Identifier: MIT
#pragma once

#include "core/octree.h"
#include "output.h"
#include "vk/headless.h"

namespace zvo::cli
{

/// The Morton codes of all voxels, ascending, as 64-bit little-endian integers, and nothing else.
void writeMorton(vk::HeadlessDevice& device, const Octree& octree, Output& output);

/// A binary little-endian PLY file: the voxels' centres in world space in Morton order, and, where the octree has
/// attributes, unit normals and sRGB colours. After: G. Turk, The PLY Polygon File Format, 1994.
void writePly(vk::HeadlessDevice& device, const Octree& octree, Output& output);

/// The unit vector of an octahedral code (Attribute::normal).
glm::vec3 decodeNormal(std::uint32_t code);

} // namespace zvo::cli
