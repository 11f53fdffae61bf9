// SPDX-License-Identifier: MIT
// The tables and the JSON of `zvo-bench baselines`. bench/results-page makes a page of the JSON.
#pragma once

#include "bench/baseline_rows.h"
#include "bench/bench_options.h"
#include "common/report.h"
#include "vk/device.h"

#include <string>

namespace zvo::cli
{

/// Works with their ratios, sizes, and orders of nodes.
std::string baselineTables(const vk::DeviceReport& device, const BenchBaselinesOptions& options,
                           const BaselineRows& rows);

/// Schema zvo.bench_baselines/1: all rows, and the figures that the sources published.
Json baselineJson(const vk::DeviceReport& device, const BenchBaselinesOptions& options, const BaselineRows& rows);

} // namespace zvo::cli
