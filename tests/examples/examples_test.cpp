// SPDX-License-Identifier: MIT
// Runs the examples as a shell would. They show what the command line shows.
#include "cli/run_zvo.h"
#include "common/mesh.h"
#include "examples/composite.h"
#include "io/image/image_io.h"
#include "support/device.h"
#include "support/places.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using test::Outcome;
using test::Picture;

const std::string kCamera = "1.5,2,3.5,0,0,0,26";

// Reads a PPM file of the examples.
Picture readPpm(const std::filesystem::path& path)
{
    const std::string bytes = test::contentOf(path);
    const std::string header = "P6\n320 200\n255\n";
    Picture picture;
    EXPECT_TRUE(bytes.starts_with(header)) << path;
    EXPECT_EQ(bytes.size(), header.size() + 3 * picture.rgb.size()) << path;
    for (std::size_t i = 0; i < picture.rgb.size() && header.size() + 3 * i + 2 < bytes.size(); ++i)
    {
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
            picture.rgb[i][channel] = static_cast<std::uint8_t>(bytes[header.size() + 3 * i + channel]);
        }
    }
    return picture;
}

Picture readPng(const std::filesystem::path& path)
{
    const std::string bytes = test::contentOf(path);
    const Image image =
        decodeImage({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "picture", path.string());
    Picture picture;
    EXPECT_EQ(image.rgba.size(), 4 * picture.rgb.size());
    for (std::size_t i = 0; i < picture.rgb.size() && 4 * i + 3 < image.rgba.size(); ++i)
    {
        std::copy_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, picture.rgb[i].begin());
    }
    return picture;
}

// Of codes.
int largestDifference(const Picture& a, const Picture& b)
{
    int largest = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
    {
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
            largest = std::max(largest, std::abs(int{a.rgb[i][channel]} - int{b.rgb[i][channel]}));
        }
    }
    return largest;
}

std::filesystem::path exampleProgram(const std::string& name)
{
    return test::placeOf(ZVO_EXAMPLES_DIR, "bin") / name;
}

class Examples : public testing::Test
{
protected:
    // Runs an example to its end, with validation if the tests' devices have it. It must print no errors.
    void run(const std::string& name, std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), name);
        arguments.insert(arguments.end(), {"--device", test::deviceOptions().device});
        if (test::deviceOptions().validation)
        {
            arguments.emplace_back("--validation");
        }
        const Outcome outcome = test::ZvoProcess(exampleProgram(name), m_folder.path(), arguments, {}).wait();
        EXPECT_EQ(outcome.exit_code, 0) << name;
        EXPECT_EQ(outcome.err, "") << name;
    }

    // The command line's picture of a file, with the examples' camera; by default of one sample without occlusion, as
    // hosts trace it.
    Picture render(const std::vector<std::string>& scene, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> arguments = {"render", "-f",      "-o",       "cli.png",
                                              "--size", "320x200", "--camera", kCamera};
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        if (std::ranges::find_if(more, [](const std::string& it) { return it == "--view" || it == "--integrator"; }) ==
            more.end())
        {
            arguments.insert(arguments.end(), {"--spp", "1", "--occlusion", "0"});
        }
        const Outcome outcome = test::runZvo(m_folder.path(), arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return readPng(path("cli.png"));
    }

    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return m_folder.path() / name; }

    [[nodiscard]] Picture ppm(const std::string& name) const { return readPpm(path(name)); }

    void writeKnot() const { host::writePly(host::knot(), path("knot.ply")); }

    inline static const std::vector<std::string> kKnot = {"knot.ply", "--resolution", "128"};

private:
    test::TempDir m_folder;
};

TEST_F(Examples, MinimalShowsWhatTheCommandLineShows)
{
    run("embed_minimal", {"minimal.ppm", "--ply", "knot.ply"});
    const Picture expected = render(kKnot);
    EXPECT_EQ(ppm("minimal.ppm"), expected);
    EXPECT_GT(expected.colorCount(), 1000U);
    run("embed_minimal", {"bare.ppm", "--no-optional"});
    EXPECT_EQ(ppm("bare.ppm"), expected);
}

