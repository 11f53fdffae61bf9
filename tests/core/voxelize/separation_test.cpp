// SPDX-License-Identifier: MIT
// Voxels of closed surfaces separate inside and outside: no path through faces of uncovered voxels connects them.
#include "io/gltf/gltf_loader.h"
#include "oracle/winding.h"
#include "support/engine_device.h"
#include "support/lattice_sets.h"
#include "support/param_names.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace zvo
{
namespace
{

using stress::LatticeTriangle;
using test::LatticeTriangles;

using test::device;

/// Triangles with shared corners, so that the surface stays closed when corners are rounded.
struct Solid
{
    std::vector<glm::dvec3> points;
    std::vector<glm::uvec3> triangles;
    /// Whether a point is inside: 1 yes, 0 no, -1 too close to the surface.
    std::function<int(const glm::dvec3&)> inside = [](const glm::dvec3&) { return -1; };
};

/// Adds a grid of columns x rows quads that is closed in both directions, or along columns with caps. The outside is
/// right-handed.
void addQuads(Solid& solid, std::uint32_t columns, std::uint32_t rows,
              const std::function<std::uint32_t(std::uint32_t column, std::uint32_t row)>& index)
{
    for (std::uint32_t row = 0; row < rows; ++row)
    {
        for (std::uint32_t column = 0; column < columns; ++column)
        {
            const std::uint32_t a = index(column, row);
            const std::uint32_t b = index((column + 1) % columns, row);
            const std::uint32_t c = index((column + 1) % columns, row + 1);
            const std::uint32_t d = index(column, row + 1);
            for (const glm::uvec3& triangle : {glm::uvec3(a, b, c), glm::uvec3(a, c, d)})
            {
                if (triangle.x != triangle.y && triangle.y != triangle.z && triangle.z != triangle.x)
                {
                    solid.triangles.push_back(triangle);
                }
            }
        }
    }
}

Solid sphere(std::uint32_t rings)
{
    Solid solid;
    const std::uint32_t segments = 2 * rings;
    solid.points = {{0, 0, -1}, {0, 0, 1}};
    for (std::uint32_t ring = 1; ring < rings; ++ring)
    {
        for (std::uint32_t segment = 0; segment < segments; ++segment)
        {
            const double theta = std::numbers::pi * ring / rings;
            const double phi = std::numbers::pi * segment / rings;
            solid.points.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                      -std::cos(theta));
        }
    }
    addQuads(solid, segments, rings,
             [&](std::uint32_t column, std::uint32_t row) {
                 return row == 0 ? 0 : row == rings ? 1 : 2 + (row - 1) * segments + column;
             });
    const double sure = 1 - 12.0 / (rings * rings); // the faces cut off less than that
    solid.inside = [sure](const glm::dvec3& p) { return glm::length(p) < sure ? 1 : glm::length(p) > 1.001 ? 0 : -1; };
    return solid;
}

Solid torus(std::uint32_t columns, std::uint32_t rows)
{
    constexpr double kTube = 0.4;
    constexpr double kRing = 0.6;
    Solid solid;
    for (std::uint32_t row = 0; row < rows; ++row)
    {
        for (std::uint32_t column = 0; column < columns; ++column)
        {
            const double phi = 2 * std::numbers::pi * column / columns;
            const double theta = 2 * std::numbers::pi * row / rows;
            const double distance = kRing + kTube * std::cos(theta);
            solid.points.emplace_back(distance * std::cos(phi), distance * std::sin(phi), kTube * std::sin(theta));
        }
    }
    addQuads(solid, columns, rows,
             [&](std::uint32_t column, std::uint32_t row) { return row % rows * columns + column; });
    const double slack = 12.0 / (std::min(columns, rows) * std::min(columns, rows));
    solid.inside = [slack](const glm::dvec3& p)
    {
        const double distance = std::hypot(std::hypot(p.x, p.y) - kRing, p.z);
        return distance < kTube - slack ? 1 : distance > kTube + slack ? 0 : -1;
    };
    return solid;
}

Solid cube()
{
    Solid solid;
    for (std::uint32_t corner = 0; corner < 8; ++corner)
    {
        solid.points.emplace_back((corner & 1) * 1.0 - 0.5, (corner >> 1 & 1) * 1.0 - 0.5, (corner >> 2) * 1.0 - 0.5);
    }
    solid.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    solid.inside = [](const glm::dvec3& p)
    {
        const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        return reach < 0.499 ? 1 : reach > 0.501 ? 0 : -1;
    };
    return solid;
}

/// A closed model, scaled into the unit sphere. Corners with the same position are shared.
Solid model(const std::filesystem::path& path)
{
    const Scene scene = loadGltf(path);
    Solid solid;
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives[instance.primitive];
        const auto first = static_cast<std::uint32_t>(solid.points.size());
        for (const glm::vec3& position : primitive.positions)
        {
            solid.points.emplace_back(transformPoint(instance.transform, position));
        }
        for (const glm::uvec3& triangle : primitive.triangles)
        {
            solid.triangles.push_back(triangle + first);
        }
    }
    const Bounds bounds = scene.bounds();
    const glm::dvec3 center = 0.5 * (glm::dvec3(bounds.min) + glm::dvec3(bounds.max));
    const double radius = 0.5 * glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
    for (glm::dvec3& point : solid.points)
    {
        point = (point - center) / radius;
    }
    return solid;
}

