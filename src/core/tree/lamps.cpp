// SPDX-License-Identifier: MIT
#include "core/tree/lamps.h"

#include "core/base/srgb.h"
#include "core/tree/colored_voxels.h"
#include "core/tree/rgb9e5.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace zvo
{

namespace
{

constexpr float kSameHue = 0.02F;               // deviation from the voxel's own colour, of the largest channel
constexpr float kStrengthSteps = 16.0F;         // that are told apart, to a doubling
constexpr std::uint32_t kColorBits = 8;         // of colours
constexpr std::uint32_t kEachChannel = 0x10101; // a bit of each

float largest(const glm::vec3& v)
{
    return std::max({v.r, v.g, v.b});
}

Lamp lampOf(std::uint32_t color, const glm::vec3& radiance)
{
    const glm::vec3 own(linearOf(color));
    const float strength = largest(radiance) / std::max(largest(own), 1e-6F);
    const glm::vec3 off = glm::abs(radiance - strength * own);
    if (largest(off) <= kSameHue * largest(radiance))
    {
        return {radiance, color, strength};
    }
    std::uint32_t hue = 0;
    for (int i = 0; i < 3; ++i)
    {
        const double encoded = linearToSrgb(static_cast<double>(radiance[i] / largest(radiance)));
        hue |= static_cast<std::uint32_t>(std::lround(255.0 * encoded)) << 8 * i;
    }
    return {radiance, hue, largest(radiance)};
}

} // namespace

Lamps lampsOf(const TreeData& tree, std::size_t most)
{
    std::vector<Lamp> lights; // [TreeData::emission]
    forEachColoredVoxel(tree,
                        [&](std::uint64_t, std::uint32_t color, std::uint32_t light)
                        {
                            if (light != kNoLight)
                            {
                                const glm::vec3 radiance = tree.emission_scale * decodeRgb9e5(tree.emission[light]);
                                lights.push_back(lampOf(color, radiance));
                            }
                        });
    Lamps result;
    for (std::uint32_t bits = 0; bits < kColorBits; ++bits) // that are not told apart
    {
        std::map<std::pair<std::uint32_t, long>, std::uint8_t> numbers;
        result.of_light.clear();
        for (const Lamp& light : lights)
        {
            const std::pair key(light.color >> bits & (255U >> bits) * kEachChannel,
                                std::lround(kStrengthSteps * std::log2(light.strength + 1e-30F)) >> bits);
            const auto number = numbers.emplace(key, static_cast<std::uint8_t>(numbers.size())).first->second;
            if (numbers.size() > most)
            {
                break;
            }
            result.of_light.push_back(number);
        }
        if (numbers.size() <= most)
        {
            result.lamps.resize(numbers.size());
            break;
        }
    }
    std::vector<float> counts(result.lamps.size());
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
        const Lamp& light = lights[i];
        Lamp& lamp = result.lamps[result.of_light[i]];
        lamp.radiance += (light.radiance - lamp.radiance) / ++counts[result.of_light[i]];
        lamp.color = light.color;
    }
    for (Lamp& lamp : result.lamps)
    {
        lamp = lampOf(lamp.color, lamp.radiance);
    }
    return result;
}

} // namespace zvo
