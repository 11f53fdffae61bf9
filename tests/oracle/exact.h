// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace zvo::oracle
{

__extension__ typedef __int128 Int128;

/// A point or direction in lattice coordinates (1/256 voxel). Coordinates up to 2^30 leave room for every product that
/// the coverage rules form: the largest, normal times position, stays below 2^94.
using Vec = std::array<Int128, 3>;

inline Vec operator-(const Vec& a, const Vec& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Int128 dot(const Vec& a, const Vec& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vec cross(const Vec& a, const Vec& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Int128 absolute(Int128 value)
{
    return value < 0 ? -value : value;
}

/// The largest integer not above numerator / denominator; denominator > 0.
inline Int128 floorDivide(Int128 numerator, Int128 denominator)
{
    const Int128 quotient = numerator / denominator;
    return numerator % denominator < 0 ? quotient - 1 : quotient;
}

} // namespace zvo::oracle
