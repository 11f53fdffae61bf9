// SPDX-License-Identifier: MIT
#include "io/voxel/nvdb_write.h"

#include "core/base/morton.h"
#include "core/base/srgb.h"
#include "core/tree/colored_voxels.h"
#include "io/voxel/nvdb_grids.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <new>

namespace zvo
{

namespace
{

// A grid in which the voxels are active. valueOf: of a colour. Throws std::bad_alloc if memory does not suffice.
template <typename Value, typename ValueOf>
NvdbHandle gridOf(const TreeData& tree, const char* name, nanovdb::GridClass grid_class, const ValueOf& valueOf)
{
    nanovdb::GridBuilder<Value> builder(Value(0.0F), grid_class);
    auto values = builder.getAccessor();
    forEachColoredVoxel(tree,
                        [&](std::uint64_t code, std::uint32_t color, std::uint32_t)
                        {
                            const glm::ivec3 cell(cellOfCode(code));
                            values.setValue({cell.x, cell.y, cell.z}, valueOf(color));
                        });
    return nvdbGrid(builder, tree.grid, name);
}

std::array<NvdbHandle, 2> gridsOf(const TreeData& tree)
{
    std::array<float, 256> linear{};
    for (std::uint32_t i = 0; i < linear.size(); ++i)
    {
        linear[i] = static_cast<float>(linearOf(i).r);
    }
    return {gridOf<float>(tree, "density", nanovdb::GridClass::FogVolume, [](std::uint32_t) { return 1.0F; }),
            gridOf<nanovdb::Vec3f>(tree, "color", nanovdb::GridClass::VoxelVolume,
                                   [&](std::uint32_t color) {
                                       return nanovdb::Vec3f(linear[color & 255U], linear[color >> 8U & 255U],
                                                             linear[color >> 16U & 255U]);
                                   })};
}

std::array<NvdbHandle, 2> gridsInMemory(const TreeData& tree)
{
    try
    {
        return gridsOf(tree);
    }
    catch (const std::bad_alloc&)
    {
        throwNoMemoryForNvdb(fmt::format("{} voxels, which take about 14 KiB for each block of 8^3 cells with voxels",
                                         tree.occupiedCount()));
    }
}

} // namespace

void writeNvdb(const TreeData& tree, const WriteBytes& write)
{
    writeNvdbGrids(gridsInMemory(tree), write);
}

} // namespace zvo
