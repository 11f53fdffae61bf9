// SPDX-License-Identifier: MIT
// What `zvo-bench rays --kinds` tells of a scene at one resolution: a row for each kind of rays.
#pragma once

#include "common/report.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

/// What rays of a kind take in one tree. Bytes are those of the 32-byte sectors of nodes and lists that rays load.
struct RaysInTree
{
    double mrays_per_s = 0;
    double bytes = 0;        // that a ray loads, each sector once
    double warp_bytes = 0;   // a ray's share of what a warp's rays load, each sector once for all of them
    double load_sectors = 0; // that a load of a warp's rays is of
};

struct RayKindRow
{
    std::string kind;
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    double iterations = 0; // of a ray
    double longest = 0;    // iterations of the longest ray of a warp, over those of its rays
    RaysInTree octree;
    std::optional<RaysInTree> dag;
    std::optional<double> embree_mrays_per_s; // ray by ray, through the same voxels
    std::optional<std::uint64_t> embree_hits;
};

std::string rayKindTable(const std::string& scene, std::uint32_t resolution, const std::vector<RayKindRow>& rows);

/// Null for no rows.
Json rayKindsJson(const std::vector<RayKindRow>& rows);

} // namespace zvo::cli
