// SPDX-License-Identifier: MIT
// Distances of the device against exact ones.
#pragma once

#include "core/distance/distance_builder.h"
#include "core/scene/scene.h"
#include "vk/headless.h"

#include <cstdint>

namespace zvo::test
{

/// How distances compare with those of the oracle.
struct DistanceComparison
{
    std::uint64_t in_band = 0;      // cells
    std::uint64_t inside = 0;       // of them
    std::uint64_t wrong_values = 0; // in the band or not, and where a leaf is missing
    std::uint64_t wrong_signs = 0;  // in leaves, except of centres on triangles; only of closed scenes
    bool is_closed = false;         // the scene on the lattice, as winding numbers need
    bool in_order = true;           // leaves are in Morton order, and each has a cell in the band

    [[nodiscard]] bool isWell() const { return wrong_values == 0 && wrong_signs == 0 && in_order; }
};

DistanceComparison compareDistances(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid,
                                    const DistanceOptions& options);

} // namespace zvo::test
