// SPDX-License-Identifier: MIT
#include "oracle/attribute_formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace zvo::oracle
{

namespace
{

using Vector = std::array<std::int64_t, 3>;

std::uint32_t bitsOf(std::uint32_t word, int first, int count)
{
    return word >> first & ((1U << count) - 1);
}

// from / from_max as a fraction of to_max, rounded.
std::int64_t rescaled(std::int64_t from, int from_max, int to_max)
{
    return std::lround(static_cast<double>(from) * to_max / from_max);
}

// The vector of an octahedral code, on the octahedron |x| + |y| + |z| = one. x and y are in the same unit.
Vector onOctahedron(std::int64_t x, std::int64_t y, std::int64_t one)
{
    const std::int64_t z = one - std::abs(x) - std::abs(y);
    if (z >= 0)
    {
        return {x, y, z};
    }
    return {(one - std::abs(y)) * (x < 0 ? -1 : 1), (one - std::abs(x)) * (y < 0 ? -1 : 1), z};
}

std::int64_t dot(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Whether v is nearer in angle to a than to b. Both angles are acute; v has components up to 2^15, a and b up to 2^7.
bool isNearer(const Vector& v, const Vector& a, const Vector& b)
{
    const std::int64_t to_a = std::max<std::int64_t>(dot(v, a), 0);
    const std::int64_t to_b = std::max<std::int64_t>(dot(v, b), 0);
    return to_a * to_a * dot(b, b) > to_b * to_b * dot(a, a); // squared cosines
}

std::int64_t snorm16(std::uint32_t bits)
{
    return std::max(static_cast<int>(static_cast<std::int16_t>(bits)), -32767);
}

std::uint32_t packNormal8(std::uint32_t normal)
{
    if (normal == gpu::kNoNormal)
    {
        return 0x8080;
    }
    const std::int64_t x = snorm16(normal);
    const std::int64_t y = snorm16(normal >> 16);
    const Vector v = onOctahedron(x, y, 32767);
    const auto lower = [](std::int64_t c)
    { return static_cast<std::int64_t>(std::floor(static_cast<double>(c) * 127 / 32767)); };
    std::array<std::int64_t, 2> best = {lower(x), lower(y)};
    for (const int up_y : {0, 1})
    {
        for (const int up_x : {0, 1})
        {
            const std::array<std::int64_t, 2> code = {lower(x) + up_x, lower(y) + up_y};
            const bool is_code = code[0] <= 127 && code[1] <= 127;
            if (is_code && isNearer(v, onOctahedron(code[0], code[1], 127), onOctahedron(best[0], best[1], 127)))
            {
                best = code;
            }
        }
    }
    return static_cast<std::uint8_t>(best[0]) | static_cast<std::uint32_t>(static_cast<std::uint8_t>(best[1])) << 8;
}

} // namespace

std::uint32_t packAttribute4(const gpu::Attribute& attribute)
{
    const auto channel = [&](int first, int max)
    { return static_cast<std::uint32_t>(rescaled(bitsOf(attribute.color, first, 8), 255, max)); };
    return channel(0, 31) | channel(8, 63) << 5 | channel(16, 31) << 11 | packNormal8(attribute.normal) << 16;
}

gpu::Attribute unpackAttribute4(std::uint32_t word)
{
    const auto channel = [&](int first, int bits)
    { return static_cast<std::uint32_t>(rescaled(bitsOf(word, first, bits), (1 << bits) - 1, 255)); };
    const auto coordinate = [&](int first)
    { return static_cast<std::uint16_t>(rescaled(static_cast<std::int8_t>(bitsOf(word, first, 8)), 127, 32767)); };
    const std::uint32_t normal = coordinate(16) | static_cast<std::uint32_t>(coordinate(24)) << 16;
    return {channel(0, 5) | channel(5, 6) << 8 | channel(11, 5) << 16,
            bitsOf(word, 16, 16) == 0x8080 ? gpu::kNoNormal : normal};
}

} // namespace zvo::oracle
