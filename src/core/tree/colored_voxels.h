// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/color_word.h"
#include "core/tree/tree_data.h"

#include <cstdint>

namespace zvo
{

inline constexpr std::uint32_t kNoLight = ~std::uint32_t{0};

/// Calls use(code, color, light) for every voxel, on the surface or inside, in ascending order of the Morton codes.
/// color: sRGB red | green << 8 | blue << 16; kPlainColor in a tree without attributes. light: its index in
/// TreeData::emission, or kNoLight.
template <typename Use> void forEachColoredVoxel(const TreeData& tree, const Use& use)
{
    std::uint32_t voxel = 0;
    std::uint32_t light = 0;
    forEachCell(tree,
                [&](std::uint64_t code, bool on_surface)
                {
                    if (!on_surface)
                    {
                        use(code, tree.hasAttributes() ? tree.interiorAttribute().color : kPlainColor, kNoLight);
                        return;
                    }
                    const std::uint32_t word = voxel / gpu::kVoxelsPerEmissionWord;
                    const bool emits = !tree.emission_words.empty() &&
                                       (tree.emission_words[word].x >> voxel % gpu::kVoxelsPerEmissionWord & 1U) != 0;
                    use(code, tree.hasAttributes() ? tree.voxelAttribute(voxel).color & kColorMask : kPlainColor,
                        emits ? light++ : kNoLight);
                    ++voxel;
                });
}

} // namespace zvo
