// SPDX-License-Identifier: MIT
#include "core/tree/tree_limits.h"

#include "zvo/error.h"

#include <fmt/format.h>

namespace zvo
{

void requireIndexable(std::uint64_t nodes, std::uint64_t attributes)
{
    if (nodes > kNodesMax)
    {
        throw Error(ErrorCode::Memory,
                    fmt::format("a tree of {} nodes cannot be on a device: kernels reach {} of them; "
                                "lower the resolution, or split the scene",
                                nodes, kNodesMax));
    }
    if (attributes > kIndicesMax)
    {
        throw Error(ErrorCode::Memory, fmt::format("attributes of {} voxels or nodes cannot be on a device: kernels "
                                                   "reach {} of them; lower the resolution, split the scene, or leave "
                                                   "attributes out",
                                                   attributes, kIndicesMax));
    }
}

void throwUncountable(const char* what)
{
    throw Error(ErrorCode::Memory, fmt::format("the scene makes more {} than 32-bit numbers count; "
                                               "lower the resolution, or split the scene",
                                               what));
}

} // namespace zvo
