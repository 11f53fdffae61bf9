// SPDX-License-Identifier: MIT
#include "support/edit_model.h"

#include "core/tree/tree_build.h"
#include "core/upload/texture_pool.h"
#include "oracle/morton.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>

namespace zvo::test
{

namespace
{

// Decodes an octahedral direction, whose absolute values add up to 32767. The lower half is folded outwards. Zero for a
// code without direction.
glm::ivec3 unfolded(std::uint32_t code)
{
    if (code == gpu::kNoNormal)
    {
        return glm::ivec3(0);
    }
    const int x = static_cast<std::int16_t>(code & 0xFFFFU);
    const int y = static_cast<std::int16_t>(code >> 16);
    const int z = 32767 - std::abs(x) - std::abs(y);
    return z >= 0 ? glm::ivec3(x, y, z)
                  : glm::ivec3((x < 0 ? -1 : 1) * (32767 - std::abs(y)), (y < 0 ? -1 : 1) * (32767 - std::abs(x)), z);
}

// The code that is nearest to a direction, whose components are cut to 15 bits first.
std::uint32_t normalCode(const glm::ivec3& n)
{
    const glm::ivec3 size = glm::abs(n);
    const int bits = std::bit_width(static_cast<unsigned>(size.x | size.y | size.z));
    const glm::ivec3 cut = size / (1 << std::max(bits - 15, 0));
    const int sum = std::max(cut.x + cut.y + cut.z, 1);
    glm::ivec2 p((cut.x * 32767 + sum / 2) / sum, (cut.y * 32767 + sum / 2) / sum);
    p = n.z < 0 ? glm::ivec2(32767 - p.y, 32767 - p.x) : p;
    p *= glm::ivec2(n.x < 0 ? -1 : 1, n.y < 0 ? -1 : 1);
    return (static_cast<std::uint32_t>(p.x) & 0xFFFFU) | static_cast<std::uint32_t>(p.y) << 16;
}

// The code of the mean of `count` directions: none if its absolute values add up to less than a quarter of theirs.
std::uint32_t meanNormalCode(const glm::ivec3& sum, std::uint32_t count)
{
    const std::int64_t size = std::int64_t{std::abs(sum.x)} + std::abs(sum.y) + std::abs(sum.z);
    return size * 4 < std::int64_t{32767} * count ? gpu::kNoNormal : normalCode(sum);
}

// Mean attributes of a node's children.
class Mean
{
public:
    void add(const gpu::Attribute& look)
    {
        for (std::uint32_t channel = 0; channel < 3; ++channel)
        {
            m_color[channel] += srgbToLinearTable()[look.color >> (8 * channel) & 0xFFU];
        }
        m_flags |= look.color & 0xFF000000U;
        m_normal += unfolded(look.normal);
        ++m_count;
    }

    [[nodiscard]] gpu::Attribute attribute() const
    {
        gpu::Attribute mean{m_flags, meanNormalCode(m_normal, std::max(m_count, 1U))};
        for (std::uint32_t channel = 0; channel < 3 && m_count != 0; ++channel)
        {
            const std::uint32_t linear = (m_color[channel] + m_count / 2) / m_count;
            mean.color |= std::uint32_t{linearToSrgbTable()[linear]} << (8 * channel);
        }
        return mean;
    }

private:
    std::array<std::uint32_t, 3> m_color{};
    glm::ivec3 m_normal{0};
    std::uint32_t m_flags = 0;
    std::uint32_t m_count = 0;
};

bool isUnder(const Brush& brush, const glm::ivec3& away)
{
    const double length = glm::length(glm::dvec3(away));
    return brush.shape == BrushShape::Box || length < brush.radius + 0.5;
}

glm::ivec3 outwards(const Brush& brush, const glm::ivec3& away)
{
    const int most = std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)});
    return brush.shape == BrushShape::Sphere
               ? away
               : glm::ivec3(std::abs(away.x) == most ? away.x : 0, std::abs(away.y) == most ? away.y : 0,
                            std::abs(away.z) == most ? away.z : 0);
}

} // namespace

