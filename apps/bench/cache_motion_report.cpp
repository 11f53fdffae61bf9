// SPDX-License-Identifier: MIT
// Tables and JSON of what measureMotion() has measured.
#include "bench/bench_table.h"
#include "bench/cache_motion.h"
#include "bench/table.h"

#include <fmt/format.h>

#include <utility>

namespace zvo::cli
{

namespace
{

// A line of the table of errors.
struct MotionLine
{
    const MotionResult& result;
    const MotionError& error;
};

std::string motionPercent(const std::optional<double>& value)
{
    return value ? fmt::format("{:.2f}", 100.0 * *value) : "-";
}

std::optional<double> ratioOf(const std::optional<double>& value, const std::optional<double>& to)
{
    return value && to && *to > 0 ? std::optional(*value / *to) : std::nullopt;
}

std::string ratioText(const std::optional<double>& value, const std::optional<double>& to)
{
    return cellText(ratioOf(value, to), 2);
}

const Columns<MotionLine>& motionColumns()
{
    using Row = MotionLine;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.result.scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.result.resolution); }},
        {"light", 5, [](const Row& row) { return row.result.light; }},
        {"frames", 6,
         [](const Row& row)
         { return &row.error == &row.result.still ? "still" : fmt::format("{}", row.error.frames); }},
        {"error %", 7, [](const Row& row) { return motionPercent(row.error.all); }},
        {"of still", 8, [](const Row& row) { return ratioText(row.error.all, row.result.still.all); }},
        {"near %", 6, [](const Row& row) { return motionPercent(row.error.near); }},
        {"of still", 8, [](const Row& row) { return ratioText(row.error.near, row.result.still.near); }},
        {"lag %", 6, [](const Row& row) { return motionPercent(row.error.lag); }},
        {"FLIP", 6, [](const Row& row) { return fmt::format("{:.4f}", row.error.flip); }},
    };
    return all;
}

const Columns<MotionResult>& flickerColumns()
{
    using Row = MotionResult;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.resolution); }},
        {"light", 5, [](const Row& row) { return row.light; }},
        {"near pixels %", 13, [](const Row& row) { return motionPercent(row.near_share); }},
        {"calm pixels %", 13, [](const Row& row) { return motionPercent(row.calm_share); }},
        {"flicker %", 9, [](const Row& row) { return motionPercent(row.flicker_still); }},
        {"moving %", 8, [](const Row& row) { return motionPercent(row.flicker_moving); }},
        {"of still", 8, [](const Row& row) { return ratioText(row.flicker_moving, row.flicker_still); }},
    };
    return all;
}

Json motionNumber(const std::optional<double>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

Json errorJson(const MotionError& error)
{
    return {{"frames", error.frames},
            {"relative_error", error.all},
            {"near_relative_error", motionNumber(error.near)},
            {"near_lag", motionNumber(error.lag)},
            {"flip", error.flip}};
}

} // namespace

std::string motionText(std::span<const MotionResult> results)
{
    std::string text =
        fmt::format("It follows: pictures of one frame of the radiance cache, {} frames old, in which something has "
                    "moved for {} frames and now stands for those that are named, beside one in which it always stood "
                    "there. \"near\" is where it changes the light by more than {:.0f} %, there or on the way of its "
                    "last {} frames; \"lag\" is the difference from the still picture there, and of that one from "
                    "another with other noise.\n\n{}",
                    kLightFrames, kRunFrames, 100 * kNearChange, kLingers, columnNames(motionColumns()));
    for (const MotionResult& result : results)
    {
        text += columnValues(motionColumns(), {result, result.still});
        for (const MotionError& error : result.after)
        {
            text += columnValues(motionColumns(), {result, error});
        }
    }
    text += fmt::format("\nFlicker: the standard deviation over {} frames, beside the mean, of pixels that what moves "
                        "changes by less than {:.0f} %; while it stands, and while it moves.\n\n{}",
                        kFlickerFrames, 100 * kCalmChange, columnNames(flickerColumns()));
    for (const MotionResult& result : results)
    {
        text += columnValues(flickerColumns(), result);
    }
    return text;
}

Json motionJson(std::span<const MotionResult> results)
{
    Json json = Json::array();
    for (const MotionResult& result : results)
    {
        Json entry = {{"scene", result.scene},           {"resolution", result.resolution},
                      {"light", result.light},           {"light_frames", kLightFrames},
                      {"run_frames", kRunFrames},        {"near_share", result.near_share},
                      {"calm_share", result.calm_share}, {"still", errorJson(result.still)}};
        entry["after"] = Json::array();
        for (const MotionError& error : result.after)
        {
            Json after = errorJson(error);
            after["of_still"] = motionNumber(ratioOf(error.all, result.still.all));
            after["near_of_still"] = motionNumber(ratioOf(error.near, result.still.near));
            entry["after"].push_back(std::move(after));
        }
        entry["flicker"] = {{"frames", kFlickerFrames},
                            {"still", motionNumber(result.flicker_still)},
                            {"moving", motionNumber(result.flicker_moving)},
                            {"of_still", motionNumber(ratioOf(result.flicker_moving, result.flicker_still))}};
        json.push_back(std::move(entry));
    }
    return json;
}

} // namespace zvo::cli