glm::dmat3 randomRotation(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const glm::dvec3 x = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const glm::dvec3 z = glm::normalize(glm::cross(x, glm::dvec3(normal(random), normal(random), normal(random))));
    return {x, glm::cross(z, x), z};
}

/// The position of a solid in its grid: p becomes centre + size * rotation * p, in lattice units.
struct Placement
{
    glm::dmat3 rotation{1.0};
    glm::dvec3 center{0.0};
    double size = 1;
};

LatticeTriangles placed(const Solid& solid, const Placement& placement)
{
    std::vector<glm::ivec3> points;
    for (const glm::dvec3& point : solid.points)
    {
        points.emplace_back(glm::round(placement.center + placement.size * (placement.rotation * point)));
    }
    LatticeTriangles triangles;
    for (const glm::uvec3& t : solid.triangles)
    {
        triangles.push_back({points[t.x], points[t.y], points[t.z]});
    }
    return triangles;
}

/// A grid with a byte for each voxel, x fastest.
struct Field
{
    std::uint32_t resolution;
    std::vector<std::uint8_t> values;

    [[nodiscard]] std::size_t index(const glm::ivec3& v) const
    {
        return (static_cast<std::size_t>(v.z) * resolution + static_cast<std::size_t>(v.y)) * resolution +
               static_cast<std::size_t>(v.x);
    }
    [[nodiscard]] bool holds(const glm::ivec3& v) const
    {
        return glm::all(glm::greaterThanEqual(v, glm::ivec3(0))) &&
               glm::all(glm::lessThan(v, glm::ivec3(static_cast<int>(resolution))));
    }
};

constexpr std::uint8_t kFree = 0;
constexpr std::uint8_t kCovered = 1;
constexpr std::uint8_t kReached = 2;

/// Marks everything that a path from outside of the grid through faces of free voxels reaches.
void flood(Field& field)
{
    std::vector<glm::ivec3> open;
    const auto reach = [&](const glm::ivec3& v)
    {
        if (field.holds(v) && field.values[field.index(v)] == kFree)
        {
            field.values[field.index(v)] = kReached;
            open.push_back(v);
        }
    };
    const int end = static_cast<int>(field.resolution);
    for (int a = 0; a < end; ++a)
    {
        for (int b = 0; b < end; ++b)
        {
            for (const int side : {0, end - 1})
            {
                reach({side, a, b});
                reach({a, side, b});
                reach({a, b, side});
            }
        }
    }
    while (!open.empty())
    {
        const glm::ivec3 v = open.back();
        open.pop_back();
        for (int axis = 0; axis < 3; ++axis)
        {
            for (const int step : {-1, 1})
            {
                glm::ivec3 next = v;
                next[axis] += step;
                reach(next);
            }
        }
    }
}

