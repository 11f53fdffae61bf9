// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/tree/attribute_form.h"
#include "shared/octree.h"
#include "vk/buffer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo
{

/// A sparse voxel octree in device memory; shaders/shared/octree.h documents its layout.
struct Octree
{
    /// The nodes of one level (level 0 is the root) stand together, in Morton order.
    struct Level
    {
        std::uint32_t first_node = 0;
        std::uint32_t node_count = 0;
    };

    Grid grid;
    std::uint32_t node_count = 0;
    std::uint32_t voxel_count = 0;
    std::vector<Level> levels; // grid.nodeLevels() of them; empty without voxels, or where nodes stand elsewhere

    vk::BufferOf<gpu::Node> nodes;                 // [node_count]
    vk::BufferOf<gpu::Attribute> voxel_attributes; // [voxel_count] in Morton order, or empty
    vk::BufferOf<gpu::Attribute> node_attributes;  // [node_count], averages of what is below, or empty
    PackedAttributes packed;                       // the same in another form, in place of both
    vk::BufferOf<gpu::uvec2> emission_words; // [ceil(voxel_count / 32)] bits of emissive voxels, rank of the first one
    vk::BufferOf<gpu::uint> emission;        // [emissive voxels] radiance / emission_scale as RGB9E5
    float emission_scale = 1.0F;

    [[nodiscard]] AttributeForm attributeForm() const
    {
        return voxel_attributes.count() != 0 ? AttributeForm::Bytes8 : packed.form;
    }
    [[nodiscard]] bool hasAttributes() const { return attributeForm() != AttributeForm::None; }
    [[nodiscard]] bool hasNodeAttributes() const { return node_attributes.count() + packed.nodes.count() != 0; }
    [[nodiscard]] std::uint64_t geometryBytes() const { return std::uint64_t{node_count} * sizeof(gpu::Node); }
    [[nodiscard]] std::uint64_t attributeBytes() const
    {
        return voxel_attributes.bytes() + node_attributes.bytes() + packed.bytes() + emission_words.bytes() +
               emission.bytes();
    }
};

} // namespace zvo
