// SPDX-License-Identifier: MIT
// Questions to trees, and what every voxel asked on its own says (docs/queries.md).
#pragma once

#include "core/tree/device_tree.h"
#include "oracle/query.h"
#include "support/trace_octrees.h"
#include "vk/headless.h"
#include "zvo/query.h"

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace zvo::test
{

/// As many questions of each kind.
struct Queries
{
    std::vector<PointQuery> points;
    std::vector<RayQuery> rays;
    std::vector<BoxQuery> boxes;
    std::vector<NearestQuery> nearest;
    std::vector<SweepQuery> sweeps;

    /// The list of a kind.
    [[nodiscard]] QueryList list(QueryKind kind) const;
};

inline constexpr auto kQueryKinds = {QueryKind::Point, QueryKind::Ray, QueryKind::Box, QueryKind::Nearest,
                                     QueryKind::Sweep};

/// Questions near voxels and far from them, many along voxels' faces; some with numbers of which none is allowed.
Queries pickQueries(std::mt19937& random, const Grid& grid, const Codes& codes, std::size_t count);

/// What the oracle says: of a list that has no rays, in order.
std::vector<std::optional<oracle::QueryAnswer>> expectedAnswers(const Codes& codes, const QueryList& queries);

/// The answers of the device. undecided: gets their number, or none must be.
std::vector<QueryAnswer> askDevice(vk::HeadlessDevice& device, const DeviceTree& tree, const QueryList& queries,
                                   std::uint32_t* undecided = nullptr, std::uint32_t iterations_max = 40000);

/// Returns the first difference of the device's answers, rays among them, from what codes give, or "". Counts the
/// voxels that were found in found.
std::string queryDifference(const Grid& grid, const Codes& codes, const QueryList& queries,
                            const std::vector<QueryAnswer>& answers, std::uint64_t* found);

} // namespace zvo::test
