// SPDX-License-Identifier: MIT
// Files, reports and tables of successful runs.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "core/base/kernels.h"
#include "core/headless/compress.h"
#include "core/headless/pipeline.h"
#include "core/tree/device_tree.h"
#include "io/gltf/gltf_loader.h"
#include "io/image/image_io.h"
#include "runtime/octree_sha256.h"
#include "support/device.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

namespace zvo::test
{
namespace
{

/// A folder with cube.glb, and the octree that the library makes of it at a resolution of 32.
class CliRun : public testing::Test
{
protected:
    static constexpr std::uint32_t kDepth = 5;

    void SetUp() override
    {
        m_scene = loadGltf(m_dir.write("cube.glb", coloredCube().glb()));
        m_grid = Grid::around(m_scene.bounds(), kDepth);
    }

    // Runs zvo and expects success.
    Outcome run(const std::vector<std::string>& arguments)
    {
        const Outcome outcome = runZvo(m_dir.path(), arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err.find_first_of("\r\033"), std::string::npos) << "a progress bar on what is no terminal";
        return outcome;
    }

    BuildResult build(const Grid& grid)
    {
        return buildOctree(device(), uploadScene(device(), m_scene, true), grid, {});
    }

    static vk::HeadlessDevice& device() { return sharedDevice(zvoKernels()); }

    [[nodiscard]] std::string file(const std::string& name) const { return contentOf(m_dir.path() / name); }

    [[nodiscard]] std::vector<std::uint64_t> mortonFile(const std::string& name) const
    {
        const std::string bytes = file(name);
        std::vector<std::uint64_t> codes(bytes.size() / sizeof(std::uint64_t));
        std::memcpy(codes.data(), bytes.data(), codes.size() * sizeof(std::uint64_t));
        EXPECT_EQ(bytes.size() % sizeof(std::uint64_t), 0U);
        return codes;
    }

