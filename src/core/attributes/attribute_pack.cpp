// SPDX-License-Identifier: MIT
#include "core/attributes/attribute_pack.h"

#include "attributes/attributes.h"
#include "core/base/divide_up.h"

namespace zvo
{

namespace
{

template <typename Kernel>
void packBlocks(vk::FrameGraph& graph, const Kernel& kernel, const vk::BufferOf<gpu::Attribute>& attributes,
                vk::BufferOf<gpu::uint>& words)
{
    const std::uint64_t count = attributes.count();
    vk::Pass pass = graph.addPass(kernel);
    const gpu::PackBlocksParams params = {pass.read(attributes), pass.write(words), static_cast<std::uint32_t>(count)};
    pass.dispatch(divideUp(count, gpu::kBlockVoxels), params);
}

} // namespace

void packAttributes(vk::FrameGraph& graph, const vk::BufferOf<gpu::Attribute>& attributes, AttributeFormat format,
                    vk::BufferOf<gpu::uint>& words)
{
    const std::uint64_t count = attributes.count();
    if (format == AttributeFormat::Blocks)
    {
        packBlocks(graph, gpu::attributes::BlockColors{}, attributes, words);
        packBlocks(graph, gpu::attributes::BlockNormals{}, attributes, words);
        return;
    }
    vk::Pass pass = graph.addPass(gpu::attributes::Pack4{});
    const gpu::PackWordsParams params = {pass.read(attributes), pass.write(words), static_cast<std::uint32_t>(count)};
    pass.dispatch(count, params);
}

namespace
{

// Makes the buffers into which the attributes of tree are packed.
PackedAttributes makePackedAttributes(vk::Device& device, AttributeFormat format, const DeviceTree& tree)
{
    const std::uint64_t voxel_words = packedWords(format, tree.voxel_attributes.count());
    const std::uint64_t node_words = packedWords(nodeFormat(format), tree.node_attributes.count());
    device.memory().require((voxel_words + node_words) * sizeof(gpu::uint), "packing the attributes");
    return {format, {device, "packed voxel attributes", voxel_words}, {device, "packed node attributes", node_words}};
}

} // namespace

TreePacker::TreePacker(vk::Device& device, AttributeFormat format, DeviceTree& tree)
    : m_device(device), m_format(format), m_tree(tree),
      m_is_done(!isPacked(format) || tree.attributeFormat() != AttributeFormat::Bytes8)
{
}

void TreePacker::record(vk::FrameGraph& graph)
{
    if (m_packed.format == AttributeFormat::None)
    {
        m_packed = makePackedAttributes(m_device, m_format, m_tree);
    }
    packAttributes(graph, m_tree.voxel_attributes, m_format, m_packed.voxels);
    packAttributes(graph, m_tree.node_attributes, nodeFormat(m_format), m_packed.nodes);
}

void TreePacker::resume(std::vector<vk::PassTime> passes)
{
    m_tree.packed = std::move(m_packed);
    m_tree.voxel_attributes = {};
    m_tree.node_attributes = {};
    m_passes = std::move(passes);
    m_is_done = true;
}

} // namespace zvo
