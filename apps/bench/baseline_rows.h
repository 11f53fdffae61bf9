// SPDX-License-Identifier: MIT
// What `zvo-bench baselines` measures: other algorithms beside zvo's, in turns.
#pragma once

#include "bench/bench_table.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

/// What rows are about.
struct BaselineCase
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::uint64_t voxels = 0;                   // of the scene; of one that moves, without what moves
    std::optional<std::uint64_t> moving_voxels; // that dynamic objects cover
};

/// What a source does, beside what zvo does for the same end.
struct BaselineWork
{
    std::string source;
    std::string name;
    std::function<double()> baseline; // runs it once and returns milliseconds
    std::function<double()> zvo;
    bool on_host = false; // the baseline's milliseconds are those of the host's clock
};

struct WorkRow
{
    BaselineCase what;
    std::string source;
    std::string work;
    bool on_host = false;
    Spread baseline_ms;
    Spread zvo_ms;
    Spread ratio; // baseline / zvo, of runs in turns
};

/// A tree that stands for the voxels.
struct SizeRow
{
    BaselineCase what;
    std::string form;
    std::uint64_t nodes = 0;
    std::uint64_t bytes = 0; // of geometry
};

/// zvo's octree with its nodes in some order.
struct OrderRow
{
    BaselineCase what;
    std::string order;
    Spread rays_ms;
    std::optional<Spread> update_ms; // of a scene that moves
};

struct BaselineRows
{
    std::vector<WorkRow> works;
    std::vector<SizeRow> sizes;
    std::vector<OrderRow> orders;

    /// Runs both sides once, then run_count times in turns, changing the order each time.
    void measure(const BaselineCase& what, const BaselineWork& work, std::uint32_t run_count);

    /// Adds a row of times that were measured in turns.
    void add(const BaselineCase& what, const std::string& source, const std::string& work,
             const std::vector<double>& baseline_ms, const std::vector<double>& zvo_ms);
};

} // namespace zvo::cli