    TempDir m_dir;
    Scene m_scene;
    Grid m_grid;
};

// Lists the paths of fields with their types. The first element stands for all of an array.
void listFields(const json& value, const std::string& path, std::vector<std::string>& fields)
{
    if (value.is_object() && !value.empty())
    {
        for (const auto& [name, member] : value.items())
        {
            listFields(member, path.empty() ? name : path + "." + name, fields);
        }
    }
    else if (value.is_array() && !value.empty())
    {
        listFields(value.front(), path + "[]", fields);
    }
    else
    {
        fields.push_back(path + " " + value.type_name());
    }
}

void expectFields(const json& value, const std::vector<std::string>& expected)
{
    std::vector<std::string> fields;
    listFields(value, "", fields);
    for (const std::string& field : expected)
    {
        EXPECT_NE(std::find(fields.begin(), fields.end(), field), fields.end()) << field << " is not in " << value;
    }
}

const std::vector<std::string> kOctreeFields = {"schema string",
                                                "device.name string",
                                                "device.driver string",
                                                "device.type string",
                                                "device.subgroup_size number",
                                                "grid.origin[] number",
                                                "grid.voxel_size number",
                                                "grid.depth number",
                                                "snapping string",
                                                "scene.triangles number",
                                                "scene.dropped object",
                                                "voxels number",
                                                "bricks number",
                                                "nodes number",
                                                "bytes.geometry number",
                                                "bytes.attributes number",
                                                "bytes.peak_device number",
                                                "octree_sha256 string",
                                                "passes[].name string",
                                                "passes[].ms number",
                                                "voxelize_ms number",
                                                "build_ms number"};

float asFloat(const json& number)
{
    return static_cast<float>(number.get<double>());
}

TEST_F(CliRun, HelpAndVersionAreData)
{
    EXPECT_TRUE(contains(run({"--help"}).out, "render"));
    EXPECT_TRUE(contains(run({"--version"}).out, "zvo "));
    for (const char* command : {"render", "voxelize", "info", "bench"})
    {
        const Outcome outcome = run({command, "--help"});
        EXPECT_TRUE(contains(outcome.out, "Examples:"));
        EXPECT_EQ(outcome.err, "");
    }
}

TEST_F(CliRun, MortonFileHoldsTheLibrarysCodes)
{
    run({"voxelize", "cube.glb", "-o", "cube.morton", "--resolution", "32"});
    EXPECT_EQ(mortonFile("cube.morton"), voxelCodes(device(), build(m_grid).octree));
    const Outcome piped = run({"voxelize", "cube.glb", "-o", "-", "--format", "morton", "--resolution", "32"});
    EXPECT_EQ(piped.out, file("cube.morton"));
}

TEST_F(CliRun, VoxelizeReportsTheLibrarysNumbers)
{
    const json report =
        json::parse(run({"voxelize", "cube.glb", "-o", "cube.ply", "--resolution", "32", "--json", "-"}).out);
    expectFields(report, kOctreeFields);
    const BuildResult result = build(m_grid);
    EXPECT_EQ(report["schema"], "zvo.voxelize/1");
    EXPECT_EQ(report["snapping"], "lattice256");
    EXPECT_EQ(report["scene"]["triangles"], 12);
    EXPECT_EQ(report["voxels"], result.octree.voxel_count);
    EXPECT_EQ(report["nodes"], result.octree.node_count);
    EXPECT_EQ(report["bricks"], result.octree.levels.back().node_count);
    EXPECT_EQ(report["bytes"]["geometry"], result.octree.geometryBytes());
    EXPECT_EQ(report["bytes"]["attributes"], result.octree.attributeBytes());
    EXPECT_EQ(report["octree_sha256"], octreeSha256(device(), result.octree));
    EXPECT_TRUE(report["trace_ms"].is_null());
}

TEST_F(CliRun, FlagsComeInAnyOrder)
{
    run({"voxelize", "--coverage", "conservative", "-o", "1.morton", "--resolution=32", "cube.glb"});
    run({"voxelize", "cube.glb", "--resolution", "32", "--coverage=conservative", "-o", "2.morton"});
    run({"voxelize", "--resolution", "32", "cube.glb", "-o2.morton", "-f", "--coverage", "conservative"});
    EXPECT_EQ(file("1.morton"), file("2.morton"));
    EXPECT_NE(file("1.morton"), "");
}

TEST_F(CliRun, PlyFileHoldsCentersNormalsAndColors)
{
    run({"voxelize", "cube.glb", "-o", "cube.ply", "--resolution", "32"});
    const std::vector<std::uint64_t> codes = voxelCodes(device(), build(m_grid).octree);
    const std::string ply = file("cube.ply");
    const std::string end = "end_header\n";
    const std::size_t header_bytes = ply.find(end) + end.size();
    EXPECT_TRUE(
        ply.starts_with("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(codes.size()) + "\n"));
    constexpr std::size_t kVertexBytes = 6 * sizeof(float) + 3;
    ASSERT_EQ(ply.size() - header_bytes, codes.size() * kVertexBytes);
    int plain_count = 0;
    for (std::size_t i = 0; i < codes.size(); ++i)
    {
        glm::vec3 vectors[2]; // centre, normal
        std::uint8_t rgb[3];
        const char* const vertex = ply.data() + header_bytes + i * kVertexBytes;
        std::memcpy(vectors, vertex, sizeof(vectors));
        std::memcpy(rgb, vertex + sizeof(vectors), sizeof(rgb));
        const glm::vec3 cell = (vectors[0] - m_grid.origin) / m_grid.voxel_size - 0.5F;
        std::uint64_t code = 0;
        for (std::uint32_t bit = 0; bit < 3 * kDepth; ++bit)
        {
            code |= static_cast<std::uint64_t>(std::lround(cell[static_cast<int>(bit % 3)]) >> (bit / 3) & 1) << bit;
        }
        ASSERT_EQ(code, codes[i]);
        ASSERT_NEAR(glm::length(vectors[1]), 1.0F, 1e-5F);
        for (int axis = 0; axis < 3; ++axis) // a voxel of a single face has that face's normal and colour
        {
            if (rgb[axis] == 255 && rgb[(axis + 1) % 3] == 0 && rgb[(axis + 2) % 3] == 0)
            {
                const bool is_upper = cell[axis] > 16.0F;
                ASSERT_NEAR(vectors[1][axis], is_upper ? 1.0F : -1.0F, 1e-4F);
                ++plain_count;
            }
        }
    }
    EXPECT_GT(plain_count, 6 * 28 * 28);
}

TEST_F(CliRun, GridOfAReportGivesTheSameGridBitForBit)
{
    // Corners that no short decimal number represents.
    m_scene.instances[0].transform = glm::mat4(0.1F);
    m_scene.instances[0].transform[3] = glm::vec4(1.0F / 3.0F, -7.1F, 1e-4F, 1.0F);
    GltfBuilder builder = coloredCube();
    builder.document["nodes"][0]["translation"] = {1.0 / 3.0, -7.1, 1e-4};
    builder.document["nodes"][0]["scale"] = {0.1, 0.1, 0.1};
    m_dir.write("moved.glb", builder.glb());
    const Grid expected = Grid::around(m_scene.bounds(), kDepth);

    run({"voxelize", "moved.glb", "-o", "1.morton", "--resolution", "32", "--json", "1.json"});
    const json grid = json::parse(file("1.json"))["grid"];
    for (int axis = 0; axis < 3; ++axis)
    {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(asFloat(grid["origin"][axis])),
                  std::bit_cast<std::uint32_t>(expected.origin[axis]));
    }
    EXPECT_EQ(std::bit_cast<std::uint32_t>(asFloat(grid["voxel_size"])),
              std::bit_cast<std::uint32_t>(expected.voxel_size));
    EXPECT_EQ(grid["depth"], kDepth);

    const std::string place = grid["origin"][0].dump() + "," + grid["origin"][1].dump() + "," +
                              grid["origin"][2].dump() + "," + grid["voxel_size"].dump();
    run({"voxelize", "moved.glb", "-o", "2.morton", "--resolution", "32", "--json", "2.json", "--grid", place});
    EXPECT_EQ(json::parse(file("2.json"))["octree_sha256"], json::parse(file("1.json"))["octree_sha256"]);
}

TEST_F(CliRun, BoundsFixTheGrid)
{
    const json report = json::parse(run({"voxelize", "cube.glb", "-o", "cube.morton", "--resolution", "32", "--bounds",
                                         "-1.5,-.25,0,.5,1,1", "--json", "-"})
                                        .out);
    const Grid grid = Grid::withCorner({{-1.5F, -0.25F, 0.0F}, {0.5F, 1.0F, 1.0F}}, kDepth);
    EXPECT_EQ(asFloat(report["grid"]["origin"][0]), -1.5F);
    EXPECT_EQ(asFloat(report["grid"]["voxel_size"]), 2.0F / 32.0F);
    EXPECT_EQ(mortonFile("cube.morton"), voxelCodes(device(), build(grid).octree));
}

TEST_F(CliRun, RenderWritesAPictureAndItsNumbers)
{
    run({"render", "cube.glb", "-o", "front.png", "--resolution", "32", "--size", "96x64", "--view", "albedo", "--json",
         "front.json"});
    const json report = json::parse(file("front.json"));
    expectFields(report, kOctreeFields);
    expectFields(report, {"trace_ms number", "capped_rays number"});
    EXPECT_EQ(report["schema"], "zvo.render/1");
    EXPECT_EQ(report["capped_rays"], 0);
    EXPECT_EQ(report["octree_sha256"], octreeSha256(device(), build(m_grid).octree));
    EXPECT_GT(report["trace_ms"], 0.0);

    const std::string png = file("front.png");
    const Image image = decodeImage({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()}, "", "front.png");
    ASSERT_EQ(image.width, 96U);
    ASSERT_EQ(image.height, 64U);
    const std::uint8_t* const center = image.rgba.data() + std::size_t{4} * (32 * 96 + 48);
    EXPECT_EQ(center[0], 0); // the camera looks at the face of the z axis, which is blue
    EXPECT_EQ(center[1], 0);
    EXPECT_EQ(center[2], 255);

    const std::vector<std::string> same = {"render", "cube.glb", "-o",     "-",      "--resolution", "32",
                                           "--size", "96x64",    "--view", "albedo", "--camera",     "front"};
    EXPECT_EQ(run(same).out, png);
    const std::vector<std::string> by_numbers = {
        "render", "cube.glb", "-o",    "-",        "--resolution",
        "32",     "--size",   "96x64", "--camera", "0.5,.5,4,0.5,0.5,-1e1,45.83662"};
    EXPECT_TRUE(run(by_numbers).out.starts_with("\x89PNG"));
}

TEST_F(CliRun, FramesTurnOnceAround)
{
    run({"render", "cube.glb", "-o", "f_##.png", "--frames", "0..3", "--resolution", "32", "--size", "64x64", "--view",
         "normal", "--attributes", "none"});
    run({"render", "cube.glb", "-o", "one.png", "--resolution", "32", "--size", "64x64", "--view", "normal",
         "--attributes", "none"});
    EXPECT_EQ(file("f_00.png"), file("one.png"));
    EXPECT_NE(file("f_01.png"), file("f_00.png"));
    EXPECT_EQ(filesIn(m_dir.path()),
              (std::vector<std::string>{"cube.glb", "f_00.png", "f_01.png", "f_02.png", "f_03.png", "one.png"}));
}

TEST_F(CliRun, InfoListsDevices)
{
    const json info = json::parse(run({"info", "--json"}).out);
    EXPECT_EQ(info["schema"], "zvo.info/1");
    expectFields(info,
                 {"devices[].index number", "devices[].name string", "devices[].type string", "devices[].driver string",
                  "devices[].usable boolean", "devices[].chosen boolean", "devices[].present[] string"});
    EXPECT_TRUE(info["devices"][0]["missing"].is_array());
    EXPECT_TRUE(info["devices"][0]["reasons"].is_array());
    EXPECT_TRUE(contains(run({"info", "--device", "cpu"}).out, "<- would be used"));
    const Outcome none = runZvo(m_dir.path(), {"info", "--device", "voodoo"});
    EXPECT_EQ(none.exit_code, 5);
    EXPECT_TRUE(contains(none.out, "llvmpipe"));
}

TEST_F(CliRun, BenchTellsATableAndAReport)
{
    const Outcome outcome =
        run({"bench", "cube.glb", "--resolutions", "16,32", "--runs", "1", "--json", "bench.json", "--passes"});
    EXPECT_TRUE(contains(outcome.out, "\n| cube "));
    EXPECT_TRUE(contains(outcome.out, "| voxelize/triangles "));
    EXPECT_TRUE(contains(outcome.out, " trace DAG ms |"));
    const json report = json::parse(file("bench.json"));
    expectFields(report, {"schema string", "device.name string"});
    ASSERT_EQ(report["rows"].size(), 2U);
    for (const json& row : report["rows"])
    {
        expectFields(row, {"scene string", "resolution number", "coverage string", "triangles number", "voxels number",
                           "nodes number", "geometry_bytes_per_voxel number", "attribute_bytes_per_voxel number",
                           "voxelize_ms.median number", "voxelize_ms.min number", "voxelize_ms.max number",
                           "build_ms.median number", "trace_ms.median number", "mvoxels_per_s number",
                           "mrays_per_s number", "peak_device_bytes number", "compress_ms.median number",
                           "trace_dag_ms.median number", "trace_dag_ratio.min number"});
        EXPECT_GT(row["hits"], 0);
        EXPECT_GT(row["compress_ratio"], 0);
        EXPECT_GT(row["trace_dag_ms"]["median"], 0);
        EXPECT_GE(row["trace_dag_ratio"]["min"],
                  row["trace_dag_ms"]["min"].get<double>() / row["trace_ms"]["max"].get<double>());
        EXPECT_LE(row["trace_dag_ratio"]["max"],
                  row["trace_dag_ms"]["max"].get<double>() / row["trace_ms"]["min"].get<double>());
        if (!row["embree_user_mrays_per_s"].is_null())
        {
            expectFields(row, {"embree_user_mrays_per_s number", "embree_triangle_mrays_per_s number"});
            // Rays along edges may hit either side.
            EXPECT_NEAR(row["embree_user_hits"].get<double>(), row["hits"].get<double>(), 16.0);
        }
    }
    EXPECT_EQ(report["rows"][1]["resolution"], 32);
    BuildResult built = build(m_grid);
    const json& row = report["rows"][1];
    EXPECT_EQ(row["voxels"], built.octree.voxel_count);
    EXPECT_EQ(row["geometry_bytes"], built.octree.geometryBytes());
    const DeviceTree dag = compress(device(), std::move(built.octree)).dag;
    EXPECT_EQ(row["dag_nodes"], dag.node_count);
    EXPECT_EQ(row["dag_geometry_bytes"], dag.geometryBytes());
    EXPECT_EQ(row["dag_rank_bytes"], dag.lists.rankBytes());
    EXPECT_DOUBLE_EQ(row["dag_geometry_ratio"].get<double>() * row["geometry_bytes"].get<double>(),
                     static_cast<double>(dag.geometryBytes()));
    EXPECT_TRUE(contains(outcome.out, "| svdag/insert (DAG) "));
    EXPECT_TRUE(contains(outcome.out, "| trace/ranks (DAG) "));
    const std::string told = run({"bench", "--report", "bench.json"}).out;
    EXPECT_TRUE(contains(told, "\ncube at 16:\n"));
    EXPECT_TRUE(contains(told, "\ncube at 32:\n"));
    EXPECT_TRUE(contains(told, "| trace/primary"));
}

TEST_F(CliRun, BenchWithoutMemoryForTheDagTellsOfTheOctree)
{
    const std::vector<std::string> arguments = {"bench", "cube.glb", "--resolutions", "32", "--runs",
                                                "1",     "--json",   "bench.json",    "-f", "--passes"};
    run(arguments);
    const json whole = json::parse(file("bench.json"))["rows"][0];
    // A limit that suffices only for the octree: the DAG's beam grid takes 8 MiB beside it.
    constexpr std::uint64_t kMiB = 1 << 20;
    Outcome outcome;
    for (std::uint64_t mib = whole["peak_device_bytes"].get<std::uint64_t>() / kMiB; outcome.err.empty(); mib -= 4)
    {
        std::vector<std::string> limited = arguments;
        limited.insert(limited.end(), {"--memory-limit", std::to_string(mib) + "MiB"});
        outcome = run(limited);
    }
    EXPECT_TRUE(contains(outcome.err, "zvo: warning: no DAG of cube at 32: ")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "raise --memory-limit")) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, " - |")) << outcome.out;
    EXPECT_FALSE(contains(outcome.out, " (DAG) ")) << outcome.out;
    const json row = json::parse(file("bench.json"))["rows"][0];
    for (const auto& [name, value] : whole.items())
    {
        const bool of_dag = name.starts_with("dag_") || name.starts_with("compress_") || name.starts_with("trace_dag_");
        EXPECT_EQ(row[name].is_null(), of_dag || value.is_null()) << name;
    }
    EXPECT_EQ(row["voxels"], whole["voxels"]);
    EXPECT_EQ(row["hits"], whole["hits"]);
    EXPECT_GT(row["trace_ms"]["median"], 0);
    EXPECT_GT(row["mrays_per_s"], 0);
}

