// SPDX-License-Identifier: MIT
#include "io/voxel/nvdb_distances.h"

#include "core/base/morton.h"
#include "io/voxel/nvdb_grids.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <new>

namespace zvo
{

namespace
{

using Builder = nanovdb::GridBuilder<float>;
using Accessor = Builder::ValueAccessor;

constexpr std::int32_t kNodeEdge = 8;         // cells of a leaf of NanoVDB
constexpr std::uint32_t kRootCellEdge = 4096; // cells of a node below the root

// Whether a filled tree has a cell.
bool hasCell(const TreeData& tree, const glm::uvec3& cell)
{
    std::uint32_t number = 0;
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        const auto shift = static_cast<std::uint32_t>(2 * (tree.levels.size() - 1 - level));
        const auto child = static_cast<std::uint32_t>(codeOfCell((cell >> shift) & 3U));
        const bool is_leaf = shift == 0;
        const std::uint64_t mask =
            is_leaf ? tree.occupied[number - tree.levels.back().first_node] : cellMask(tree.nodes[number]);
        if (mask == 0 || (mask >> child & 1U) == 0)
        {
            return mask == 0; // a full node, as no leaf is empty
        }
        if (is_leaf)
        {
            return true;
        }
        const auto rank = static_cast<std::uint32_t>(std::popcount(mask & ((std::uint64_t{1} << child) - 1)));
        number = tree.child(tree.nodes[number], rank);
    }
    return false;
}

class LevelSet
{
public:
    LevelSet(const DistanceData& distances, const TreeData& filled)
        : m_distances(distances), m_filled(filled),
          m_background(static_cast<float>(distances.band) * distances.grid.voxel_size),
          m_builder(m_background, nanovdb::GridClass::LevelSet), m_values(m_builder.getAccessor())
    {
    }

    NvdbHandle grid()
    {
        for (std::size_t first = 0; first < m_distances.leaves.size();)
        {
            first = addNode(first);
        }
        addInnerNodes();
        NvdbHandle handle = nvdbGrid(m_builder, m_distances.grid, "distance");
        auto* const made = handle.grid<float>();
        signTiles<1>(*made);
        signTiles<2>(*made);
        nanovdb::updateChecksum(*made);
        return handle;
    }

private:
    [[nodiscard]] float beyondBand(const glm::uvec3& cell) const
    {
        const bool is_cell = glm::all(glm::lessThan(cell, glm::uvec3(m_distances.grid.resolution())));
        return is_cell && hasCell(m_filled, cell) ? -m_background : m_background;
    }

    // Adds a node of NanoVDB, of 2^3 leaves. first: the first leaf in it, if that has any. Returns the first leaf after
    // it.
    std::size_t addNode(std::size_t first) { return addNode(m_distances.leaves[first].leaf / 2U, first); }

    std::size_t addNode(const glm::uvec3& node, std::size_t first)
    {
        const glm::ivec3 corner = kNodeEdge * glm::ivec3(node);
        auto* const made = m_values.setValue({corner.x, corner.y, corner.z}, m_background);
        for (std::uint32_t octant = 0; octant < 8; ++octant)
        {
            const glm::uvec3 leaf = 2U * node + cellOfCode(octant);
            const bool exists = first < m_distances.leaves.size() && m_distances.leaves[first].leaf == leaf;
            for (std::uint32_t cell = 0; cell < gpu::kCentersInBand; ++cell)
            {
                const glm::uvec3 place = 4U * leaf + cellOfCode(cell);
                const std::uint32_t number = ((place.x & 7U) << 6U) + ((place.y & 7U) << 3U) + (place.z & 7U);
                const bool in_band = exists && m_distances.isInBand(first, cell);
                made->mValueMask.set(number, in_band);
                made->mValues[number] = in_band  ? m_distances.distanceAt(first, cell)
                                        : exists ? (m_distances.isInside(first, cell) ? -m_background : m_background)
                                                 : beyondBand(place);
            }
            first += exists ? 1 : 0;
        }
        return first;
    }

    // Whether a node of NanoVDB has a leaf with a cell in the band.
    [[nodiscard]] bool hasLeaf(const glm::uvec3& node) const
    {
        const auto found = std::ranges::lower_bound(m_distances.leaves, codeOfCell(2U * node), {},
                                                    [](const auto& leaf) { return codeOfCell(leaf.leaf); });
        return found != m_distances.leaves.end() && found->leaf / 2U == node;
    }

    // Nodes right below the root in which all is inside have no leaf yet.
    void addInnerNodes()
    {
        const std::uint32_t count = m_distances.grid.resolution() / kRootCellEdge;
        for (std::uint32_t i = 0; i < count * count * count; ++i)
        {
            const glm::uvec3 corner = kRootCellEdge * glm::uvec3(i % count, i / count % count, i / count / count);
            const glm::ivec3 at(corner);
            if (hasCell(m_filled, corner) && !hasLeaf(corner / static_cast<std::uint32_t>(kNodeEdge)) &&
                !m_values.isActive({at.x, at.y, at.z}) && m_values.getValue({at.x, at.y, at.z}) == m_background)
            {
                addNode(corner / static_cast<std::uint32_t>(kNodeEdge), m_distances.leaves.size());
            }
        }
    }

    template <int kLevel> void signTiles(nanovdb::NanoGrid<float>& grid) const
    {
        auto* const nodes = grid.tree().template getFirstNode<kLevel>();
        for (std::uint32_t i = 0; i < grid.tree().nodeCount(kLevel); ++i)
        {
            auto* const node = nodes[i].data();
            for (std::uint32_t tile = 0; tile < std::remove_pointer_t<decltype(nodes)>::SIZE; ++tile)
            {
                if (!node->mChildMask.isOn(tile))
                {
                    const nanovdb::Coord at = nodes[i].offsetToGlobalCoord(tile);
                    node->mTable[tile].value = beyondBand(glm::uvec3(at[0], at[1], at[2]));
                }
            }
        }
    }

    const DistanceData& m_distances;
    const TreeData& m_filled;
    float m_background;
    Builder m_builder;
    Accessor m_values;
};

NvdbHandle gridInMemory(const DistanceData& distances, const TreeData& filled)
{
    try
    {
        return LevelSet(distances, filled).grid();
    }
    catch (const std::bad_alloc&)
    {
        throwNoMemoryForNvdb(
            fmt::format("{} leaves, which take about 5 KiB for each block of 8^3 cells", distances.leaves.size()));
    }
}

} // namespace

void writeNvdbDistances(const DistanceData& distances, const TreeData& filled, const WriteBytes& write)
{
    const std::array<NvdbHandle, 1> grids = {gridInMemory(distances, filled)};
    writeNvdbGrids(grids, write);
}

} // namespace zvo
