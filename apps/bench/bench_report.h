// SPDX-License-Identifier: MIT
// What the JSON reports of zvo-bench say, as Markdown: figures beside targets, and the passes that take longest.
#pragma once

#include "bench/bench_options.h"
#include "common/report.h"

#include <string>
#include <vector>

namespace zvo::cli
{

/// A table of targets (the format: bench/targets.json), each beside the figure that reports have for it. Rows that have
/// not measured it do not count; where several have, the first does. Throws Error{Input} where targets are not in that
/// format.
std::string targetTable(const Json& targets, const std::vector<Json>& reports);

/// A table of the passes of a row of a report, the longest first, at most row_count of them, with their time for each
/// element. Passes of rays have a time for each ray, the others for each triangle, voxel and node. "" if the row has
/// no passes. row: of a report of `zvo-bench build`, `rays` or `dynamic`, of which what moves counts.
std::string slowestPasses(const Json& row, std::size_t row_count);

/// `zvo-bench report`: reads the reports and the targets that options name, and writes the tables to standard output.
/// Throws Error{Input}.
void benchReport(const BenchReportOptions& options);

} // namespace zvo::cli