TEST_F(CliRun, BenchOfBalanceTellsEverySceneAndItsRatios)
{
    const Outcome outcome =
        run({"bench", "--balance", "cube.glb", "--resolutions", "16,32", "--runs", "1", "--json", "balance.json"});
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
    EXPECT_EQ(report["rows"].size(), 12U);
    ASSERT_EQ(fine.size(), 6U);
    EXPECT_EQ(fine["cube"]["voxels"], build(m_grid).octree.voxel_count);
    EXPECT_EQ(fine["triangle"]["triangles"], 1);
    EXPECT_GE(fine["triangle"]["voxels"], 16 * 16);
    EXPECT_LE(fine["triangle"]["voxels"], 16 * 16 + 78) << "its area and its outline";
    EXPECT_NEAR(fine["patch"]["voxels"].get<double>(), fine["triangle"]["voxels"].get<double>(), 32);
    EXPECT_EQ(fine["slivers"]["triangles"], 400);
    EXPECT_EQ(fine["crowded"]["voxels"], 1);
    EXPECT_EQ(fine["crowded"]["triangles"], fine["spread"]["triangles"]);
    EXPECT_EQ(fine["spread"]["voxels"], fine["spread"]["triangles"]);
    std::map<std::string, int> ratio_counts;
    for (const json& ratio : report["ratios"])
    {
        expectFields(ratio, {"scenes string", "resolution number", "geometry number", "attributes number"});
        EXPECT_GT(ratio["geometry"], 0);
        ++ratio_counts[ratio["name"]];
    }
    EXPECT_EQ(ratio_counts, (std::map<std::string, int>{{"triangle / patch", 2},
                                                        {"sliver / patch", 2},
                                                        {"crowded / spread", 2},
                                                        {"doubling", 3},
                                                        {"largest doubling", 1}}));
}

