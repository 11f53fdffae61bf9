// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo
{

/// What leaveOutHulls() took away.
struct LeftOutHulls
{
    std::uint64_t hull_count = 0;
    std::uint64_t triangle_count = 0;   // of primitives; several instances of one count once
    std::vector<std::string> materials; // their names, each once
};

/// Leaves out inverted hulls: connected surfaces of single-sided materials that are inside out and lie closely around
/// others, as toon shading has them for outlines. A rasterizer that culls back faces shows what is in them, while their
/// voxels would hide it. docs/input.md has the rule. Cost: triangles; where there is a surface that is inside out,
/// triangles of all instances x log hulls.
LeftOutHulls leaveOutHulls(Scene& scene);

} // namespace zvo
