// SPDX-License-Identifier: MIT
#include "io/voxel/nvdb_write.h"

#include "core/base/morton.h"
#include "io/voxel/colored_voxels.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <cstdint>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>

namespace zvo
{

namespace
{

nanovdb::Rgba8 rgbaOf(std::uint32_t color)
{
    return {static_cast<std::uint8_t>(color), static_cast<std::uint8_t>(color >> 8),
            static_cast<std::uint8_t>(color >> 16)};
}

using Builder = nanovdb::GridBuilder<nanovdb::Rgba8>;

// The finished grid. Throws std::bad_alloc if memory does not suffice.
nanovdb::GridHandle<> handleOf(Builder& builder, const Grid& grid)
{
    const glm::dvec3 center = glm::dvec3(grid.origin) + 0.5 * double{grid.voxel_size};
    try
    {
        return builder.getHandle(double{grid.voxel_size}, {center.x, center.y, center.z}, "zvo");
    }
    catch (const std::runtime_error&) // thrown only when its buffer or thread could not be made
    {
        throw std::bad_alloc();
    }
}

nanovdb::GridHandle<> gridOf(const TreeData& tree)
{
    Builder builder(nanovdb::Rgba8(std::uint8_t{0}), nanovdb::GridClass::VoxelVolume);
    auto values = builder.getAccessor();
    forEachColoredVoxel(tree,
                        [&](std::uint64_t code, std::uint32_t color)
                        {
                            const glm::ivec3 cell(cellOfCode(code));
                            values.setValue({cell.x, cell.y, cell.z}, rgbaOf(color));
                        });
    return handleOf(builder, tree.grid);
}

// The bytes before the grid. The library's own writer needs a file in which it can seek back.
std::string headOf(const nanovdb::GridHandle<>& grid)
{
    nanovdb::io::Segment segment;
    segment.add(grid);
    segment.meta.front().fileSize = grid.size();
    std::ostringstream head;
    segment.write(head);
    return head.str();
}

nanovdb::GridHandle<> gridInMemory(const TreeData& tree)
{
    try
    {
        return gridOf(tree);
    }
    catch (const std::bad_alloc&)
    {
        throw Error(ErrorCode::Memory,
                    fmt::format("the host's memory does not suffice for the NanoVDB grid of {} voxels, which takes "
                                "about 4 KiB for each block of 8^3 cells with voxels: lower the resolution",
                                tree.voxel_count));
    }
}

} // namespace

void writeNvdb(const TreeData& tree, const WriteBytes& write)
{
    const nanovdb::GridHandle<> grid = gridInMemory(tree);
    const std::string head = headOf(grid);
    write(std::as_bytes(std::span(head)));
    write({reinterpret_cast<const std::byte*>(grid.data()), grid.size()});
}

} // namespace zvo
