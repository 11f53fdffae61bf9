// SPDX-License-Identifier: MIT
#include "bench/bench_edit.h"

#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/canvas.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "core/tree/tree_data.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr std::uint32_t kDepth = 9;
constexpr std::array<std::uint32_t, 4> kRadii = {4, 8, 16, 32};
constexpr std::array<const char*, 3> kActionNames = {"carve", "fill", "paint"};
constexpr std::array<std::uint32_t, 3> kStrokeCounts = {10, 100, 1000};
constexpr std::uint32_t kStrokesMeasured = 10; // the last ones of each stage
constexpr std::uint32_t kHistoryRadius = 8;
constexpr HistoryBounds kBounds = {kStrokeCounts.back(), 256U << 20};

// Median and percentile of times, in milliseconds.
struct Times
{
    double median = 0;
    double p95 = 0; // 95 of 100 times are not above it

    /// values: at least one.
    static Times of(std::vector<double> values)
    {
        std::ranges::sort(values);
        return {Spread::of(values).median, values[(95 * values.size() + 99) / 100 - 1]};
    }
};

std::string timesText(const Times& times)
{
    return fmt::format("{:.3f} / {:.3f}", times.median, times.p95);
}

Json timesJson(const Times& times)
{
    return {{"median", times.median}, {"p95", times.p95}};
}

// Strokes of one radius and action, each on the unedited tree.
struct StrokeRow
{
    std::uint32_t radius = 0;
    std::string action;
    Times dab_ms;
    Times undo_ms;
    Times redo_ms;
    std::uint64_t bytes = 0; // median
};

// Strokes of all actions, each on the result of the last one.
struct HistoryRow
{
    std::uint32_t stroke_count = 0;
    Times dab_ms;
    Times undo_ms;
    Times redo_ms;
    std::uint64_t held_bytes = 0;
    std::uint32_t compaction_count = 0;
    double compaction_ms = 0; // of the last one
};

struct EditRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::uint64_t voxels = 0;
    std::vector<StrokeRow> strokes;
    std::vector<HistoryRow> history;
};

// A row of a table with its scene.
template <typename Row> using InScene = std::pair<const EditRow*, const Row*>;

const Columns<InScene<StrokeRow>>& strokeColumns()
{
    using Row = InScene<StrokeRow>;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.first->scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.first->resolution); }},
        {"voxels", 9, [](const Row& row) { return fmt::format("{}", row.first->voxels); }},
        {"radius", 6, [](const Row& row) { return fmt::format("{}", row.second->radius); }},
        {"action", 6, [](const Row& row) { return row.second->action; }},
        {"dab ms", 17, [](const Row& row) { return timesText(row.second->dab_ms); }},
        {"undo ms", 13, [](const Row& row) { return timesText(row.second->undo_ms); }},
        {"redo ms", 13, [](const Row& row) { return timesText(row.second->redo_ms); }},
        {"bytes", 9, [](const Row& row) { return fmt::format("{}", row.second->bytes); }},
    };
    return all;
}

const Columns<InScene<HistoryRow>>& historyColumns()
{
    using Row = InScene<HistoryRow>;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.first->scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.first->resolution); }},
        {"strokes", 7, [](const Row& row) { return fmt::format("{}", row.second->stroke_count); }},
        {"dab ms", 17, [](const Row& row) { return timesText(row.second->dab_ms); }},
        {"undo ms", 13, [](const Row& row) { return timesText(row.second->undo_ms); }},
        {"redo ms", 13, [](const Row& row) { return timesText(row.second->redo_ms); }},
        {"held bytes", 10, [](const Row& row) { return fmt::format("{}", row.second->held_bytes); }},
        {"compactions", 11, [](const Row& row) { return fmt::format("{}", row.second->compaction_count); }},
        {"last, ms", 8, [](const Row& row) { return fmt::format("{:.3f}", row.second->compaction_ms); }},
    };
    return all;
}

Json rowJson(const EditRow& row)
{
    Json json;
    json["scene"] = row.scene;
    json["resolution"] = row.resolution;
    json["voxels"] = row.voxels;
    json["strokes"] = Json::array();
    for (const StrokeRow& stroke : row.strokes)
    {
        json["strokes"].push_back({{"radius", stroke.radius},
                                   {"action", stroke.action},
                                   {"dab_ms", timesJson(stroke.dab_ms)},
                                   {"undo_ms", timesJson(stroke.undo_ms)},
                                   {"redo_ms", timesJson(stroke.redo_ms)},
                                   {"bytes", stroke.bytes}});
    }
    json["history"] = Json::array();
    for (const HistoryRow& history : row.history)
    {
        json["history"].push_back({{"strokes", history.stroke_count},
                                   {"dab_ms", timesJson(history.dab_ms)},
                                   {"undo_ms", timesJson(history.undo_ms)},
                                   {"redo_ms", timesJson(history.redo_ms)},
                                   {"held_bytes", history.held_bytes},
                                   {"compactions", history.compaction_count},
                                   {"compaction_ms", history.compaction_ms}});
    }
    return json;
}

