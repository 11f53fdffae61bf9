// SPDX-License-Identifier: MIT
// Tables and reports of zvo-bench.
#include "bench/bench_run.h"
#include "runtime/trees.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace zvo::test
{
namespace
{

TEST_F(BenchRun, HelpAndVersionAreData)
{
    EXPECT_TRUE(run({"--version"}).out.starts_with("zvo-bench "));
    const std::string help = run({"--help"}).out;
    for (const char* command : {"build", "rays", "dynamic", "edit", "queries", "solid", "path", "cache", "denoise",
                                "baselines", "balance", "tune", "report"})
    {
        EXPECT_TRUE(contains(help, std::string("\n  ") + command + " ")) << command;
        const Outcome outcome = run({command, "--help"});
        EXPECT_TRUE(contains(outcome.out, std::string("Examples:\n  zvo-bench ") + command)) << command;
        EXPECT_FALSE(contains(outcome.out, "Excludes:") || contains(outcome.out, "Needs:")) << command;
        EXPECT_EQ(outcome.err, "");
    }
}

// The names of fields that have a value.
std::set<std::string> measuredFields(const json& row)
{
    std::set<std::string> names;
    for (const auto& [name, value] : row.items())
    {
        if (!value.is_null() && !name.starts_with("embree_"))
        {
            names.insert(name);
        }
    }
    return names;
}

constexpr const char* kSizes[] = {"scene",
                                  "resolution",
                                  "coverage",
                                  "attributes",
                                  "triangles",
                                  "voxels",
                                  "nodes",
                                  "geometry_bytes",
                                  "geometry_bytes_per_voxel",
                                  "attribute_bytes_per_voxel",
                                  "dag_nodes",
                                  "dag_geometry_bytes",
                                  "dag_geometry_bytes_per_voxel",
                                  "dag_geometry_ratio",
                                  "dag_rank_bytes",
                                  "peak_device_bytes",
                                  "passes"};

TEST_F(BenchRun, BuildTellsOfTreesAndWhatMakingThemTakes)
{
    const Outcome outcome =
        run({"build", "cube.glb", "--resolutions", "16,32", "--runs", "1", "--json", "build.json", "--passes"});
    EXPECT_TRUE(contains(outcome.out, "\n| cube "));
    EXPECT_TRUE(contains(outcome.out, " compress ms |"));
    EXPECT_FALSE(contains(outcome.out, "Mrays/s"));
    EXPECT_FALSE(contains(outcome.out, "Embree"));
    EXPECT_TRUE(contains(outcome.out, "| voxelize/bin "));
    EXPECT_TRUE(contains(outcome.out, "| svdag/insert (DAG) "));
    EXPECT_FALSE(contains(outcome.out, "| trace/"));
    const json report = json::parse(file("build.json"));
    expectFields(report, {"schema string", "device.name string", "width null", "height null", "runs number"});
    EXPECT_EQ(report["schema"], "zvo.bench/1");
    ASSERT_EQ(report["rows"].size(), 2U);
    std::set<std::string> measured(std::begin(kSizes), std::end(kSizes));
    measured.insert({"voxelize_ms", "build_ms", "compress_ms", "compress_ratio", "mvoxels_per_s"});
    for (const json& row : report["rows"])
    {
        EXPECT_EQ(measuredFields(row), measured);
        expectFields(row, {"voxelize_ms.median number", "voxelize_ms.min number", "voxelize_ms.max number",
                           "build_ms.median number", "compress_ms.median number"});
        EXPECT_GT(row["compress_ratio"], 0);
    }
    const json& row = report["rows"][1];
    EXPECT_EQ(row["resolution"], 32);
    BuildResult built = build(m_grid);
    EXPECT_EQ(row["voxels"], built.octree.voxel_count);
    EXPECT_EQ(row["geometry_bytes"], built.octree.geometryBytes());
    const DeviceTree dag = compress(device(), std::move(built.octree)).dag;
    EXPECT_EQ(row["dag_nodes"], dag.node_count);
    EXPECT_EQ(row["dag_geometry_bytes"], dag.geometryBytes());
    EXPECT_EQ(row["dag_rank_bytes"], dag.lists.rankBytes());
    EXPECT_DOUBLE_EQ(row["dag_geometry_ratio"].get<double>() * row["geometry_bytes"].get<double>(),
                     static_cast<double>(dag.geometryBytes()));
}

// Expects rows of these kinds of rays in a closed cube, which all but short ones hit, by Embree as well.
void expectKinds(const json& rows, const std::vector<std::string>& kinds)
{
    ASSERT_EQ(rows.size(), kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i)
    {
        const json& row = rows[i];
        EXPECT_EQ(row["kind"], kinds[i]);
        EXPECT_GT(row["hits"], 0) << kinds[i];
        EXPECT_EQ(row["hits"] == row["rays"], kinds[i] == "shadow") << kinds[i];
        EXPECT_GE(row["longest_of_warp"], 1) << kinds[i];
        for (const char* tree : {"octree", "dag"})
        {
            EXPECT_GT(row[tree]["mrays_per_s"], 0);
            EXPECT_GE(row[tree]["bytes"], 32);
            EXPECT_LE(row[tree]["bytes"], 64 * row["iterations"].get<double>());
            EXPECT_LE(row[tree]["warp_bytes"], row[tree]["bytes"]);
            EXPECT_GE(row[tree]["load_sectors"], 1);
        }
        if (!row["embree_hits"].is_null())
        {
            const auto hits = row["hits"].get<double>();
            EXPECT_NEAR(row["embree_hits"].get<double>(), hits, 1e-4 * hits + 2) << kinds[i];
        }
    }
}

TEST_F(BenchRun, RaysTellsOfPicturesOfTheSameTrees)
{
    const Outcome outcome = run({"rays", "cube.glb", "--resolutions", "16,32", "--runs", "1", "--json", "rays.json",
                                 "--passes", "--kinds", "shadow,ambient", "--camera=0.5,0.5,0.5,1,0.6,0.7"});
    EXPECT_TRUE(contains(outcome.out, "\n| cube "));
    EXPECT_TRUE(contains(outcome.out, " trace DAG ms |"));
    EXPECT_FALSE(contains(outcome.out, "voxelize"));
    EXPECT_FALSE(contains(outcome.out, "compress"));
    EXPECT_TRUE(contains(outcome.out, "| trace/ranks (DAG) "));
    const json report = json::parse(file("rays.json"));
    expectFields(report, {"schema string", "device.name string", "width number", "height number", "runs number"});
    EXPECT_EQ(report["schema"], "zvo.bench/1");
    ASSERT_EQ(report["rows"].size(), 2U);
    std::set<std::string> measured(std::begin(kSizes), std::end(kSizes));
    measured.insert(
        {"trace_ms", "trace_dag_ms", "trace_dag_ratio", "mrays_per_s", "node_paths_ms", "rays", "hits", "kinds"});
    for (const json& row : report["rows"])
    {
        EXPECT_EQ(measuredFields(row), measured);
        EXPECT_GT(row["hits"], 0);
        expectKinds(row["kinds"], {"shadow", "ambient"});
        EXPECT_GT(row["trace_dag_ms"]["median"], 0);
        EXPECT_GE(row["trace_dag_ratio"]["min"],
                  row["trace_dag_ms"]["min"].get<double>() / row["trace_ms"]["max"].get<double>());
        EXPECT_LE(row["trace_dag_ratio"]["max"],
                  row["trace_dag_ms"]["max"].get<double>() / row["trace_ms"]["min"].get<double>());
        EXPECT_EQ(contains(outcome.out, "Embree"), !row["embree_user_mrays_per_s"].is_null());
        if (!row["embree_user_mrays_per_s"].is_null())
        {
            expectFields(row, {"embree_user_mrays_per_s number", "embree_triangle_mrays_per_s number"});
            // Rays along edges may hit either side.
            EXPECT_NEAR(row["embree_user_hits"].get<double>(), row["hits"].get<double>(), 16.0);
        }
    }
    const BuildResult built = build(m_grid);
    EXPECT_EQ(report["rows"][1]["voxels"], built.octree.voxel_count);
    EXPECT_EQ(report["rows"][1]["geometry_bytes"], built.octree.geometryBytes());
}

TEST_F(BenchRun, ReportTellsOfSeveral)
{
    run({"build", "cube.glb", "--resolutions", "16", "--runs", "1", "--json", "build.json"});
    run({"rays", "cube.glb", "--resolutions", "16", "--runs", "1", "--json", "rays.json"});
    m_dir.write("targets.json", std::string_view(R"({"schema": "zvo.targets/1", "targets": [
        {"work": "pictures of a cube", "unit": "ms", "published": null, "floor": null, "reach": 1e9, "moonshot": null,
         "schema": "zvo.bench/1", "scene": "cube", "resolution": 16, "sums": [["trace_ms"]]}]})"));
    const std::string told = run({"report", "build.json", "rays.json", "--targets", "targets.json"}).out;
    EXPECT_TRUE(contains(told, "| pictures of a cube ")) << told;
    EXPECT_TRUE(contains(told, " reached |")) << told;
    EXPECT_TRUE(contains(told, "\ncube at 16:\n"));
    EXPECT_TRUE(contains(told, "| voxelize/bin "));
    EXPECT_TRUE(contains(told, "| trace/primary"));
}

TEST_F(BenchRun, RaysWithoutMemoryForTheDagTellsOfTheOctree)
{
    const std::vector<std::string> arguments = {"rays", "cube.glb", "--resolutions", "32", "--runs",
                                                "1",    "--json",   "rays.json",     "-f", "--passes"};
    run(arguments);
    const json whole = json::parse(file("rays.json"))["rows"][0];
    // A limit that suffices only for the octree: the DAG's node paths take 4 MiB beside it.
    constexpr std::uint64_t kMiB = 1 << 20;
    Outcome outcome;
    for (std::uint64_t mib = whole["peak_device_bytes"].get<std::uint64_t>() / kMiB; outcome.err.empty(); mib -= 4)
    {
        std::vector<std::string> limited = arguments;
        limited.insert(limited.end(), {"--memory-limit", std::to_string(mib) + "MiB"});
        outcome = run(limited);
    }
    EXPECT_TRUE(contains(outcome.err, "zvo-bench: warning: no DAG of cube at 32: ")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "raise --memory-limit")) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, " - |")) << outcome.out;
    EXPECT_FALSE(contains(outcome.out, " (DAG) ")) << outcome.out;
    const json row = json::parse(file("rays.json"))["rows"][0];
    for (const auto& [name, value] : whole.items())
    {
        const bool of_dag = name.starts_with("dag_") || name.starts_with("trace_dag_");
        EXPECT_EQ(row[name].is_null(), of_dag || value.is_null()) << name;
    }
    EXPECT_EQ(row["voxels"], whole["voxels"]);
    EXPECT_EQ(row["hits"], whole["hits"]);
    EXPECT_GT(row["trace_ms"]["median"], 0);
    EXPECT_GT(row["mrays_per_s"], 0);
}

