// SPDX-License-Identifier: MIT
#include "bench/bench_rows.h"

#include "bench/bench_scenes.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "zvo/error.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <filesystem>
#include <span>
#include <utility>
#include <vector>

namespace zvo::cli
{

void measureRows(const PassBenchOptions& options, const RowTable& table,
                 const std::function<void(vk::HeadlessDevice&, const BenchSubject&, BenchRow&)>& measure)
{
    const std::vector<std::filesystem::path> paths = benchScenes(options);
    const std::vector<std::uint32_t> depths = options.depths.value_or(std::vector{8U, 9U, 10U});
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    const BenchHeader header = {device.device().report(), table.width, table.height, options.run_count};
    Output output("-", true);
    const auto show = [&](const std::string& text)
    {
        if (options.output.json != "-")
        {
            clearProgressBar();
            output.write(text);
        }
    };
    show(fmt::format("zvo {} on {} ({}, {}). {}\n\n{}", ZVO_VERSION_TEXT, header.device.name, header.device.type,
                     header.device.driver, table.conditions, columnNames(table.columns)));
    std::vector<BenchRow> rows;
    Progress progress(paths.size() * depths.size());
    for (const std::filesystem::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        const GpuScene uploaded = uploadScene(device, scene, options.attributes);
        for (const std::uint32_t depth : depths)
        {
            BenchRow row;
            row.scene = path.stem().string();
            row.resolution = 1U << depth;
            row.coverage = options.coverage;
            row.attributes = options.attributes;
            row.triangles = scene.triangleCount();
            progress.begin(fmt::format("{} at {}", row.scene, row.resolution));
            device.device().memory().resetPeak();
            measure(device, {scene, uploaded, Grid::around(scene.bounds(), depth)}, row);
            show(columnValues(table.columns, row));
            rows.push_back(std::move(row));
        }
    }
    for (const BenchRow& row : rows)
    {
        if (options.passes)
        {
            show(passTable(row.scene, row.resolution, row.passes));
        }
        if (!row.kinds.empty())
        {
            show(rayKindTable(row.scene, row.resolution, row.kinds));
        }
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, benchJson(header, rows));
    }
}

std::string warmRuns(std::uint32_t run_count)
{
    return fmt::format("{} warm {}", run_count, run_count == 1 ? "run" : "runs");
}

bool withDag(const BenchRow& row, const std::function<void()>& work)
{
    try
    {
        work();
        return true;
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        talk(fmt::format("warning: no DAG of {} at {}: {}", row.scene, row.resolution, error.what()));
        return false;
    }
}

} // namespace zvo::cli
