// SPDX-License-Identifier: MIT
// Attributes in fewer bytes (docs/attributes.md).
#pragma once

#include "core/tree/octree.h"
#include "vk/frame_graph.h"

namespace zvo
{

/// Records the passes that pack attributes into words, [packedWords(form, attributes.count())]. The words follow from
/// the attributes alone. Cost: attributes.
void packAttributes(vk::FrameGraph& graph, const vk::BufferOf<gpu::Attribute>& attributes, AttributeForm form,
                    vk::BufferOf<gpu::uint>& words);

/// What the attributes of tree, those of voxels and of nodes, are packed into. Throws Error{Memory} when the device's
/// budget does not suffice.
PackedAttributes makePackedAttributes(vk::Device& device, AttributeForm form, const Octree& tree);

} // namespace zvo
