// SPDX-License-Identifier: MIT
// What brushes do to voxels, voxel by voxel, on the host.
#pragma once

#include "core/base/grid.h"
#include "core/edit/brush.h"
#include "core/update/merge_rule.h"
#include "support/octree_contents.h"

#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace zvo::test
{

/// The voxels of a tree, and what brushes do to them.
class EditModel
{
public:
    /// cells: as cellsOf() lists them.
    EditModel(const Grid& grid, const std::vector<Cell>& cells, bool attributes);

    void apply(const Brush& brush);

    /// With dynamic objects. moving: the cells of what moves alone; all: of that and the tree from before all brushes.
    /// A voxel of both is the mean, for MergeRule::Average, only in leaves that no brush has changed.
    [[nodiscard]] EditModel merged(MergeRule rule, const std::vector<Cell>& moving, const std::vector<Cell>& all) const;

    [[nodiscard]] std::size_t voxelCount() const { return m_voxels.size(); }
    [[nodiscard]] const std::map<std::uint64_t, Cell>& voxels() const { return m_voxels; } // by code
    [[nodiscard]] bool has(std::uint64_t code) const { return m_voxels.contains(code); }

    /// As cellsOf() lists them: voxels, and all nodes above with the mean of their children.
    [[nodiscard]] std::vector<Cell> cells() const;

private:
    Grid m_grid;
    bool m_attributes;
    std::map<std::uint64_t, Cell> m_voxels; // by code
    std::set<std::uint64_t> m_changed;      // codes of leaves that brushes have changed
};

} // namespace zvo::test
