// SPDX-License-Identifier: MIT
// The device's voxels against the oracle's, triangle by triangle.
#pragma once

#include "stress/lattice_triangles.h"
#include "vk/headless.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo::stress
{

/// What comparisons looked at and what they found.
struct Tally
{
    std::uint64_t triangles = 0;
    std::uint64_t dropped = 0;   // triangles that the definition leaves out
    std::uint64_t voxels = 0;    // that the oracle has
    std::uint64_t fragments = 0; // covered voxels counted for each triangle
    std::uint64_t hidden = 0;    // fragments that could be missing without a trace: not in the set, nor in a colour
    std::uint64_t differences = 0;
    std::vector<std::string> findings; // the first differences, a line each

    void add(const Tally& other);
};

/// Voxelizes batch with a colour of its own for each triangle, on the device and by the oracle, and compares the set,
/// every voxel's mean colour and the counts of dropped triangles. Where triangles overlap, a wrong fragment changes the
/// colour of its voxel; where they do not, the set.
Tally compareBatch(vk::HeadlessDevice& device, const Batch& batch, Coverage coverage);

/// The same for a scene as it is: the set, the mean colours, and dropped triangles.
Tally compareScene(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage);

} // namespace zvo::stress