TEST_F(BenchRun, BalanceTellsEverySceneAndItsRatios)
{
    const Outcome outcome =
        run({"balance", "cube.glb", "--resolutions", "16,32", "--runs", "1", "--json", "balance.json"});
    EXPECT_TRUE(contains(outcome.out, "\n| cube "));
    EXPECT_TRUE(contains(outcome.out, "\n| triangle / patch "));
    const json report = json::parse(file("balance.json"));
    expectFields(report, {"schema string", "device.name string", "coverage string", "runs number"});
    std::map<std::string, json> fine; // [scene] rows at a resolution of 32
    for (const json& row : report["rows"])
    {
        expectFields(row, {"scene string", "generated boolean", "resolution number", "triangles number",
                           "voxels number", "geometry_ms.median number", "geometry_ns_per_voxel number",
                           "attributes_ms.median number", "attributes_ns_per_voxel number"});
        EXPECT_GT(row["attributes_ms"]["median"], 0);
        if (row["resolution"] == 32)
        {
            fine[row["scene"]] = row;
        }
    }
    EXPECT_EQ(report["rows"].size(), 18U);
    ASSERT_EQ(fine.size(), 9U);
    EXPECT_EQ(fine["cube"]["voxels"], build(m_grid).octree.voxel_count);
    EXPECT_EQ(fine["triangle"]["triangles"], 1);
    EXPECT_GE(fine["triangle"]["voxels"], 16 * 16);
    EXPECT_LE(fine["triangle"]["voxels"], 16 * 16 + 78) << "its area and its outline";
    EXPECT_NEAR(fine["patch"]["voxels"].get<double>(), fine["triangle"]["voxels"].get<double>(), 32);
    EXPECT_EQ(fine["slivers"]["triangles"], 400);
    EXPECT_EQ(fine["crowded"]["voxels"], 1);
    EXPECT_EQ(fine["crowded"]["triangles"], fine["spread"]["triangles"]);
    EXPECT_EQ(fine["spread"]["voxels"], fine["spread"]["triangles"]);
    EXPECT_EQ(fine["brick"]["voxels"], 16 * 16 * 16);
    EXPECT_EQ(fine["fan"]["triangles"], 2000);
    EXPECT_EQ(fine["boxes"]["triangles"], 8 * 8 * 8 * 12);
    std::map<std::string, int> ratio_counts;
    for (const json& ratio : report["ratios"])
    {
        expectFields(ratio, {"scenes string", "resolution number", "geometry number", "attributes number"});
        EXPECT_GT(ratio["geometry"], 0);
        ++ratio_counts[ratio["name"]];
    }
    EXPECT_EQ(ratio_counts, (std::map<std::string, int>{{"triangle / patch", 2},
                                                        {"sliver / patch", 2},
                                                        {"fan / patch", 2},
                                                        {"boxes / patch", 2},
                                                        {"crowded / spread", 2},
                                                        {"brick / spread", 2},
                                                        {"doubling", 3},
                                                        {"largest doubling", 1}}));
}

