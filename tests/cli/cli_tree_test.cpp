// SPDX-License-Identifier: MIT
// .zvo files in the program: build, inspect, validate, render, convert, and refusals.
#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "io/file/sha256.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <thread>

namespace zvo::test
{
namespace
{

std::string succeed(const TempDir& dir, const std::vector<std::string>& arguments)
{
    const Outcome outcome = runZvo(dir.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments.front() << ": " << outcome.err;
    return outcome.out;
}

void writeCube(const TempDir& dir)
{
    dir.write("cube.glb", coloredCube().glb());
}

// The cube at 32^3, in both structures.
void buildBoth(const TempDir& dir)
{
    writeCube(dir);
    succeed(dir, {"build", "cube.glb", "-o", "svo.zvo", "--resolution", "32", "--structure", "svo"});
    succeed(dir, {"build", "cube.glb", "-o", "svdag.zvo", "--resolution", "32", "--structure", "svdag"});
}

std::string shaOf(const TempDir& dir, const std::string& file)
{
    const std::string content = contentOf(dir.path() / file);
    return sha256Hex(std::as_bytes(std::span(content)));
}

TEST(CliTree, InspectTellsExactlyTheseFields)
{
    const TempDir dir;
    buildBoth(dir);
    const json voxelized =
        json::parse(succeed(dir, {"voxelize", "cube.glb", "-o", "cube.ply", "--resolution", "32", "--json", "-"}));
    for (const std::string structure : {"svo", "svdag"})
    {
        const std::string file = structure + ".zvo";
        const json report = json::parse(succeed(dir, {"inspect", file, "--json"}));
        std::vector<std::string> fields;
        for (const auto& [name, value] : report.items())
        {
            fields.push_back(name);
        }
        EXPECT_EQ(fields,
                  (std::vector<std::string>{"attribute_bytes", "geometry_bytes", "geometry_bytes_per_voxel", "grid",
                                            "nodes", "nodes_per_level", "rank_bytes", "schema", "sha256",
                                            "slides_dag_bytes", "slides_octree_bytes", "structure", "voxels"}));
        EXPECT_EQ(report["schema"], "zvo.inspect/1");
        EXPECT_EQ(report["structure"], structure);
        EXPECT_EQ(report["grid"], voxelized["grid"]);
        EXPECT_EQ(report["voxels"], voxelized["voxels"]);
        EXPECT_EQ(report["sha256"], shaOf(dir, file));
        EXPECT_EQ(report["geometry_bytes_per_voxel"],
                  report["geometry_bytes"].get<double>() / report["voxels"].get<double>());
        std::uint64_t nodes = 0;
        for (const json& count : report["nodes_per_level"])
        {
            nodes += count.get<std::uint64_t>();
        }
        EXPECT_EQ(report["nodes"], nodes);
        const std::string text = succeed(dir, {"inspect", file});
        EXPECT_NE(text.find(shaOf(dir, file)), std::string::npos) << text;
        EXPECT_NE(text.find("68-byte nodes"), std::string::npos) << text;
    }
    const json svo = json::parse(succeed(dir, {"inspect", "svo.zvo", "--json"}));
    EXPECT_EQ(svo["nodes"], voxelized["nodes"]);
    EXPECT_EQ(svo["geometry_bytes"], voxelized["bytes"]["geometry"]);
    EXPECT_EQ(svo["attribute_bytes"], voxelized["bytes"]["attributes"]);
    const json svdag = json::parse(succeed(dir, {"inspect", "svdag.zvo", "--json"}));
    EXPECT_LT(svdag["nodes"], svo["nodes"]);
    EXPECT_EQ(svdag["slides_octree_bytes"], svo["slides_octree_bytes"]);
    EXPECT_EQ(svdag["slides_dag_bytes"], svo["slides_dag_bytes"]);
}

TEST(CliTree, ValidateAcceptsWhatBuildWrites)
{
    const TempDir dir;
    buildBoth(dir);
    succeed(dir, {"build", "cube.glb", "-o", "none.zvo", "--resolution", "32", "--attributes", "none"});
    succeed(dir, {"build", "cube.glb", "-o", "empty.zvo", "--resolution", "32", "--bounds", "5,5,5,6,6,6"});
    for (const char* const file : {"svo.zvo", "svdag.zvo", "none.zvo", "empty.zvo"})
    {
        EXPECT_NE(succeed(dir, {"validate", file}).find("sound"), std::string::npos);
    }
    const json none = json::parse(succeed(dir, {"inspect", "none.zvo", "--json"}));
    EXPECT_EQ(none["attribute_bytes"], 0);
    const json empty = json::parse(succeed(dir, {"inspect", "empty.zvo", "--json"}));
    EXPECT_EQ(empty["voxels"], 0);
    EXPECT_EQ(empty["geometry_bytes_per_voxel"], 0.0);
    succeed(dir, {"render", "empty.zvo", "-o", "empty.png", "--size", "16x16"});
    for (const char* const format : {"ply", "vox", "morton", "glb", "nvdb"})
    {
        succeed(dir, {"convert", "empty.zvo", "-o", std::string("empty.") + format});
    }
}

TEST(CliTree, PicturesOfFilesAreThoseOfTheScene)
{
    const TempDir dir;
    buildBoth(dir);
    const std::vector<std::string> view = {"--size", "96x64", "--camera", "2,2.5,3,0.5,0.5,0.5"};
    const auto draw = [&](const std::string& input, const std::string& picture, std::vector<std::string> more)
    {
        std::vector<std::string> arguments = {"render", input, "-o", picture};
        arguments.insert(arguments.end(), view.begin(), view.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        succeed(dir, arguments);
        return contentOf(dir.path() / picture);
    };
    const std::string scene = draw("cube.glb", "scene.png", {"--resolution", "32"});
    EXPECT_TRUE(draw("svo.zvo", "svo.png", {}) == scene);
    EXPECT_TRUE(draw("svdag.zvo", "svdag.png", {"--json", "svdag.json"}) == scene);
    const json report = json::parse(contentOf(dir.path() / "svdag.json"));
    EXPECT_EQ(report["schema"], "zvo.render_tree/1");
    EXPECT_EQ(report["structure"], "svdag");
}

// Renders and converts packed attributes of both structures.
TEST(CliTree, PackedAttributesGoWhereOthersGo)
{
    const TempDir dir;
    buildBoth(dir);
    const std::uint64_t plain_bytes = json::parse(succeed(dir, {"inspect", "svdag.zvo", "--json"}))["attribute_bytes"];
    for (const std::string attributes : {"4", "block"})
    {
        for (const std::string structure : {"svo", "svdag"})
        {
            const std::string file = structure + attributes + ".zvo";
            succeed(dir, {"build", "cube.glb", "-o", file, "--resolution", "32", "--structure", structure,
                          "--attributes", attributes, "--json", structure + attributes + ".json"});
            const json report = json::parse(contentOf(dir.path() / (structure + attributes + ".json")));
            EXPECT_EQ(report["attribute_form"], attributes);
            EXPECT_GT(report["pack_ms"], 0.0);
            EXPECT_NE(succeed(dir, {"validate", file}).find("sound"), std::string::npos);
            const std::string text = succeed(dir, {"inspect", file});
            EXPECT_NE(text.find("form " + attributes + ": "), std::string::npos) << text;
            const json inspected = json::parse(succeed(dir, {"inspect", file, "--json"}));
            EXPECT_LT(inspected["attribute_bytes"], plain_bytes * 6 / 10);
            EXPECT_EQ(inspected["attribute_bytes"], report["bytes"]["attributes"]);
            succeed(dir, {"render", file, "-o", structure + attributes + ".png", "--size", "96x64"});
            for (const std::string format : {"ply", "vox", "morton", "glb", "nvdb"})
            {
                succeed(dir, {"convert", file, "-o", structure + attributes + "." + format});
            }
        }
        for (const std::string extension : {".png", ".ply", ".vox", ".morton", ".glb", ".nvdb"})
        {
            EXPECT_EQ(shaOf(dir, "svo" + attributes + extension), shaOf(dir, "svdag" + attributes + extension))
                << extension;
        }
        succeed(dir, {"convert", "svo" + attributes + ".zvo", "-o", "again.zvo", "-f"});
        EXPECT_EQ(shaOf(dir, "again.zvo"), shaOf(dir, "svdag" + attributes + ".zvo"));
    }
}

TEST(CliTree, ConvertWritesWhatVoxelizeWrites)
{
    const TempDir dir;
    buildBoth(dir);
    for (const std::string format : {"ply", "morton"})
    {
        succeed(dir, {"voxelize", "cube.glb", "-o", "scene." + format, "--resolution", "32"});
        succeed(dir, {"convert", "svo.zvo", "-o", "svo." + format});
        succeed(dir, {"convert", "svdag.zvo", "-o", "svdag." + format});
        EXPECT_EQ(shaOf(dir, "svo." + format), shaOf(dir, "scene." + format));
        EXPECT_EQ(shaOf(dir, "svdag." + format), shaOf(dir, "scene." + format));
        EXPECT_TRUE(succeed(dir, {"convert", "svdag.zvo", "-o", "-", "--format", format}) ==
                    contentOf(dir.path() / ("scene." + format)));
    }
    succeed(dir, {"convert", "svo.zvo", "-o", "again.zvo"});
    EXPECT_EQ(shaOf(dir, "again.zvo"), shaOf(dir, "svdag.zvo"));
}

TEST(CliTree, VoxFilesComeBackWithTheirVoxelsAndColors)
{
    const TempDir dir;
    buildBoth(dir);
    succeed(dir, {"convert", "svdag.zvo", "-o", "cube.vox"});
    succeed(dir, {"convert", "cube.vox", "-o", "back.zvo"});
    succeed(dir, {"validate", "back.zvo"});
    succeed(dir, {"convert", "back.zvo", "-o", "back.morton"});
    succeed(dir, {"convert", "svo.zvo", "-o", "svo.morton"});
    EXPECT_EQ(shaOf(dir, "back.morton"), shaOf(dir, "svo.morton"));
    succeed(dir, {"convert", "back.zvo", "-o", "back.vox"});
    EXPECT_EQ(shaOf(dir, "back.vox"), shaOf(dir, "cube.vox"));
}

TEST(CliTree, MeshesOfVoxelsCanBeVoxelized)
{
    const TempDir dir;
    buildBoth(dir);
    succeed(dir, {"convert", "svo.zvo", "-o", "svo.glb"});
    succeed(dir, {"convert", "svdag.zvo", "-o", "svdag.glb"});
    EXPECT_EQ(shaOf(dir, "svo.glb"), shaOf(dir, "svdag.glb"));
    const json report =
        json::parse(succeed(dir, {"voxelize", "svo.glb", "-o", "again.morton", "--resolution", "32", "--json", "-"}));
    EXPECT_GT(report["voxels"], 32 * 32 * 5);
}

struct Refusal
{
    std::vector<std::string> arguments;
    int exit_code;
    std::string words;
};

TEST(CliTree, RefusalsAreOneLineWithTheirExitCode)
{
    const TempDir dir;
    buildBoth(dir);
    std::string cut = contentOf(dir.path() / "svo.zvo");
    cut.resize(cut.size() / 2);
    dir.write("cut.zvo", cut);
    std::string changed = contentOf(dir.path() / "svo.zvo");
    changed[changed.size() - 1] ^= 1;
    dir.write("changed.zvo", changed);
    dir.write("text.zvo", std::string_view("ply\n"));
    dir.write("broken.vox", std::string_view("VOX \x96\0\0\0MAIN\0\0\0\0\xff\0\0\0", 20));
    const std::vector<std::string> before = filesIn(dir.path());
    const std::vector<Refusal> refusals = {
        {{"inspect", "absent.zvo"}, 3, "absent.zvo"},
        {{"inspect", "cut.zvo"}, 3, "cut short"},
        {{"validate", "changed.zvo"}, 3, "do not match their checksum"},
        {{"render", "changed.zvo", "-o", "a.png"}, 3, "do not match their checksum"},
        {{"convert", "changed.zvo", "-o", "a.ply"}, 3, "do not match their checksum"},
        {{"validate", "text.zvo"}, 3, "not a .zvo file"},
        {{"validate", "cube.glb"}, 3, "not a .zvo file"},
        {{"convert", "cube.glb", "-o", "a.ply"}, 3, "neither a .zvo nor a .vox file"},
        {{"convert", "broken.vox", "-o", "a.zvo"}, 3, "cut short"},
        {{"voxelize", "svo.zvo", "-o", "a.ply"}, 3, "voxels and no triangles"},
        {{"convert", "svo.zvo", "-o", "a.stl"}, 2, ".morton"},
        {{"convert", "svo.zvo", "-o", "svo.zvo", "-f"}, 2, "overwritten"},
        {{"convert", "svdag.zvo", "-o", "a.zvo", "--structure", "svo"}, 2, "cannot become an octree"},
        {{"build", "cube.glb", "-o", "a.ply"}, 2, "name it .zvo"},
        {{"build", "cube.glb", "-o", "a.zvo", "--structure", "grid"}, 2, "svo or svdag"},
        {{"build", "cube.glb", "-o", "a.zvo", "--attributes", "5"}, 2, "--attributes 5"},
        {{"render", "svo.zvo", "-o", "a.png", "--resolution", "64"}, 2, "--resolution does not go with svo.zvo"},
        {{"render", "svo.zvo", "-o", "a.png", "--attributes", "none"}, 2, "--attributes does not go with"},
        {{"render", "svo.zvo", "-o", "a.png", "--structure", "svdag"}, 2, "--structure does not go with"},
        {{"render", "svo.zvo", "cube.glb", "-o", "a.png"}, 2, "stands alone"},
        {{"build", "cube.glb", "-o", "svo.zvo", "--resolution", "32"}, 4, "exists already"},
        {{"build", "cube.glb", "-o", "/dev/full", "--resolution", "8"}, 2, "name it .zvo"},
        {{"convert", "svo.zvo", "-o", "/dev/full", "--format", "zvo"}, 4, "No space left"},
        {{"convert", "svo.zvo", "-o", "/dev/full", "--format", "glb"}, 4, "No space left"},
        {{"convert", "svo.zvo", "-o", "/dev/full", "--format", "vox"}, 4, "No space left"},
        {{"convert", "svo.zvo", "-o", "/dev/full", "--format", "nvdb"}, 4, "No space left"},
    };
    for (const Refusal& refusal : refusals)
    {
        expectErrorLine(runZvo(dir.path(), refusal.arguments), refusal.exit_code, {refusal.words});
        EXPECT_EQ(filesIn(dir.path()), before);
    }
}

// Limits the size of files that this process and its children write.
class FileSizeLimit
{
public:
    explicit FileSizeLimit(rlim_t bytes)
    {
        getrlimit(RLIMIT_FSIZE, &m_before);
        const struct rlimit limit = {bytes, m_before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &m_before); }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    struct rlimit m_before = {};
};

TEST(CliTree, AFullDiskLeavesTheOldFile)
{
    const TempDir dir;
    buildBoth(dir);
    for (const std::string name : {"a.zvo", "a.ply", "a.vox", "a.morton", "a.glb", "a.nvdb"})
    {
        dir.write(name, std::string_view("old"));
    }
    const std::vector<std::string> before = filesIn(dir.path());
    const std::vector<std::vector<std::string>> commands = {
        {"build", "cube.glb", "-o", "a.zvo", "-f", "--resolution", "32", "--structure", "svo"},
        {"build", "cube.glb", "-o", "a.zvo", "-f", "--resolution", "32", "--attributes", "block"},
        {"convert", "svo.zvo", "-o", "a.zvo", "-f"},
        {"convert", "svdag.zvo", "-o", "a.ply", "-f"},
        {"convert", "svdag.zvo", "-o", "a.vox", "-f"},
        {"convert", "svdag.zvo", "-o", "a.morton", "-f"},
        {"convert", "svdag.zvo", "-o", "a.glb", "-f"},
        {"convert", "svdag.zvo", "-o", "a.nvdb", "-f"},
    };
    for (const std::vector<std::string>& command : commands)
    {
        Outcome outcome;
        {
            const FileSizeLimit limit(4096); // all of these files are larger
            // One in a process, where main() has to deal with the signal.
            outcome =
                &command == &commands.front() ? ZvoProcess(dir.path(), command).wait() : runZvo(dir.path(), command);
        }
        const std::string& name = command[3];
        expectErrorLine(outcome, 4, {name});
        EXPECT_TRUE(contentOf(dir.path() / name) == "old") << name;
        EXPECT_EQ(filesIn(dir.path()), before);
    }
}

// Waits until a file beside the one of that name has so many bytes, but at most a minute.
void waitForTemporaryFile(const std::filesystem::path& folder, const std::string& target, std::uintmax_t bytes)
{
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (bool is_writing = false; !is_writing && std::chrono::steady_clock::now() < deadline;)
    {
        for (const std::string& name : filesIn(folder))
        {
            std::error_code gone;
            const std::uintmax_t size = std::filesystem::file_size(folder / name, gone);
            is_writing = is_writing || (name != target && !gone && size >= bytes);
        }
    }
}

// The program is killed while it writes the temporary file, which already has that many bytes.
TEST(CliTree, AKillInTheMiddleLeavesTheOldFile)
{
    const TempDir dir;
    writeCube(dir);
    const std::string scene = (dir.path() / "cube.glb").string();
    const std::string tree = (dir.path() / "big.zvo").string();
    succeed(dir, {"build", "cube.glb", "-o", "big.zvo", "--resolution", "512", "--structure", "svo"});
    const TempDir out;
    const std::vector<std::vector<std::string>> commands = {
        {"convert", tree, "-o", "a.ply", "-f"},
        {"build", scene, "-o", "a.zvo", "-f", "--resolution", "512", "--structure", "svo"},
    };
    for (const std::vector<std::string>& command : commands)
    {
        const std::string& target = command[3];
        out.write(target, std::string_view("old"));
        for (const auto& [signal, bytes] :
             {std::pair{SIGKILL, 0U}, {SIGKILL, 1000000U}, {SIGTERM, 0U}, {SIGTERM, 1000000U}})
        {
            ZvoProcess process(out.path(), command);
            waitForTemporaryFile(out.path(), target, bytes);
            process.signal(signal);
            EXPECT_EQ(process.wait().exit_code, 128 + signal);
            EXPECT_TRUE(contentOf(out.path() / target) == "old");
            if (signal == SIGTERM)
            {
                EXPECT_EQ(filesIn(out.path()), std::vector<std::string>{target});
            }
            for (const std::string& name : filesIn(out.path())) // the file that SIGKILL left has another name
            {
                if (name != target)
                {
                    std::filesystem::remove(out.path() / name);
                }
            }
        }
        std::filesystem::remove(out.path() / target);
    }
}

// scripts/check-svdag does the same with more threads and a larger scene; zvo_determinism_test changes the order of
// triangles.
TEST(CliTree, FilesAreTheSameBytesOnEveryRun)
{
    const TempDir dir;
    writeCube(dir);
    for (const auto& [structure, attributes] :
         {std::pair{"svo", "8"}, {"svdag", "none"}, {"svdag", "4"}, {"svdag", "8"}, {"svdag", "block"}})
    {
        const std::vector<std::string> arguments = {"build",   "cube.glb",     "-o",      "again.zvo",
                                                    "-f",      "--resolution", "32",      "--structure",
                                                    structure, "--attributes", attributes};
        succeed(dir, arguments);
        const std::string sha = shaOf(dir, "again.zvo");
        for (const char* const setting : {"LP_NUM_THREADS=0", "LP_NUM_THREADS=4", "LP_NATIVE_VECTOR_WIDTH=128"})
        {
            const Outcome outcome = runZvo(dir.path(), arguments, {setting});
            EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
            EXPECT_EQ(shaOf(dir, "again.zvo"), sha) << structure << " " << attributes << " " << setting;
        }
    }
}

} // namespace
} // namespace zvo::test
