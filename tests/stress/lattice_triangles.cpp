// SPDX-License-Identifier: MIT
#include "stress/lattice_triangles.h"

#include "stress/triangle_maker.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace zvo::stress
{
namespace
{

// Single precision, with 24 bits, holds all lattice points up to here; deep_grid_test covers deeper grids.
constexpr int kDepthMax = 16;

/// Puts one triangle into each block of edge^3 voxels, in blocks drawn without repetition. A voxel's width is left free
/// at each side of a block, because closed voxels touch.
void fillBlocks(TriangleMaker& maker, Batch& batch, int block_log2, std::size_t count_max)
{
    const int axis_log2 = static_cast<int>(batch.depth) - block_log2;
    const std::uint64_t block_count = std::uint64_t{1} << (3 * axis_log2);
    const std::uint64_t start = maker.bits();
    const std::uint64_t stride = maker.bits() | 1;
    const TriangleRoom room = {256, ((1 << block_log2) - 1) * 256};
    const std::uint64_t axis_mask = (std::uint64_t{1} << axis_log2) - 1;
    batch.disjoint = true;
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(block_count, count_max); ++i)
    {
        const std::uint64_t block = (start + i * stride) & (block_count - 1);
        const glm::ivec3 corner =
            glm::ivec3(static_cast<int>(block & axis_mask), static_cast<int>(block >> axis_log2 & axis_mask),
                       static_cast<int>(block >> (2 * axis_log2)))
            << (block_log2 + 8);
        LatticeTriangle triangle = maker.triangle(batch.shape, room, 1 << batch.depth);
        for (glm::ivec3& p : triangle)
            p = representable(p + corner);
        batch.triangles.push_back(triangle);
    }
}

/// Puts triangles on top of each other, across a grid of low resolution. expected_voxels: approximate number for one
/// triangle.
void fillPile(TriangleMaker& maker, Batch& batch, std::size_t expected_voxels, std::size_t count_max)
{
    const int resolution = 1 << batch.depth;
    const std::size_t voxels = std::size_t{1} << (3 * batch.depth);
    // Usually so few that each fragment shows in its voxel's colour; sometimes only a handful, so that each shows in
    // the set.
    std::size_t count = std::clamp<std::size_t>(6 * voxels / expected_voxels, 12, 4096);
    count = maker.oneIn(4) ? static_cast<std::size_t>(maker.pick(1, 4)) : count;
    const int margin = maker.oneIn(2) ? 0 : maker.pick(1, 512);
    const TriangleRoom room = {-margin, resolution * 256 + margin};
    while (batch.triangles.size() < std::min(count, count_max))
        batch.triangles.push_back(maker.triangle(batch.shape, room, resolution));
}

/// Long needles and slivers beyond the grid on all sides, at high resolution.
void fillHugeLines(TriangleMaker& maker, Batch& batch, std::size_t count_max)
{
    const std::size_t count = std::clamp<std::size_t>((std::size_t{1} << 17) >> batch.depth, 4, 256);
    for (std::size_t i = 0; i < std::min(count_max, count); ++i)
        batch.triangles.push_back(maker.huge(1 << batch.depth, true));
}

std::uint32_t pickDepth(TriangleMaker& maker, int low, int high)
{
    return static_cast<std::uint32_t>(maker.pick(low, high));
}

} // namespace

const char* nameOf(Shape shape)
{
    static constexpr std::array<const char*, kShapeCount> kNames{
        "random", "sliver", "needle", "tiny", "aligned", "degenerate", "border", "huge", "threshold"};
    return kNames[static_cast<std::size_t>(shape)];
}

