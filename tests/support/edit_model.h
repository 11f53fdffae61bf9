// SPDX-License-Identifier: MIT
// What brushes do to voxels, voxel by voxel, on the host.
#pragma once

#include "core/brush.h"
#include "core/grid.h"
#include "support/octree_contents.h"

#include <cstdint>
#include <map>
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

    [[nodiscard]] std::size_t voxelCount() const { return m_voxels.size(); }
    [[nodiscard]] bool has(std::uint64_t code) const { return m_voxels.contains(code); }

    /// As cellsOf() lists them: voxels, and all nodes above with the mean of their children.
    [[nodiscard]] std::vector<Cell> cells() const;

private:
    Grid m_grid;
    bool m_attributes;
    std::map<std::uint64_t, Cell> m_voxels; // by code
};

} // namespace zvo::test
