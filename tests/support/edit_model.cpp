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

bool isInside(const gpu::Attribute& attribute)
{
    return attribute.color == kInside.color && attribute.normal == kInside.normal;
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

EditModel::EditModel(const Grid& grid, const std::vector<Cell>& cells, bool attributes, bool filled)
    : m_grid(grid), m_attributes(attributes), m_filled(filled && attributes)
{
    for (const Cell& cell : cells)
    {
        if (cell.level == grid.nodeLevels())
        {
            m_voxels[cell.code] = cell;
        }
        else if (m_filled && !isInside(cell.attribute))
        {
            m_nodes[{cell.level, cell.code}] = cell.attribute;
        }
    }
}

gpu::Attribute EditModel::lookAround(std::uint32_t level, std::uint64_t code, const Nodes& nodes) const
{
    for (; !nodes.contains({level, code}); --level, code >>= 6)
    {
    }
    return {nodes.at({level, code}).color & 0xFFFFFFU, gpu::kNoNormal};
}

gpu::Attribute EditModel::lookOf(const Cell& voxel) const
{
    return isInside(voxel.attribute) ? lookAround(m_grid.nodeLevels() - 1, voxel.code >> 6, m_nodes) : voxel.attribute;
}

bool EditModel::isAnythingBelow(std::uint32_t level, std::uint64_t code) const
{
    const std::uint32_t shift = 6 * (m_grid.nodeLevels() - level);
    const auto found = m_voxels.lower_bound(code << shift);
    return found != m_voxels.end() && found->first >> shift == code;
}

// Gives what is inside of changed leaves attributes, and the nodes above those of their children.
void EditModel::changeLeaves(const Leaves& changed)
{
    m_changed.insert(changed.begin(), changed.end());
    if (!m_filled)
    {
        return;
    }
    const Nodes before = m_nodes;
    Leaves nodes = changed;
    for (std::uint32_t level = m_grid.nodeLevels(); level-- > 0;)
    {
        Leaves parents;
        for (const std::uint64_t code : nodes)
        {
            Mean mean;
            for (std::uint64_t child = code << 6; child < (code + 1) << 6; ++child)
            {
                if (!isAnythingBelow(level + 1, child))
                {
                    continue;
                }
                const bool is_voxel = level + 1 == m_grid.nodeLevels();
                gpu::Attribute& look = is_voxel ? m_voxels.at(child).attribute
                                                : m_nodes.try_emplace({level + 1, child}, kInside).first->second;
                look = isInside(look) ? lookAround(level, code, before) : look;
                mean.add(look);
            }
            m_nodes[{level, code}] = mean.attribute();
            if (!isAnythingBelow(level, code) && level != 0)
            {
                m_nodes.erase({level, code});
            }
            parents.insert(code >> 6);
        }
        nodes = std::move(parents);
    }
}

// Whether a brush that carves comes close to a leaf: to a voxel of it or, with a stamp, into the leaf or a neighbour.
bool EditModel::isClose(const Brush& brush, const VoxelBox& box, std::uint64_t code) const
{
    const glm::ivec3 voxel(oracle::mortonDecode(code));
    if (brush.stamp == nullptr)
    {
        const double length = glm::length(glm::dvec3(voxel - brush.center));
        return VoxelBox{box.lo - 1, box.hi + 1}.contains(voxel) &&
               (brush.shape == BrushShape::Box || length < brush.radius + 1.5);
    }
    // A dab looks at the leaves that its box, a voxel larger, touches.
    const auto last = static_cast<int>(m_grid.resolution()) - 1;
    const VoxelBox leaves = {glm::max(box.lo - 1, glm::ivec3(0)) / 4, glm::min(box.hi + 1, glm::ivec3(last)) / 4};
    const auto isStamped = [&](const glm::ivec3& leaf)
    {
        bool has_voxels = false;
        for (std::uint32_t i = 0; i < 64 && leaves.contains(leaf); ++i)
        {
            const glm::ivec3 at = 4 * leaf + glm::ivec3(oracle::mortonDecode(i));
            has_voxels = has_voxels || stamped(*brush.stamp, at, i);
        }
        return has_voxels;
    };
    const glm::ivec3 leaf = voxel / 4;
    bool is_close = isStamped(leaf);
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        glm::ivec3 step(0);
        step[axis] = 1;
        is_close = is_close || isStamped(leaf + step) || isStamped(leaf - step);
    }
    return is_close && leaves.contains(leaf);
}

