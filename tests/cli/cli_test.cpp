// SPDX-License-Identifier: MIT
// Files, reports and tables of successful runs.
#include "cli/cli_run.h"
#include "runtime/octree_sha256.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace zvo::test
{
namespace
{

const std::vector<std::string> kOctreeFields = {
    // clang-format off
    "schema string", "device.name string", "device.driver string", "device.type string", "device.subgroup_size number",
    "grid.origin[] number", "grid.voxel_size number", "grid.depth number", "snapping string", "scene.triangles number",
    "scene.dropped object", "voxels number", "bricks number", "nodes number", "bytes.geometry number",
    "bytes.attributes number", "bytes.peak_device number", "octree_sha256 string", "passes[].name string",
    "passes[].ms number", "voxelize_ms number", "build_ms number",
    // clang-format on
};

float asFloat(const json& number)
{
    return static_cast<float>(number.get<double>());
}

TEST_F(CliRun, HelpAndVersionAreData)
{
    EXPECT_TRUE(contains(run("--help").out, "render"));
    EXPECT_TRUE(contains(run("--version").out, "zvo "));
    for (const std::string command : {"render", "voxelize", "info"})
    {
        const Outcome outcome = run(command + " --help");
        EXPECT_TRUE(contains(outcome.out, "Examples:"));
        EXPECT_EQ(outcome.err, "");
    }
}

TEST_F(CliRun, HelpIsAWordToo)
{
    EXPECT_EQ(run("help").out, run("--help").out);
    EXPECT_EQ(run("help convert").out, run("convert --help").out);
    EXPECT_NE(run("help render").out, run("help convert").out);
}

TEST_F(CliRun, QuietRunsTellOnlyOfWhatIsWrong)
{
    EXPECT_TRUE(contains(run("render cube.glb -o 1.png --resolution 8 --size 16x16").err, "voxels of 8^3"));
    EXPECT_EQ(run("render cube.glb -o 2.png --resolution 8 --size 16x16 --quiet").err, "");
    EXPECT_EQ(file("2.png"), file("1.png"));
    EXPECT_EQ(run("build cube.glb -o cube.zvo --resolution 8 -q").err, "");
    EXPECT_EQ(run("convert cube.zvo -o cube.ply -q").err, "");
    const std::string path = "render cube.zvo --size 16x16 --integrator path --spp 1 -o ";
    EXPECT_TRUE(contains(run(path + "3.png -q --environment none").err, "warning: nothing gives off light"));
    EXPECT_TRUE(contains(run(path + "4.png").err, "1 path a pixel"));
}

TEST_F(CliRun, MortonFileHoldsTheLibrarysCodes)
{
    run("voxelize cube.glb -o cube.morton --resolution 32");
    EXPECT_EQ(codes("cube.morton"), voxelCodes(device(), build(m_grid).octree));
    EXPECT_EQ(run("voxelize cube.glb -o - --format morton --resolution 32").out, file("cube.morton"));
}

TEST_F(CliRun, VoxelizeReportsTheLibrarysNumbers)
{
    const json report = printedBy("voxelize cube.glb -o cube.ply --resolution 32 --json -");
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
    run("voxelize --coverage conservative -o 1.morton --resolution=32 cube.glb");
    run("voxelize cube.glb --resolution 32 --coverage=conservative -o 2.morton");
    run("voxelize --resolution 32 cube.glb -o2.morton -f --coverage conservative");
    EXPECT_EQ(file("1.morton"), file("2.morton"));
    EXPECT_NE(file("1.morton"), "");
}

TEST_F(CliRun, FillsWhatIsClosedInAllOfItsFiles)
{
    constexpr std::size_t kCells = 16 * 16 * 16; // the cube is the whole grid
    run("voxelize cube.glb --resolution 16 --fill solid -o full.morton");
    EXPECT_EQ(file("full.morton").size(), kCells * sizeof(std::uint64_t));
    run("voxelize cube.glb --resolution 16 --fill robust -o robust.morton");
    EXPECT_EQ(file("robust.morton"), file("full.morton"));
    run("build cube.glb --resolution 16 --fill parity -o full.zvo --json full.json");
    EXPECT_EQ(json::parse(file("full.json"))["voxels"], kCells);
    run("convert full.zvo -o full.ply");
    EXPECT_NE(file("full.ply").find(fmt::format("element vertex {}\n", kCells)), std::string::npos);
    run("render full.zvo -o a.png --size 64x48");
    run("build cube.glb --resolution 16 --structure svo -o shell.zvo");
    run("render shell.zvo -o b.png --size 64x48");
    EXPECT_EQ(file("a.png"), file("b.png"));
    expectError("build cube.glb --resolution 16 --fill robust --distance 2 -o a.nvdb", 2, {"solid or parity"});
    run("build cube.glb --resolution 16 --fill solid --structure svo -o octree.zvo");
    run("convert octree.zvo -o octree.ply");
    EXPECT_EQ(file("octree.ply"), file("full.ply"));
    run("validate full.zvo");
    run("voxelize cube.glb --resolution 16 --margin 1 --fill parity --shell none -o core.morton");
    EXPECT_EQ(file("core.morton").size(), std::size_t{14} * 14 * 14 * sizeof(std::uint64_t)); // as long as the cube
    expectError("build cube.glb --resolution 16 --shell none -o a.zvo", 2, {"shell"});
    expectError("build cube.glb --resolution 16 --fill robust --shell none -o a.zvo", 2, {"shell"});
    expectError("build cube.glb --resolution 16 --distance 2 --shell none -o a.nvdb", 2, {"--shell"});
    expectError("voxelize cube.glb --resolution 4 --fill solid -o a.morton", 2, {"resolution of 8"});
    run("build cube.glb --resolution 16 --distance 2 -o near.nvdb --json near.json");
    EXPECT_GT(json::parse(file("near.json"))["leaves"], 8);
    expectError("build cube.glb --resolution 16 --distance 2 -o a.zvo", 2, {"name it .nvdb"});
    expectError("build cube.glb --resolution 16 --distance 2 --structure svo -o a.nvdb", 2, {"goes without"});
    expectError("build cube.glb --resolution 16 --distance 16 -o a.nvdb", 2, {"--distance"});
}

TEST_F(CliRun, EditsTreesByScripts)
{
    run("build cube.glb --resolution 16 --fill solid -o full.zvo");
    m_dir.write("cut.json", R"({"schema": "zvo.edits/1", "about": "half of it", "edits": [
        {"action": "carve", "mesh": {"file": "cube.glb", "place": {"translation": [0, 0.5, 0]}}},
        {"action": "carve", "sphere": {"centre": [-9, 0, 0], "radius": 1}}]})");
    run("edit full.zvo cut.json -o half.zvo");
    run("edit full.zvo cut.json -o half.morton");
    const auto report = printedBy("inspect half.zvo --json");
    const std::size_t left = file("half.morton").size() / sizeof(std::uint64_t);
    EXPECT_EQ(report["voxels"], left);
    EXPECT_GT(left, 16U * 16 * 4);
    EXPECT_LT(left, 16U * 16 * 9);
    run("validate half.zvo");
    run("build cube.glb --resolution 16 -o dag.zvo");
    run("edit dag.zvo cut.json -o dag_cut.zvo");
    EXPECT_EQ(printedBy("inspect dag_cut.zvo --json")["structure"], "svdag");
    EXPECT_EQ(report["structure"], "svdag"); // of a filled DAG
    run("edit full.zvo cut.json -o octree.zvo --structure svo");
    run("algebra octree.zvo -o again.zvo");
    EXPECT_EQ(file("again.zvo"), file("half.zvo"));
    expectError("edit full.zvo missing.json -o a.zvo", 3, {"missing.json"});
    m_dir.write("bad.json", R"({"schema": "zvo.edits/1", "edits": [{"action": "carve", "mesh": {"file": "no.obj"}}]})");
    expectError("edit full.zvo bad.json -o a.zvo", 3, {"no.obj"});
}

