// SPDX-License-Identifier: MIT
// Packed attributes: the device packs as the oracle does, and reading gives what was packed.
#include "core/attributes/attribute_pack.h"
#include "runtime/attribute_packer.h"
#include "runtime/trees.h"

#include "core/base/kernels.h"
#include "core/tree/device_tree.h"
#include "oracle/attribute_formats.h"
#include "support/dag_compare.h"
#include "support/dags.h"
#include "support/device.h"
#include "support/engine_device.h"
#include "support/octree_access.h"
#include "support/param_names.h"
#include "support/pictures.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::array kFormats = {AttributeFormat::Bytes4, AttributeFormat::Blocks};

using Attributes = std::vector<gpu::Attribute>;
using Words = std::vector<gpu::uint>;

using test::device;

// Arbitrary attributes, some with codes that no kernel makes, and some without a normal.
Attributes randomAttributes(std::size_t count, std::uint32_t seed)
{
    std::mt19937 random(seed);
    Attributes attributes(count);
    for (gpu::Attribute& attribute : attributes)
    {
        attribute = {static_cast<gpu::uint>(random()), static_cast<gpu::uint>(random())};
        attribute.normal = random() % 8 == 0 ? gpu::kNoNormal : attribute.normal;
    }
    return attributes;
}

// Attributes as they occur in space: runs of equal ones, of one that changes slightly, and of two that alternate.
Attributes coherentAttributes(std::size_t count, std::uint32_t seed)
{
    std::mt19937 random(seed);
    Attributes attributes;
    while (attributes.size() < count)
    {
        const gpu::Attribute first = randomAttributes(1, static_cast<std::uint32_t>(random()))[0];
        const gpu::Attribute second = randomAttributes(1, static_cast<std::uint32_t>(random()))[0];
        const std::uint32_t kind = random() % 4;
        const std::uint32_t color_mask = 0x010101U * (random() % 16);
        const std::uint32_t normal_mask = 0x10001U * (random() % 2048);
        for (std::size_t i = random() % 50; i != 0 && attributes.size() < count; --i)
        {
            gpu::Attribute next = kind == 0 && random() % 2 == 0 ? second : first;
            next.color ^= kind == 2 ? static_cast<gpu::uint>(random()) & color_mask : 0;
            next.normal ^= kind >= 2 ? static_cast<gpu::uint>(random()) & normal_mask : 0;
            attributes.push_back(next);
        }
    }
    return attributes;
}

Words packOnDevice(const Attributes& attributes, AttributeFormat format)
{
    const auto from = device().makeBuffer<gpu::Attribute>("attributes", attributes);
    vk::BufferOf<gpu::uint> words(device().device(), "words", packedWords(format, attributes.size()));
    device().run([&](vk::FrameGraph& graph) { packAttributes(graph, from, format, words); });
    return device().download(words);
}

Words packByOracle(const Attributes& attributes, AttributeFormat format)
{
    Words words;
    for (std::size_t first = 0; first < attributes.size() && format == AttributeFormat::Blocks; first += 16)
    {
        const std::size_t count = std::min<std::size_t>(attributes.size() - first, 16);
        const oracle::Block block = oracle::packBlock(std::span(attributes).subspan(first, count));
        words.insert(words.end(), block.begin(), block.end());
    }
    if (format == AttributeFormat::Blocks)
    {
        return words;
    }
    for (const gpu::Attribute& attribute : attributes)
    {
        words.push_back(oracle::packAttribute4(attribute));
    }
    return words;
}

using PackAttributes = testing::TestWithParam<AttributeFormat>;

INSTANTIATE_TEST_SUITE_P(Formats, PackAttributes, testing::ValuesIn(kFormats),
                         [](const auto& format) { return std::string("Format") + formatName(format.param); });

TEST_P(PackAttributes, GivesTheOraclesWords)
{
    for (const std::size_t count : {0U, 1U, 27U, 64U, 2049U, 231917U})
    {
        for (const Attributes& attributes : {randomAttributes(count, 3), coherentAttributes(count, 9)})
        {
            const Words words = packOnDevice(attributes, GetParam());
            ASSERT_EQ(words.size(), packedWords(GetParam(), count));
            EXPECT_EQ(words, packByOracle(attributes, GetParam())) << count;
        }
    }
}

