// SPDX-License-Identifier: MIT
// Messages and exit codes when something is wrong: one line on standard error, and the right code.
#include "cli/cli_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <ostream>
#include <sys/stat.h>
#include <thread>

namespace zvo::test
{
namespace
{

const std::vector<WrongUse>& wrongUses()
{
    static const std::vector<WrongUse> uses = {
        {"NoCommand", 2, "", {"render, voxelize, build, inspect, validate, convert, edit, algebra, query or info"}},
        {"UnknownCommand", 2, "bake cube.glb -o a.png", {"no command or option bake; see zvo --help"}},
        {"MistypedCommand", 2, "rendr cube.glb -o a.png", {"rendr (did you mean render?); see zvo --help"}},
        {"MistypedOption",
         2,
         "render cube.glb -o a.png --integrater=path",
         {"--integrater (did you mean --integrator?)"}},
        {"MistypedOutput", 2, "render cube.glb --ouput a.png", {"--ouput (did you mean --output?)"}},
        {"HelpOfNoCommand", 2, "help vaildate", {"render, voxelize", "did you mean validate?"}},
        {"HelpOfTwo", 2, "help render info", {"one command"}},
        {"UnknownFlag", 2, "render cube.glb -o a.png --colour", {"--colour", "zvo render --help"}},
        {"NoScene", 2, "render -o a.png", {"SCENE"}},
        {"NoOutput", 2, "render cube.glb", {"--output"}},
        {"OutputWithoutAName", 2, {"voxelize", "cube.glb", "--format", "ply", "-o", ""}, {"-o needs a file's name"}},
        {"ReportWithoutAName", 2, {"render", "cube.glb", "-o", "a.png", "--json", ""}, {"--json needs a file's name"}},
        {"ResolutionOfNoPowerOfTwo", 2, "render cube.glb -o a.png --resolution 500", {"500", "power of two"}},
        {"ResolutionTooHigh", 2, "render cube.glb -o a.png --resolution 262144", {"262144", "131072"}},
        {"TuningOfNothing", 2, "render cube.glb -o a.png --tuning rows=3", {"--tuning rows=3", "block-lanes"}},
        {
            "TuningOfAnotherValue",
            2,
            "render cube.glb -o a.png --tuning block-lanes=3",
            {"--tuning block-lanes=3", "16, 32"},
        },
        {"FlagTwice",
         2,
         "voxelize cube.glb -o a.ply --resolution 8 --resolution 16",
         {"--resolution is given more than once;"}},
        {"SizeOfOneNumber", 2, "render cube.glb -o a.png --size 1280", {"1280x720"}},
        {"UnknownView", 2, "render cube.glb -o a.png --view xray", {"xray", "normal"}},
        {"UnknownCamera", 2, "render cube.glb -o a.png --camera bakc", {"did you mean back?", "\"front\"", "iso"}},
        {"CameraOfFiveNumbers", 2, "render cube.glb -o a.png --camera 1,2,3,4,5", {"5 numbers"}},
        {"BoundsUpsideDown", 2, "voxelize cube.glb -o a.ply --bounds 1,0,0,0,1,1", {"x0 <= x1"}},
        {"BoundsAndGrid", 2, "voxelize cube.glb -o a.ply --bounds 0,0,0,1,1,1 --grid 0,0,0,1", {"--grid"}},
        {"MemoryLimitWithoutNumber", 2, "voxelize cube.glb -o a.ply --memory-limit G", {"512M"}},
        {"MemoryLimitInBytesOfNothing", 2, "voxelize cube.glb -o a.ply --memory-limit 2iB", {"512M"}},
        {"MarginAndGrid", 2, "voxelize cube.glb -o a.ply --margin 1 --grid 0,0,0,1", {"--margin"}},
        {"MarginOfTheWholeGrid", 2, "voxelize cube.glb -o a.ply --margin 4 --resolution 8", {"--margin", "8 voxels"}},
        {"NumberInAnotherLocale", 2, "voxelize cube.glb -o a.ply --grid 0;0;0;0,1", {"numbers"}},
        {"PictureOfUnknownExtension", 2, "render cube.glb -o a.bmp", {"a.bmp", ".png", ".webp"}},
        {"RadianceOfAView", 2, "render cube.glb -o a.exr --view normal", {"a.exr", "--view shows no radiance"}},
        {"RadianceOfASheet", 2, "render cube.glb -o a.exr --integrator path --sheet top,iso", {"--sheet", ".png"}},
        {"SheetOfNoCamera", 2, "render cube.glb -o a.png --sheet top,bottom", {"bottom: there is no such camera"}},
        {"SheetOfAnEmptyName", 2, "render cube.glb -o a.png --sheet top,,iso", {"names with commas"}},
        {"SheetAndCamera", 2, "render cube.glb -o a.png --sheet top,iso --camera front", {"--sheet"}},
        {"WebpTooWide", 2, "render cube.glb -o a.webp --size 16384x16", {"16383"}},
        {"QualityOfAPng", 2, "render cube.glb -o a.png --quality 50", {"--quality needs", ".jpg or .webp"}},
        {"QualityTooHigh", 2, "render cube.glb -o a.jpg --quality 101", {"1 to 100"}},
        {"TurntableOfNone", 2, "render cube.glb -o a_#.png --turntable 0", {"--turntable 0"}},
        {"TurntableAndFrames", 2, "render cube.glb -o a_#.png --turntable 3 --frames 0..2", {"--frames"}},
        {"DenoisedPrimaryRays", 2, "render cube.glb -o a.png --denoise", {"--denoise needs --integrator path"}},
        {"VoxelsOfUnknownExtension", 2, "voxelize cube.glb -o a.vox", {"a.vox", ".morton", ".ply"}},
        {"FramesWithoutPlaceForNumber", 2, "render cube.glb -o a.jpg --frames 0..3", {"####"}},
        {"FramesBackwards", 2, "render cube.glb -o a_#.png --frames 3..0", {"0..35"}},
        {"BothOutputsToStandardOutput", 2, "render cube.glb -o - --json -", {"two places"}},
        {"BothOutputsToOneFile", 2, "render cube.glb -o a.png --json ./a.png", {"two places"}},

        {"OutputIsTheInput", 2, "voxelize cube.glb -o ./cube.glb --format ply -f", {"overwritten"}},
        {"ReportIsTheInput", 2, "render cube.glb -o a.png --json cube.glb -f", {"overwritten"}},

        {"InputIsADevice", 3, "render /dev/zero -o a.png", {"/dev/zero", "device"}},
        {"InputIsAPipe", 3, "render pipe.obj -o a.png", {"pipe.obj", "a pipe, not a file"}},
        {"EmptyName", 3, {"render", "", "-o", "a.png"}, {"cannot read \"\": No such file"}},
        {"MissingFile", 3, "render absent.glb -o a.png", {"absent.glb", "No such file"}},
        {"BrokenGlb", 3, "render broken.glb -o a.png", {"broken.glb"}},
        {"EmptyFile", 3, "voxelize empty.glb -o a.ply", {"empty.glb"}},
        {"MissingBuffer", 3, "voxelize no_buffer.gltf -o a.ply", {"absent.bin"}},
        {"UnknownRequiredExtension", 3, "voxelize extension.glb -o a.ply", {"EXT_from_the_future"}},

        {"PictureExists", 4, "render cube.glb -o taken.png", {"taken.png", "-f"}},
        {"ReportExists", 4, "render cube.glb -o a.png --json taken.png", {"taken.png", "-f"}},
        {"FrameExists", 4, "render cube.glb -o frame#.png --frames 0..3", {"frame2.png", "-f"}},
        {"OutputInMissingFolder", 4, "voxelize absent.glb -o absent/a.ply", {"absent/a.ply"}},
        {"OutputIsAFolder", 4, "voxelize cube.glb -o . --format ply", {"directory"}},
        {"DiskFull", 4, "voxelize cube.glb -o /dev/full --format ply --resolution 8", {"No space left"}},

        {"UnknownDevice", 5, "voxelize cube.glb -o a.ply --device voodoo", {"voodoo", "the devices are 0: "}},
        {"NoDriver",
         5,
         "voxelize cube.glb -o a.ply",
         {"Vulkan"},
         {"VK_ICD_FILENAMES=/absent.json", "VK_DRIVER_FILES=/absent.json"}},

        {
            "PictureTooLarge",
            6,
            "render cube.glb -o a.png --resolution 8 --size 16384x16384 --memory-limit 1G",
            {"16384 x 16384 pixels (--size)", "raise --memory-limit, or", "a smaller picture"},
        },
        {"MemoryLimitTooLow", 6, "voxelize cube.glb -o a.ply --memory-limit 64KiB", {"raise --memory-limit, or"}},
    };
    return uses;
}

class CliError : public CliFolder, public testing::WithParamInterface<WrongUse>
{
};

INSTANTIATE_TEST_SUITE_P(Cli, CliError, testing::ValuesIn(wrongUses()),
                         [](const auto& test_case) { return std::string(test_case.param.name); });

TEST_P(CliError, IsOneLineAndAnExitCodeAndLeavesNothingBehind)
{
    GltfBuilder builder = coloredCube();
    const std::vector<std::uint8_t> cube = builder.glb();
    m_dir.write("broken.glb", std::span(cube).first(cube.size() / 2));
    m_dir.write("empty.glb", std::string_view());
    ASSERT_EQ(mkfifo((m_dir.path() / "pipe.obj").c_str(), S_IRUSR | S_IWUSR), 0);
    m_dir.write("taken.png", std::string_view("kept"));
    m_dir.write("frame2.png", std::string_view("kept"));
    json no_buffer = builder.finished();
    no_buffer["buffers"][0]["uri"] = "absent.bin";
    m_dir.write("no_buffer.gltf", no_buffer.dump());
    builder.document["extensionsUsed"] = builder.document["extensionsRequired"] = {"EXT_from_the_future"};
    m_dir.write("extension.glb", builder.glb());
    const std::vector<std::string> before = filesIn(m_dir.path());

    const Outcome outcome = runZvo(m_dir.path(), GetParam().arguments, GetParam().environment);
    expectErrorLine(outcome, GetParam().exit_code, GetParam().words);
    EXPECT_EQ(filesIn(m_dir.path()), before);
    EXPECT_EQ(file("taken.png"), "kept");
}

using Cli = CliFolder;

TEST_F(Cli, InterruptLeavesNoFile)
{
    const TempDir out;
    for (const int signal : {SIGINT, SIGTERM})
    {
        ZvoProcess process(out.path(),
                           "voxelize " + (m_dir.path() / "cube.glb").string() + " -o a.ply --resolution 2048");
        while (filesIn(out.path()).empty()) // the output begins with a temporary file
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        process.signal(signal);
        const Outcome outcome = process.wait();
        EXPECT_EQ(outcome.exit_code, 128 + signal) << outcome.err;
        EXPECT_EQ(filesIn(out.path()), std::vector<std::string>{});
    }
}

TEST_F(Cli, ForceOverwrites)
{
    m_dir.write("a.morton", std::string_view("old"));
    run("voxelize cube.glb -o a.morton --resolution 8 -f");
    EXPECT_EQ(file("a.morton").size() % 8, 0U);
    EXPECT_EQ(filesIn(m_dir.path()), (std::vector<std::string>{"a.morton", "cube.glb"}));
}

} // namespace
} // namespace zvo::test
