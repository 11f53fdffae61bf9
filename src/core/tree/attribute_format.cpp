// SPDX-License-Identifier: MIT
#include "core/tree/attribute_format.h"

#include "core/base/divide_up.h"

#include <cassert>
#include <cstddef>

namespace zvo
{

namespace
{

constexpr std::uint32_t kChannelBits = 8; // of gpu::Attribute::color
constexpr int kOne16 = 32767;             // 1 as a snorm16

// The lowest bits of word, which lose them.
std::uint32_t take(std::uint32_t& word, std::uint32_t bits)
{
    const std::uint32_t taken = word & ((1U << bits) - 1);
    word >>= bits;
    return taken;
}

// c / max as a fraction of 255, rounded.
std::uint32_t widenChannel(std::uint32_t c, std::uint32_t bits)
{
    const std::uint32_t max = (1U << bits) - 1;
    return (c * 255 + max / 2) / max;
}

std::uint32_t unpackColor565(std::uint32_t code)
{
    const std::uint32_t red = widenChannel(take(code, gpu::kRedBits), gpu::kRedBits);
    const std::uint32_t green = widenChannel(take(code, gpu::kGreenBits), gpu::kGreenBits);
    const std::uint32_t blue = widenChannel(take(code, gpu::kBlueBits), gpu::kBlueBits);
    return red | green << kChannelBits | blue << (2 * kChannelBits);
}

// A snorm8 as a snorm16, rounded.
std::uint32_t widenNormal(std::uint32_t byte)
{
    const int v = static_cast<std::int8_t>(byte);
    const int size = (std::abs(v) * kOne16 + gpu::kNormalOne4 / 2) / gpu::kNormalOne4;
    return static_cast<std::uint16_t>(v < 0 ? -size : size);
}

gpu::Attribute unpackAttribute4(std::uint32_t word)
{
    const std::uint32_t normal = word >> gpu::kNormalShift4;
    return {unpackColor565(word),
            normal == gpu::kNoNormal4 ? gpu::kNoNormal : widenNormal(normal) | widenNormal(normal >> 8) << 16};
}

// Octahedral coordinates and vectors, in which 1 is kOne16.
glm::ivec3 unfoldNormal(const glm::ivec2& p)
{
    const glm::ivec2 size = glm::abs(p);
    const int z = kOne16 - size.x - size.y;
    const glm::ivec2 folded = (kOne16 - glm::ivec2(size.y, size.x)) * glm::ivec2(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
    return {z < 0 ? folded : p, z};
}

std::uint32_t foldNormal(const glm::ivec3& v)
{
    const glm::ivec2 size = glm::abs(glm::ivec2(v));
    const glm::ivec2 folded = v.z < 0 ? kOne16 - glm::ivec2(size.y, size.x) : size;
    const glm::ivec2 p = folded * glm::ivec2(v.x < 0 ? -1 : 1, v.y < 0 ? -1 : 1);
    return static_cast<std::uint16_t>(p.x) | static_cast<std::uint32_t>(static_cast<std::uint16_t>(p.y)) << 16;
}

std::uint32_t unpackBlockColor(std::uint32_t ends, std::uint32_t index)
{
    const std::uint32_t first = unpackColor565(ends);
    const std::uint32_t second = unpackColor565(ends >> gpu::kNormalShift4);
    std::uint32_t color = 0;
    for (std::uint32_t shift = 0; shift < 3 * kChannelBits; shift += kChannelBits)
    {
        const std::uint32_t sum =
            (first >> shift & 255U) * (gpu::kColorIndexMax - index) + (second >> shift & 255U) * index;
        color |= (sum + gpu::kColorIndexMax / 2) / gpu::kColorIndexMax << shift;
    }
    return color;
}

// The coordinate that an index of a scale stands for. ends: the scale's two ends, 7 bits each.
int unpackCoordinate(std::uint32_t ends, std::uint32_t index)
{
    constexpr int kMax = gpu::kNormalIndexMax;
    const int first = static_cast<int>(take(ends, gpu::kEndBits)) - gpu::kNormalEnd;
    const int second = static_cast<int>(take(ends, gpu::kEndBits)) - gpu::kNormalEnd;
    const int sum = first * (kMax - static_cast<int>(index)) + second * static_cast<int>(index);
    const int sum_one = gpu::kNormalEnd * kMax;
    const int size = (std::abs(sum) * kOne16 + sum_one / 2) / sum_one;
    return sum < 0 ? -size : size;
}

std::uint32_t unpackBlockNormal(glm::ivec2 p, std::uint32_t frame)
{
    const std::uint32_t axis = frame & gpu::kFrameAxis;
    if (axis == gpu::kFrameNone)
    {
        return gpu::kNoNormal;
    }
    if ((frame & gpu::kFrameDiagonal) != 0)
    {
        p = glm::clamp(glm::ivec2(p.x + p.y, p.x - p.y), -kOne16, kOne16);
    }
    glm::ivec3 v = unfoldNormal(p);
    v.z = (frame & gpu::kFrameNegative) != 0 ? -v.z : v.z;
    return foldNormal(axis == 0 ? glm::ivec3(v.z, v.x, v.y) : axis == 1 ? glm::ivec3(v.y, v.z, v.x) : v);
}

gpu::Attribute unpackBlock(std::span<const gpu::uint> block, std::uint32_t voxel)
{
    std::uint32_t x_index = 0;
    std::uint32_t y_index = 0;
    for (std::uint32_t bit = 0; bit < 3; ++bit)
    {
        const std::uint32_t plane = block[gpu::kBlockNormalIndices + bit] >> voxel;
        x_index |= (plane & 1U) << bit;
        y_index |= (plane >> gpu::kBlockVoxels & 1U) << bit;
    }
    const std::uint32_t ends = block[gpu::kBlockNormals];
    const glm::ivec2 p(unpackCoordinate(ends, x_index), unpackCoordinate(ends >> (2 * gpu::kEndBits), y_index));
    const std::uint32_t color_index = block[gpu::kBlockColorIndices] >> (2 * voxel) & gpu::kColorIndexMax;
    return {unpackBlockColor(block[0], color_index), unpackBlockNormal(p, ends >> gpu::kFrameShift)};
}

} // namespace

const char* formatName(AttributeFormat format)
{
    switch (format)
    {
    case AttributeFormat::Bytes4:
        return "4";
    case AttributeFormat::Bytes8:
        return "8";
    case AttributeFormat::Blocks:
        return "block";
    default:
        return "none";
    }
}

std::uint64_t packedWords(AttributeFormat format, std::uint64_t count)
{
    assert(isPacked(format));
    return format == AttributeFormat::Blocks ? gpu::kBlockWords * divideUp(count, gpu::kBlockVoxels) : count;
}

gpu::Attribute unpackAttribute(AttributeFormat format, std::span<const gpu::uint> words, std::uint64_t index)
{
    assert(isPacked(format));
    if (format == AttributeFormat::Blocks)
    {
        return unpackBlock(words.subspan(index / gpu::kBlockVoxels * gpu::kBlockWords, gpu::kBlockWords),
                           static_cast<std::uint32_t>(index % gpu::kBlockVoxels));
    }
    return unpackAttribute4(words[index]);
}

} // namespace zvo