TEST_P(PackAttributes, PieceByPieceIsTheSame)
{
    const Attributes attributes = randomAttributes(231917, 4);
    const Words expected = packByOracle(attributes, GetParam());
    std::mt19937 random(8);
    for (const std::uint64_t budget : {std::uint64_t{2} << 20, std::uint64_t{1} << 40})
    {
        vk::HeadlessOptions options = test::deviceOptions();
        options.memory_budget_bytes = budget;
        vk::HeadlessDevice limited(options, zvoKernels());
        AttributePacker packer(limited, GetParam());
        for (std::size_t first = 0; first < attributes.size();)
        {
            const std::size_t count = std::min<std::size_t>(attributes.size() - first, random() % 40000);
            const auto begin = attributes.begin() + static_cast<std::ptrdiff_t>(first);
            packer.append({begin, begin + static_cast<std::ptrdiff_t>(count)});
            first += count;
        }
        packer.finish();
        EXPECT_TRUE(packer.attributes.empty());
        EXPECT_EQ(packer.words, expected);
        EXPECT_FALSE(packer.passes.empty());
        EXPECT_LE(limited.device().memory().peakHeldBytes(), budget);
    }
}

TEST(AttributePacker, LeavesPlainAttributesAsTheyAre)
{
    const Attributes attributes = randomAttributes(100000, 5);
    AttributePacker packer(device(), AttributeFormat::Bytes8);
    packer.append({attributes.begin(), attributes.begin() + 70000});
    packer.append({attributes.begin() + 70000, attributes.end()});
    packer.finish();
    EXPECT_TRUE(std::equal(attributes.begin(), attributes.end(), packer.attributes.begin(), packer.attributes.end(),
                           [](const auto& a, const auto& b) { return a.color == b.color && a.normal == b.normal; }));
    EXPECT_TRUE(packer.words.empty());
}

// Reads every word of 16 bits of colour and every one of 16 bits of normal on the host.
TEST(UnpackAttribute, OfFourBytesIsTheOracles)
{
    for (std::uint32_t half = 0; half < 1U << 16; ++half)
    {
        for (const std::uint32_t word : {half, half << 16})
        {
            const gpu::Attribute expected = oracle::unpackAttribute4(word);
            const gpu::Attribute actual = unpackAttribute(AttributeFormat::Bytes4, std::span(&word, 1), 0);
            ASSERT_EQ(actual.color, expected.color) << word;
            ASSERT_EQ(actual.normal, expected.normal) << word;
        }
    }
}

TEST(UnpackAttribute, OfABlockIsTheOracles)
{
    std::mt19937 random(7);
    for (int i = 0; i < 20000; ++i)
    {
        oracle::Block block{};
        std::generate(block.begin(), block.end(), [&] { return static_cast<std::uint32_t>(random()); });
        for (std::uint32_t end = 0; end < 28; end += 7) // 0 to 126
        {
            block[2] &= (block[2] >> end & 127) == 127 ? ~(1U << end) : UINT32_MAX;
        }
        Words words(6 * 3);
        std::copy(block.begin(), block.end(), words.begin() + 6);
        for (std::uint32_t voxel = 0; voxel < 16; ++voxel)
        {
            const gpu::Attribute expected = oracle::unpackBlock(block, voxel);
            const gpu::Attribute actual = unpackAttribute(AttributeFormat::Blocks, words, 16 + voxel);
            ASSERT_EQ(actual.color, expected.color);
            ASSERT_EQ(actual.normal, expected.normal) << block[2];
        }
    }
}

