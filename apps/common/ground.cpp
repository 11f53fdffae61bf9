// SPDX-License-Identifier: MIT
#include "common/ground.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kCorners = 256; // of the disc
constexpr float kGrey = 0.4F;           // linear

} // namespace

Grid gridWithGround(const Grid& grid, const Bounds& bounds)
{
    if (grid.depth == Grid::kDepthMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("--ground needs a grid twice as wide: at most --resolution {}",
                                                  1U << (Grid::kDepthMax - 1)));
    }
    Grid wide = grid;
    ++wide.depth;
    if (!bounds.empty())
    {
        const float half = grid.voxel_size * static_cast<float>(grid.resolution());
        const glm::vec3 middle = 0.5F * (bounds.min + bounds.max);
        wide.origin = {middle.x - half, bounds.min.y - grid.voxel_size, middle.z - half};
    }
    return wide;
}

void addGround(AnimatedScene& animated, const Bounds& bounds, const Grid& grid)
{
    if (bounds.empty())
    {
        return;
    }
    const float voxel = grid.voxel_size;
    const float edge = voxel * static_cast<float>(grid.resolution());
    const glm::vec3 middle = 0.5F * (bounds.min + bounds.max);
    const glm::vec3 low = middle - grid.origin;
    const float radius = std::min({low.x, low.z, edge - low.x, edge - low.z}) - voxel;
    const float height = std::max(bounds.min.y, grid.origin.y + voxel) - 0.5F * voxel;
    if (radius <= 0.0F)
    {
        return;
    }
    Scene ground;
    Material& material = ground.materials.emplace_back();
    material.name = "ground";
    material.base_color = {kGrey, kGrey, kGrey, 1.0F};
    Primitive disc;
    disc.positions.emplace_back(middle.x, height, middle.z);
    for (std::uint32_t i = 0; i < kCorners; ++i)
    {
        const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / kCorners;
        disc.positions.emplace_back(middle.x + radius * std::cos(angle), height, middle.z - radius * std::sin(angle));
        disc.triangles.emplace_back(0, i + 1, (i + 1) % kCorners + 1);
    }
    ground.primitives.push_back(std::move(disc));
    ground.instances.push_back({});
    animated.fixed.append(std::move(ground));
}

} // namespace zvo::cli