TEST_F(BenchRun, BalanceNeedsNoAttributesAndNoFiles)
{
    const json report =
        json::parse(run({"balance", "--resolutions", "16", "--runs", "1", "--attributes", "none", "--json", "-"}).out);
    EXPECT_EQ(report["rows"].size(), 8U);
    EXPECT_EQ(report["ratios"].size(), 6U);
    EXPECT_TRUE(report["rows"][0]["attributes_ms"].is_null());
    EXPECT_TRUE(report["ratios"][0]["attributes"].is_null());
}

TEST_F(BenchRun, SolidTellsWhatFillingAndAlgebraTake)
{
    const Outcome outcome = run({"solid", "cube.glb", "--resolutions", "32", "--runs", "1", "--json", "solid.json"});
    EXPECT_TRUE(contains(outcome.out, "\n| cube "));
    const json report = json::parse(file("solid.json"));
    EXPECT_EQ(report["schema"], "zvo.bench_solid/1");
    ASSERT_EQ(report["rows"].size(), 11U);
    std::map<std::string, std::uint64_t> voxels;
    for (const json& row : report["rows"])
    {
        expectFields(row, {"scene string", "work string", "voxels number"});
        EXPECT_GT(row["ms"]["median"], 0);
        voxels[row["work"]] = row["voxels"];
    }
    EXPECT_GE(voxels["enclose"], voxels["build the surface"]);
    EXPECT_EQ(voxels["union"], voxels["build and fill"]);
    EXPECT_EQ(voxels["difference"] + voxels["erode"], voxels["build and fill"]);
    EXPECT_EQ(voxels["largest component"], voxels["build the surface"]);
}

