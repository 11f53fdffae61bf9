// SPDX-License-Identifier: MIT
#include "runtime/copy_voxels.h"

#include "core/edit/edit.h"

namespace zvo
{

VoxelClip copyVoxels(vk::HeadlessDevice& device, const DeviceTree& tree, std::uint32_t root, const VoxelBox& box)
{
    const Brush everything = {.shape = BrushShape::Box, .center = box.lo, .span = box.hi - box.lo};
    VoxelClip clip(box.size());
    for (const Brush& part : partsOf(everything, tree.grid))
    {
        const DabExtent extent = DabExtent::of(part, tree.grid).value();
        DabBuffers buffers(device.device(), extent.cell_count);
        vk::BufferOf<gpu::uint> words(device.device(), "copied voxels",
                                      std::uint64_t{extent.leafCount()} * gpu::kStampWords);
        device.run([&](vk::FrameGraph& graph) { recordCopy(graph, tree, root, extent, words, buffers); });
        const Stamp copied = {{glm::ivec3(extent.box.lo), glm::ivec3(extent.box.hi)}, device.download(words)};
        clip.add(VoxelClip(copied), copied.box.lo - box.lo);
    }
    return clip;
}

} // namespace zvo
