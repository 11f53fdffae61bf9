// SPDX-License-Identifier: MIT
#include "bench/baseline_report.h"

#include "bench/baseline_comparisons.h"
#include "bench/bench_table.h"
#include "bench/table.h"
#include "zvo/version.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

// A figure that a source published: a time or a size.
struct PublishedFigure
{
    const char* source;
    const char* scene;
    std::uint32_t resolution;
    const char* work;
    double ms;    // 0: none
    double bytes; // 0: none
    const char* hardware;
};

constexpr const char* kThesisHardware = "RTX 3080";
constexpr const char* kSlidesHardware = "RX 7900 XTX";

// The thesis: tables 1 and 2, 1280x720. The slides: Asian Dragon, and the scene of the RT Camp, of 41 million voxels.
constexpr PublishedFigure kPublishedFigures[] = {
    {"thesis", "sponza_bunny", 512, "voxelize", 401.51, 0, kThesisHardware},
    {"thesis", "sponza_bunny", 512, "build, bottom-up", 20.80, 0, kThesisHardware},
    {"Crassin, Green", "sponza_bunny", 512, "build, top-down", 21.18, 0, kThesisHardware},
    {"thesis", "sponza_bunny", 512, "update: voxelize", 0.37, 0, kThesisHardware},
    {"thesis", "sponza_bunny", 512, "update: merge", 20.90, 0, kThesisHardware},
    {"thesis", "sponza_bunny", 512, "update", 21.27, 0, kThesisHardware},
    {"thesis", "sponza_bunny", 512, "rays after the update", 20.12, 0, kThesisHardware},
    {"thesis", "buddha_dragon", 512, "voxelize", 1.14, 0, kThesisHardware},
    {"thesis", "buddha_dragon", 512, "build, bottom-up", 20.33, 0, kThesisHardware},
    {"Crassin, Green", "buddha_dragon", 512, "build, top-down", 15.88, 0, kThesisHardware},
    {"thesis", "buddha_dragon", 512, "update: voxelize", 2.36, 0, kThesisHardware},
    {"thesis", "buddha_dragon", 512, "update: merge", 22.23, 0, kThesisHardware},
    {"thesis", "buddha_dragon", 512, "update", 24.59, 0, kThesisHardware},
    {"thesis", "buddha_dragon", 512, "rays after the update", 10.04, 0, kThesisHardware},
    {"slides", "RT Camp scene", 8192, "voxelize and build", 135.0, 0, kSlidesHardware},
    {"slides", "Asian Dragon", 8192, "rays, state saved", 2.0, 0, kSlidesHardware},
    {"slides", "Asian Dragon", 8192, "octree", 0, 955e6, kSlidesHardware},
    {"slides", "Asian Dragon", 8192, "DAG", 0, 61e6, kSlidesHardware},
};

std::optional<double> publishedMs(const WorkRow& row)
{
    const auto isOfRow = [&](const PublishedFigure& figure)
    {
        return row.source == figure.source && row.what.scene == figure.scene &&
               row.what.resolution == figure.resolution && row.work == figure.work && figure.ms > 0;
    };
    const auto* const found = std::ranges::find_if(kPublishedFigures, isOfRow);
    return found == std::end(kPublishedFigures) ? std::nullopt : std::optional(found->ms);
}

// The vector instructions that software devices and Embree can use here.
const char* instructionSet()
{
#if defined(__x86_64__)
    return __builtin_cpu_supports("avx512f") != 0 ? "AVX-512" : __builtin_cpu_supports("avx2") != 0 ? "AVX2" : "SSE";
#else
    return "";
#endif
}

// Columns that all rows have.
template <typename Row> Columns<Row> caseColumns()
{
    return {{"scene", 14, [](const Row& row) { return row.what.scene; }},
            {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.what.resolution); }}};
}