TEST_F(BenchRun, QueriesTellsOctreeAndDagByKind)
{
    const Outcome outcome =
        run({"queries", "cube.glb", "--resolutions", "32", "--runs", "1", "--count", "100", "--json", "queries.json"});
    EXPECT_TRUE(contains(outcome.out, "\n| cube "));
    const json report = json::parse(file("queries.json"));
    EXPECT_EQ(report["schema"], "zvo.bench_queries/1");
    ASSERT_EQ(report["rows"].size(), 6U);
    for (const json& row : report["rows"])
    {
        expectFields(row, {"scene string", "question string", "found number"});
        EXPECT_GT(row["octree_mqueries_per_s"], 0);
        EXPECT_GT(row["dag_mqueries_per_s"], 0);
    }
    EXPECT_EQ(report["rows"][3]["question"], "nearest");
    EXPECT_EQ(report["rows"][3]["found"], 100);
}

TEST_F(BenchRun, EditTellsStrokesByRadiusActionAndNumber)
{
    const Outcome outcome =
        run({"edit", "cube.glb", "--resolutions", "32", "--runs", "2", "--structure", "svdag", "--json", "edit.json"});
    EXPECT_TRUE(contains(outcome.out, "\n| cube "));
    EXPECT_TRUE(contains(outcome.out, "| compactions |"));
    const json report = json::parse(file("edit.json"));
    expectFields(report,
                 {"schema string", "device.name string", "coverage string", "attributes string", "runs number"});
    EXPECT_EQ(report["schema"], "zvo.bench_edit/1");
    EXPECT_EQ(report["structure"], "svdag");
    ASSERT_EQ(report["rows"].size(), 1U);
    const json& row = report["rows"][0];
    EXPECT_EQ(row["resolution"], 32);
    EXPECT_EQ(row["voxels"], build(m_grid).octree.voxel_count);
    std::map<std::string, int> actions;
    for (const json& stroke : row["strokes"])
    {
        expectFields(stroke, {"radius number", "dab_ms.median number", "dab_ms.p95 number", "undo_ms.median number",
                              "redo_ms.median number", "bytes number"});
        EXPECT_GE(stroke["dab_ms"]["p95"], stroke["dab_ms"]["median"]);
        EXPECT_GT(stroke["undo_ms"]["median"], 0);
        EXPECT_GT(stroke["redo_ms"]["median"], 0);
        EXPECT_GT(stroke["bytes"], 0) << "a voxel of the cube is under each brush";
        ++actions[stroke["action"]];
    }
    EXPECT_EQ(actions, (std::map<std::string, int>{{"carve", 4}, {"fill", 4}, {"paint", 4}}));
    ASSERT_EQ(row["history"].size(), 3U);
    EXPECT_EQ(row["history"][2]["strokes"], 1000);
    for (const json& history : row["history"])
    {
        expectFields(history, {"strokes number", "dab_ms.median number", "dab_ms.p95 number", "undo_ms.p95 number",
                               "redo_ms.p95 number", "held_bytes number"});
        EXPECT_GT(history["held_bytes"], 0);
        EXPECT_LE(history["held_bytes"], 256 << 20);
        EXPECT_EQ(history["compactions"] == 0, history["compaction_ms"] == 0.0);
    }
    EXPECT_GT(row["history"][2]["compactions"], 0);
}

