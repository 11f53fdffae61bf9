// SPDX-License-Identifier: MIT
// A reference for brushes: edits on the host, voxel by voxel.
#pragma once

#include "core/base/grid.h"
#include "core/edit/brush.h"
#include "core/edit/voxel_box.h"
#include "support/octree_contents.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace zvo::test
{

/// The voxels of a tree, which brushes change.
class EditModel
{
public:
    /// cells: as cellsOf() lists them. filled: of a filled tree.
    EditModel(const Grid& grid, const std::vector<Cell>& cells, bool attributes, bool filled = false);

    /// The emission that some brushes have, over the tree's emission scale.
    static constexpr gpu::vec3 kEmission{2.0F, 0.5F, 0.25F};

    /// brush: with kEmission, or none. emits: voxels can have emission.
    void apply(const Brush& brush, bool emits);

    /// The edited tree with dynamic objects. moving: the cells of the objects alone; all: those of the objects and the
    /// unedited tree. With MergeRule::Average, a voxel of both has mean attributes only in leaves that no brush has
    /// changed.
    [[nodiscard]] EditModel merged(MergeRule rule, const std::vector<Cell>& moving, const std::vector<Cell>& all) const;

    [[nodiscard]] std::size_t voxelCount() const { return m_voxels.size(); }
    [[nodiscard]] const std::map<std::uint64_t, Cell>& voxels() const { return m_voxels; } // by code
    [[nodiscard]] bool has(std::uint64_t code) const { return m_voxels.contains(code); }

    /// What a voxel looks like where it is copied: what is inside, like the lowest node around it with attributes.
    [[nodiscard]] gpu::Attribute lookOf(const Cell& voxel) const;

    /// Lists voxels and all nodes above, as cellsOf() does; a node has the mean of its children.
    [[nodiscard]] std::vector<Cell> cells() const;

private:
    using Nodes = std::map<std::pair<std::uint32_t, std::uint64_t>, gpu::Attribute>;
    using Leaves = std::set<std::uint64_t>;

    void apply(const Brush& brush, const glm::ivec3& voxel, bool emits, Leaves& changed);
    void expose(const Brush& brush, const VoxelBox& box, Leaves& changed);
    [[nodiscard]] bool isClose(const Brush& brush, const VoxelBox& box, std::uint64_t code) const;
    static glm::ivec3 exposedNormal(const Brush& brush, const VoxelBox& box, const glm::ivec3& voxel);
    void changeLeaves(const Leaves& changed);
    [[nodiscard]] gpu::Attribute lookAround(std::uint32_t level, std::uint64_t code, const Nodes& nodes) const;
    [[nodiscard]] bool isAnythingBelow(std::uint32_t level, std::uint64_t code) const;

    Grid m_grid;
    bool m_attributes;
    bool m_filled;
    Nodes m_nodes;                          // of a filled tree: those that have attributes, by level and code
    std::map<std::uint64_t, Cell> m_voxels; // by code
    Leaves m_changed;                       // codes of the leaves that brushes have changed
};

} // namespace zvo::test
