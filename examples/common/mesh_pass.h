// SPDX-License-Identifier: MIT
#pragma once

#include "common/host.h"
#include "common/mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace host
{

/// Draws a mesh, tested against a reversed depth. Takes the feature dynamicRendering.
class MeshPass
{
public:
    /// Shaders: SPIR-V; both have the same push constants.
    MeshPass(const Device& device, const Mesh& mesh, std::span<const std::uint32_t> vertex_shader,
             std::span<const std::uint32_t> fragment_shader, VkFormat color_format, std::uint32_t push_bytes);
    ~MeshPass();
    MeshPass(const MeshPass&) = delete;
    MeshPass& operator=(const MeshPass&) = delete;

    /// Records a rendering into color and depth (D32_SFLOAT). load: keeps what is there, or clears both to 0.
    void draw(VkCommandBuffer commands, const Image& color, const Image& depth, VkExtent2D size,
              std::span<const std::byte> push, VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_LOAD) const;

    /// What it does to these images.
    static constexpr Edge kColor = {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    static constexpr Edge kDepth = {
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};

private:
    void makePipeline(std::span<const std::uint32_t> vertex_shader, std::span<const std::uint32_t> fragment_shader,
                      VkFormat color_format);

    const Device& m_device;
    Buffer m_vertices;
    Buffer m_indices;
    std::uint32_t m_index_count;
    VkPipelineLayout m_layout = VK_NULL_HANDLE;
    VkPipeline m_pipeline = VK_NULL_HANDLE;
};

} // namespace host
