// SPDX-License-Identifier: MIT
// A reference for brushes: edits on the host, voxel by voxel.
#pragma once

#include "core/base/grid.h"
#include "core/edit/brush.h"
#include "support/octree_contents.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace zvo::test
{

/// The voxels of a tree, which brushes change.
class EditModel
{
public:
    /// cells: as cellsOf() lists them.
    EditModel(const Grid& grid, const std::vector<Cell>& cells, bool attributes);

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

    /// Lists voxels and all nodes above, as cellsOf() does; a node has the mean of its children.
    [[nodiscard]] std::vector<Cell> cells() const;

private:
    void apply(const Brush& brush, const glm::ivec3& voxel, bool emits);

    Grid m_grid;
    bool m_attributes;
    std::map<std::uint64_t, Cell> m_voxels; // by code
    std::set<std::uint64_t> m_changed;      // codes of the leaves that brushes have changed
};

} // namespace zvo::test
