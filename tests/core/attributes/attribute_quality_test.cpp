// SPDX-License-Identifier: MIT
// Errors of packed attributes on whole scenes: colours in dB, normals in degrees, pictures in dB. The disabled test
// makes the tables of docs/attributes.md.
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/octree_access.h"
#include "support/param_names.h"
#include "support/pictures.h"
#include "support/scenes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace zvo
{
namespace
{

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 720;

using test::device;

// Peak signal to noise ratio of 8-bit channels whose errors have this sum of squares.
double decibels(double squares, double channels)
{
    return squares == 0 ? std::numeric_limits<double>::infinity() : 10 * std::log10(255 * 255 * channels / squares);
}

double squaredDifference(std::uint32_t a, std::uint32_t b)
{
    double sum = 0;
    for (std::uint32_t shift = 0; shift < 24; shift += 8)
    {
        const double d = static_cast<double>(a >> shift & 255) - static_cast<double>(b >> shift & 255);
        sum += d * d;
    }
    return sum;
}

/// Errors of attributes.
struct Loss
{
    double color_db = 0;
    double mean_degrees = 0;
    double percentile_degrees = 0; // not exceeded by 99 of 100
    double max_degrees = 0;
    double missing_share = 0;  // without a normal before; neither these nor the next two have an angle
    double stand_in_share = 0; // of these, with one after
    double lost_share = 0;     // with a normal before, without one after
};

Loss lossOf(const std::vector<gpu::Attribute>& attributes, AttributeFormat format, const std::vector<gpu::uint>& words)
{
    Loss loss;
    double squares = 0;
    std::vector<float> degrees;
    degrees.reserve(attributes.size());
    for (std::size_t i = 0; i < attributes.size(); ++i)
    {
        const gpu::Attribute unpacked = unpackAttribute(format, words, i);
        squares += squaredDifference(unpacked.color, attributes[i].color);
        const bool is_missing = unpacked.normal == gpu::kNoNormal;
        const bool was_missing = attributes[i].normal == gpu::kNoNormal;
        const double share = 1.0 / static_cast<double>(attributes.size());
        loss.stand_in_share += was_missing && !is_missing ? share : 0.0;
        loss.lost_share += is_missing && !was_missing ? share : 0.0;
        loss.missing_share += was_missing ? share : 0.0;
        if (is_missing || was_missing)
        {
            continue;
        }
        const glm::dvec3 a = test::normalOf(unpacked);
        const glm::dvec3 b = test::normalOf(attributes[i]);
        degrees.push_back(static_cast<float>(glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)))));
        loss.mean_degrees += degrees.back();
    }
    loss.mean_degrees /= static_cast<double>(degrees.size());
    std::sort(degrees.begin(), degrees.end());
    loss.color_db = decibels(squares, 3.0 * static_cast<double>(attributes.size()));
    loss.percentile_degrees = degrees[degrees.size() * 99 / 100];
    loss.max_degrees = degrees.back();
    return loss;
}

std::string lossText(const Loss& loss)
{
    return fmt::format("{:.1f} dB | {:.2f}° {:.1f}° {:.1f}°", loss.color_db, loss.mean_degrees, loss.percentile_degrees,
                       loss.max_degrees);
}

std::vector<gpu::uint> pictureOf(const DeviceTree& octree, const Scene& scene)
{
    const ViewCamera view = scene.cameras.empty() ? ViewCamera::framing(scene.bounds(), double{kWidth} / kHeight)
                                                  : ViewCamera::of(scene.cameras.front());
    return test::takePicture(device(), octree, traceCamera(view, octree.grid, kHeight), kWidth, kHeight, {}).image;
}

double pictureDecibels(const std::vector<gpu::uint>& a, const std::vector<gpu::uint>& b)
{
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        squares += squaredDifference(a[i], b[i]);
    }
    return decibels(squares, 3.0 * static_cast<double>(a.size()));
}

/// The errors and sizes of a scene in one format.
struct Quality
{
    Loss voxels;
    Loss nodes;
    double picture_db = 0;
    double bytes_per_voxel = 0; // for voxels, nodes and emission
    double pack_ms = 0;
    double build_ms = 0; // time of the whole build before packing
};

