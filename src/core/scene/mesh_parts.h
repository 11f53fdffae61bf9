// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <vector>

namespace zvo
{

/// The connected parts of a primitive.
struct MeshParts
{
    std::vector<std::uint32_t> of_triangle; // [triangles] number of the part
    std::uint32_t count = 0;
};

/// Triangles are connected by the vertices that they share and, if welded, by vertices at the same place, which takes
/// a sort of the vertices.
MeshParts partsOf(const Primitive& primitive, bool welded = true);

} // namespace zvo
