// SPDX-License-Identifier: MIT
#include "io/voxel/quantize.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace zvo
{

namespace
{

constexpr std::size_t kChannels = 3;

std::uint32_t channelOf(std::uint32_t color, std::size_t channel)
{
    return color >> (8 * channel) & 255U;
}

// Colours that become one, in ascending order.
struct Box
{
    std::vector<std::uint32_t> colors;
    std::array<double, kChannels> mean{};
    std::size_t widest = 0; // channel with the largest deviation
    double deviation = 0;   // its sum of squared differences from the mean
};

Box boxOf(std::vector<std::uint32_t> colors, std::span<const std::uint32_t> counts)
{
    Box box;
    for (std::size_t channel = 0; channel < kChannels; ++channel)
    {
        std::uint64_t weight = 0; // at most 2^32 voxels; their sums of 8-bit squares stay below 2^49, and are exact
        std::uint64_t sum = 0;
        std::uint64_t squares = 0;
        for (const std::uint32_t color : colors)
        {
            const std::uint64_t value = channelOf(color, channel);
            weight += counts[color];
            sum += counts[color] * value;
            squares += counts[color] * value * value;
        }
        box.mean[channel] = static_cast<double>(sum) / static_cast<double>(weight);
        const double deviation = static_cast<double>(squares) - box.mean[channel] * static_cast<double>(sum);
        if (deviation > box.deviation)
        {
            box.deviation = deviation;
            box.widest = channel;
        }
    }
    box.colors = std::move(colors);
    return box;
}

std::uint32_t meanColor(const Box& box)
{
    std::uint32_t color = 0;
    for (std::size_t channel = 0; channel < kChannels; ++channel)
    {
        color |= static_cast<std::uint32_t>(box.mean[channel] + 0.5) << (8 * channel);
    }
    return color;
}

// Splits a box at the mean of its widest channel. Both halves get colours, since in a channel that deviates some are
// above the mean and some are not.
void halve(Box& box, std::vector<Box>& boxes, std::span<const std::uint32_t> counts)
{
    const auto isLow = [&](std::uint32_t color)
    { return static_cast<double>(channelOf(color, box.widest)) <= box.mean[box.widest]; };
    std::vector<std::uint32_t> low;
    std::vector<std::uint32_t> high;
    for (const std::uint32_t color : box.colors)
    {
        (isLow(color) ? low : high).push_back(color);
    }
    if (low.empty() || high.empty())
    {
        box.deviation = 0; // the deviation was only rounding
        return;
    }
    Box upper = boxOf(std::move(high), counts);
    box = boxOf(std::move(low), counts);
    boxes.push_back(std::move(upper));
}

} // namespace

Palette quantize(std::span<const std::uint32_t> counts, std::uint32_t capacity)
{
    assert(counts.size() == kColorCount && capacity >= 1 && capacity <= 256);
    std::vector<std::uint32_t> used;
    for (std::uint32_t color = 0; color < kColorCount; ++color)
    {
        if (counts[color] != 0)
        {
            used.push_back(color);
        }
    }
    Palette palette;
    palette.indices.resize(kColorCount);
    if (used.size() <= capacity)
    {
        palette.colors = used.empty() ? std::vector<std::uint32_t>{0} : used;
        for (std::size_t i = 0; i < used.size(); ++i)
        {
            palette.indices[used[i]] = static_cast<std::uint8_t>(i);
        }
        return palette;
    }
    std::vector<Box> boxes;
    boxes.reserve(capacity);
    boxes.push_back(boxOf(std::move(used), counts));
    while (boxes.size() < capacity)
    {
        const auto most = std::max_element(boxes.begin(), boxes.end(),
                                           [](const Box& a, const Box& b) { return a.deviation < b.deviation; });
        if (!(most->deviation > 0))
        {
            break;
        }
        halve(*most, boxes, counts);
    }
    for (const Box& box : boxes)
    {
        palette.colors.push_back(meanColor(box));
    }
    std::sort(palette.colors.begin(), palette.colors.end());
    palette.colors.erase(std::unique(palette.colors.begin(), palette.colors.end()), palette.colors.end());
    for (const Box& box : boxes)
    {
        const auto found = std::lower_bound(palette.colors.begin(), palette.colors.end(), meanColor(box));
        for (const std::uint32_t color : box.colors)
        {
            palette.indices[color] = static_cast<std::uint8_t>(found - palette.colors.begin());
        }
    }
    return palette;
}

} // namespace zvo
