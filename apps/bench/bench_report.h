// SPDX-License-Identifier: MIT
// What the JSON reports of `zvo bench` say, as Markdown: figures beside targets, and the passes that take longest.
#pragma once

#include "bench/bench_options.h"
#include "common/report.h"

#include <string>
#include <vector>

namespace zvo::cli
{

/// A table of targets (the format: bench/targets.json), each beside the figure that reports have for it. Where several
/// rows have one, the first counts. Throws Error{Input} where targets are not in that format.
std::string targetTable(const Json& targets, const std::vector<Json>& reports);

/// A table of the passes of a row of a report, the longest first, at most row_count of them, with their time for each
/// element. Passes of rays have a time for each ray, the others for each triangle, voxel and node. "" if the row has
/// no passes. row: of a report of `zvo bench`, plain or --dynamic, where what moves counts.
std::string slowestPasses(const Json& row, std::size_t row_count);

/// Reads the reports and the targets that options name, and writes the tables to standard output. Throws Error{Input}.
void benchReport(const BenchOptions& options);

} // namespace zvo::cli