TEST_F(Examples, MinimalShowsTheTreeOfAFile)
{
    writeKnot();
    for (const char* const structure : {"svo", "svdag"})
    {
        const Outcome built = test::runZvo(
            path(""), {"build", "knot.ply", "-f", "-o", "knot.zvo", "--resolution", "256", "--structure", structure});
        EXPECT_EQ(built.exit_code, 0) << built.err;
        run("embed_minimal", {"minimal.ppm", "knot.zvo"});
        EXPECT_EQ(ppm("minimal.ppm"), render({"knot.zvo"})) << structure;
    }
}

TEST_F(Examples, WhatIsNoTreeIsAnErrorInOneLine)
{
    writeKnot();
    const Outcome outcome =
        test::ZvoProcess(exampleProgram("embed_minimal"), path(""),
                         {"embed_minimal", "minimal.ppm", "knot.ply", "--device", test::deviceOptions().device}, {})
            .wait();
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("knot.ply"), std::string::npos);
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1);
}

TEST_F(Examples, TheHostsShaderFindsWhatPicturesShow)
{
    writeKnot();
    const Picture albedo = render(kKnot, {"--view", "albedo"});
    const Picture normals = render(kKnot, {"--view", "normal"});
    EXPECT_NE(albedo, normals);
    run("host_shader", {"albedo.ppm", "normals.ppm"});
    EXPECT_EQ(ppm("albedo.ppm"), albedo);
    EXPECT_LE(largestDifference(ppm("normals.ppm"), normals), 1) << "another kernel may round in another way";
    run("host_shader", {"albedo_bare.ppm", "normals_bare.ppm", "--no-optional"});
    EXPECT_EQ(ppm("albedo_bare.ppm"), albedo);
    EXPECT_LE(largestDifference(ppm("normals_bare.ppm"), normals), 1);
}

TEST_F(Examples, TwoContextsShowTheSame)
{
    writeKnot();
    const Picture expected = render(kKnot);
    run("two_contexts", {"a.ppm", "b.ppm"});
    EXPECT_EQ(ppm("a.ppm"), expected);
    EXPECT_EQ(ppm("b.ppm"), expected);
    run("two_contexts", {"a_bare.ppm", "b_bare.ppm", "--no-optional"});
    EXPECT_EQ(ppm("a_bare.ppm"), expected);
    EXPECT_EQ(ppm("b_bare.ppm"), expected);
}

TEST_F(Examples, FramesAddUpToThePathsOfTheCommandLine)
{
    writeKnot();
    const Picture expected = render(kKnot, {"--integrator", "path", "--spp", "3"});
    EXPECT_NE(expected, render(kKnot, {"--integrator", "path", "--spp", "2"}));
    run("progressive", {"paths.ppm", "3"});
    EXPECT_EQ(ppm("paths.ppm"), expected);
    run("progressive", {"bare.ppm", "3", "--no-optional"});
    EXPECT_EQ(ppm("bare.ppm"), expected);
}

