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

void packAttributes(vk::FrameGraph& graph, const vk::BufferOf<gpu::Attribute>& attributes, AttributeForm form,
                    vk::BufferOf<gpu::uint>& words)
{
    const std::uint64_t count = attributes.count();
    if (form == AttributeForm::Blocks)
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

// What the attributes of tree are packed into.
PackedAttributes makePackedAttributes(vk::Device& device, AttributeForm form, const DeviceTree& tree)
{
    const std::uint64_t voxel_words = packedWords(form, tree.voxel_attributes.count());
    const std::uint64_t node_words = packedWords(nodeForm(form), tree.node_attributes.count());
    device.memory().require((voxel_words + node_words) * sizeof(gpu::uint), "packing the attributes");
    return {form, {device, "packed voxel attributes", voxel_words}, {device, "packed node attributes", node_words}};
}

} // namespace

TreePacker::TreePacker(vk::Device& device, AttributeForm form, DeviceTree& tree)
    : m_device(device), m_form(form), m_tree(tree),
      m_is_done(!isPacked(form) || tree.attributeForm() != AttributeForm::Bytes8)
{
}

void TreePacker::record(vk::FrameGraph& graph)
{
    if (m_packed.form == AttributeForm::None)
    {
        m_packed = makePackedAttributes(m_device, m_form, m_tree);
    }
    packAttributes(graph, m_tree.voxel_attributes, m_form, m_packed.voxels);
    packAttributes(graph, m_tree.node_attributes, nodeForm(m_form), m_packed.nodes);
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