TEST_F(CliRun, CalculatesWithTreesInTheOrderOfTheCommandLine)
{
    run("build cube.glb --resolution 16 --structure svo -o shell.zvo");
    const auto voxels = [&](const std::string& steps)
    {
        run("algebra shell.zvo " + steps + " -o a.morton -f");
        return file("a.morton").size() / sizeof(std::uint64_t);
    };
    constexpr std::size_t kSolid = 16 * 16 * 16; // the cube is the whole grid
    constexpr std::size_t kShell = kSolid - 14 * 14 * 14;
    EXPECT_EQ(voxels("--dilate 2"), kSolid - 10 * 10 * 10);
    EXPECT_EQ(voxels("--erode 1"), 12 * 14 + 8); // the edges: what lies outside of the grid takes nothing away
    EXPECT_EQ(voxels("--neighbors 26 --close 3 --keep-largest 1"), kShell);
    run("build cube.glb --resolution 16 -o dag.zvo");
    EXPECT_EQ(voxels("--enclose --subtract dag.zvo"), kSolid - kShell);
    EXPECT_EQ(voxels("--subtract dag.zvo --enclose --unite dag.zvo"), kShell);
    run("algebra shell.zvo --enclose -o full.zvo");
    run("validate full.zvo");
    run("algebra full.zvo --intersect full.zvo --subtract shell.zvo -o core.zvo --components sizes.csv");
    EXPECT_EQ(file("sizes.csv"), "voxels,x,y,z\n2744,1,1,1\n");
    run("build cube.glb --resolution 32 -o fine.zvo");
    expectError("algebra shell.zvo --unite fine.zvo -o b.zvo", 3, {"fine.zvo", "--resolution"});
    expectError("algebra shell.zvo --dilate 0 -o b.zvo", 2, {"--dilate"});
    expectError("algebra shell.zvo --dilate 1", 2, {"--output or --components"});
    run("algebra full.zvo -o octree.zvo --structure svo");
    run("algebra octree.zvo --intersect full.zvo -o again.zvo");
    EXPECT_EQ(file("again.zvo"), file("full.zvo")); // a filled DAG, of a DAG or an octree
}

