// SPDX-License-Identifier: MIT
// MagicaVoxel's files, made here chunk by chunk as the format's author documents them, and read back.
#include "io/voxel/vox_file.h"

#include "core/base/morton.h"
#include "core/file/tree_check.h"
#include "core/tree/tree_build.h"
#include "support/errors.h"
#include "support/sweep.h"
#include "support/tree_samples.h"
#include "vox_chunks.h"
#include "written_bytes.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <string>

namespace zvo::test
{
namespace
{

using namespace vox;

VoxVoxels read(const std::string& file)
{
    return readVox(std::span(reinterpret_cast<const std::uint8_t*>(file.data()), file.size()), "a.vox");
}

bool isRead(const std::string& file)
{
    return loadsOrIsRefused([&] { static_cast<void>(read(file)); });
}

// Colours at MagicaVoxel's world coordinates.
std::map<std::array<int, 3>, std::uint32_t> worldOf(const VoxVoxels& voxels)
{
    std::map<std::array<int, 3>, std::uint32_t> world;
    for (std::size_t i = 0; i < voxels.codes.size(); ++i)
    {
        const glm::ivec3 cell = glm::ivec3(cellOfCode(voxels.codes[i])) + glm::ivec3(voxels.grid.origin);
        world[{cell.x, -1 - cell.z, cell.y}] = voxels.colors[i];
    }
    return world;
}

constexpr std::uint32_t kFirstColor = 0xffffffU;  // index 1 of the default palette
constexpr std::uint32_t kSecondColor = 0xccffffU; // index 2: red and green 255, blue 204

TEST(VoxFile, WithoutASceneTheFirstModelStandsAtTheOrigin)
{
    const std::string voxels("\0\0\0\1\1\2\3\2\1\1\1\0", 12); // the third one is empty
    const VoxVoxels read_voxels = read(voxFile(model(2, 3, 4, voxels)));
    EXPECT_EQ(worldOf(read_voxels),
              (std::map<std::array<int, 3>, std::uint32_t>{{{0, 0, 0}, kFirstColor}, {{1, 2, 3}, kSecondColor}}));
    EXPECT_EQ(read(voxFile(model(2, 3, 4, voxels) + model(1, 1, 1, ""))).warnings.size(), 1U);
}

TEST(VoxFile, DefaultPaletteEndsInRamps)
{
    std::string voxels;
    for (int i = 1; i < 256; ++i)
    {
        voxels += std::string{static_cast<char>(i - 1), '\0', '\0', static_cast<char>(i)};
    }
    const auto world = worldOf(read(voxFile(model(256, 1, 1, voxels))));
    // Colours of the format's palette are 0xAABBGGRR.
    EXPECT_EQ((world.at({0, 0, 0})), 0xffffffU);
    EXPECT_EQ((world.at({6, 0, 0})), 0xffccffU);
    EXPECT_EQ((world.at({36, 0, 0})), 0xffffccU);
    EXPECT_EQ((world.at({214, 0, 0})), 0x330000U);
    EXPECT_EQ((world.at({215, 0, 0})), 0x0000eeU);
    EXPECT_EQ((world.at({225, 0, 0})), 0x00ee00U);
    EXPECT_EQ((world.at({235, 0, 0})), 0xee0000U);
    EXPECT_EQ((world.at({245, 0, 0})), 0xeeeeeeU);
    EXPECT_EQ((world.at({254, 0, 0})), 0x111111U);
}

TEST(VoxFile, ModelsGoWhereTheirNodesSay)
{
    // Two instances of a model of 3 x 1 x 1: one moved, one rotated so that x becomes -y.
    const std::string voxels("\0\0\0\1\2\0\0\2", 8);
    const std::string file = voxFile(model(3, 1, 1, voxels) + transform(0, 1, {}) + group(1, {2, 4}) +
                                     transform(2, 3, {{"_t", "10 20 -5"}}) + shape(3, 0) +
                                     transform(4, 5, {{"_r", "33"}, {"_t", "0 0 2"}}) + shape(5, 0));
    // 33 = 0b0100001: row 0 has 1 at y, row 1 has -1 at x, row 2 has 1 at z.
    const std::map<std::array<int, 3>, std::uint32_t> expected = {
        {{9, 20, -5}, kFirstColor}, {{11, 20, -5}, kSecondColor}, {{0, 0, 2}, kFirstColor}, {{0, -2, 2}, kSecondColor}};
    EXPECT_EQ(worldOf(read(file)), expected);
}

// Materials of the format's extension: index, and a dictionary. Power is a number of tenfold steps.
TEST(VoxFile, MaterialsThatEmitGiveOffLightOfTheirColor)
{
    const auto material = [](int index, const Entries& entries)
    { return chunk("MATL", number(index) + dictionary(entries)); };
    const std::string voxels("\0\0\0\1\1\0\0\2\2\0\0\3\3\0\0\4", 16);
    const std::string head = model(4, 1, 1, voxels);
    EXPECT_TRUE(read(voxFile(head + material(1, {{"_type", "_diffuse"}, {"_emit", "1"}}))).emission.empty());
    const VoxVoxels lit =
        read(voxFile(head + material(2, {{"_type", "_emit"}, {"_emit", "0.5"}, {"_flux", "2"}, {"_ldr", "0.3"}}) +
                     material(3, {{"_type", "_emit"}, {"_emit", "nonsense"}, {"_flux", "-1"}}) +
                     material(0, {{"_type", "_emit"}}) + material(256, {{"_type", "_emit"}})));
    const auto linear = [](double code) { return std::pow((code / 255 + 0.055) / 1.055, 2.4); };
    ASSERT_EQ(lit.emission.size(), 4U);
    EXPECT_EQ(lit.emission[0], glm::vec3(0.0F));
    EXPECT_LT(glm::distance(lit.emission[1], 50.0F * glm::vec3(1.0F, 1.0F, linear(204))), 1e-4F);
    EXPECT_LT(glm::distance(lit.emission[2], glm::vec3(1.0F, 1.0F, linear(153))), 1e-5F);

    TreeData tree = octreeOfVoxels(lit.grid, lit.codes);
    addColors(tree, lit.colors);
    addEmission(tree, lit.emission);
    tree.node_attributes.resize(tree.nodes.size()); // which the device makes
    EXPECT_EQ(checkTree(tree).value_or(""), "");
    ASSERT_EQ(tree.emission.size(), 2U);
    EXPECT_EQ(tree.emission_words.front().x, 6U);
    for (std::size_t i = 0; i < 2; ++i)
    {
        const std::uint32_t code = tree.emission[i];
        const glm::vec3 mantissa(code & 511U, code >> 9U & 511U, code >> 18U & 511U);
        const glm::vec3 radiance = tree.emission_scale * mantissa * std::exp2(static_cast<float>(code >> 27U) - 24.0F);
        EXPECT_LT(glm::distance(radiance, lit.emission[i + 1]), 0.005F * lit.emission[i + 1].r);
    }
}

TEST(VoxFile, HiddenNodesAndLayersAreLeftOutAndTheLastOneStays)
{
    const std::string one("\0\0\0\1", 4);
    const std::string two("\0\0\0\2", 4);
    const std::string layer = chunk("LAYR", number(7) + dictionary({{"_hidden", "1"}}) + number(-1));
    const std::string models = model(1, 1, 1, one) + model(1, 1, 1, two);
    const std::string nodes = transform(0, 1, {}) + group(1, {2, 4, 6, 8}) + transform(2, 3, {}) + shape(3, 0) +
                              transform(4, 5, {}) + shape(5, 1) +
                              transform(6, 7, {{"_t", "5 0 0"}}, {{"_hidden", "1"}}) + shape(7, 0) +
                              transform(8, 9, {{"_t", "6 0 0"}}, {}, 7) + shape(9, 0);
    EXPECT_EQ(worldOf(read(voxFile(models + nodes + layer))),
              (std::map<std::array<int, 3>, std::uint32_t>{{{0, 0, 0}, kSecondColor}}));
}

TEST(VoxFile, WhatIsWrongHasItsMessage)
{
    const std::string one = model(1, 1, 1, std::string("\0\0\0\1", 4));
    const std::string scene = one + transform(0, 1, {}) + shape(1, 0);
    const std::string good = voxFile(scene);
    ASSERT_TRUE(isRead(good));
    const std::vector<std::pair<std::string, const char*>> faults = {
        {"", "not a MagicaVoxel file"},
        {"VOX!" + good.substr(4), "not a MagicaVoxel file"},
        {"VOX " + number(99) + good.substr(8), "version 99"},
        {"VOX " + number(150) + chunk("MAIM", "", one), "not MAIN"},
        {voxFile(one.substr(0, one.size() - 1)), "cut short"},
        {voxFile(chunk("SIZE", number(257) + number(1) + number(1))), "257 voxels wide"},
        {voxFile(chunk("SIZE", number(0) + number(1) + number(1))), "0 voxels wide"},
        {voxFile(chunk("SIZE", number(1))), "cut short"},
        {voxFile(chunk("XYZI", number(0))), "has voxels and no size"},
        {voxFile(chunk("SIZE", number(1) + number(1) + number(1))), "has a size and no voxels"},
        {voxFile(chunk("SIZE", number(1) + number(1) + number(1)) + chunk("XYZI", number(1000000))),
         "no room for them"},
        {voxFile(chunk("SIZE", number(1) + number(1) + number(1)) + chunk("XYZI", number(-1))), "no room for them"},
        {voxFile(model(1, 1, 1, std::string("\0\1\0\1", 4))), "outside of its 1 x 1 x 1"},
        {voxFile(chunk("SIZE", number(1) + number(1) + number(1)) + chunk("TDCZ", "x")), "TDCZ, the compressed format"},
        {voxFile(chunk("TDCZ", number(2) + number(1) + number(1) + "x")), "Teardown"},
        {voxFile(chunk("MATT", number(1))), "cut short"},
        {voxFile(one + transform(0, 1, {})), "node 1 is named and not there"},
        {voxFile(one + transform(0, 0, {})), "go round in a circle"},
        {voxFile(one + transform(0, 1, {}) + group(1, {0, 0, 0})), "go round in a circle"},
        {voxFile(one + transform(0, 1, {}) + shape(1, 1)), "model 1 is named and not there"},
        {voxFile(scene + shape(1, 0)), "two nodes have the number 1"},
        {voxFile(one + transform(0, 1, {{"_r", "3"}}) + shape(1, 0)), "a rotation"},
        {voxFile(one + transform(0, 1, {{"_r", "x"}}) + shape(1, 0)), "a rotation"},
        {voxFile(one + transform(0, 1, {{"_t", "1 2"}}) + shape(1, 0)), "a place"},
        {voxFile(one + transform(0, 1, {{"_t", "99999999 0 0"}}) + shape(1, 0)), "a place"},
        {voxFile(one + transform(0, 1, {{"_t", "200000 0 0"}}) + shape(1, 0)), "more than the 131072"},
    };
    for (const auto& [file, words] : faults)
    {
        expectParts(messageOf([&file = file] { static_cast<void>(read(file)); }, ErrorCode::Input), {words});
    }
    for (std::size_t size = 0; size < good.size(); ++size)
    {
        EXPECT_FALSE(isRead(good.substr(0, size))) << size;
    }
}

TEST(VoxFile, ChangedFilesAreReadOrRefused)
{
    const std::string good =
        voxFile(model(3, 1, 1, std::string("\0\0\0\1\2\0\0\2", 8)) + transform(0, 1, {}) + group(1, {2, 4}) +
                transform(2, 3, {{"_t", "10 20 -5"}}) + shape(3, 0) + transform(4, 5, {{"_r", "33"}}) + shape(5, 0));
    std::mt19937 random(4);
    for (int i = 0; i < 20000; ++i)
    {
        std::string changed = good;
        for (std::size_t rest = 1 + random() % 3; rest != 0; --rest)
        {
            changed[random() % changed.size()] = static_cast<char>(random() % 3 == 0 ? random() : random() % 8);
        }
        isRead(changed);
    }
}

TEST(VoxFile, TreesComeBackWithTheirVoxelsAndColors)
{
    int number = 0;
    for (const TreeSample& sample : treeSamples())
    {
        if (sample.name.ends_with("_dag") && sample.name != "random_5_with_attributes_block_dag")
        {
            continue; // each file takes a table of 2^24 colours: one DAG is enough
        }
        if (!sample.name.ends_with("_dag") && number++ % 3 != 0 && !test::isFull())
        {
            continue;
        }
        const VoxVoxels back = read(writtenBytes(writeVox, sample.tree));
        std::vector<std::uint64_t> codes;
        forEachVoxel(sample.tree, [&codes](std::uint64_t code) { codes.push_back(code); });
        EXPECT_EQ(back.codes, codes) << sample.name;
        std::map<std::uint32_t, std::uint32_t> used;
        const auto isDark = [&](std::size_t i) { return back.emission.empty() || back.emission[i] == glm::vec3(0.0F); };
        for (std::size_t i = 0; i < codes.size() && sample.tree.hasAttributes(); ++i)
        {
            ++used[sample.tree.voxelAttribute(i).color & 0xffffffU];
        }
        std::size_t lit_count = 0;
        for (std::size_t i = 0; i < codes.size() && used.size() <= 223; ++i)
        {
            const std::uint32_t expected = used.empty() ? 0xcbcbcbU : sample.tree.voxelAttribute(i).color & 0xffffffU;
            lit_count += isDark(i) ? 0 : 1;
            ASSERT_TRUE(back.colors[i] == expected || !isDark(i)) << sample.name;
        }
        EXPECT_TRUE(used.size() > 223 || lit_count == sample.tree.emission.size()) << sample.name;
    }
}

// The tree of voxels in a row.
TreeData rowOf(const std::vector<std::uint32_t>& colors, const std::vector<glm::vec3>& emission)
{
    std::vector<std::uint64_t> codes;
    for (std::uint32_t i = 0; i < colors.size(); ++i)
    {
        codes.push_back(codeOfCell({i % 64, i / 64, 0}));
    }
    std::sort(codes.begin(), codes.end());
    TreeData tree = octreeOfVoxels({glm::vec3(0.0F), 1.0F, 6}, codes);
    addColors(tree, colors);
    addEmission(tree, emission);
    return tree;
}

TEST(VoxFile, LightComesBack)
{
    const std::vector<std::uint32_t> colors = {0x0000ff, 0x0000ff, 0x0000ff, 0xc0c0c0, 0x000000, 0xc0c0c0};
    const float grey = std::pow((192.0F / 255.0F + 0.055F) / 1.055F, 2.4F);
    const std::vector<glm::vec3> emission = {{0, 0, 0},    {1, 0, 0},    {70, 0, 0},
                                             {0, 0, 0.5F}, {2, 1, 0.2F}, glm::vec3(17.0F * grey)};
    const VoxVoxels back = read(writtenBytes(writeVox, rowOf(colors, emission)));
    EXPECT_TRUE(back.warnings.empty());
    ASSERT_EQ(back.emission.size(), emission.size());
    for (std::size_t i = 0; i < emission.size(); ++i)
    {
        EXPECT_LE(glm::distance(back.emission[i], emission[i]), 0.02F * glm::length(emission[i])) << i;
    }
    for (const std::size_t own : {0, 1, 2, 5}) // the others take the colour of their light
    {
        EXPECT_EQ(back.colors[own], colors[own]);
    }
}

TEST(VoxFile, ManyLightsBecomeNearOnes)
{
    std::mt19937 random(8); // NOLINT: the same lights on every run
    std::vector<std::uint32_t> colors;
    std::vector<glm::vec3> emission;
    for (std::uint32_t i = 0; i < 2000; ++i)
    {
        colors.push_back(i % 220);
        const float most = std::exp2(static_cast<float>(random() % 1000) / 100.0F);
        emission.push_back(i % 2 == 0 ? glm::vec3(0.0F)
                                      : most * glm::vec3(1.0F, static_cast<float>(random() % 100) / 100.0F, 0.0F));
    }
    const VoxVoxels back = read(writtenBytes(writeVox, rowOf(colors, emission)));
    ASSERT_EQ(back.emission.size(), emission.size());
    glm::vec3 sums[2] = {};
    for (std::size_t i = 0; i < emission.size(); ++i)
    {
        EXPECT_LE(back.emission[i].r, 4.0F * emission[i].r) << i;
        EXPECT_GE(back.emission[i].r, 0.25F * emission[i].r) << i;
        EXPECT_TRUE(i % 2 == 1 || back.colors[i] == colors[i]);
        sums[0] += emission[i];
        sums[1] += back.emission[i];
    }
    EXPECT_LT(glm::distance(sums[0], sums[1]), 0.02F * glm::length(sums[0]));
}

TEST(VoxFile, MaterialsOfVoxelsThatAreNotReadAreNamed)
{
    const auto material = [](int index, const Entries& entries)
    { return chunk("MATL", number(index) + dictionary(entries)); };
    const auto warningsOf = [](const std::string& chunks)
    { return read(voxFile(model(2, 1, 1, std::string("\0\0\0\1\1\0\0\2", 8)) + chunks)).warnings; };
    EXPECT_TRUE(warningsOf(material(1, {{"_type", "_diffuse"}, {"_rough", "0.1"}}) +
                           material(9, {{"_type", "_metal"}}) + material(2, {{"_emit", "0.3"}, {"_rough", "0.1"}}))
                    .empty())
        << "what no voxel has, and what says nothing";
    EXPECT_EQ(warningsOf(material(1, {{"_type", "_metal"}, {"_rough", "0.1"}}) + material(2, {{"_type", "_glass"}})),
              (std::vector<std::string>{
                  "a.vox: materials of kind glass, metal with roughness left out but for their colour"}));
    // The chunk of files before 0.99: index, type, weight, and numbers that are not read.
    const auto old = [](int index, int type, float weight)
    { return chunk("MATT", number(index) + number(type) + number(std::bit_cast<std::int32_t>(weight)) + number(0)); };
    EXPECT_EQ(warningsOf(old(1, 2, 0.5F)).at(0), "a.vox: materials of kind glass left out but for their colour");
    const VoxVoxels lit = read(voxFile(model(1, 1, 1, std::string("\0\0\0\1", 4)) + old(1, 3, 0.75F)));
    EXPECT_EQ(lit.emission.at(0), glm::vec3(0.75F));
    EXPECT_TRUE(lit.warnings.empty());
}

TEST(VoxFile, FramesThatAreLeftOutAreNamed)
{
    const std::string models = model(1, 1, 1, std::string("\0\0\0\1", 4)) + model(1, 1, 1, std::string("\0\0\0\2", 4));
    const std::string shapes =
        chunk("nSHP", number(1) + dictionary({}) + number(2) + number(0) + dictionary({}) + number(1) + dictionary({}));
    EXPECT_EQ(read(voxFile(models + transform(0, 1, {}) + shapes)).warnings.at(0),
              "a.vox: frames of an animation left out but for the first");
    const std::string moves =
        chunk("nTRN", number(0) + dictionary({}) + number(1) + number(-1) + number(0) + number(2) +
                          dictionary({{"_f", "0"}}) + dictionary({{"_f", "9"}, {"_t", "1 0 0"}}));
    EXPECT_EQ(read(voxFile(models + moves + shape(1, 0))).warnings.size(), 1U);
}

TEST(VoxFile, GridsBeyond256AreSplit)
{
    std::vector<std::uint64_t> codes;
    std::mt19937 random(6);
    for (int i = 0; i < 3000; ++i)
    {
        codes.push_back(random() % (std::uint64_t{1} << 30)); // 1024^3: 64 blocks
    }
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    const TreeData tree = octreeOf(codes, 10);
    const std::string file = writtenBytes(writeVox, tree);
    std::size_t sizes = 0;
    for (std::size_t at = file.find("SIZE"); at != std::string::npos; at = file.find("SIZE", at + 4))
    {
        ++sizes;
        for (std::size_t i = 0; i < 3; ++i)
        {
            std::uint32_t edge = 0;
            std::memcpy(&edge, file.data() + at + 12 + 4 * i, sizeof(edge));
            EXPECT_LE(edge, 256U);
        }
    }
    EXPECT_EQ(sizes, 64U);
    EXPECT_EQ(read(file).codes, codes);
}

TEST(TreeBuild, OctreesAreThoseOfTheReference)
{
    for (const TreeSample& sample : treeSamples())
    {
        if (sample.tree.structure == TreeStructure::Svo && !sample.tree.hasAttributes())
        {
            std::vector<std::uint64_t> codes;
            forEachVoxel(sample.tree, [&codes](std::uint64_t code) { codes.push_back(code); });
            const TreeData built = octreeOfVoxels(sample.tree.grid, codes);
            EXPECT_EQ(treeDifference(built, sample.tree), "") << sample.name;
        }
    }
}

TEST(TreeBuild, HasVoxelKnowsAllAndNoOthers)
{
    for (const TreeSample& sample : treeSamples())
    {
        std::vector<std::uint64_t> codes;
        forEachVoxel(sample.tree, [&codes](std::uint64_t code) { codes.push_back(code); });
        const int n = std::min(static_cast<int>(sample.tree.grid.resolution()), 32);
        for (int z = -1; z <= n; ++z)
        {
            for (int y = -1; y <= n; ++y)
            {
                for (int x = -1; x <= n; ++x)
                {
                    const bool inside = std::min({x, y, z}) >= 0 && std::max({x, y, z}) < n;
                    const bool expected =
                        inside && std::binary_search(codes.begin(), codes.end(), codeOfCell({x, y, z}));
                    const bool outside_of_grid = std::max({x, y, z}) >= static_cast<int>(sample.tree.grid.resolution());
                    if (inside || outside_of_grid || std::min({x, y, z}) < 0)
                    {
                        ASSERT_EQ(hasVoxel(sample.tree, {x, y, z}), expected) << sample.name;
                    }
                }
            }
        }
    }
}

} // namespace
} // namespace zvo::test