void expectSeparates(const Solid& solid, const Placement& placement, std::uint32_t depth, Coverage coverage)
{
    const LatticeTriangles triangles = placed(solid, placement);
    std::vector<oracle::Triangle> exact;
    std::transform(triangles.begin(), triangles.end(), std::back_inserter(exact), stress::exact);
    ASSERT_TRUE(oracle::isClosed(exact)) << "not a closed surface";
    const std::vector<std::int16_t> winding = oracle::windingNumbers(exact, 1U << depth);

    Field field{1U << depth, std::vector<std::uint8_t>(winding.size(), kFree)};
    for (const std::uint64_t code : test::deviceVoxels(device(), triangles, depth, coverage))
    {
        field.values[field.index(glm::ivec3(oracle::mortonDecode(code)))] = kCovered;
    }
    flood(field);

    const int end = static_cast<int>(field.resolution);
    const glm::dmat3 back = glm::transpose(placement.rotation);
    std::size_t inside_count = 0;
    std::size_t leaks = 0;
    std::size_t steps_through = 0; // between free neighbours with different winding numbers
    std::size_t misjudged = 0;     // winding numbers that contradict the solid
    for (glm::ivec3 v{0}; v.z < end; ++v.z)
    {
        for (v.y = 0; v.y < end; ++v.y)
        {
            for (v.x = 0; v.x < end; ++v.x)
            {
                const std::size_t i = field.index(v);
                const glm::dvec3 center = glm::dvec3(v) * 256.0 + 128.0;
                const int sure = solid.inside(back * (center - placement.center) / placement.size);
                misjudged += sure >= 0 && sure != winding[i] ? 1 : 0;
                leaks += sure == 1 && field.values[i] == kReached ? 1 : 0;
                if (field.values[i] == kCovered)
                {
                    continue;
                }
                inside_count += winding[i] != 0 ? 1 : 0;
                leaks += winding[i] != 0 && field.values[i] == kReached ? 1 : 0;
                for (int axis = 0; axis < 3; ++axis)
                {
                    glm::ivec3 next = v;
                    ++next[axis];
                    const bool free = next[axis] < end && field.values[field.index(next)] != kCovered;
                    steps_through += free && winding[field.index(next)] != winding[i] ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(inside_count, 0U);
    EXPECT_EQ(misjudged, 0U);
    EXPECT_EQ(leaks, 0U);
    EXPECT_EQ(steps_through, 0U);
}

void expectSeparatesInManyPlaces(const Solid& solid, std::uint32_t depth, int count)
{
    std::mt19937 random(depth);
    const double edge = 256.0 * (1U << depth);
    for (int i = 0; i < count; ++i)
    {
        SCOPED_TRACE(i);
        Placement placement;
        placement.size = edge * std::uniform_real_distribution<double>(0.3, 0.45)(random);
        for (int axis = 0; axis < 3; ++axis)
        {
            placement.center[axis] = edge / 2 + std::uniform_real_distribution<double>(-200, 200)(random);
        }
        if (i % 4 != 0)
        {
            placement.rotation = randomRotation(random);
        }
        else // faces on borders and on centres of voxels, corners on both
        {
            placement.center = glm::dvec3(edge / 2 + 128.0 * (i / 4 % 2));
            placement.size = 256.0 * std::floor(placement.size / 256);
        }
        expectSeparates(solid, placement, depth, Coverage::Thin);
    }
    Placement placement{randomRotation(random), glm::dvec3(edge / 2), edge * 0.45};
    expectSeparates(solid, placement, depth, Coverage::Conservative);
}

TEST(Separation, OfSpheres)
{
    expectSeparatesInManyPlaces(sphere(8), 5, 16);
    expectSeparatesInManyPlaces(sphere(48), 7, 4);  // triangles of a few voxels
    expectSeparatesInManyPlaces(sphere(128), 6, 4); // triangles smaller than voxels
}

TEST(Separation, OfCubes)
{
    expectSeparatesInManyPlaces(cube(), 4, 40);
    expectSeparatesInManyPlaces(cube(), 7, 8);
}

TEST(Separation, OfTori)
{
    expectSeparatesInManyPlaces(torus(12, 8), 5, 16);
    expectSeparatesInManyPlaces(torus(96, 48), 7, 4);
}

TEST(Separation, OfSliversAndNeedles)
{
    // A sphere stretched along an axis. Its triangles are needles, and near the ends its sides are less than a voxel
    // apart.
    Solid solid = sphere(24);
    for (glm::dvec3& point : solid.points)
    {
        point *= glm::dvec3(0.05, 0.05, 1.0);
    }
    solid.inside = [](const glm::dvec3&) { return -1; };
    expectSeparatesInManyPlaces(solid, 7, 8);
}

using SeparationOfModels = testing::TestWithParam<std::string>;

INSTANTIATE_TEST_SUITE_P(Models, SeparationOfModels, testing::Values("asian_dragon_28k.glb", "buddha_113k.glb"),
                         test::paramName<std::string>);

TEST_P(SeparationOfModels, InAnyRotation)
{
    const auto path = test::findScene(GetParam());
    if (!path)
    {
        GTEST_SKIP() << GetParam() << " is not there";
    }
    expectSeparatesInManyPlaces(model(*path), 7, 3);
}

} // namespace
} // namespace zvo