// Strokes of one kind, each of which is undone.
StrokeRow measureStrokes(Canvas& canvas, std::uint32_t radius, std::uint32_t action, std::uint32_t run_count)
{
    std::vector<double> dab_ms;
    std::vector<double> undo_ms;
    std::vector<double> redo_ms;
    std::vector<std::uint64_t> bytes;
    for (std::uint32_t run = 0; run <= run_count; ++run)
    {
        const double ms = canvas.stroke(static_cast<BrushAction>(action), radius);
        const std::uint64_t top = canvas.edits().shownBytes();
        const double first_undo_ms = canvas.undo();
        if (run != 0) // the first one only makes room
        {
            dab_ms.push_back(ms);
            undo_ms.push_back(first_undo_ms);
            bytes.push_back(top - canvas.edits().shownBytes());
            redo_ms.push_back(canvas.redo());
            canvas.undo();
        }
    }
    std::ranges::sort(bytes);
    return {radius,
            kActionNames.at(action),
            Times::of(dab_ms),
            Times::of(undo_ms),
            Times::of(redo_ms),
            bytes[bytes.size() / 2]};
}

// Measures the last strokes after given numbers of them.
std::vector<HistoryRow> measureHistory(Canvas& canvas, Progress& progress)
{
    std::vector<HistoryRow> rows;
    std::vector<double> dab_ms;
    for (const std::uint32_t count : kStrokeCounts)
    {
        progress.begin(fmt::format("{} strokes", count));
        while (dab_ms.size() < count)
        {
            const auto action = static_cast<BrushAction>(dab_ms.size() % kActionNames.size());
            dab_ms.push_back(canvas.stroke(action, kHistoryRadius));
        }
        HistoryRow row;
        row.stroke_count = count;
        row.dab_ms = Times::of({dab_ms.end() - kStrokesMeasured, dab_ms.end()});
        std::vector<double> undo_ms;
        std::vector<double> redo_ms;
        for (std::uint32_t i = 0; i < kStrokesMeasured; ++i)
        {
            undo_ms.push_back(canvas.undo());
        }
        for (std::uint32_t i = 0; i < kStrokesMeasured; ++i)
        {
            redo_ms.push_back(canvas.redo());
        }
        row.undo_ms = Times::of(undo_ms);
        row.redo_ms = Times::of(redo_ms);
        row.held_bytes = canvas.edits().heldBytes();
        row.compaction_count = canvas.compactionCount();
        row.compaction_ms = canvas.compactionMs();
        rows.push_back(row);
    }
    return rows;
}

EditRow measure(vk::HeadlessDevice& device, const BenchEditOptions& options, const std::string& name,
                const Scene& scene, std::uint32_t depth, Progress& progress)
{
    const Grid grid = Grid::around(scene.bounds(), depth);
    EditRow row;
    row.scene = name;
    row.resolution = grid.resolution();
    {
        Canvas canvas(device, options, scene, grid, kBounds);
        row.voxels = canvas.voxelCount();
        for (const std::uint32_t radius : kRadii)
        {
            progress.begin(fmt::format("{} at {}: radius {}", name, row.resolution, radius));
            for (std::uint32_t action = 0; action < kActionNames.size(); ++action)
            {
                row.strokes.push_back(measureStrokes(canvas, radius, action, options.run_count));
            }
        }
    }
    Canvas canvas(device, options, scene, grid, kBounds);
    row.history = measureHistory(canvas, progress);
    return row;
}

std::string tableHead(const vk::DeviceReport& device, const BenchEditOptions& options)
{
    return fmt::format(
        "zvo {} on {} ({}, {}). Strokes of a sphere on an {}: GPU milliseconds, median / 95 of 100, of {} "
        "strokes from the unedited scene on, and of the last {} of many of radius {}.\n",
        ZVO_VERSION_TEXT, device.name, device.type, device.driver,
        options.structure == TreeStructure::Svdag ? "octree's DAG" : "octree", options.run_count, kStrokesMeasured,
        kHistoryRadius);
}

std::string tables(const std::vector<EditRow>& rows)
{
    std::string text = fmt::format("\n{}", columnNames(strokeColumns()));
    for (const EditRow& row : rows)
    {
        for (const StrokeRow& stroke : row.strokes)
        {
            text += columnValues(strokeColumns(), {&row, &stroke});
        }
    }
    text += fmt::format("\n{}", columnNames(historyColumns()));
    for (const EditRow& row : rows)
    {
        for (const HistoryRow& history : row.history)
        {
            text += columnValues(historyColumns(), {&row, &history});
        }
    }
    return text;
}

Json reportJson(const vk::DeviceReport& device, const BenchEditOptions& options, const std::vector<EditRow>& rows)
{
    Json json = headJson("zvo.bench_edit/1", device);
    json["coverage"] = coverageName(options.coverage);
    json["attributes"] = options.attributes ? "full" : "none";
    json["structure"] = structureName(options.structure);
    json["runs"] = options.run_count;
    json["rows"] = Json::array();
    for (const EditRow& row : rows)
    {
        json["rows"].push_back(rowJson(row));
    }
    return json;
}

} // namespace

void benchEdit(const BenchEditOptions& options)
{
    const std::vector<fs::path> paths = benchScenes(options);
    const std::vector<std::uint32_t> depths = options.depths.value_or(std::vector{kDepth});
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::vector<EditRow> rows;
    Progress progress(paths.size() * depths.size() * (kRadii.size() + kStrokeCounts.size()));
    for (const fs::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        for (const std::uint32_t depth : depths)
        {
            rows.push_back(measure(device, options, path.stem().string(), scene, depth, progress));
        }
    }
    clearProgressBar();
    if (options.output.json != "-")
    {
        Output table("-", true);
        table.write(tableHead(device.device().report(), options) + tables(rows));
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, reportJson(device.device().report(), options, rows));
    }
}

} // namespace zvo::cli