TEST_F(BenchRun, BaselinesTellsEachSourceBesideZvo)
{
    const Outcome outcome =
        run({"baselines", "cube.glb", "--resolutions", "16", "--runs", "1", "--json", "baselines.json"});
    EXPECT_TRUE(contains(outcome.out, "| published ms |"));
    EXPECT_FALSE(contains(outcome.err, "warning"));
    const json report = json::parse(file("baselines.json"));
    EXPECT_EQ(report["schema"], "zvo.bench_baselines/1");
    std::map<std::string, int> sources;
    for (const json& row : report["rows"])
    {
        expectFields(row, {"scene string", "resolution number", "work string", "baseline_ms.median number",
                           "zvo_ms.median number", "ratio.median number"});
        EXPECT_TRUE(row["published_ms"].is_null()) << "no source has figures of a cube";
        const std::string source = row["source"];
        const bool on_host = source == "Embree" || source == "DDA" || source == "hash table";
        EXPECT_EQ(row["clock"], on_host ? "wall" : "device") << source;
        EXPECT_GT(row["baseline_ms"]["median"], 0);
        EXPECT_GT(row["zvo_ms"]["median"], 0);
        ++sources[row["source"]];
    }
    expectFields(report,
                 {"instruction_set string", "date string", "published[].source string", "published[].hardware string"});
    EXPECT_EQ(sources["Embree"] % 4, 0) << "it may not be there";
    sources.erase("Embree");
    EXPECT_EQ(sources, (std::map<std::string, int>{
                           {"Crassin, Green", 1}, {"DDA", 1}, {"hash table", 1}, {"slides", 7}, {"thesis", 5}}));
    ASSERT_EQ(report["sizes"].size(), 6U);
    for (const json& size : report["sizes"])
    {
        EXPECT_GT(size["bytes"], 0) << size["form"];
        EXPECT_EQ(size["voxels"], report["sizes"][0]["voxels"]);
    }
    ASSERT_EQ(report["orders"].size(), 3U);
    for (const json& order : report["orders"])
    {
        EXPECT_GT(order["rays_ms"]["median"], 0);
        EXPECT_TRUE(order["update_ms"].is_null());
    }
}