template <typename Row> Columns<Row> withCase(const Columns<Row>& others)
{
    Columns<Row> all = caseColumns<Row>();
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

const Columns<WorkRow>& workColumns()
{
    static const Columns<WorkRow> all = withCase<WorkRow>({
        {"source", 14, [](const WorkRow& row) { return row.source; }},
        {"work", 37, [](const WorkRow& row) { return row.work; }},
        {"published ms", 12,
         [](const WorkRow& row)
         {
             const std::optional<double> ms = publishedMs(row);
             return ms ? fmt::format("{:.2f}", *ms) : "-";
         }},
        {"baseline ms", 11, [](const WorkRow& row) { return fmt::format("{:.2f}", row.baseline_ms.median); }},
        {"zvo ms", 9, [](const WorkRow& row) { return fmt::format("{:.2f}", row.zvo_ms.median); }},
        {"baseline / zvo", 14, [](const WorkRow& row) { return fmt::format("{:.2f}", row.ratio.median); }},
    });
    return all;
}

const Columns<SizeRow>& sizeColumns()
{
    static const Columns<SizeRow> all = withCase<SizeRow>({
        {"form", 29, [](const SizeRow& row) { return row.form; }},
        {"voxels", 9, [](const SizeRow& row) { return fmt::format("{}", row.what.voxels); }},
        {"nodes", 9, [](const SizeRow& row) { return fmt::format("{}", row.nodes); }},
        {"bytes a voxel", 13,
         [](const SizeRow& row)
         {
             const auto voxels = static_cast<double>(std::max<std::uint64_t>(row.what.voxels, 1));
             return fmt::format("{:.2f}", static_cast<double>(row.bytes) / voxels);
         }},
    });
    return all;
}

const Columns<OrderRow>& orderColumns()
{
    static const Columns<OrderRow> all = withCase<OrderRow>({
        {"order of nodes", 14, [](const OrderRow& row) { return row.order; }},
        {"rays ms", 22, [](const OrderRow& row) { return spreadText(row.rays_ms); }},
        {"update ms", 22, [](const OrderRow& row) { return row.update_ms ? spreadText(*row.update_ms) : "-"; }},
    });
    return all;
}

template <typename Row> std::string tableOf(const Columns<Row>& columns, const std::vector<Row>& rows)
{
    std::string text = rows.empty() ? "" : columnNames(columns);
    for (const Row& row : rows)
    {
        text += columnValues(columns, row);
    }
    return text;
}

Json caseJson(const BaselineCase& what)
{
    return {{"scene", what.scene},
            {"resolution", what.resolution},
            {"voxels", what.voxels},
            {"moving_voxels", what.moving_voxels ? Json(*what.moving_voxels) : Json()}};
}

} // namespace

std::string baselineTables(const vk::DeviceReport& device, const BenchBaselinesOptions& options,
                           const BaselineRows& rows)
{
    return fmt::format(
        "zvo {} on {} ({}, {}; processor: {}). {} coverage, {}; milliseconds, medians of {} runs in "
        "turns: the device's, for Embree, DDA and hash table the host's on all processors. Rays of {}x{} "
        "pixels, zvo's with their beam pass. Published: the thesis on an RTX 3080.\n\n{}\n{}\n{}",
        ZVO_VERSION_TEXT, device.name, device.type, device.driver, instructionSet(), coverageName(options.coverage),
        options.attributes ? "with attributes" : "geometry alone", options.run_count, kBaselineWidth, kBaselineHeight,
        tableOf(workColumns(), rows.works), tableOf(sizeColumns(), rows.sizes), tableOf(orderColumns(), rows.orders));
}

Json baselineJson(const vk::DeviceReport& device, const BenchBaselinesOptions& options, const BaselineRows& rows)
{
    Json json = headJson("zvo.bench_baselines/1", device);
    json["instruction_set"] = instructionSet();
    json["date"] = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    json["coverage"] = coverageName(options.coverage);
    json["attributes"] = options.attributes ? "full" : "none";
    json["runs"] = options.run_count;
    json["size"] = {kBaselineWidth, kBaselineHeight};
    json["published"] = Json::array();
    for (const PublishedFigure& figure : kPublishedFigures)
    {
        json["published"].push_back({{"source", figure.source},
                                     {"scene", figure.scene},
                                     {"resolution", figure.resolution},
                                     {"work", figure.work},
                                     {"ms", figure.ms > 0 ? Json(figure.ms) : Json()},
                                     {"bytes", figure.bytes > 0 ? Json(figure.bytes) : Json()},
                                     {"hardware", figure.hardware}});
    }
    json["rows"] = Json::array();
    for (const WorkRow& row : rows.works)
    {
        const std::optional<double> published = publishedMs(row);
        Json entry = caseJson(row.what);
        entry["source"] = row.source;
        entry["work"] = row.work;
        entry["clock"] = row.on_host ? "wall" : "device";
        entry["published_ms"] = published ? Json(*published) : Json();
        entry["baseline_ms"] = spreadJson(row.baseline_ms);
        entry["zvo_ms"] = spreadJson(row.zvo_ms);
        entry["ratio"] = spreadJson(row.ratio);
        json["rows"].push_back(std::move(entry));
    }
    json["sizes"] = Json::array();
    for (const SizeRow& row : rows.sizes)
    {
        Json entry = caseJson(row.what);
        entry["form"] = row.form;
        entry["nodes"] = row.nodes;
        entry["bytes"] = row.bytes;
        json["sizes"].push_back(std::move(entry));
    }
    json["orders"] = Json::array();
    for (const OrderRow& row : rows.orders)
    {
        Json entry = caseJson(row.what);
        entry["order"] = row.order;
        entry["rays_ms"] = spreadJson(row.rays_ms);
        entry["update_ms"] = row.update_ms ? spreadJson(*row.update_ms) : Json();
        json["orders"].push_back(std::move(entry));
    }
    return json;
}

} // namespace zvo::cli
