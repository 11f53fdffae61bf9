// SPDX-License-Identifier: MIT
// .zvo files in the program: build, inspect, validate, render, convert, and refusals.
#include "cli/cli_folder.h"
#include "io/file/sha256.h"

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

class CliTree : public CliFolder
{
protected:
    // Makes svo.zvo and svdag.zvo, the cube at 32^3.
    void buildBoth() const
    {
        for (const std::string structure : {"svo", "svdag"})
        {
            run("build cube.glb --resolution 32 -o " + structure + ".zvo --structure " + structure);
        }
    }

    [[nodiscard]] json inspected(const std::string& name) const { return printedBy("inspect --json " + name); }

    [[nodiscard]] std::string shaOf(const std::string& name) const
    {
        const std::string content = file(name);
        return sha256Hex(std::as_bytes(std::span(content)));
    }
};

TEST_F(CliTree, InspectTellsExactlyTheseFields)
{
    buildBoth();
    const json voxelized = printedBy("voxelize cube.glb -o cube.ply --resolution 32 --json -");
    for (const std::string structure : {"svo", "svdag"})
    {
        const std::string name = structure + ".zvo";
        const json report = inspected(name);
        std::vector<std::string> fields;
        for (const auto& [field, value] : report.items())
        {
            fields.push_back(field);
        }
        EXPECT_EQ(fields, (std::vector<std::string>{"attribute_bytes", "geometry_bytes", "geometry_bytes_per_voxel",
                                                    "grid", "interior_voxels", "nodes", "nodes_per_level", "rank_bytes",
                                                    "schema", "sha256", "slides_dag_bytes", "slides_octree_bytes",
                                                    "structure", "voxels"}));
        EXPECT_EQ(report["schema"], "zvo.inspect/1");
        EXPECT_EQ(report["structure"], structure);
        EXPECT_EQ(report["grid"], voxelized["grid"]);
        EXPECT_EQ(report["voxels"], voxelized["voxels"]);
        EXPECT_EQ(report["sha256"], shaOf(name));
        EXPECT_EQ(report["geometry_bytes_per_voxel"],
                  report["geometry_bytes"].get<double>() / report["voxels"].get<double>());
        std::uint64_t nodes = 0;
        for (const json& count : report["nodes_per_level"])
        {
            nodes += count.get<std::uint64_t>();
        }
        EXPECT_EQ(report["nodes"], nodes);
        const std::string text = run("inspect " + name).out;
        EXPECT_NE(text.find(shaOf(name)), std::string::npos) << text;
        EXPECT_NE(text.find("68-byte nodes"), std::string::npos) << text;
    }
    const json svo = inspected("svo.zvo");
    EXPECT_EQ(svo["nodes"], voxelized["nodes"]);
    EXPECT_EQ(svo["geometry_bytes"], voxelized["bytes"]["geometry"]);
    EXPECT_EQ(svo["attribute_bytes"], voxelized["bytes"]["attributes"]);
    const json svdag = inspected("svdag.zvo");
    EXPECT_LT(svdag["nodes"], svo["nodes"]);
    EXPECT_EQ(svdag["slides_octree_bytes"], svo["slides_octree_bytes"]);
    EXPECT_EQ(svdag["slides_dag_bytes"], svo["slides_dag_bytes"]);
}

TEST_F(CliTree, ValidateAcceptsWhatBuildWrites)
{
    buildBoth();
    run("build cube.glb -o none.zvo --resolution 32 --attributes none");
    run("build cube.glb -o empty.zvo --resolution 32 --bounds 5,5,5,6,6,6");
    for (const std::string name : {"svo.zvo", "svdag.zvo", "none.zvo", "empty.zvo"})
    {
        EXPECT_NE(run("validate " + name).out.find("sound"), std::string::npos);
    }
    const json none = inspected("none.zvo");
    EXPECT_EQ(none["attribute_bytes"], 0);
    const json empty = inspected("empty.zvo");
    EXPECT_EQ(empty["voxels"], 0);
    EXPECT_EQ(empty["geometry_bytes_per_voxel"], 0.0);
    run("render empty.zvo -o empty.png --size 16x16");
    for (const std::string format : {"ply", "vox", "morton", "glb", "nvdb"})
    {
        run("convert empty.zvo -o empty." + format);
    }
}

TEST_F(CliTree, PicturesOfFilesAreThoseOfTheScene)
{
    buildBoth();
    const std::string render = "render --size 96x64 --camera 2,2.5,3,0.5,0.5,0.5 ";
    run(render + "cube.glb -o scene.png --resolution 32");
    run(render + "svo.zvo -o svo.png");
    run(render + "svdag.zvo -o svdag.png --json svdag.json");
    EXPECT_TRUE(file("svo.png") == file("scene.png"));
    EXPECT_TRUE(file("svdag.png") == file("scene.png"));
    const json report = jsonFile("svdag.json");
    EXPECT_EQ(report["schema"], "zvo.render_tree/1");
    EXPECT_EQ(report["structure"], "svdag");
}

