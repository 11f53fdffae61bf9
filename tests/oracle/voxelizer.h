// SPDX-License-Identifier: MIT
// The voxel set of a scene on the CPU, after docs/voxelization.md. It is written to be simple, and handles a million
// triangles a minute.
#pragma once

#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace zvo::oracle
{

struct OracleVoxels
{
    std::vector<std::uint64_t> codes;             // 64-bit Morton codes, x in bit 0; sorted, unique
    std::map<std::string, std::uint64_t> dropped; // triangles by reason; reasons that did not occur are absent
};

/// The voxels in which at least one fragment exists.
OracleVoxels voxelize(const Scene& scene, const Grid& grid, Coverage coverage);

} // namespace zvo::oracle
