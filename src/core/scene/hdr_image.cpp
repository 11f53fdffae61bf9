// SPDX-License-Identifier: MIT
#include "core/scene/hdr_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zvo
{

namespace
{

constexpr double kBlurReach = 3; // standard deviations; what is farther away does not count
constexpr double kTexels = 2;    // of a standard deviation, at least
constexpr std::uint32_t kRowsMin = 16;

// A map of another size, each of whose texels is the mean of those whose middles it contains.
HdrImage reduced(std::uint32_t width, std::uint32_t height, std::span<const glm::vec3> texels, std::uint32_t columns,
                 std::uint32_t rows)
{
    HdrImage means = {columns, rows, std::vector(std::size_t{columns} * rows, glm::vec3(0.0F))};
    std::vector<float> counts(means.texels.size());
    for (std::uint64_t i = 0; i < texels.size(); ++i)
    {
        const std::uint64_t column = (2 * (i % width) + 1) * columns / (2 * width);
        const std::uint64_t row = (2 * (i / width) + 1) * rows / (2 * height);
        means.texels[row * columns + column] += texels[i];
        counts[row * columns + column] += 1.0F;
    }
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
        means.texels[i] /= counts[i];
    }
    return means;
}

} // namespace

HdrImage blurredMap(std::uint32_t width, std::uint32_t height, std::span<const glm::vec3> texels, double deviation)
{
    const double texel = deviation / kTexels;
    const auto atLeast = [&](double angle)
    { return static_cast<std::uint32_t>(std::ceil(std::min(angle / texel, 1e6))); };
    const std::uint32_t rows = std::min(std::max(atLeast(std::numbers::pi), kRowsMin), height);
    const std::uint32_t columns = std::min(std::max(atLeast(2.0 * std::numbers::pi), 2 * kRowsMin), width);
    const HdrImage map = reduced(width, height, texels, columns, rows);
    HdrImage blurred = {columns, rows, std::vector(map.texels.size(), glm::vec3(0.0F))};
    const double farthest = std::cos(std::min(kBlurReach * deviation, std::numbers::pi));
    std::vector<float> weights(columns); // by the difference of columns
    for (std::uint32_t row = 0; row < rows; ++row)
    {
        const double polar = std::numbers::pi * (row + 0.5) / rows;
        std::vector<glm::vec3> sums(columns, glm::vec3(0.0F));
        double total = 0;
        for (std::uint32_t other = 0; other < rows; ++other)
        {
            const double other_polar = std::numbers::pi * (other + 0.5) / rows;
            std::uint32_t reach = 0; // columns to either side
            for (; reach <= columns / 2; ++reach)
            {
                const double turn = 2.0 * std::numbers::pi * reach / columns;
                const double cosine =
                    std::cos(polar) * std::cos(other_polar) + std::sin(polar) * std::sin(other_polar) * std::cos(turn);
                if (cosine < farthest)
                {
                    break;
                }
                weights[reach] =
                    static_cast<float>(std::sin(other_polar) * std::exp((cosine - 1.0) / (deviation * deviation)));
            }
            if (reach == 0) // the whole row is too far away
            {
                continue;
            }
            const glm::vec3* const line = &map.texels[std::size_t{other} * columns];
            const std::uint32_t count = std::min(2 * reach - 1, columns); // the nearest column once, others twice
            for (std::uint32_t i = 0; i < count; ++i)
            {
                const std::uint32_t away = (i + 1) / 2;
                const float weight = weights[away];
                const std::uint32_t shift = i % 2 == 0 ? away : columns - away;
                total += weight;
                for (std::uint32_t column = 0; column < columns; ++column)
                {
                    const std::uint32_t from = column + shift;
                    sums[column] += weight * line[from < columns ? from : from - columns];
                }
            }
        }
        for (std::uint32_t column = 0; column < columns; ++column)
        {
            blurred.texels[std::size_t{row} * columns + column] = sums[column] / static_cast<float>(total);
        }
    }
    return blurred;
}

} // namespace zvo
