// SPDX-License-Identifier: MIT
#include "bench/balance_scenes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kCrowdMax = 200000;
constexpr std::uint32_t kBoxesMax = 100000;
constexpr float kSlopeX = 0.2F; // slope of the plane of triangle and patch
constexpr float kSlopeY = 0.13F;

Scene soupOf(std::vector<glm::vec3> corners)
{
    Scene scene;
    scene.materials.emplace_back();
    Primitive& primitive = scene.primitives.emplace_back();
    for (std::uint32_t i = 0; i < corners.size(); i += 3)
    {
        primitive.triangles.emplace_back(i, i + 1, i + 2);
    }
    primitive.positions = std::move(corners);
    scene.instances.emplace_back();
    return scene;
}

glm::vec3 onPlane(float x, float y)
{
    return {1 + x, 1 + y, 1 + kSlopeX * x + kSlopeY * y};
}

// A number in [-1, 1]. Unlike the library's distributions, it is the same on every platform.
float signedUnit(std::mt19937& random)
{
    return static_cast<float>(random() >> 8) / static_cast<float>(1U << 23) - 1.0F;
}

glm::vec3 direction(std::mt19937& random)
{
    for (;;)
    {
        const glm::vec3 v(signedUnit(random), signedUnit(random), signedUnit(random));
        const float length = glm::length(v);
        if (length > 0.1F && length <= 1.0F)
        {
            return v / length;
        }
    }
}

// At most as many as there are blocks of edge^3 voxels.
std::uint32_t countOf(std::uint32_t most, std::uint32_t resolution, std::uint32_t edge)
{
    const std::uint64_t blocks = resolution / edge;
    return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(blocks * blocks * blocks, 1, most));
}

std::uint32_t crowdCount(std::uint32_t resolution)
{
    return countOf(kCrowdMax, resolution, 2);
}

// Adds an equilateral triangle, whose middle is at the origin inside the voxel around it.
void addThroughMiddle(std::vector<glm::vec3>& corners, const glm::vec3& middle, std::mt19937& random)
{
    constexpr float kRadius = 0.45F;
    const glm::vec3 first = direction(random);
    glm::vec3 across = glm::cross(first, direction(random));
    while (glm::length(across) < 0.1F)
    {
        across = glm::cross(first, direction(random));
    }
    const glm::vec3 side = glm::normalize(across) * std::sqrt(0.75F);
    for (const glm::vec3& corner : {first, side - 0.5F * first, -side - 0.5F * first})
    {
        corners.push_back(middle + kRadius * corner);
    }
}

// Points of a cubic lattice, with as many on each edge as `count` needs.
struct Lattice
{
    std::uint32_t edge = 1;
    std::uint32_t step = 1;
};

Lattice latticeOf(std::uint32_t count, std::uint32_t resolution)
{
    Lattice lattice;
    while (std::uint64_t{lattice.edge} * lattice.edge * lattice.edge < count)
    {
        ++lattice.edge;
    }
    lattice.step = std::max(resolution / lattice.edge, 1U);
    return lattice;
}

// Middles of voxels over the whole grid.
std::vector<glm::vec3> crowdMiddles(std::uint32_t resolution)
{
    const std::uint32_t count = crowdCount(resolution);
    const auto [edge, step] = latticeOf(count, resolution);
    std::vector<glm::vec3> middles;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        middles.push_back(glm::vec3(glm::uvec3(i % edge, i / edge % edge, i / edge / edge) * step) + 0.5F);
    }
    return middles;
}

Scene crowd(const std::vector<glm::vec3>& middles)
{
    std::mt19937 random(1);
    std::vector<glm::vec3> corners;
    corners.reserve(3 * middles.size());
    for (const glm::vec3& middle : middles)
    {
        addThroughMiddle(corners, middle, random);
    }
    return soupOf(std::move(corners));
}

} // namespace

Scene largeTriangle(std::uint32_t resolution)
{
    const float leg = static_cast<float>(resolution) * std::sqrt(0.5F);
    return soupOf({onPlane(0, 0), onPlane(leg, 0), onPlane(0, leg)});
}