Batch makeBatch(std::uint64_t seed, Shape shape, std::uint64_t number, std::size_t count_max)
{
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL; // makes seeds differ in all bits
    TriangleMaker maker((seed * kGolden + static_cast<std::uint64_t>(shape)) * kGolden + number);
    Batch batch;
    batch.shape = shape;
    const bool pile = number % 3 == 0;
    switch (batch.shape)
    {
    case Shape::Border:
        batch.depth = pickDepth(maker, 1, 6);
        fillPile(maker, batch, std::size_t{1} << (2 * batch.depth), count_max);
        break;
    case Shape::Huge:
        batch.depth = number % 4 == 1 ? pickDepth(maker, 7, kDepthMax) : pickDepth(maker, 1, 6);
        if (number % 32 == 31) // many blocks
        {
            batch.depth = pickDepth(maker, 8, 10);
            batch.triangles.push_back(maker.huge(1 << batch.depth, false));
        }
        else if (batch.depth <= 6)
            fillPile(maker, batch, std::size_t{2} << (2 * batch.depth), count_max);
        else
            fillHugeLines(maker, batch, count_max);
        break;
    case Shape::Threshold:
        batch.depth = maker.oneIn(4) ? kDepthMax : pickDepth(maker, 9, kDepthMax);
        fillBlocks(maker, batch, maker.oneIn(4) ? 9 : 6, std::min<std::size_t>(count_max, 2048));
        break;
    default:
        if (pile)
        {
            batch.depth = pickDepth(maker, 1, 6);
            fillPile(maker, batch, batch.shape == Shape::Tiny ? 4 : 4U << batch.depth, count_max);
        }
        else
        {
            // Blocks of 8^3 or 16^3 voxels have small triangles. Blocks of 64^3 and more also have some that go by
            // rows.
            const int block_log2 = maker.oneIn(12) ? 6 : maker.oneIn(3) ? 4 : 3;
            batch.depth = pickDepth(maker, std::max(7, block_log2 + 3), kDepthMax);
            fillBlocks(maker, batch, block_log2, std::min<std::size_t>(count_max, block_log2 == 6 ? 1024 : 16384));
        }
        break;
    }
    return batch;
}

oracle::Triangle exact(const LatticeTriangle& triangle)
{
    oracle::Triangle result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            result[i][k] = triangle[i][static_cast<int>(k)];
    return result;
}

Scene latticeScene(std::span<const LatticeTriangle> triangles, std::span<const std::array<std::uint16_t, 3>> colors)
{
    Scene scene;
    scene.materials.emplace_back();
    Primitive& primitive = scene.primitives.emplace_back();
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
        const auto first = static_cast<std::uint32_t>(3 * i);
        primitive.triangles.emplace_back(first, first + 1, first + 2);
        for (const glm::ivec3& p : triangles[i])
        {
            primitive.positions.push_back(glm::vec3(p) / 256.0F);
            if (!colors.empty())
                primitive.colors.emplace_back(static_cast<float>(colors[i][0]) / 65535.0F,
                                              static_cast<float>(colors[i][1]) / 65535.0F,
                                              static_cast<float>(colors[i][2]) / 65535.0F, 1.0F);
        }
    }
    scene.instances.emplace_back();
    return scene;
}

PosedGpuScene makePosedScene(std::uint64_t seed, std::uint64_t number)
{
    std::mt19937_64 random(seed * 1'000'003 + number);
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const auto vector = [&](float reach) {
        return glm::vec3{uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)};
    };

    PosedGpuScene placed;
    placed.grid.depth = 5 + static_cast<std::uint32_t>(random() % 4);
    placed.grid.voxel_size = std::exp2(uniform(-20.0F, 12.0F));
    const float edge = placed.grid.voxel_size * static_cast<float>(placed.grid.resolution());
    placed.grid.origin = vector(edge * std::exp2(uniform(-2.0F, 8.0F)));
    constexpr std::uint32_t kPlaces = 8;
    constexpr std::uint32_t kTrianglesPerPlace = 250;
    for (std::uint32_t place = 0; place < kPlaces; ++place)
    {
        std::vector<LatticeTriangle> triangles(kTrianglesPerPlace);
        std::vector<std::array<std::uint16_t, 3>> colors(kTrianglesPerPlace);
        for (std::array<std::uint16_t, 3>& color : colors)
            for (std::uint16_t& channel : color)
                channel = static_cast<std::uint16_t>(random() & 65535);
        Scene part = latticeScene(triangles, colors);
        std::vector<glm::vec3>& points = part.primitives[0].positions;
        for (std::size_t i = 0; i < points.size(); i += 3)
        {
            const glm::vec3 middle = vector(1.0F);
            const float size = std::exp2(uniform(-9.0F, -2.0F));
            for (std::size_t k = 0; k < 3; ++k)
                points[i + k] = middle + vector(size);
        }
        glm::mat4& transform = part.instances[0].transform;
        for (int column = 0; column < 3; ++column)
            transform[column] = glm::vec4(vector(edge * 0.3F), 0.0F);
        transform[3] = glm::vec4(placed.grid.origin + 0.5F * edge + vector(0.2F * edge), 1.0F);
        placed.scene.append(std::move(part));
    }
    return placed;
}

std::string toText(const LatticeTriangle& triangle)
{
    std::string text;
    for (const glm::ivec3& p : triangle)
        text += (text.empty() ? "(" : " (") + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                std::to_string(p.z) + ")";
    return text;
}

} // namespace zvo::stress
