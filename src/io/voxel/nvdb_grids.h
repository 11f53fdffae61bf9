// SPDX-License-Identifier: MIT
// What the writers of NanoVDB files share.
#pragma once

#include "core/base/grid.h"
#include "io/voxel/write_bytes.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <cstddef>
#include <new>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

namespace zvo
{

using NvdbHandle = nanovdb::GridHandle<>;

/// The grid of a builder, whose cells are voxels of `grid`. Throws std::bad_alloc if memory does not suffice.
template <typename Builder> NvdbHandle nvdbGrid(Builder& builder, const Grid& grid, const char* name)
{
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

/// Passes the bytes of a file of these grids to `write`. The library's own writer needs a file in which it can seek
/// back.
inline void writeNvdbGrids(std::span<const NvdbHandle> grids, const WriteBytes& write)
{
    nanovdb::io::Segment segment;
    for (const NvdbHandle& grid : grids)
    {
        segment.add(grid);
        segment.meta.back().fileSize = grid.size();
    }
    std::ostringstream stream;
    segment.write(stream);
    const std::string head = stream.str();
    write(std::as_bytes(std::span(head)));
    for (const NvdbHandle& grid : grids)
    {
        write({reinterpret_cast<const std::byte*>(grid.data()), grid.size()});
    }
}

/// The error of memory that does not suffice for the grids. what: is in them, as "20 voxels, which take ...".
[[noreturn]] inline void throwNoMemoryForNvdb(const std::string& what)
{
    throw Error(ErrorCode::Memory, fmt::format("the host's memory does not suffice for the NanoVDB grids of {}: lower "
                                               "the resolution",
                                               what));
}

} // namespace zvo