Scene smallTriangles(std::uint32_t resolution)
{
    const float edge = static_cast<float>(resolution) / 2;
    const auto quads = static_cast<std::uint32_t>(std::max(1.0F, std::round(edge / std::sqrt(8.0F))));
    const float step = edge / static_cast<float>(quads);
    std::vector<glm::vec3> corners;
    for (std::uint32_t i = 0; i < quads * quads; ++i)
    {
        const glm::vec2 low = step * glm::vec2(i % quads, i / quads);
        const glm::vec2 high = low + step;
        const glm::vec3 a = onPlane(low.x, low.y);
        const glm::vec3 b = onPlane(high.x, high.y);
        corners.insert(corners.end(), {a, onPlane(high.x, low.y), b, a, b, onPlane(low.x, high.y)});
    }
    return soupOf(std::move(corners));
}

Scene diagonalSlivers(std::uint32_t resolution)
{
    constexpr int kRows = 10; // of slivers on either axis, along each diagonal
    const auto edge = static_cast<float>(resolution);
    const float spread = edge / 4; // edge of the squares in which they begin and end
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 4 * kRows * kRows; ++i)
    {
        const glm::vec2 base = glm::vec2(i / 4 % kRows, i / 4 / kRows) * (spread / kRows);
        glm::vec3 triangle[3] = {{base, 0}, {base + (edge - spread), edge}, {base, 0}};
        triangle[2].z += 2;
        for (glm::vec3& corner : triangle)
        {
            corner.x = i % 2 == 0 ? corner.x : edge - corner.x;
            corner.y = i / 2 % 2 == 0 ? corner.y : edge - corner.y;
        }
        corners.insert(corners.end(), std::begin(triangle), std::end(triangle));
    }
    return soupOf(std::move(corners));
}

Scene crowdedTriangles(std::uint32_t resolution)
{
    return crowd(std::vector(crowdCount(resolution), glm::vec3(static_cast<float>(resolution / 2) + 0.5F)));
}

Scene spreadTriangles(std::uint32_t resolution)
{
    return crowd(crowdMiddles(resolution));
}

Scene brickTriangles(std::uint32_t resolution)
{
    const glm::vec3 low = glm::vec3(static_cast<float>(resolution / 32 * 16) + 0.5F);
    const std::uint32_t edge = std::min(resolution, 16U);
    std::vector<glm::vec3> middles;
    for (std::uint32_t i = 0; i < crowdCount(resolution); ++i)
    {
        middles.push_back(low + glm::vec3(glm::uvec3(i, i / edge, i / edge / edge) % edge));
    }
    return crowd(middles);
}

Scene fanOfSlivers(std::uint32_t resolution)
{
    constexpr int kSlivers = 2000;
    const float half = static_cast<float>(resolution) / 2;
    std::mt19937 random(1);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < kSlivers; ++i)
    {
        const glm::vec3 end = glm::vec3(half) + half * direction(random);
        corners.insert(corners.end(), {glm::vec3(half), end, end + 2.0F * direction(random)});
    }
    return soupOf(std::move(corners));
}

Scene manyBoxes(std::uint32_t resolution)
{
    const std::uint32_t count = countOf(kBoxesMax, resolution, 4);
    const auto [edge, step] = latticeOf(count, resolution);
    const float size = 0.6F * static_cast<float>(step);
    std::vector<glm::vec3> corners;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const glm::vec3 low = glm::vec3(glm::uvec3(i % edge, i / edge % edge, i / edge / edge) * step) + 0.25F;
        for (int face = 0; face < 6; ++face)
        {
            const int axis = face % 3;
            glm::vec3 quad[4];
            for (int corner = 0; corner < 4; ++corner)
            {
                quad[corner] = low;
                quad[corner][axis] += face < 3 ? 0.0F : size;
                quad[corner][(axis + 1) % 3] += corner % 2 == 0 ? 0.0F : size;
                quad[corner][(axis + 2) % 3] += corner / 2 == 0 ? 0.0F : size;
            }
            corners.insert(corners.end(), {quad[0], quad[1], quad[3], quad[0], quad[3], quad[2]});
        }
    }
    return soupOf(std::move(corners));
}

} // namespace zvo::cli
