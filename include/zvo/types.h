// SPDX-License-Identifier: MIT
// Small types that all of zvo shares. Vectors and matrices are plain arrays, so that those of any maths library can be
// copied.
#pragma once

#include "zvo/enums.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace zvo
{

using Vec2 = std::array<float, 2>;
using Vec3 = std::array<float, 3>;
using Vec4 = std::array<float, 4>;
using DVec2 = std::array<double, 2>;
using DVec3 = std::array<double, 3>;

/// An affine transform of columns: element (row, column) is [4 * column + row], the last row is (0, 0, 0, 1).
using Mat4 = std::array<float, 16>;
using DMat4 = std::array<double, 16>;

inline constexpr Mat4 kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// A cube of (1 << depth)^3 voxels. Voxel (x, y, z) is the box of edge voxel_size whose minimum corner is origin +
/// voxel_size * (x, y, z).
struct GridInfo
{
    Vec3 origin{};           // world position of the minimum corner
    float voxel_size = 1.0F; // world units
    std::uint32_t depth = 8; // 1 to 17
};

/// The device's time of one pass.
struct PassTime
{
    std::string name; // "operation/kernel", or "fill", "copy" and so on with a buffer's name
    double ms = 0;
};

} // namespace zvo