TEST_F(CliRun, BenchOfBalanceNeedsNoAttributesAndNoFiles)
{
    const json report = json::parse(
        run({"bench", "--balance", "--resolutions", "16", "--runs", "1", "--attributes", "none", "--json", "-"}).out);
    EXPECT_EQ(report["rows"].size(), 5U);
    EXPECT_EQ(report["ratios"].size(), 3U);
    EXPECT_TRUE(report["rows"][0]["attributes_ms"].is_null());
    EXPECT_TRUE(report["ratios"][0]["attributes"].is_null());
}

TEST_F(CliRun, BenchOfEditTellsStrokesByRadiusActionAndNumber)
{
    const Outcome outcome = run({"bench", "--edit", "cube.glb", "--resolutions", "32", "--runs", "2", "--structure",
                                 "svdag", "--json", "edit.json"});
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

TEST_F(CliRun, BenchOfBaselinesTellsEachSourceBesideZvo)
{
    const Outcome outcome =
        run({"bench", "--baselines", "cube.glb", "--resolutions", "16", "--runs", "1", "--json", "baselines.json"});
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
        EXPECT_GT(row["baseline_ms"]["median"], 0);
        EXPECT_GT(row["zvo_ms"]["median"], 0);
        ++sources[row["source"]];
    }
    EXPECT_EQ(sources, (std::map<std::string, int>{{"Crassin, Green", 1}, {"slides", 6}, {"thesis", 3}}));
    ASSERT_EQ(report["sizes"].size(), 4U);
    for (const json& size : report["sizes"])
    {
        EXPECT_GT(size["bytes"], 0) << size["form"];
        EXPECT_EQ(size["voxels"], report["sizes"][0]["voxels"]);
    }
}

TEST_F(CliRun, CloseCameraHitsMore)
{
    run({"bench", "cube.glb", "--resolutions", "16", "--runs", "1", "--camera", "auto", "--json", "auto.json"});
    run({"bench", "cube.glb", "--resolutions", "16", "--runs", "1", "--camera", "close", "--json", "close.json"});
    const double rays = 1920.0 * 1080.0;
    const double far_hits = json::parse(file("auto.json"))["rows"][0]["hits"].get<double>() / rays;
    const double close_hits = json::parse(file("close.json"))["rows"][0]["hits"].get<double>() / rays;
    EXPECT_LT(far_hits, 0.5);
    EXPECT_GT(close_hits, 0.6);
}

TEST_F(CliRun, PipelinesAreKeptInTheCacheFolder)
{
    const TempDir cache;
    const Outcome outcome = runZvo(m_dir.path(), {"voxelize", "cube.glb", "-o", "cube.ply", "--resolution", "8"},
                                   {"XDG_CACHE_HOME=" + cache.path().string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(filesIn(cache.path() / "zvo"), std::vector<std::string>{"pipelines.bin"});
}

} // namespace
} // namespace zvo::test
