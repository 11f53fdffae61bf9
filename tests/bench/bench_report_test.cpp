// SPDX-License-Identifier: MIT
// Tables of small reports, with sums and costs worked out by hand.
#include "bench/bench_report.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace zvo::cli
{
namespace
{

// 1,000 triangles, 2,000 voxels, 500 nodes and 4,000 rays.
Json builtReport()
{
    return Json::parse(R"({"schema": "zvo.bench/1", "rows": [
        {"scene": "ball", "resolution": 64, "voxelize_ms": {"median": 1}, "build_ms": {"median": 1}},
        {"scene": "ball", "resolution": 128, "triangles": 1000, "voxels": 2000, "nodes": 500, "rays": 4000,
         "voxelize_ms": {"median": 2.5, "min": 1}, "build_ms": {"median": 0.5}, "compress_ms": null,
         "passes": [{"name": "octree/place", "ms": 0.25}, {"name": "trace/primary", "ms": 2},
                    {"name": "voxelize/bin_large", "ms": 1}]}]})");
}

Json movingReport()
{
    return Json::parse(R"({"schema": "zvo.bench_dynamic/1", "rows": [
        {"scene": "ball", "resolution": 128, "triangles_static": 7, "triangles_dynamic": 100,
         "voxels_dynamic": {"min": 1, "max": 200}, "nodes_dynamic": {"min": 1, "max": 50},
         "update_ms": {"median": 4}, "passes": [{"name": "update/insert", "ms": 0.001}]}]})");
}

Json target(const std::string& sums)
{
    Json target = Json::parse(R"({"work": "the ball", "unit": "ms", "published": "9", "floor": null, "reach": 4,
        "moonshot": 2, "schema": "zvo.bench/1", "scene": "ball", "resolution": 128})");
    target["sums"] = Json::parse(sums);
    return target;
}

// The cells of a table's lines behind the two of its head, without blanks around them.
std::vector<std::vector<std::string>> cells(const std::string& table)
{
    std::vector<std::vector<std::string>> lines;
    for (std::size_t begin = 0, end = 0; begin < table.size(); begin = end + 1)
    {
        end = table.find('\n', begin);
        std::vector<std::string>& line = lines.emplace_back();
        for (std::size_t bar = table.find('|', begin); table.find('|', bar + 1) < end;)
        {
            const std::size_t next = table.find('|', bar + 1);
            const std::string cell = table.substr(bar + 1, next - bar - 1);
            const std::size_t first = cell.find_first_not_of(' ');
            line.push_back(first == std::string::npos ? ""
                                                      : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
            bar = next;
        }
    }
    lines.erase(lines.begin(), lines.begin() + std::min<std::ptrdiff_t>(2, std::ssize(lines)));
    return lines;
}

std::vector<std::string> lastOfTarget(const Json& target)
{
    const auto lines = cells(targetTable({{"targets", {target}}}, {movingReport(), builtReport()}));
    EXPECT_EQ(lines.size(), 1U);
    return {lines.at(0).at(6), lines.at(0).at(7)};
}

using Words = std::vector<std::string>;

TEST(BenchReport, AFigureIsTheLeastOfTheSumsThatTheRowHas)
{
    EXPECT_EQ(lastOfTarget(target(R"([["voxelize_ms", "build_ms"]])")), (Words{"3.000", "reached"}));
    EXPECT_EQ(lastOfTarget(target(R"([["voxelize_ms", "build_ms"], ["build_ms"]])")),
              (Words{"0.500", "moonshot reached"}));
    EXPECT_EQ(lastOfTarget(target(R"([["triangles"], ["build_ms", "compress_ms"]])")),
              (Words{"1000.000", "250.00 times the target"}));
    EXPECT_EQ(lastOfTarget(target(R"([["compress_ms"]])")), (Words{"-", "not measured"}));
}

TEST(BenchReport, AFigureIsThatOfTheTargetsSceneResolutionAndKind)
{
    Json other = target(R"([["update_ms"]])");
    EXPECT_EQ(lastOfTarget(other), (Words{"-", "not measured"}));
    other["schema"] = "zvo.bench_dynamic/1";
    EXPECT_EQ(lastOfTarget(other), (Words{"4.000", "reached"}));
    other["resolution"] = 256;
    EXPECT_EQ(lastOfTarget(other), (Words{"-", "not measured"}));
    other["resolution"] = 128;
    other["scene"] = "cube";
    EXPECT_EQ(lastOfTarget(other), (Words{"-", "not measured"}));
}

TEST(BenchReport, AFigureIsThatOfTheReportThatHasMeasuredIt)
{
    const Json rays = Json::parse(R"({"schema": "zvo.bench/1", "rows": [{"scene": "ball", "resolution": 128,
        "voxelize_ms": null, "compress_ms": null, "trace_ms": {"median": 3}}]})");
    const Json pictures = target(R"([["trace_ms"]])");
    const Json voxels = target(R"([["voxelize_ms"]])");
    for (const std::vector<Json>& reports : {std::vector{builtReport(), rays}, std::vector{rays, builtReport()}})
    {
        const auto lines = cells(targetTable({{"targets", {pictures, voxels}}}, reports));
        ASSERT_EQ(lines.size(), 2U);
        EXPECT_EQ(lines[0].at(6), "3.000");
        EXPECT_EQ(lines[1].at(6), "2.500");
    }
}

TEST(BenchReport, ATargetMayLackWhatNobodyKnows)
{
    Json other = target(R"([["voxelize_ms"]])");
    other["reach"] = nullptr;
    EXPECT_EQ(lastOfTarget(other), (Words{"2.500", "1.25 times the moonshot"}));
    other["moonshot"] = nullptr;
    EXPECT_EQ(lastOfTarget(other), (Words{"2.500", "no target"}));
    other.erase("moonshot");
    EXPECT_THROW(targetTable({{"targets", {other}}}, {builtReport()}), Error);
}

TEST(BenchReport, SlowestPassesHaveTheirTimeForEachElement)
{
    const Json row = builtReport()["rows"][1];
    const auto lines = cells(slowestPasses(row, 2));
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines[0], (Words{"trace/primary", "2.0000", "61.5%", "-", "-", "-", "500"}));
    EXPECT_EQ(lines[1], (Words{"voxelize/bin_large", "1.0000", "30.8%", "1000", "500", "2000", "-"}));
    EXPECT_EQ(cells(slowestPasses(row, 9)).size(), 3U);
    EXPECT_EQ(slowestPasses(builtReport()["rows"][0], 9), "");
}

TEST(BenchReport, PassesOfUpdatesCountWhatMoves)
{
    const auto lines = cells(slowestPasses(movingReport()["rows"][0], 9));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0], (Words{"update/insert", "0.0010", "100.0%", "10", "5", "20", "-"}));
}

} // namespace
} // namespace zvo::cli
