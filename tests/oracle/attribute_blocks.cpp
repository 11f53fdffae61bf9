// SPDX-License-Identifier: MIT
// Blocks of 16 attributes, packed by voxel and by channel.
#include "oracle/attribute_formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>

namespace zvo::oracle
{

namespace
{

constexpr std::size_t kVoxels = 16;

using Color = std::array<std::int64_t, 3>; // 0 to 255
using Vector = std::array<std::int64_t, 3>;
using Point = std::array<std::int64_t, 2>;
constexpr Color kChannelMax = {31, 63, 31};

// a / b, rounded down; b above 0.
std::int64_t floored(std::int64_t a, std::int64_t b)
{
    return a / b - (a % b < 0 ? 1 : 0);
}

// a / b, rounded; b above 0.
std::int64_t rounded(std::int64_t a, std::int64_t b)
{
    return floored(2 * a + b, 2 * b);
}

// ---- colours

/// Two colours as fractions of kChannelMax.
struct ColorPair
{
    Color first{};
    Color second{};
};

struct Choices
{
    std::array<std::int64_t, kVoxels> of_voxels{};
    std::int64_t error = 0;
};

Color paletteColor(const ColorPair& pair, std::int64_t index)
{
    Color color{};
    for (std::size_t c = 0; c < 3; ++c)
    {
        const std::int64_t first = rounded(pair.first[c] * 255, kChannelMax[c]);
        const std::int64_t second = rounded(pair.second[c] * 255, kChannelMax[c]);
        color[c] = rounded(first * (3 - index) + second * index, 3);
    }
    return color;
}

Choices chooseColors(const std::array<Color, kVoxels>& colors, const ColorPair& pair)
{
    Choices choices;
    for (std::size_t i = 0; i < kVoxels; ++i)
    {
        std::int64_t least = INT64_MAX;
        for (std::int64_t index = 0; index < 4; ++index)
        {
            std::int64_t distance = 0;
            for (std::size_t c = 0; c < 3; ++c)
            {
                const std::int64_t d = paletteColor(pair, index)[c] - colors[i][c];
                distance += d * d;
            }
            if (distance < least)
            {
                least = distance;
                choices.of_voxels[i] = index;
            }
        }
        choices.error += least;
    }
    return choices;
}

Color sumOf(const std::array<Color, kVoxels>& colors)
{
    Color sum{};
    for (const Color& color : colors)
    {
        for (std::size_t c = 0; c < 3; ++c)
        {
            sum[c] += color[c];
        }
    }
    return sum;
}

// Returns, of the pairs of codes around the mean colour, the first one whose colour 1 is nearest, channel by channel.
ColorPair pairAroundMean(const std::array<Color, kVoxels>& colors)
{
    ColorPair pair;
    for (std::size_t c = 0; c < 3; ++c)
    {
        const std::int64_t mean = floored(sumOf(colors)[c] + 8, 16);
        const std::int64_t low = floored(mean * kChannelMax[c], 255);
        const std::int64_t high = std::min(low + 1, kChannelMax[c]);
        std::int64_t least = INT64_MAX;
        for (const auto& [first, second] : {std::pair{low, low}, {high, low}, {low, high}, {high, high}})
        {
            ColorPair tried;
            tried.first[c] = first;
            tried.second[c] = second;
            const std::int64_t distance = std::abs(paletteColor(tried, 1)[c] - mean);
            if (distance < least)
            {
                least = distance;
                pair.first[c] = first;
                pair.second[c] = second;
            }
        }
    }
    return pair;
}

ColorPair pairOfBox(const std::array<Color, kVoxels>& colors)
{
    const Color sum = sumOf(colors);
    std::array<Color, 3> covariances{};
    Color low = {255, 255, 255};
    Color high{};
    for (const Color& color : colors)
    {
        for (std::size_t c = 0; c < 3; ++c)
        {
            low[c] = std::min(low[c], color[c]);
            high[c] = std::max(high[c], color[c]);
            for (std::size_t d = 0; d < 3; ++d)
            {
                covariances[c][d] += (16 * color[c] - sum[c]) * (16 * color[d] - sum[d]);
            }
        }
    }
    std::size_t most = 0;
    for (std::size_t c = 1; c < 3; ++c)
    {
        most = covariances[c][c] > covariances[most][most] ? c : most;
    }
    ColorPair pair;
    for (std::size_t c = 0; c < 3; ++c)
    {
        const bool falling = covariances[most][c] < 0;
        pair.first[c] = rounded((falling ? high : low)[c] * kChannelMax[c], 255);
        pair.second[c] = rounded((falling ? low : high)[c] * kChannelMax[c], 255);
    }
    return pair;
}

/// Sums over voxels of the weights a and b of the two ends, and of their products with values.
struct Weights
{
    std::int64_t aa = 0;
    std::int64_t ab = 0;
    std::int64_t bb = 0;
    std::int64_t av = 0;
    std::int64_t bv = 0;