// Measures both packed formats.
std::vector<Quality> measure(const std::filesystem::path& path, std::uint32_t depth)
{
    const Scene scene = loadGltf(path);
    const GpuScene uploaded = uploadScene(device(), scene, true);
    std::vector<Quality> qualities;
    for (const AttributeFormat format : {AttributeFormat::Bytes4, AttributeFormat::Blocks})
    {
        BuildResult built = buildOctree(device(), uploaded, Grid::around(scene.bounds(), depth), {});
        DeviceTree& octree = built.octree;
        const std::vector<gpu::Attribute> voxels = device().download(octree.voxel_attributes);
        const std::vector<gpu::Attribute> nodes = device().download(octree.node_attributes);
        const std::vector<gpu::uint> picture = pictureOf(octree, scene);
        const std::vector<vk::PassTime> passes = packTree(device(), format, octree);
        Quality& quality = qualities.emplace_back();
        quality.voxels = lossOf(voxels, format, device().download(octree.packed.voxels));
        quality.nodes = lossOf(nodes, nodeFormat(format), device().download(octree.packed.nodes));
        quality.picture_db = pictureDecibels(picture, pictureOf(octree, scene));
        quality.bytes_per_voxel = static_cast<double>(octree.attributeBytes()) / octree.voxel_count;
        quality.pack_ms = operationMs(passes, "attributes");
        quality.build_ms = built.operationMs("voxelize") + built.operationMs("octree");
        fmt::print("| {} {} | {} | {} | {} | {:.1f} dB | {:.2f} | {:.0f} of {:.0f} ms |\n", path.stem().string(),
                   1U << depth, formatName(format), lossText(quality.voxels), lossText(quality.nodes),
                   quality.picture_db, quality.bytes_per_voxel, quality.pack_ms, quality.build_ms);
    }
    return qualities;
}

/// Least quality of blocks for a scene at 256^3, a little below the measured one.
struct Bounds256
{
    const char* scene;
    double color_db;
    double mean_degrees;
    double percentile_degrees;
    double max_degrees;
    double picture_db;
};

void PrintTo(const Bounds256& bounds, std::ostream* stream)
{
    *stream << bounds.scene;
}

using AttributeQuality = testing::TestWithParam<Bounds256>;

INSTANTIATE_TEST_SUITE_P(Scenes, AttributeQuality,
                         testing::Values(Bounds256{"dragon.glb", 49.5, 1.8, 8, 20, 42},
                                         Bounds256{"sponza.glb", 37, 0.8, 8.5, 22, 30},
                                         Bounds256{"damaged_helmet.glb", 32, 1.2, 7, 21, 38},
                                         Bounds256{"atrium.glb", 31, 1.9, 12.5, 28, 30}),
                         [](const auto& bounds) { return test::nameOf(std::string(bounds.param.scene)); });

TEST_P(AttributeQuality, IsKept)
{
    const auto path = test::findScene(GetParam().scene);
    if (!path)
    {
        GTEST_SKIP() << GetParam().scene << " is not there";
    }
    const std::vector<Quality> qualities = measure(*path, 8);
    const Quality& words = qualities[0];
    EXPECT_GT(words.voxels.color_db, 41);
    EXPECT_EQ(words.voxels.stand_in_share + words.voxels.lost_share, 0.0);
    EXPECT_LT(words.voxels.mean_degrees, 0.32);
    EXPECT_LT(words.voxels.max_degrees, 0.66);
    EXPECT_GT(words.picture_db, 41);
    const Quality& blocks = qualities[1];
    EXPECT_GT(blocks.voxels.color_db, GetParam().color_db);
    EXPECT_LT(blocks.voxels.stand_in_share + blocks.voxels.lost_share, 0.075);
    EXPECT_LT(blocks.voxels.mean_degrees, GetParam().mean_degrees);
    EXPECT_LT(blocks.voxels.percentile_degrees, GetParam().percentile_degrees);
    EXPECT_LT(blocks.voxels.max_degrees, GetParam().max_degrees);
    EXPECT_GT(blocks.picture_db, GetParam().picture_db);
    EXPECT_GT(blocks.nodes.color_db, 41);
    EXPECT_LT(blocks.nodes.max_degrees, 0.66);
}

TEST_P(AttributeQuality, DISABLED_Table)
{
    const auto path = test::findScene(GetParam().scene);
    ASSERT_TRUE(path);
    const Loss blocks = measure(*path, 9)[1].voxels;
    measure(*path, 10);
    fmt::print("{} 512 in blocks: {:.1f} % of the voxels have no normal, {:.1f} % a stand-in, {:.1f} % lost theirs\n",
               GetParam().scene, 100 * blocks.missing_share, 100 * blocks.stand_in_share, 100 * blocks.lost_share);
}

} // namespace
} // namespace zvo
