// SPDX-License-Identifier: MIT
#include "core/edit/voxel_clip.h"

#include <algorithm>
#include <cstdlib>
#include <deque>

namespace zvo
{

namespace
{

// Where a voxel stands in the words of a stamp.
struct StampPlace
{
    std::size_t mask; // word
    std::uint32_t bit;
    std::size_t cell; // the first of its words
};

StampPlace placeIn(const VoxelBox& box, const glm::ivec3& voxel)
{
    const glm::ivec3 first = box.lo / kLeafEdge;
    const gpu::uvec3 size(box.hi / kLeafEdge - first + 1);
    const gpu::uvec3 leaf(voxel / kLeafEdge - first);
    const std::uint32_t leaf_number = leaf.x + size.x * (leaf.y + size.y * leaf.z);
    std::uint32_t number = 0; // Morton code in the leaf
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        const auto in_leaf = static_cast<std::uint32_t>(voxel[axis] % kLeafEdge);
        number |= (in_leaf & 1U) << axis | (in_leaf >> 1) << (axis + 3);
    }
    return {gpu::stampMask(leaf_number, number), number % 32, gpu::stampCell(leaf_number, number)};
}

// The octahedral code of a direction with the sign of a component changed. Codes are folded: the lower half outwards.
std::uint32_t mirroredNormal(std::uint32_t code, glm::length_t axis)
{
    if (code == gpu::kNoNormal)
    {
        return code;
    }
    constexpr int kOne = 32767;
    glm::ivec2 p(static_cast<std::int16_t>(code), static_cast<std::int16_t>(code >> 16));
    if (axis < 2)
    {
        p[axis] = -p[axis];
    }
    else // the point at the other side of the fold
    {
        const glm::ivec2 size = glm::abs(p);
        const glm::ivec2 sign(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
        p = sign * glm::ivec2(kOne - size.y, kOne - size.x);
    }
    return static_cast<std::uint16_t>(p.x) | static_cast<std::uint32_t>(p.y) << 16;
}

std::uint32_t colorDistance(std::uint32_t a, std::uint32_t b)
{
    std::uint32_t distance = 0;
    for (std::uint32_t shift = 0; shift < 24; shift += 8)
    {
        const int away = int{static_cast<std::uint8_t>(a >> shift)} - int{static_cast<std::uint8_t>(b >> shift)};
        distance = std::max(distance, static_cast<std::uint32_t>(std::abs(away)));
    }
    return distance;
}

} // namespace

VoxelClip::VoxelClip(const glm::ivec3& size) : m_size(size), m_cells(VoxelBox{glm::ivec3(0), size - 1}.volume()) {}

VoxelClip::VoxelClip(const Stamp& stamp) : VoxelClip(stamp.box.size())
{
    forCells(stamp.box,
             [&](const glm::ivec3& voxel)
             {
                 const StampPlace place = placeIn(stamp.box, voxel);
                 if ((stamp.words[place.mask] >> place.bit & 1U) != 0)
                 {
                     const std::uint32_t* const words = &stamp.words[place.cell];
                     set(voxel - stamp.box.lo, ClipVoxel{{words[0], words[1]}, words[2]});
                 }
             });
}

void VoxelClip::set(const glm::ivec3& cell, const std::optional<ClipVoxel>& voxel)
{
    std::optional<ClipVoxel>& at = m_cells[indexOf(cell)];
    m_count = m_count + (voxel ? 1 : 0) - (at ? 1 : 0);
    at = voxel;
}

void VoxelClip::add(const VoxelClip& other, const glm::ivec3& at)
{
    forCells({glm::ivec3(0), other.size() - 1},
             [&](const glm::ivec3& cell)
             {
                 if (const std::optional<ClipVoxel>& voxel = other.at(cell))
                 {
                     set(at + cell, voxel);
                 }
             });
}

VoxelClip VoxelClip::mirrored(glm::length_t axis) const
{
    VoxelClip mirrored(m_size);
    forCells({glm::ivec3(0), m_size - 1},
             [&](const glm::ivec3& cell)
             {
                 if (std::optional<ClipVoxel> voxel = at(cell))
                 {
                     glm::ivec3 to = cell;
                     to[axis] = m_size[axis] - 1 - to[axis];
                     voxel->look.normal = mirroredNormal(voxel->look.normal, axis);
                     mirrored.set(to, voxel);
                 }
             });
    return mirrored;
}

std::shared_ptr<const Stamp> VoxelClip::stampAt(const glm::ivec3& voxel, const Grid& grid) const
{
    const VoxelBox own = VoxelBox{glm::ivec3(0), m_size - 1}.movedBy(voxel);
    const VoxelBox box = own.within({glm::ivec3(0), glm::ivec3(grid.resolution()) - 1});
    if (box.isEmpty() || m_count == 0)
    {
        return nullptr;
    }
    auto stamp = std::make_shared<Stamp>();
    stamp->box = box;
    const VoxelBox leaves = {box.lo / kLeafEdge, box.hi / kLeafEdge};
    stamp->words.resize(gpu::kStampWords * leaves.volume());
    bool has_voxels = false;
    forCells(box,
             [&](const glm::ivec3& at_grid)
             {
                 if (const std::optional<ClipVoxel>& from = at(at_grid - voxel))
                 {
                     const StampPlace place = placeIn(box, at_grid);
                     stamp->words[place.mask] |= 1U << place.bit;
                     stamp->words[place.cell] = from->look.color;
                     stamp->words[place.cell + 1] = from->look.normal;
                     stamp->words[place.cell + 2] = from->emission;
                     has_voxels = true;
                 }
             });
    return has_voxels ? stamp : nullptr;
}

Flood floodFrom(const VoxelClip& clip, const glm::ivec3& seed, std::uint32_t tolerance)
{
    Flood flood{VoxelClip(clip.size())};
    const VoxelBox box = {glm::ivec3(0), clip.size() - 1};
    if (!box.contains(seed) || !clip.at(seed))
    {
        return flood;
    }
    const std::uint32_t color = clip.at(seed)->look.color;
    std::deque<glm::ivec3> border = {seed};
    flood.voxels.set(seed, clip.at(seed));
    flood.reached = {seed, seed};
    for (; !border.empty(); border.pop_front())
    {
        const glm::ivec3 cell = border.front();
        flood.reached = {glm::min(flood.reached.lo, cell), glm::max(flood.reached.hi, cell)};
        forCells(VoxelBox{cell - 1, cell + 1}.within(box),
                 [&](const glm::ivec3& next)
                 {
                     const std::optional<ClipVoxel>& voxel = clip.at(next);
                     if (voxel && !flood.voxels.at(next) && colorDistance(voxel->look.color, color) <= tolerance)
                     {
                         flood.voxels.set(next, voxel);
                         border.push_back(next);
                     }
                 });
    }
    return flood;
}

} // namespace zvo