TEST_F(BenchRun, BaselinesUpdatesScenesThatMove)
{
    m_dir.write("moving.scene.json", std::string_view(R"({
        "seconds": 1, "frames_per_second": 8,
        "objects": [
            {"name": "still", "file": "cube.glb", "static": true},
            {"name": "moving", "file": "cube.glb", "place": {"scale": 0.4},
             "motion": {"line": {"from": [-1, 0.8, 0], "to": [1, 0.8, 0]}}}]})"));
    run({"baselines", "moving.scene.json", "--resolutions", "32", "--runs", "2", "--json", "moving.json"});
    const json report = json::parse(file("moving.json"));
    std::set<std::string> updates;
    for (const json& row : report["rows"])
    {
        EXPECT_EQ(row["scene"], "moving");
        EXPECT_GT(row["baseline_ms"]["median"], 0) << row["work"];
        EXPECT_GT(row["zvo_ms"]["median"], 0) << row["work"];
        if (!row["moving_voxels"].is_null())
        {
            EXPECT_GT(row["moving_voxels"], 0);
            updates.insert(row["work"]);
        }
    }
    EXPECT_EQ(updates, (std::set<std::string>{"rays after the update", "update", "update, range of codes",
                                              "update: merge", "update: merge, range of codes", "update: voxelize",
                                              "update: voxelize, range of codes"}));
    ASSERT_EQ(report["orders"].size(), 3U);
    EXPECT_GT(report["orders"][1]["update_ms"]["median"], 0);
}

TEST_F(BenchRun, CloseCameraHitsMore)
{
    run({"rays", "cube.glb", "--resolutions", "16", "--runs", "1", "--camera", "auto", "--json", "auto.json"});
    run({"rays", "cube.glb", "--resolutions", "16", "--runs", "1", "--camera", "close", "--json", "close.json"});
    const double rays = 1920.0 * 1080.0;
    const double far_hits = json::parse(file("auto.json"))["rows"][0]["hits"].get<double>() / rays;
    const double close_hits = json::parse(file("close.json"))["rows"][0]["hits"].get<double>() / rays;
    EXPECT_LT(far_hits, 0.5);
    EXPECT_GT(close_hits, 0.6);
}

} // namespace
} // namespace zvo::test
