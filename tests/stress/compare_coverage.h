// SPDX-License-Identifier: MIT
// Compares the device's voxels with the oracle's.
#pragma once

#include "stress/lattice_triangles.h"
#include "vk/headless.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo::stress
{

/// What comparisons counted, and the differences that they found.
struct Tally
{
    std::uint64_t triangles = 0;
    std::uint64_t dropped = 0;   // triangles that the definition drops
    std::uint64_t voxels = 0;    // of the oracle
    std::uint64_t fragments = 0; // covered voxels, counted for each triangle
    std::uint64_t hidden = 0;    // fragments whose absence would change neither the set nor a colour
    std::uint64_t differences = 0;
    std::vector<std::string> findings; // the first differences, a line each

    void add(const Tally& other);
};

/// Voxelizes batch on the device and by the oracle, with its own colour for each triangle. Compares the sets of voxels,
/// their mean colours and the counts of dropped triangles. A wrong fragment changes the colour of its voxel where
/// triangles overlap, and the set where they do not.
Tally compareBatch(vk::HeadlessDevice& device, const Batch& batch, Coverage coverage);

/// Compares the same for a scene, with its own colours.
Tally compareScene(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage);

} // namespace zvo::stress