TEST_F(Examples, ArgumentsThatMakeNoSenseAreNamed)
{
    const auto progressive = [&](const std::vector<std::string>& arguments)
    {
        std::vector<std::string> command = {"progressive"};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return test::ZvoProcess(exampleProgram("progressive"), path(""), command, {}).wait();
    };
    for (const std::string count : {"0", "abc", "1e9", "4.5", "4294967296"})
    {
        const Outcome outcome = progressive({"never.ppm", count});
        EXPECT_EQ(outcome.exit_code, 1) << count;
        EXPECT_NE(outcome.err.find("a whole number from 1"), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(path("never.ppm")));
    const Outcome help = progressive({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_TRUE(help.out.starts_with("usage: ") && help.out.find("progressive PICTURE SAMPLES") != std::string::npos)
        << help.out;
}

// After many frames of updates, a dynamic tree looks like one that another program builds at once.
TEST_F(Examples, FramesInFlightEndWhereARebuildDoes)
{
    writeKnot();
    host::writePly(host::ring({0, 0, 0}, 0.5F, 0.125F, {240, 240, 240, 255}), path("ring.ply"));
    const Picture knot = render(kKnot, {"--json", "knot.json"});
    const nlohmann::json grid = nlohmann::json::parse(test::contentOf(path("knot.json")))["grid"];
    std::string grid_option;
    for (const nlohmann::json& coordinate : grid["origin"])
    {
        grid_option += coordinate.dump() + ",";
    }
    grid_option += grid["voxel_size"].dump();

    run("frames_in_flight", {"at-"});
    run("frames_in_flight", {"bare-", "--no-optional"});
    Picture previous;
    for (const int frame : {22, 23, 24})
    {
        const nlohmann::json scene = {
            {"objects",
             {{{"file", "knot.ply"}, {"static", true}},
              {{"file", "ring.ply"}, {"static", true}, {"place", {{"translation", {0, 1.0 - frame / 16.0, 0}}}}}}}};
        std::ofstream(path("both.scene.json")) << scene;
        const Picture expected = render({"both.scene.json", "--resolution", "128", "--grid", grid_option});
        EXPECT_EQ(ppm("at-" + std::to_string(frame) + ".ppm"), expected) << frame;
        EXPECT_EQ(ppm("bare-" + std::to_string(frame) + ".ppm"), expected) << frame;
        EXPECT_NE(expected, previous);
        previous = expected;
    }
    EXPECT_NE(previous, knot);
}

// The ring of the raster example, drawn by the test. Whether ring or knot is nearer is computed in double precision,
// from the ring's triangles and the oracle's voxels.
TEST_F(Examples, TheNearerOfMeshAndVoxelIsSeen)
{
    writeKnot();
    const Picture traced = render(kKnot);
    run("embed_raster", {"raster.ppm"});
    const Picture picture = ppm("raster.ppm");
    const test::Winners winners =
        test::winnersOf(path("knot.ply"), 7, host::ring({0, 0, 0}, 0.75F, 0.125F, {255, 0, 255, 255}));
    const auto is_ring = [](const Picture::Rgb& rgb) { return rgb[0] > 64 && rgb[0] == rgb[2] && rgb[1] == 0; };
    EXPECT_TRUE(std::ranges::none_of(traced.rgb, is_ring));
    std::size_t wrong_count = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    {
        // Each pixel shows one or the other, never a mixture, even if it is open which.
        EXPECT_TRUE(is_ring(picture.rgb[i]) || picture.rgb[i] == traced.rgb[i]) << i;
        const bool is_wrong =
            winners[i] != test::Winner::Open && is_ring(picture.rgb[i]) != (winners[i] == test::Winner::Mesh);
        wrong_count += is_wrong ? 1 : 0;
    }
    EXPECT_EQ(wrong_count, 0U);
    const auto count = [&](test::Winner winner) { return std::ranges::count(winners, winner); };
    EXPECT_GT(count(test::Winner::Mesh), 4000);
    EXPECT_GT(count(test::Winner::VoxelBeforeMesh), 1000);
    EXPECT_LT(count(test::Winner::Open), 64); // of 64,000
    // There are silhouettes where voxels are before the ring, with both sides known.
    EXPECT_GT(test::edgeCount(winners), 100U);

    run("embed_raster", {"bare.ppm", "--no-optional"});
    EXPECT_EQ(ppm("bare.ppm"), picture);
}

// Mean linear light of a part of a picture, from low up to, but without, high.
std::array<double, 3> lightOf(const Picture& picture, const std::array<std::size_t, 2>& low,
                              const std::array<std::size_t, 2>& high)
{
    std::array<double, 3> sum{};
    for (std::size_t y = low[1]; y < high[1]; ++y)
    {
        for (std::size_t x = low[0]; x < high[0]; ++x)
        {
            for (std::size_t channel = 0; channel < 3; ++channel)
            {
                sum.at(channel) += std::pow(picture.rgb[y * Picture::kWidth + x].at(channel) / 255.0, 2.2);
            }
        }
    }
    const auto count = static_cast<double>((high[0] - low[0]) * (high[1] - low[1]));
    return {sum[0] / count, sum[1] / count, sum[2] / count};
}

// Light of a lamp and of coloured walls, on meshes that the host draws.
TEST_F(Examples, MeshesAreLitByWhatVoxelsKeep)
{
    run("embed_gi", {"before.ppm", "after.ppm"});
    const Picture before = ppm("before.ppm");
    const Picture after = ppm("after.ppm");
    const auto behind_ring_before = lightOf(before, {232, 85}, {246, 95}); // on the green wall
    const auto behind_ring_after = lightOf(after, {232, 85}, {246, 95});
    EXPECT_LT(behind_ring_before[1], 0.6 * behind_ring_after[1]) << "the ring's shadow has moved away";
    const auto below_ring_before = lightOf(before, {170, 175}, {200, 185}); // on the floor
    const auto below_ring_after = lightOf(after, {170, 175}, {200, 185});
    EXPECT_LT(below_ring_after[1], 0.9 * below_ring_before[1]) << "and falls there";
    const auto ceiling_left = lightOf(before, {80, 14}, {95, 18});
    const auto ceiling_right = lightOf(before, {215, 14}, {230, 18});
    EXPECT_GT(ceiling_left[0] / ceiling_left[1], 1.1 * ceiling_right[0] / ceiling_right[1])
        << "red light of a red wall";
    for (const Picture* picture : {&before, &after})
    {
        for (std::size_t y = 40; y < 150; ++y)
        {
            for (std::size_t x = 112; x < 216; ++x)
            {
                const Picture::Rgb& rgb = picture->rgb[y * Picture::kWidth + x];
                EXPECT_GT(int{rgb[0]} + rgb[1] + rgb[2], 60) << "black at " << x << ", " << y;
            }
        }
    }
    run("embed_gi", {"before_bare.ppm", "after_bare.ppm", "--no-optional"});
    EXPECT_EQ(ppm("before_bare.ppm"), before);
    EXPECT_EQ(ppm("after_bare.ppm"), after);
}

// The rules that the examples promise to their readers.
TEST(ExampleSources, AreShortAndSeePublicHeadersOnly)
{
    const std::filesystem::path root = ZVO_EXAMPLES_SOURCE_DIR;
    std::size_t example_count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    {
        const std::string extension = entry.path().extension().string();
        if (extension != ".cpp" && extension != ".h")
        {
            continue;
        }
        std::ifstream file(entry.path());
        std::size_t line_count = 0;
        for (std::string line; std::getline(file, line); ++line_count)
        {
            const bool is_include = line.starts_with("#include \"");
            const std::string name = is_include ? line.substr(10, line.rfind('"') - 10) : "";
            const bool is_own = std::filesystem::exists(root / name) || name.ends_with(".comp.h") ||
                                name.ends_with(".vert.h") || name.ends_with(".frag.h");
            const bool is_public =
                name.starts_with("zvo/") && std::filesystem::exists(root.parent_path() / "include" / name);
            EXPECT_TRUE(!is_include || is_own || is_public) << entry.path() << ": " << line;
        }
        if (entry.path().filename() == "main.cpp")
        {
            EXPECT_LT(line_count, 150U) << entry.path();
            ++example_count;
        }
    }
    EXPECT_EQ(example_count, 7U);
}

} // namespace
} // namespace zvo