    Weights(const std::array<std::int64_t, kVoxels>& choices, std::int64_t steps,
            const std::function<std::int64_t(std::size_t)>& value)
    {
        for (std::size_t i = 0; i < kVoxels; ++i)
        {
            const std::int64_t b = choices[i];
            const std::int64_t a = steps - b;
            aa += a * a;
            ab += a * b;
            bb += b * b;
            av += a * value(i);
            bv += b * value(i);
        }
    }

    [[nodiscard]] std::int64_t determinant() const { return aa * bb - ab * ab; }
    [[nodiscard]] std::int64_t first() const
    {
        return av * bb - bv * ab;
    } // numerator of the first end; the determinant is its denominator
    [[nodiscard]] std::int64_t second() const { return bv * aa - av * ab; }
};

ColorPair leastSquares(const std::array<Color, kVoxels>& colors, const ColorPair& pair, const Choices& choices)
{
    ColorPair better = pair;
    for (std::size_t c = 0; c < 3; ++c)
    {
        const Weights weights(choices.of_voxels, 3, [&](std::size_t i) { return colors[i][c]; });
        const std::int64_t whole = 255 * weights.determinant();
        if (whole != 0)
        {
            const auto end = [&](std::int64_t numerator)
            { return std::clamp<std::int64_t>(rounded(3 * numerator * kChannelMax[c], whole), 0, kChannelMax[c]); };
            better.first[c] = end(weights.first());
            better.second[c] = end(weights.second());
        }
    }
    return better;
}

std::uint32_t code565(const Color& color)
{
    return static_cast<std::uint32_t>(color[0] | color[1] << 5 | color[2] << 11);
}

void packColors(const std::array<Color, kVoxels>& colors, Block& block)
{
    ColorPair best = pairAroundMean(colors);
    Choices best_choices = chooseColors(colors, best);
    ColorPair pair = pairOfBox(colors);
    for (int round = 0; round < 3; ++round)
    {
        const Choices choices = chooseColors(colors, pair);
        if (choices.error < best_choices.error)
        {
            best = pair;
            best_choices = choices;
        }
        pair = leastSquares(colors, pair, choices);
    }
    block[0] = code565(best.first) | code565(best.second) << 16;
    for (std::size_t i = 0; i < kVoxels; ++i)
    {
        block[1] |= static_cast<std::uint32_t>(best_choices.of_voxels[i]) << (2 * i);
    }
}

// ---- normals

/// A pole and the directions of x and y.
struct Frame
{
    std::uint32_t axis = 0;
    bool negative = false;
    bool diagonal = false;
};

// The coordinates, in a frame, of a vector on the octahedron |x| + |y| + |z| = one.
Point pointOf(const Vector& v, const Frame& frame, std::int64_t one)
{
    const std::int64_t x = v[(frame.axis + 1) % 3];
    const std::int64_t y = v[(frame.axis + 2) % 3];
    const std::int64_t z = frame.negative ? -v[frame.axis] : v[frame.axis];
    Point p = {x, y};
    if (z < 0)
    {
        p = {(one - std::abs(y)) * (x < 0 ? -1 : 1), (one - std::abs(x)) * (y < 0 ? -1 : 1)};
    }
    return frame.diagonal ? Point{floored(p[0] + p[1], 2), floored(p[0] - p[1], 2)} : p;
}

Vector vectorOf(Point p, const Frame& frame, std::int64_t one)
{
    if (frame.diagonal)
    {
        p = {std::clamp(p[0] + p[1], -one, one), std::clamp(p[0] - p[1], -one, one)};
    }
    const std::int64_t z = one - std::abs(p[0]) - std::abs(p[1]);
    if (z < 0)
    {
        p = {(one - std::abs(p[1])) * (p[0] < 0 ? -1 : 1), (one - std::abs(p[0])) * (p[1] < 0 ? -1 : 1)};
    }
    Vector v{};
    v[frame.axis] = frame.negative ? -z : z;
    v[(frame.axis + 1) % 3] = p[0];
    v[(frame.axis + 2) % 3] = p[1];
    return v;
}

constexpr std::int64_t kVectorOne = 4095; // length of vectors in packing
constexpr std::int64_t kStep = 65;        // between the ends 0 to 126 of scales, counted from -1

/// A scale of one coordinate.
struct Scale
{
    std::int64_t first = 0;
    std::int64_t second = 0;
    std::array<std::int64_t, kVoxels> steps{};
    std::int64_t error = 0;

