// SPDX-License-Identifier: MIT
#include "support/edit_model.h"

#include "core/tree/tree_build.h"
#include "core/upload/texture_pool.h"
#include "oracle/morton.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <optional>

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

// The box of a brush without stamp.
struct Ends
{
    glm::ivec3 lo;
    glm::ivec3 hi;
};

Ends endsOf(const Brush& brush)
{
    const glm::ivec3 far = brush.center + brush.span;
    const auto radius = static_cast<int>(brush.radius);
    return {glm::min(brush.center, far) - radius, glm::max(brush.center, far) + radius};
}

bool isUnder(const Brush& brush, const glm::ivec3& voxel)
{
    const double length = glm::length(glm::dvec3(voxel - brush.center));
    return brush.shape == BrushShape::Box || length < brush.radius + 0.5;
}

// Across the nearest sides of a box, each in the direction in which it is nearer than the one opposite.
glm::ivec3 outwards(const Brush& brush, const glm::ivec3& voxel)
{
    if (brush.shape == BrushShape::Sphere)
    {
        return voxel - brush.center;
    }
    const Ends ends = endsOf(brush);
    int nearest = INT32_MAX;
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        nearest = std::min({nearest, voxel[axis] - ends.lo[axis], ends.hi[axis] - voxel[axis]});
    }
    glm::ivec3 direction(0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        direction[axis] += ends.hi[axis] - voxel[axis] == nearest ? 1 : 0;
        direction[axis] -= voxel[axis] - ends.lo[axis] == nearest ? 1 : 0;
    }
    return direction;
}

// The voxel of a stamp's leaf; nothing if it has none. code: of the voxel in its leaf.
std::optional<Cell> stamped(const Stamp& stamp, const glm::ivec3& voxel, std::uint32_t code)
{
    if (!stamp.box.contains(voxel))
    {
        return std::nullopt;
    }
    const glm::ivec3 first = stamp.box.lo / 4;
    const glm::ivec3 size = stamp.box.hi / 4 - first + 1;
    const glm::ivec3 at = voxel / 4 - first;
    const std::uint32_t* const words = stamp.words.data() + 194 * (at.x + size.x * (at.y + size.y * at.z));
    if ((words[code / 32] >> code % 32 & 1U) == 0)
    {
        return std::nullopt;
    }
    const std::uint32_t* const look = words + 2 + 3 * code;
    return Cell{0, 0, {look[0], look[1]}, look[2]};
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
    const auto resolution = static_cast<int>(m_grid.resolution());
    const Ends ends = brush.stamp != nullptr ? Ends{brush.stamp->box.lo, brush.stamp->box.hi} : endsOf(brush);
    const glm::ivec3 lo = glm::max(ends.lo, glm::ivec3(0));
    const glm::ivec3 hi = glm::min(ends.hi, glm::ivec3(resolution - 1));
    for (int z = lo.z; z <= hi.z; ++z)
    {
        for (int y = lo.y; y <= hi.y; ++y)
        {
            for (int x = lo.x; x <= hi.x; ++x)
            {
                if (!brush.part || brush.part->contains({x, y, z}))
                {
                    apply(brush, {x, y, z}, emits);
                }
            }
        }
    }
}

void EditModel::apply(const Brush& brush, const glm::ivec3& voxel, bool emits)
{
    // kEmission in RGB9E5, by hand: its exponent is 17, so a mantissa of 128 is 1.
    const std::uint32_t emission = emits && brush.emission == kEmission ? 256U | 64U << 9 | 32U << 18 | 17U << 27 : 0U;
    const std::uint32_t color = brush.color | (emission != 0 ? gpu::kAttributeEmissive << 24 : 0U);
    const std::uint64_t code = oracle::mortonEncode(glm::uvec3(voxel));
    const std::optional<Cell> look = brush.stamp ? stamped(*brush.stamp, voxel, code & 63U) : std::nullopt;
    if (brush.stamp != nullptr ? !look : !isUnder(brush, voxel))
    {
        return;
    }
    const auto found = m_voxels.find(code);
    const bool is_there = found != m_voxels.end();
    if (brush.action == BrushAction::Carve)
    {
        if (m_voxels.erase(code) == 0)
        {
            return;
        }
    }
    else if (brush.action == BrushAction::Fill ? is_there && (!look || !m_attributes) : !is_there || !m_attributes)
    {
        return;
    }
    else
    {
        Cell& cell = m_voxels[code];
        cell.level = m_grid.nodeLevels();
        cell.code = code;
        cell.emission = look ? look->emission : m_attributes ? emission : 0;
        if (m_attributes && look)
        {
            cell.attribute = look->attribute;
        }
        else if (m_attributes)
        {
            const glm::ivec3 direction = outwards(brush, voxel);
            const std::uint32_t made = direction == glm::ivec3(0) ? gpu::kNoNormal : normalCode(direction);
            cell.attribute = {color, is_there ? cell.attribute.normal : made};
        }
    }
    m_changed.insert(code >> 6);
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