// The direction that a voxel faces where a brush that carves takes a neighbour of it by a face: to the brush, or
// against the normals of what a stamp takes.
glm::ivec3 EditModel::exposedNormal(const Brush& brush, const VoxelBox& box, const glm::ivec3& voxel)
{
    bool is_bare = false;
    glm::ivec3 taken(0);
    glm::ivec3 open(0);
    for (int side = 0; side < 6; ++side)
    {
        glm::ivec3 beside = voxel;
        beside[side / 2] += side % 2 == 0 ? -1 : 1;
        if (!box.contains(beside))
        {
            continue;
        }
        if (brush.stamp == nullptr)
        {
            is_bare = is_bare || isUnder(brush, beside);
        }
        else if (const auto look = stamped(*brush.stamp, beside, oracle::mortonEncode(glm::uvec3(beside)) & 63U))
        {
            taken += unfolded(look->attribute.normal);
            open += beside - voxel;
        }
    }
    return brush.stamp != nullptr ? (taken != glm::ivec3(0) ? -taken : open)
           : is_bare              ? -outwards(brush, voxel)
                                  : glm::ivec3(0);
}

// Of a filled tree, what a brush that carves lays bare changes, too. Leaves that it comes close to, and that have
// voxels without attributes or that a brush has changed before, count as changed.
void EditModel::expose(const Brush& brush, const VoxelBox& box, Leaves& changed)
{
    Leaves bared;
    for (const auto& [code, cell] : m_voxels)
    {
        if ((isInside(cell.attribute) || m_changed.contains(code >> 6)) && isClose(brush, box, code))
        {
            bared.insert(code >> 6);
        }
    }
    changed.merge(bared);
    for (const std::uint64_t leaf : changed)
    {
        const auto end = m_voxels.lower_bound((leaf + 1) << 6);
        for (auto at = m_voxels.lower_bound(leaf << 6); at != end; ++at)
        {
            const glm::ivec3 normal = exposedNormal(brush, box, glm::ivec3(oracle::mortonDecode(at->first)));
            if (at->second.attribute.normal == gpu::kNoNormal && normal != glm::ivec3(0))
            {
                at->second.attribute = {lookOf(at->second).color, normalCode(normal)};
            }
        }
    }
}

void EditModel::apply(const Brush& brush, bool emits)
{
    const auto resolution = static_cast<int>(m_grid.resolution());
    const Ends ends = brush.stamp != nullptr ? Ends{brush.stamp->box.lo, brush.stamp->box.hi} : endsOf(brush);
    VoxelBox box = {glm::max(ends.lo, glm::ivec3(0)), glm::min(ends.hi, glm::ivec3(resolution - 1))};
    if (brush.part)
    {
        box = box.within(*brush.part);
    }
    if (box.isEmpty())
    {
        return;
    }
    const auto& [lo, hi] = box;
    Leaves changed;
    for (int z = lo.z; z <= hi.z; ++z)
    {
        for (int y = lo.y; y <= hi.y; ++y)
        {
            for (int x = lo.x; x <= hi.x; ++x)
            {
                apply(brush, {x, y, z}, emits, changed);
            }
        }
    }
    if (m_filled && brush.action == BrushAction::Carve)
    {
        expose(brush, box, changed);
    }
    changeLeaves(changed);
}

void EditModel::apply(const Brush& brush, const glm::ivec3& voxel, bool emits, Leaves& changed)
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
    changed.insert(code >> 6);
}

EditModel EditModel::merged(MergeRule rule, const std::vector<Cell>& moving, const std::vector<Cell>& all) const
{
    const EditModel objects(m_grid, moving, m_attributes);
    const EditModel unedited(m_grid, all, m_attributes);
    EditModel merged = *this;
    Leaves touched;
    for (const auto& [code, voxel] : objects.m_voxels)
    {
        touched.insert(code >> 6);
        const bool is_mean = rule == MergeRule::Average && !m_changed.contains(code >> 6);
        if (rule != MergeRule::StaticWins || !has(code))
        {
            merged.m_voxels[code] = is_mean ? unedited.m_voxels.at(code) : voxel;
        }
    }
    merged.changeLeaves(touched);
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
            const auto kept = m_nodes.find({number, above[i].code});
            above[i].attribute = !m_filled ? means[i].attribute() : kept != m_nodes.end() ? kept->second : kInside;
        }
        all.insert(all.begin(), above.begin(), above.end());
        level = std::move(above);
    }
    return all;
}

} // namespace zvo::test