// Each channel of each grey is unpacked to the nearest representable value, and the errors cancel out.
TEST(PackAttribute4, ColorsAreTheNearestOnesAndNoBrighter)
{
    std::array<int, 3> sums = {0, 0, 0};
    for (std::uint32_t gray = 0; gray < 256; ++gray)
    {
        const std::uint32_t color = oracle::unpackAttribute4(oracle::packAttribute4({gray * 0x10101U, 0})).color;
        for (int channel = 0; channel < 3; ++channel)
        {
            const int bits = channel == 1 ? 6 : 5;
            int nearest = 256;
            for (std::uint32_t code = 0; code < 1U << bits; ++code)
            {
                const std::uint32_t word = code << (channel == 0 ? 0 : channel == 1 ? 5 : 11);
                const auto value = static_cast<int>(oracle::unpackAttribute4(word).color >> (8 * channel) & 255);
                nearest = std::min(nearest, std::abs(value - static_cast<int>(gray)));
            }
            const int error = static_cast<int>(color >> (8 * channel) & 255) - static_cast<int>(gray);
            EXPECT_EQ(std::abs(error), nearest) << gray << " channel " << channel;
            sums[static_cast<std::size_t>(channel)] += error;
        }
    }
    EXPECT_EQ(sums, (std::array<int, 3>{0, 0, 0}));
}

