// SPDX-License-Identifier: MIT
#include "io/voxel/nvdb_write.h"

#include "core/base/morton.h"
#include "core/base/srgb.h"
#include "core/tree/colored_voxels.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <array>
#include <cstdint>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

namespace zvo
{

namespace
{

using Handle = nanovdb::GridHandle<>;

// A grid in which the voxels are active. valueOf: of a colour. Throws std::bad_alloc if memory does not suffice.
template <typename Value, typename ValueOf>
Handle gridOf(const TreeData& tree, const char* name, nanovdb::GridClass grid_class, const ValueOf& valueOf)
{
    nanovdb::GridBuilder<Value> builder(Value(0.0F), grid_class);
    auto values = builder.getAccessor();
    forEachColoredVoxel(tree,
                        [&](std::uint64_t code, std::uint32_t color, std::uint32_t)
                        {
                            const glm::ivec3 cell(cellOfCode(code));
                            values.setValue({cell.x, cell.y, cell.z}, valueOf(color));
                        });
    const Grid& grid = tree.grid;
    const glm::dvec3 center = glm::dvec3(grid.origin) + 0.5 * double{grid.voxel_size};
    try
    {
        return builder.getHandle(double{grid.voxel_size}, {center.x, center.y, center.z}, name);
    }
    catch (const std::runtime_error&) // thrown only when its buffer or thread could not be made
    {
        throw std::bad_alloc();
    }
}

std::array<Handle, 2> gridsOf(const TreeData& tree)
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

// The bytes before the grids. The library's own writer needs a file in which it can seek back.
std::string headOf(const std::array<Handle, 2>& grids)
{
    nanovdb::io::Segment segment;
    for (const Handle& grid : grids)
    {
        segment.add(grid);
        segment.meta.back().fileSize = grid.size();
    }
    std::ostringstream head;
    segment.write(head);
    return head.str();
}

std::array<Handle, 2> gridsInMemory(const TreeData& tree)
{
    try
    {
        return gridsOf(tree);
    }
    catch (const std::bad_alloc&)
    {
        throw Error(ErrorCode::Memory,
                    fmt::format("the host's memory does not suffice for the NanoVDB grids of {} voxels, which take "
                                "about 14 KiB for each block of 8^3 cells with voxels: lower the resolution",
                                tree.occupiedCount()));
    }
}

} // namespace

void writeNvdb(const TreeData& tree, const WriteBytes& write)
{
    const std::array<Handle, 2> grids = gridsInMemory(tree);
    const std::string head = headOf(grids);
    write(std::as_bytes(std::span(head)));
    for (const Handle& grid : grids)
    {
        write({reinterpret_cast<const std::byte*>(grid.data()), grid.size()});
    }
}

} // namespace zvo