EditModel::EditModel(const Grid& grid, const std::vector<Cell>& cells, bool attributes)
    : m_grid(grid), m_attributes(attributes)
{
    for (const Cell& cell : cells)
    {
        if (cell.level == grid.nodeLevels())
        {
            m_voxels[cell.code] = cell;
        }
    }
}

void EditModel::apply(const Brush& brush, bool emits)
{
    // kEmission in RGB9E5, by hand: its exponent is 17, so a mantissa of 128 is 1.
    const std::uint32_t emission = emits && brush.emission == kEmission ? 256U | 64U << 9 | 32U << 18 | 17U << 27 : 0U;
    const std::uint32_t color = brush.color | (emission != 0 ? gpu::kAttributeEmissive << 24 : 0U);
    const int radius = static_cast<int>(brush.radius);
    const auto resolution = static_cast<int>(m_grid.resolution());
    for (int z = -radius; z <= radius; ++z)
    {
        for (int y = -radius; y <= radius; ++y)
        {
            for (int x = -radius; x <= radius; ++x)
            {
                const glm::ivec3 away(x, y, z);
                const glm::ivec3 voxel = brush.center + away;
                if (!isUnder(brush, away) || glm::any(glm::lessThan(voxel, glm::ivec3(0))) ||
                    glm::any(glm::greaterThanEqual(voxel, glm::ivec3(resolution))))
                {
                    continue;
                }
                const std::uint64_t code = oracle::mortonEncode(glm::uvec3(voxel));
                const auto found = m_voxels.find(code);
                bool is_changed = false;
                if (brush.action == BrushAction::Carve)
                {
                    is_changed = m_voxels.erase(code) != 0;
                }
                else if (brush.action == BrushAction::Fill && found == m_voxels.end())
                {
                    Cell made = {m_grid.nodeLevels(), code, {}, 0};
                    if (m_attributes)
                    {
                        made.attribute = {color, normalCode(outwards(brush, away))};
                        made.emission = emission;
                    }
                    m_voxels[code] = made;
                    is_changed = true;
                }
                else if (brush.action == BrushAction::Paint && found != m_voxels.end() && m_attributes)
                {
                    found->second.attribute.color = color;
                    found->second.emission = emission;
                    is_changed = true;
                }
                if (is_changed)
                {
                    m_changed.insert(code >> 6);
                }
            }
        }
    }
}

EditModel EditModel::merged(MergeRule rule, const std::vector<Cell>& moving, const std::vector<Cell>& all) const
{
    const EditModel objects(m_grid, moving, m_attributes);
    const EditModel unedited(m_grid, all, m_attributes);
    EditModel merged = *this;
    for (const auto& [code, voxel] : objects.m_voxels)
    {
        const bool is_mean = rule == MergeRule::Average && !m_changed.contains(code >> 6);
        if (rule != MergeRule::StaticWins || !has(code))
        {
            merged.m_voxels[code] = is_mean ? unedited.m_voxels.at(code) : voxel;
        }
    }
    return merged;
}

std::vector<Cell> EditModel::cells() const
{
    std::vector<Cell> level;
    for (const auto& [code, voxel] : m_voxels)
    {
        level.push_back(voxel);
    }
    std::vector<Cell> all = level;
    for (std::uint32_t number = m_grid.nodeLevels(); number-- > 0;)
    {
        std::vector<Cell> above;
        std::vector<Mean> means;
        for (const Cell& child : level)
        {
            if (above.empty() || above.back().code != child.code >> 6)
            {
                above.push_back({number, child.code >> 6, {}, 0});
                means.emplace_back();
            }
            means.back().add(child.attribute);
        }
        for (std::size_t i = 0; i < above.size() && m_attributes; ++i)
        {
            above[i].attribute = means[i].attribute();
        }
        all.insert(all.begin(), above.begin(), above.end());
        level = std::move(above);
    }
    return all;
}

} // namespace zvo::test
