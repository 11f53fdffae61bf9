// SPDX-License-Identifier: MIT
#include "runtime/mesh_dabs.h"

#include "core/base/morton.h"
#include "core/edit/voxel_box.h"
#include "core/tree/tree_data.h"
#include "core/upload/gpu_scene.h"
#include "runtime/copy_voxels.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr int kStampEdge = 64;          // of the nodes that become stamps
constexpr std::uint32_t kDepthMin = 3;  // of grids that are filled
constexpr double kLongestOfGrids = 8.0; // of meshes
constexpr int kMarginVoxels = 2;        // around a mesh

// A grid with the lattice of another one, as far as floats tell, around a mesh.
struct MeshGrid
{
    Grid grid;
    glm::ivec3 first{0}; // its first voxel in the other grid
};

std::optional<MeshGrid> gridAround(const Bounds& bounds, const Grid& whole)
{
    const glm::dvec3 origin(whole.origin);
    const double size = whole.voxel_size;
    const glm::dvec3 lo = glm::floor((glm::dvec3(bounds.min) - origin) / size);
    const glm::dvec3 hi = glm::floor((glm::dvec3(bounds.max) - origin) / size);
    const glm::dvec3 edges = hi - lo + 1.0;
    const double longest = std::max({edges.x, edges.y, edges.z});
    const double longest_allowed = kLongestOfGrids * whole.resolution();
    if (!(longest <= longest_allowed))
    {
        throw Error(ErrorCode::Input, fmt::format("the mesh is {:.0f} voxels long; expected at most {:.0f}, {} times "
                                                  "the grid",
                                                  longest, longest_allowed, kLongestOfGrids));
    }
    if (glm::any(glm::lessThan(hi, glm::dvec3(0.0))) ||
        glm::any(glm::greaterThanEqual(lo, glm::dvec3(whole.resolution()))))
    {
        return std::nullopt;
    }
    MeshGrid result;
    result.first = glm::ivec3(lo) - kMarginVoxels;
    result.grid.origin = glm::vec3(origin + size * glm::dvec3(result.first));
    result.grid.voxel_size = whole.voxel_size;
    const auto needed = static_cast<std::uint32_t>(longest) + 2 * kMarginVoxels;
    result.grid.depth = std::max(static_cast<std::uint32_t>(std::bit_width(needed - 1)), kDepthMin);
    if (result.grid.depth > Grid::kDepthMax)
    {
        throw Error(ErrorCode::Input, fmt::format("the mesh is {:.0f} voxels long, more than a grid has", longest));
    }
    return result;
}

// A cube of voxels that a node stands for.
struct Block
{
    glm::ivec3 lo;
    int edge;
    bool is_full; // without any voxel of the surface
};

// The nodes of a tree that are not larger than stamps, and full ones of any size.
std::vector<Block> blocksOf(const TreeData& tree)
{
    std::vector<Block> blocks;
    std::vector<std::pair<std::uint32_t, std::uint64_t>> level = {{0, 0}}; // numbers of nodes, and their codes
    auto edge = static_cast<int>(tree.grid.rootResolution());
    for (std::size_t number = 0; !tree.nodes.empty() && !level.empty(); ++number, edge /= kLeafEdge)
    {
        std::vector<std::pair<std::uint32_t, std::uint64_t>> below;
        const bool are_leaves = number + 1 == tree.levels.size();
        for (const auto& [index, code] : level)
        {
            const gpu::Node& node = tree.nodes[index];
            const bool is_full = tree.isFilled() && !are_leaves && cellMask(node) == 0;
            if (is_full || edge <= kStampEdge)
            {
                blocks.push_back({glm::ivec3(cellOfCode(code)) * edge, edge, is_full});
                continue;
            }
            std::uint32_t rank = 0;
            for (std::uint64_t rest = cellMask(node); rest != 0; rest &= rest - 1, ++rank)
            {
                below.emplace_back(tree.child(node, rank),
                                   code << kCellBits | static_cast<std::uint64_t>(std::countr_zero(rest)));
            }
        }
        level = std::move(below);
    }
    return blocks;
}

// The voxels of a mesh, and the first one's place in another grid.
struct VoxelizedMesh
{
    DeviceTree octree;
    glm::ivec3 first;
};

std::optional<VoxelizedMesh> voxelized(vk::HeadlessDevice& device, const Scene& mesh, const DeviceTree& tree,
                                       const MeshDabOptions& options)
{
    const Bounds bounds = mesh.bounds();
    const std::optional<MeshGrid> around = bounds.empty() ? std::nullopt : gridAround(bounds, tree.grid);
    if (!around)
    {
        return std::nullopt;
    }
    const auto& [grid, first] = *around;
    const bool attributes = tree.hasNodeAttributes();
    const GpuScene uploaded = uploadScene(device, mesh, attributes, tree.emission_scale);
    BuildResult built = buildOctree(device, uploaded, grid,
                                    {.coverage = options.coverage, .attributes = attributes, .fill = options.fill});
    return VoxelizedMesh{std::move(built.octree), first};
}