    [[nodiscard]] std::int64_t at(std::int64_t step) const
    {
        return floored((first * (7 - step) + second * step) * kStep + 3, 7);
    }
};

// coordinates: from 0 to 2 * kVectorOne. A step is (coordinate - first) * (7 / length), with 7 / length truncated to
// 1/2^18.
void chooseSteps(const std::array<std::int64_t, kVoxels>& coordinates, Scale& scale)
{
    const std::int64_t length = (scale.second - scale.first) * kStep;
    const std::int64_t inverse = length == 0 ? 0 : (7 << 18) / length;
    scale.error = 0;
    for (std::size_t i = 0; i < kVoxels; ++i)
    {
        const std::int64_t along = (coordinates[i] - scale.first * kStep) * inverse;
        scale.steps[i] = std::clamp<std::int64_t>(floored(along + (1 << 17), 1 << 18), 0, 7);
        const std::int64_t d = scale.at(scale.steps[i]) - coordinates[i];
        scale.error += d * d;
    }
}

Scale fitScale(const std::array<std::int64_t, kVoxels>& coordinates)
{
    const auto end = [](std::int64_t coordinate)
    { return std::clamp<std::int64_t>(floored(coordinate + 32, kStep), 0, 126); };
    const auto [least, greatest] = std::minmax_element(coordinates.begin(), coordinates.end());
    Scale full;
    full.first = end(*least);
    full.second = end(*greatest);
    chooseSteps(coordinates, full);
    const Weights weights(full.steps, 7, [&](std::size_t i) { return coordinates[i]; });
    if (weights.determinant() == 0)
    {
        return full;
    }
    Scale fitted;
    fitted.first = end(floored(7 * std::max<std::int64_t>(weights.first(), 0), weights.determinant()));
    fitted.second =
        std::max(end(floored(7 * std::max<std::int64_t>(weights.second(), 0), weights.determinant())), fitted.first);
    chooseSteps(coordinates, fitted);
    return fitted.error < full.error ? fitted : full;
}

Vector normalOf(std::uint32_t code)
{
    const auto coordinate = [](std::uint32_t bits)
    {
        const std::int64_t v = std::max<std::int64_t>(static_cast<std::int16_t>(bits), -32767);
        return v < 0 ? -rounded(-v * kVectorOne, 32767) : rounded(v * kVectorOne, 32767);
    };
    return vectorOf({coordinate(code), coordinate(code >> 16)}, {2, false, false}, kVectorOne);
}

void packNormals(const std::array<Vector, kVoxels>& normals, Block& block)
{
    std::int64_t least = INT64_MAX;
    for (const bool diagonal : {false, true})
    {
        for (const bool negative : {false, true})
        {
            for (const std::uint32_t axis : {0U, 1U, 2U})
            {
                const Frame frame = {axis, negative, diagonal};
                std::array<std::array<std::int64_t, kVoxels>, 2> coordinates{};
                for (std::size_t i = 0; i < kVoxels; ++i)
                {
                    const Point p = pointOf(normals[i], frame, kVectorOne);
                    coordinates[0][i] = p[0] + kVectorOne;
                    coordinates[1][i] = p[1] + kVectorOne;
                }
                const Scale x = fitScale(coordinates[0]);
                const Scale y = fitScale(coordinates[1]);
                std::int64_t error = 0;
                Block tried{};
                for (std::size_t i = 0; i < kVoxels; ++i)
                {
                    const Vector v =
                        vectorOf({x.at(x.steps[i]) - kVectorOne, y.at(y.steps[i]) - kVectorOne}, frame, kVectorOne);
                    for (std::size_t c = 0; c < 3; ++c)
                    {
                        error += (v[c] - normals[i][c]) * (v[c] - normals[i][c]);
                    }
                    for (std::uint32_t bit = 0; bit < 3; ++bit)
                    {
                        tried[3 + bit] |= static_cast<std::uint32_t>(x.steps[i] >> bit & 1) << i |
                                          static_cast<std::uint32_t>(y.steps[i] >> bit & 1) << (i + 16);
                    }
                }
                if (error < least)
                {
                    least = error;
                    block[2] = static_cast<std::uint32_t>(x.first | x.second << 7 | y.first << 14 | y.second << 21) |
                               axis << 28 | (negative ? 1U << 30 : 0U) | (diagonal ? 1U << 31 : 0U);
                    std::copy(tried.begin() + 3, tried.end(), block.begin() + 3);
                }
            }
        }
    }
}

} // namespace

Block packBlock(std::span<const gpu::Attribute> attributes)
{
    std::array<Color, kVoxels> colors{};
    std::array<std::uint32_t, kVoxels> codes{};
    for (std::size_t i = 0; i < kVoxels; ++i)
    {
        const gpu::Attribute& attribute = attributes[std::min(i, attributes.size() - 1)];
        colors[i] = {attribute.color & 255, attribute.color >> 8 & 255, attribute.color >> 16 & 255};
        codes[i] = attribute.normal;
    }
    Block block{};
    packColors(colors, block);
    if (std::ranges::count(codes, gpu::kNoNormal) > 8)
    {
        block[2] = 3U << 28;
        return block;
    }
    // For a normal that is missing stands in the last one before it, else the first one of all.
    std::array<Vector, kVoxels> normals{};
    for (std::size_t i = 0; i < kVoxels; ++i)
    {
        std::size_t from = i;
        while (from != 0 && codes[from] == gpu::kNoNormal)
        {
            --from;
        }
        while (codes[from] == gpu::kNoNormal)
        {
            ++from;
        }
        normals[i] = normalOf(codes[from]);
    }
    packNormals(normals, block);
    return block;
}

gpu::Attribute unpackBlock(const Block& block, std::uint32_t voxel)
{
    const auto color = [](std::uint32_t code) { return Color{code & 31, code >> 5 & 63, code >> 11 & 31}; };
    const ColorPair pair = {color(block[0]), color(block[0] >> 16)};
    const Color c = paletteColor(pair, block[1] >> (2 * voxel) & 3);
    const auto coordinate = [&](std::uint32_t first_bit, std::uint32_t first_plane_bit)
    {
        const auto end = [&](std::uint32_t bit) { return static_cast<double>(block[2] >> bit & 127) - 63; };
        std::uint32_t step = 0;
        for (std::uint32_t bit = 0; bit < 3; ++bit)
        {
            step |= (block[3 + bit] >> (first_plane_bit + voxel) & 1) << bit;
        }
        const double p = (end(first_bit) * (7 - step) + end(first_bit + 7) * step) / (7.0 * 63.0);
        return static_cast<std::int64_t>(std::lround(p * 32767));
    };
    const auto color_code = static_cast<std::uint32_t>(c[0] | c[1] << 8 | c[2] << 16);
    const Frame frame = {block[2] >> 28 & 3, (block[2] >> 30 & 1) != 0, block[2] >> 31 != 0};
    if (frame.axis == 3)
    {
        return {color_code, gpu::kNoNormal};
    }
    const Vector v = vectorOf({coordinate(0, 0), coordinate(14, 16)}, frame, 32767);
    const Point p = pointOf(v, {2, false, false}, 32767);
    return {color_code, static_cast<std::uint16_t>(p[0]) | static_cast<std::uint32_t>(static_cast<std::uint16_t>(p[1]))
                                                               << 16};
}

} // namespace zvo::oracle