TEST_F(CliRun, PlyFileHoldsCentersNormalsAndColors)
{
    run("voxelize cube.glb -o cube.ply --resolution 32");
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

    run("voxelize moved.glb -o 1.morton --resolution 32 --json 1.json");
    const json grid = jsonFile("1.json")["grid"];
    for (int axis = 0; axis < 3; ++axis)
    {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(asFloat(grid["origin"][axis])),
                  std::bit_cast<std::uint32_t>(expected.origin[axis]));
    }
    EXPECT_EQ(std::bit_cast<std::uint32_t>(asFloat(grid["voxel_size"])),
              std::bit_cast<std::uint32_t>(expected.voxel_size));
    EXPECT_EQ(grid["depth"], kDepth);

    run("voxelize moved.glb -o 2.morton --resolution 32 --json 2.json --grid " + gridText(grid));
    EXPECT_EQ(jsonFile("2.json")["octree_sha256"], jsonFile("1.json")["octree_sha256"]);
}

TEST_F(CliRun, BoundsFixTheGrid)
{
    const json report =
        printedBy("voxelize cube.glb -o cube.morton --resolution 32 --bounds -1.5,-.25,0,.5,1,1 --json -");
    const Grid grid = Grid::withCorner({{-1.5F, -0.25F, 0.0F}, {0.5F, 1.0F, 1.0F}}, kDepth);
    EXPECT_EQ(asFloat(report["grid"]["origin"][0]), -1.5F);
    EXPECT_EQ(asFloat(report["grid"]["voxel_size"]), 2.0F / 32.0F);
    EXPECT_EQ(codes("cube.morton"), voxelCodes(device(), build(grid).octree));
}

TEST_F(CliRun, RenderWritesAPictureAndItsNumbers)
{
    run("render cube.glb -o front.png --resolution 32 --size 96x64 --view albedo --json front.json");
    const json report = jsonFile("front.json");
    expectFields(report, kOctreeFields);
    expectFields(report, {"trace_ms number", "capped_rays number"});
    EXPECT_EQ(report["schema"], "zvo.render/1");
    EXPECT_EQ(report["capped_rays"], 0);
    EXPECT_EQ(report["octree_sha256"], octreeSha256(device(), build(m_grid).octree));
    EXPECT_GT(report["trace_ms"], 0.0);

    const Image image = pixels("front.png");
    ASSERT_EQ(image.width, 96U);
    ASSERT_EQ(image.height, 64U);
    const std::uint8_t* const center = image.rgba.data() + std::size_t{4} * (32 * 96 + 48);
    EXPECT_EQ(center[0], 0); // the camera looks at the face of the z axis, which is blue
    EXPECT_EQ(center[1], 0);
    EXPECT_EQ(center[2], 255);

    const std::string to_stdout = "render cube.glb -o - --resolution 32 --size 96x64 ";
    EXPECT_EQ(run(to_stdout + "--view albedo --camera front").out, file("front.png"));
    EXPECT_TRUE(run(to_stdout + "--camera 0.5,.5,4,0.5,0.5,-1e1,45.83662").out.starts_with("\x89PNG"));
}

TEST_F(CliRun, FramesTurnOnceAround)
{
    const std::string render = "render cube.glb --resolution 32 --size 64x64 --view normal --attributes none ";
    run(render + "-o f_##.png --frames 0..3");
    run(render + "-o one.png");
    EXPECT_EQ(file("f_00.png"), file("one.png"));
    EXPECT_NE(file("f_01.png"), file("f_00.png"));
    EXPECT_EQ(filesIn(m_dir.path()),
              (std::vector<std::string>{"cube.glb", "f_00.png", "f_01.png", "f_02.png", "f_03.png", "one.png"}));
}

TEST_F(CliRun, InfoListsDevices)
{
    const json info = printedBy("info --json");
    EXPECT_EQ(info["schema"], "zvo.info/1");
    expectFields(info,
                 {"devices[].index number", "devices[].name string", "devices[].type string", "devices[].driver string",
                  "devices[].usable boolean", "devices[].chosen boolean", "devices[].present[] string"});
    EXPECT_TRUE(info["devices"][0]["missing"].is_array());
    EXPECT_TRUE(info["devices"][0]["reasons"].is_array());
    const std::string type = info["devices"][0]["type"];
    EXPECT_TRUE(type != "cpu" || contains(run("info --device cpu").out, "<- would be used"));
    const Outcome none = runZvo(m_dir.path(), "info --device voodoo");
    EXPECT_EQ(none.exit_code, 5);
    EXPECT_TRUE(contains(none.out, info["devices"][0]["name"].get<std::string>()));
}

TEST_F(CliRun, PipelinesAreKeptInTheCacheFolder)
{
    const TempDir cache;
    const Outcome outcome = runZvo(m_dir.path(), "voxelize cube.glb -o cube.ply --resolution 8",
                                   {"XDG_CACHE_HOME=" + cache.path().string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(filesIn(cache.path() / "zvo"), std::vector<std::string>{"pipelines.bin"});
}

} // namespace
} // namespace zvo::test