double degreesBetween(const gpu::Attribute& a, const gpu::Attribute& b)
{
    const glm::dvec3 u = test::normalOf(a);
    const glm::dvec3 v = test::normalOf(b);
    return glm::degrees(std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
}

gpu::Attribute withNormal(int x, int y)
{
    return {0, static_cast<std::uint16_t>(x) | static_cast<std::uint32_t>(static_cast<std::uint16_t>(y)) << 16};
}

TEST(PackAttribute4, NormalsAlongAxesStayThere)
{
    constexpr int kOne = 32767;
    for (const auto& [x, y] : {std::pair{0, 0}, {kOne, 0}, {-kOne, 0}, {0, kOne}, {0, -kOne}, {kOne, kOne}})
    {
        const gpu::Attribute axis = withNormal(x, y);
        EXPECT_EQ(degreesBetween(axis, oracle::unpackAttribute4(oracle::packAttribute4(axis))), 0.0) << x << " " << y;
    }
}

TEST(PackAttribute4, NormalsAreOffByTwoThirdsOfADegreeAtMost)
{
    std::mt19937 random(6);
    double sum = 0.0;
    double worst = 0.0;
    constexpr int kCount = 200000;
    std::normal_distribution<double> gauss;
    for (int i = 0; i < kCount; ++i)
    {
        const glm::dvec3 v(gauss(random), gauss(random), gauss(random));
        const double size = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
        glm::dvec2 p(v.x / size, v.y / size);
        if (v.z < 0)
        {
            p = {std::copysign(1 - std::abs(p.y), v.x), std::copysign(1 - std::abs(p.x), v.y)};
        }
        const gpu::Attribute look =
            withNormal(static_cast<int>(std::lround(32767 * p.x)), static_cast<int>(std::lround(32767 * p.y)));
        const double error = degreesBetween(look, oracle::unpackAttribute4(oracle::packAttribute4(look)));
        sum += error;
        worst = std::max(worst, error);
    }
    EXPECT_LT(worst, 0.66);
    EXPECT_LT(sum / kCount, 0.315);
}

TEST_P(PackAttributes, ReplacesThoseOfATree)
{
    std::mt19937 random(2);
    const AttributeFormat format = GetParam();
    DeviceTree octree = test::octreeOf(device(), test::randomCodes(6, 3000, random), 6);
    test::addAttributes(device(), octree);
    const Attributes voxels = device().download(octree.voxel_attributes);
    const Attributes nodes = device().download(octree.node_attributes);
    const std::uint64_t plain_bytes = octree.attributeBytes();
    EXPECT_EQ(octree.attributeFormat(), AttributeFormat::Bytes8);
    EXPECT_TRUE(packTree(device(), AttributeFormat::Bytes8, octree).empty());
    EXPECT_EQ(octree.attributeFormat(), AttributeFormat::Bytes8);
    EXPECT_FALSE(packTree(device(), format, octree).empty());
    EXPECT_EQ(octree.attributeFormat(), format);
    EXPECT_EQ(octree.voxel_attributes.count() + octree.node_attributes.count(), 0U);
    EXPECT_LT(octree.attributeBytes(), plain_bytes);
    EXPECT_EQ(device().download(octree.packed.voxels), packByOracle(voxels, format));
    EXPECT_EQ(device().download(octree.packed.nodes), packByOracle(nodes, nodeFormat(format)));
    EXPECT_TRUE(packTree(device(), format, octree).empty()); // a second call has nothing to do
    DeviceTree bare = test::octreeOf(device(), test::randomCodes(6, 30, random), 6);
    EXPECT_TRUE(packTree(device(), format, bare).empty());
    EXPECT_EQ(bare.attributeFormat(), AttributeFormat::None);
}

// Replaces a packed tree's attributes by the same ones in 8 bytes, with their flags.
void unpackTree(DeviceTree& octree)
{
    const PackedAttributes packed = std::exchange(octree.packed, {});
    const Words voxels = device().download(packed.voxels);
    const Words nodes = device().download(packed.nodes);
    const std::vector<gpu::uvec2> emission = device().download(octree.emission_words);
    const auto node_count = static_cast<std::uint32_t>(octree.node_count);
    Attributes of_voxels;
    Attributes of_nodes;
    for (std::uint32_t i = 0; i < octree.voxel_count; ++i)
    {
        of_voxels.push_back(unpackAttribute(packed.format, voxels, i));
        of_voxels.back().color |= (emission[i / 32].x >> (i % 32) & 1) << 24;
    }
    for (std::uint32_t i = 0; i < node_count; ++i)
    {
        of_nodes.push_back(unpackAttribute(nodeFormat(packed.format), nodes, i));
    }
    octree.voxel_attributes = device().makeBuffer<gpu::Attribute>("unpacked", of_voxels);
    octree.node_attributes = device().makeBuffer<gpu::Attribute>("unpacked", of_nodes);
}

std::vector<gpu::uint> pictureOf(const DeviceTree& tree, const TraceOptions& options)
{
    const ViewCamera view = test::manyCameras(tree.grid).front();
    const TraceCamera camera = traceCamera(view, tree.grid, 70);
    const test::Picture picture = test::takePicture(device(), tree, camera, 99, 70, options);
    EXPECT_GT(test::hitCount(picture), 500U);
    return picture.image;
}

// Kernels read a packed tree as the host does, and octree and DAG are shaded equally.
TEST_P(PackAttributes, ShowsInPictures)
{
    for (const std::uint32_t depth : {5U, 7U})
    {
        DeviceTree packed = test::octreeOf(device(), test::sphereShell(depth, depth == 5 ? 12.0 : 50.0), depth);
        test::addAttributes(device(), packed);
        DeviceTree dag = test::svdagOf(device(), packed);
        DeviceTree unpacked = test::octreeOf(device(), test::sphereShell(depth, depth == 5 ? 12.0 : 50.0), depth);
        test::addAttributes(device(), unpacked);
        packTree(device(), GetParam(), packed);
        packTree(device(), GetParam(), dag);
        packTree(device(), GetParam(), unpacked);
        unpackTree(unpacked);
        for (const View view : {View::Color, View::Albedo, View::Normal})
        {
            for (const std::uint32_t level : {UINT32_MAX, 2U})
            {
                TraceOptions options;
                options.view = view;
                options.occlusion_rays = 2;
                options.detail_level = level;
                const std::vector<gpu::uint> expected = pictureOf(unpacked, options);
                EXPECT_EQ(pictureOf(packed, options), expected);
                EXPECT_EQ(pictureOf(dag, options), expected);
            }
        }
    }
}

TEST_P(PackAttributes, AndCompressingGoInAnyOrder)
{
    for (const std::uint32_t depth : {2U, 6U, 7U})
    {
        std::mt19937 random(depth);
        const test::Codes codes = test::randomCodes(depth, 3000, random);
        DeviceTree octree = test::octreeOf(device(), codes, depth);
        test::addAttributes(device(), octree);
        DeviceTree late = compress(device(), std::move(octree)).dag;
        packTree(device(), GetParam(), late);
        octree = test::octreeOf(device(), codes, depth);
        test::addAttributes(device(), octree);
        packTree(device(), GetParam(), octree);
        const DeviceTree early = compress(device(), std::move(octree)).dag;
        EXPECT_EQ(test::difference(device(), early, late), "") << depth;
        EXPECT_EQ(early.attributeFormat(), GetParam());
        const DeviceTree again = compress(device(), std::move(late)).dag;
        EXPECT_EQ(test::difference(device(), again, early), "") << depth;
    }
}

} // namespace
} // namespace zvo
