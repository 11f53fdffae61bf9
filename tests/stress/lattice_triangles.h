// SPDX-License-Identifier: MIT
// Triangles on the lattice (1/256 voxel) for comparing coverage. Each shape can fail in its own way.
#pragma once

#include "core/scene/scene.h"
#include "oracle/coverage.h"

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace zvo::stress
{

/// Three points of the lattice, with coordinates that single precision holds exactly.
using LatticeTriangle = std::array<glm::ivec3, 3>;

enum class Shape : std::uint32_t
{
    Random,     // three points anywhere, of all sizes
    Sliver,     // the third point almost on the edge between the others, or on it
    Needle,     // two points within a few units of each other
    Tiny,       // less than a voxel or so, near corners, middles and diamonds of voxels
    Aligned,    // multiples of 256, 128, 64 or 32: borders, centres, walls, 45 degrees
    Degenerate, // points and segments
    Border,     // across the grid's faces, in them, one unit beside them, or outside of them
    Huge,       // up to 2^29, far beyond the grid
    Threshold   // near the limits of kernels: 32 columns, 8192 units, blocks of 256 columns and 8 rows
};
constexpr std::uint32_t kShapeCount = 9;

const char* nameOf(Shape shape);

/// Triangles for one grid.
struct Batch
{
    Shape shape = Shape::Random;
    std::uint32_t depth = 1;
    bool disjoint = false; // no voxel is covered by two triangles, because each is in its own block
    std::vector<LatticeTriangle> triangles;
};

/// Makes a batch of at most count_max triangles, which is the same for the same arguments.
Batch makeBatch(std::uint64_t seed, Shape shape, std::uint64_t number, std::size_t count_max);

oracle::Triangle exact(const LatticeTriangle& triangle);

/// The triangles as a scene. Its grid has the corner at 0 and voxels of size 1, so that points lie on the lattice
/// exactly. colors: one for each triangle, fractions of 65535, or empty.
Scene latticeScene(std::span<const LatticeTriangle> triangles, std::span<const std::array<std::uint16_t, 3>> colors);

/// Triangles with points between those of the lattice: a few primitives in several instances, rotated, sheared and
/// mirrored at random, in a grid of any size and position. They are the same for the same arguments.
struct PosedGpuScene
{
    Scene scene;
    Grid grid;
};
PosedGpuScene makePosedScene(std::uint64_t seed, std::uint64_t number);

/// "(x y z) (x y z) (x y z)".
std::string toText(const LatticeTriangle& triangle);

} // namespace zvo::stress
