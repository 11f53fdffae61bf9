// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/color_word.h"
#include "core/tree/tree_data.h"

#include <cstddef>
#include <cstdint>

namespace zvo
{

/// Calls use(code, color) for every voxel in ascending order of the Morton codes. color: sRGB red | green << 8 | blue
/// << 16; kPlainColor in a tree without attributes.
template <typename Use> void forEachColoredVoxel(const TreeData& tree, const Use& use)
{
    std::size_t voxel = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     use(code, tree.hasAttributes() ? tree.voxelAttribute(voxel).color & kColorMask : kPlainColor);
                     ++voxel;
                 });
}

} // namespace zvo