// Calls what() with cubes of kStampEdge that a box consists of.
void forStampBoxes(const VoxelBox& box, const std::function<void(const VoxelBox&)>& what)
{
    for (int z = box.lo.z; z <= box.hi.z; z += kStampEdge)
    {
        for (int y = box.lo.y; y <= box.hi.y; y += kStampEdge)
        {
            for (int x = box.lo.x; x <= box.hi.x; x += kStampEdge)
            {
                const glm::ivec3 lo(x, y, z);
                what({lo, glm::min(lo + kStampEdge - 1, box.hi)});
            }
        }
    }
}

// Calls what() for the parts of a brush that carves a box.
void carveBox(const VoxelBox& box, const Grid& grid, const std::function<void(const Brush&)>& what)
{
    const Brush brush = {
        .shape = BrushShape::Box, .action = BrushAction::Carve, .center = box.lo, .span = box.size() - 1};
    std::ranges::for_each(partsOf(brush, grid), what);
}

// What a clip of a part of a box does not have.
VoxelClip complementOf(const VoxelClip& part, const glm::ivec3& part_first, const glm::ivec3& size)
{
    VoxelClip result(size);
    const VoxelBox covered = {part_first, part_first + part.size() - 1};
    forCells({glm::ivec3(0), size - 1},
             [&](const glm::ivec3& cell)
             {
                 if (!covered.contains(cell) || !part.at(cell - part_first))
                 {
                     result.set(cell, ClipVoxel{{0, gpu::kNoNormal}, 0});
                 }
             });
    return result;
}

} // namespace

void forMeshDabs(vk::HeadlessDevice& device, const Scene& mesh, const DeviceTree& tree, const MeshDabOptions& options,
                 const std::function<void(const Brush&)>& dab)
{
    const std::optional<VoxelizedMesh> voxels = voxelized(device, mesh, tree, options);
    if (!voxels)
    {
        return;
    }
    const int last = static_cast<int>(voxels->octree.grid.resolution()) - 1;
    const VoxelBox whole = {glm::ivec3(0), glm::ivec3(static_cast<int>(tree.grid.resolution()) - 1)};
    for (const Block& block : blocksOf(downloadTree(device, voxels->octree)))
    {
        const VoxelBox reach = {block.lo, glm::min(block.lo + block.edge - 1, last)};
        if (reach.movedBy(voxels->first).within(whole).isEmpty())
        {
            continue;
        }
        if (block.is_full && options.action == BrushAction::Carve)
        {
            carveBox(reach.movedBy(voxels->first), tree.grid, dab);
            continue;
        }
        forStampBoxes(reach,
                      [&](const VoxelBox& part)
                      {
                          const VoxelClip clip = copyVoxels(device, voxels->octree, 0, part);
                          if (auto stamp = clip.stampAt(voxels->first + part.lo, tree.grid))
                          {
                              dab({.action = options.action, .stamp = std::move(stamp)});
                          }
                      });
    }
}

void forDabsOutside(vk::HeadlessDevice& device, const Scene& mesh, const DeviceTree& tree, const TreeData& contents,
                    const MeshDabOptions& options, const std::function<void(const Brush&)>& dab)
{
    const std::optional<VoxelizedMesh> voxels = voxelized(device, mesh, tree, options);
    const glm::ivec3 first = voxels ? voxels->first : glm::ivec3(0);
    const VoxelBox mesh_box =
        voxels ? VoxelBox{first, first + static_cast<int>(voxels->octree.grid.resolution()) - 1} : VoxelBox::none();
    const int last = static_cast<int>(tree.grid.resolution()) - 1;
    for (const Block& block : blocksOf(contents))
    {
        const VoxelBox reach = {block.lo, glm::min(block.lo + block.edge - 1, last)};
        if (reach.within(mesh_box).isEmpty())
        {
            carveBox(reach, tree.grid, dab);
            continue;
        }
        forStampBoxes(reach,
                      [&](const VoxelBox& part)
                      {
                          const VoxelBox both = part.within(mesh_box);
                          const VoxelClip kept = both.isEmpty()
                                                     ? VoxelClip()
                                                     : copyVoxels(device, voxels->octree, 0, both.movedBy(-first));
                          if (kept.voxelCount() == 0)
                          {
                              carveBox(part, tree.grid, dab);
                          }
                          else if (kept.voxelCount() != part.volume())
                          {
                              const VoxelClip outside = complementOf(kept, both.lo - part.lo, part.size());
                              dab({.action = BrushAction::Carve, .stamp = outside.stampAt(part.lo, tree.grid)});
                          }
                      });
    }
}

} // namespace zvo