// Renders and converts packed attributes of both structures.
TEST_F(CliTree, PackedAttributesGoWhereOthersGo)
{
    buildBoth();
    const std::uint64_t plain_bytes = inspected("svdag.zvo")["attribute_bytes"];
    for (const std::string attributes : {"4", "block"})
    {
        for (const std::string structure : {"svo", "svdag"})
        {
            const std::string name = structure + attributes + ".zvo";
            run("build cube.glb -o " + name + " --resolution 32 --structure " + structure + " --attributes " +
                attributes + " --json " + structure + attributes + ".json");
            const json report = jsonFile(structure + attributes + ".json");
            EXPECT_EQ(report["attribute_form"], attributes);
            EXPECT_GT(report["pack_ms"], 0.0);
            EXPECT_NE(run("validate " + name).out.find("sound"), std::string::npos);
            const std::string text = run("inspect " + name).out;
            EXPECT_NE(text.find("form " + attributes + ": "), std::string::npos) << text;
            const json packed = inspected(name);
            EXPECT_LT(packed["attribute_bytes"], plain_bytes * 6 / 10);
            EXPECT_EQ(packed["attribute_bytes"], report["bytes"]["attributes"]);
            run("render " + name + " -o " + structure + attributes + ".png --size 96x64");
            for (const std::string format : {"ply", "vox", "morton", "glb", "nvdb"})
            {
                run("convert " + name + " -o " + structure + attributes + "." + format);
            }
        }
        for (const std::string extension : {".png", ".ply", ".vox", ".morton", ".glb", ".nvdb"})
        {
            EXPECT_EQ(shaOf("svo" + attributes + extension), shaOf("svdag" + attributes + extension)) << extension;
        }
        run("convert svo" + attributes + ".zvo -o again.zvo -f");
        EXPECT_EQ(shaOf("again.zvo"), shaOf("svdag" + attributes + ".zvo"));
    }
}

TEST_F(CliTree, ConvertWritesWhatVoxelizeWrites)
{
    buildBoth();
    for (const std::string format : {"ply", "morton"})
    {
        run("voxelize cube.glb -o scene." + format + " --resolution 32");
        run("convert svo.zvo -o svo." + format);
        run("convert svdag.zvo -o svdag." + format);
        EXPECT_EQ(shaOf("svo." + format), shaOf("scene." + format));
        EXPECT_EQ(shaOf("svdag." + format), shaOf("scene." + format));
        EXPECT_TRUE(run("convert svdag.zvo -o - --format " + format).out == file("scene." + format));
    }
    run("convert svo.zvo -o again.zvo");
    EXPECT_EQ(shaOf("again.zvo"), shaOf("svdag.zvo"));
}

TEST_F(CliTree, MeshesOfVoxelsCanBeVoxelized)
{
    buildBoth();
    run("convert svo.zvo -o svo.glb");
    run("convert svdag.zvo -o svdag.glb");
    EXPECT_EQ(shaOf("svo.glb"), shaOf("svdag.glb"));
    const json report = printedBy("voxelize svo.glb -o again.morton --resolution 32 --json -");
    EXPECT_GT(report["voxels"], 32 * 32 * 5);
}

TEST_F(CliTree, RefusalsAreOneLineWithTheirExitCode)
{
    buildBoth();
    std::string cut = file("svo.zvo");
    cut.resize(cut.size() / 2);
    m_dir.write("cut.zvo", cut);
    std::string changed = file("svo.zvo");
    changed[changed.size() - 1] ^= 1;
    m_dir.write("changed.zvo", changed);
    m_dir.write("text.zvo", std::string_view("ply\n"));
    m_dir.write("voxels.scene.json", std::string_view(R"({"objects": [{"name": "a", "file": "broken.vox"}]})"));
    m_dir.write("broken.vox", std::string_view("VOX \x96\0\0\0MAIN\0\0\0\0\xff\0\0\0", 20));
    const std::vector<std::string> before = filesIn(m_dir.path());
    struct Refusal
    {
        const char* arguments;
        int exit_code;
        const char* words;
    };
    constexpr Refusal kRefusals[] = {
        {"inspect absent.zvo", 3, "absent.zvo"},
        {"inspect cut.zvo", 3, "cut short"},
        {"validate changed.zvo", 3, "do not match their checksum"},
        {"render changed.zvo -o a.png", 3, "do not match their checksum"},
        {"convert changed.zvo -o a.ply", 3, "do not match their checksum"},
        {"validate text.zvo", 3, "not a .zvo file"},
        {"validate cube.glb", 3, "zvo build makes one of a scene"},
        {"convert cube.glb -o a.ply", 3, "neither a .zvo nor a .vox file"},
        {"convert broken.vox -o a.zvo", 3, "cut short"},
        {"voxelize svo.zvo -o a.ply", 3, "svo.zvo: it holds voxels and no triangles"},
        {"build broken.vox -o a.zvo", 3, "zvo convert makes a .zvo file"},
        {"render voxels.scene.json -o a.png", 3, "broken.vox: it holds voxels and no triangles"},
        {"render broken.vox -o a.png", 3, "cut short"},
        {"inspect broken.vox", 3, "cut short"},
        {"validate broken.vox", 3, "cut short"},
        {"render broken.vox -o a.png --resolution 64", 2, "--resolution does not go with broken.vox"},
        {"render broken.vox -o a.png --margin 8", 2, "--margin does not go with broken.vox"},
        {"render cube.glb broken.vox -o a.png", 2, "broken.vox stands alone; show one .zvo or .vox file"},
        {"convert svo.zvo -o a.stl", 2, ".morton"},
        {"convert svo.zvo -o svo.zvo -f", 2, "overwritten"},
        {"convert svdag.zvo -o a.zvo --structure svo", 2, "cannot become an octree"},
        {"build cube.glb -o a.ply", 2, "name it .zvo"},
        {"build cube.glb -o a.zvo --structure grid", 2, "svo or svdag"},
        {"build cube.glb -o a.zvo --attributes 5", 2, "--attributes 5"},
        {"render svo.zvo -o a.png --resolution 64", 2, "--resolution does not go with svo.zvo"},
        {"render svo.zvo -o a.png --attributes none", 2, "--attributes does not go with"},
        {"render svo.zvo -o a.png --structure svdag", 2, "--structure does not go with"},
        {"render svo.zvo cube.glb -o a.png", 2, "stands alone"},
        {"build cube.glb -o svo.zvo --resolution 32", 4, "exists already"},
        {"build cube.glb -o /dev/full --resolution 8", 2, "name it .zvo"},
        {"convert svo.zvo -o /dev/full --format zvo", 4, "No space left"},
        {"convert svo.zvo -o /dev/full --format glb", 4, "No space left"},
        {"convert svo.zvo -o /dev/full --format vox", 4, "No space left"},
        {"convert svo.zvo -o /dev/full --format nvdb", 4, "No space left"},
    };
    for (const Refusal& refusal : kRefusals)
    {
        expectError(refusal.arguments, refusal.exit_code, {refusal.words});
        EXPECT_EQ(filesIn(m_dir.path()), before);
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

TEST_F(CliTree, AFullDiskLeavesTheOldFile)
{
    buildBoth();
    for (const std::string name : {"a.zvo", "a.ply", "a.vox", "a.morton", "a.glb", "a.nvdb"})
    {
        m_dir.write(name, std::string_view("old"));
    }
    const std::vector<std::string> before = filesIn(m_dir.path());
    const std::vector<CommandLine> commands = {
        "build cube.glb -o a.zvo -f --resolution 32 --structure svo",
        "build cube.glb -o a.zvo -f --resolution 32 --attributes block",
        "convert svo.zvo -o a.zvo -f",
        "convert svdag.zvo -o a.ply -f",
        "convert svdag.zvo -o a.vox -f",
        "convert svdag.zvo -o a.morton -f",
        "convert svdag.zvo -o a.glb -f",
        "convert svdag.zvo -o a.nvdb -f",
    };
    for (const CommandLine& command : commands)
    {
        Outcome outcome;
        {
            const FileSizeLimit limit(4096); // all of these files are larger
            // One in a process, where main() has to deal with the signal.
            outcome = &command == &commands.front() ? ZvoProcess(m_dir.path(), command).wait()
                                                    : runZvo(m_dir.path(), command);
        }
        const std::string& name = command[3];
        expectErrorLine(outcome, 4, {name});
        EXPECT_TRUE(file(name) == "old") << name;
        EXPECT_EQ(filesIn(m_dir.path()), before);
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
TEST_F(CliTree, AKillInTheMiddleLeavesTheOldFile)
{
    const std::string scene = (m_dir.path() / "cube.glb").string();
    const std::string tree = (m_dir.path() / "big.zvo").string();
    run("build cube.glb -o big.zvo --resolution 512 --structure svo");
    const TempDir out;
    const std::vector<CommandLine> commands = {
        "convert " + tree + " -o a.ply -f",
        "build " + scene + " -o a.zvo -f --resolution 512 --structure svo",
    };
    for (const CommandLine& command : commands)
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
TEST_F(CliTree, FilesAreTheSameBytesOnEveryRun)
{
    for (const std::string form : {"svo --attributes 8", "svdag --attributes none", "svdag --attributes 4",
                                   "svdag --attributes 8", "svdag --attributes block"})
    {
        const std::string arguments = "build cube.glb -o again.zvo -f --resolution 32 --structure " + form;
        run(arguments);
        const std::string sha = shaOf("again.zvo");
        for (const std::vector<std::string>& environment :
             {std::vector<std::string>{"LP_NUM_THREADS=0"}, {"LP_NUM_THREADS=4"}, vectorsOf(128)})
        {
            const Outcome outcome = runZvo(m_dir.path(), arguments, environment);
            EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
            EXPECT_EQ(shaOf("again.zvo"), sha) << form << " " << environment.front();
        }
    }
}

} // namespace
} // namespace zvo::test
