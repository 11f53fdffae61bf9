// SPDX-License-Identifier: MIT
#include "common/mesh_pass.h"

#include <cstddef>
#include <cstring>

namespace host
{

namespace
{

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkPipelineShaderStageCreateInfo makeStage(const Device& device, VkShaderStageFlagBits stage,
                                          std::span<const std::uint32_t> words)
{
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    VkPipelineShaderStageCreateInfo result{};
    result.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    result.stage = stage;
    result.pName = "main";
    check(device.fn().vkCreateShaderModule(device.handle(), &info, nullptr, &result.module), "vkCreateShaderModule");
    return result;
}

VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkAttachmentLoadOp load)
{
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info.imageView = image.view();
    info.imageLayout = layout;
    info.loadOp = load;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

} // namespace

MeshPass::MeshPass(const Device& device, const Mesh& mesh, std::span<const std::uint32_t> vertex_shader,
                   std::span<const std::uint32_t> fragment_shader, VkFormat color_format, std::uint32_t push_bytes)
    : m_device(device),
      m_vertices(device, mesh.vertices.size() * sizeof(mesh.vertices[0]), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
      m_indices(device, mesh.triangles.size() * sizeof(mesh.triangles[0]), VK_BUFFER_USAGE_INDEX_BUFFER_BIT),
      m_index_count(static_cast<std::uint32_t>(3 * mesh.triangles.size()))
{
    std::memcpy(m_vertices.mapped(), mesh.vertices.data(), mesh.vertices.size() * sizeof(mesh.vertices[0]));
    std::memcpy(m_indices.mapped(), mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
    const VkPushConstantRange push = {kStages, 0, push_bytes};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &push;
    check(device.fn().vkCreatePipelineLayout(device.handle(), &layout, nullptr, &m_layout), "vkCreatePipelineLayout");
    makePipeline(vertex_shader, fragment_shader, color_format);
}

void MeshPass::makePipeline(std::span<const std::uint32_t> vertex_shader,
                            std::span<const std::uint32_t> fragment_shader, VkFormat color_format)
{
    const Functions& fn = m_device.fn();
    const std::array stages = {makeStage(m_device, VK_SHADER_STAGE_VERTEX_BIT, vertex_shader),
                               makeStage(m_device, VK_SHADER_STAGE_FRAGMENT_BIT, fragment_shader)};
    const VkVertexInputBindingDescription binding = {0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
    const std::array<VkVertexInputAttributeDescription, 3> attributes = {
        {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
         {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)},
         {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, color)}}};
    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(attributes.size());
    input.pVertexAttributeDescriptions = attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = VK_TRUE;
    depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = VK_COMPARE_OP_GREATER; // reversed: what is nearer has more
    VkPipelineColorBlendAttachmentState blend_attachment{};
    blend_attachment.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &blend_attachment;
    const std::array<VkDynamicState, 2> states = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(states.size());
    dynamic.pDynamicStates = states.data();
    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &color_format;
    rendering.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.pNext = &rendering;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = m_layout;
    const VkResult result =
        fn.vkCreateGraphicsPipelines(m_device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &m_pipeline);
    for (const VkPipelineShaderStageCreateInfo& stage : stages)
    {
        fn.vkDestroyShaderModule(m_device.handle(), stage.module, nullptr);
    }
    check(result, "vkCreateGraphicsPipelines");
}

MeshPass::~MeshPass()
{
    m_device.fn().vkDestroyPipeline(m_device.handle(), m_pipeline, nullptr);
    m_device.fn().vkDestroyPipelineLayout(m_device.handle(), m_layout, nullptr);
}

void MeshPass::draw(VkCommandBuffer commands, const Image& color, const Image& depth, VkExtent2D size,
                    std::span<const std::byte> push, VkAttachmentLoadOp load) const
{
    const Functions& fn = m_device.fn();
    const VkRenderingAttachmentInfo color_attachment = attachment(color, kColor.layout, load);
    const VkRenderingAttachmentInfo depth_attachment = attachment(depth, kDepth.layout, load);
    const VkRect2D area = {{0, 0}, size};
    const VkViewport viewport = {0, 0, static_cast<float>(size.width), static_cast<float>(size.height), 0, 1};
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = area;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &color_attachment;
    info.pDepthAttachment = &depth_attachment;
    fn.vkCmdBeginRendering(commands, &info);
    fn.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, m_pipeline);
    fn.vkCmdSetViewport(commands, 0, 1, &viewport);
    fn.vkCmdSetScissor(commands, 0, 1, &area);
    fn.vkCmdPushConstants(commands, m_layout, kStages, 0, static_cast<std::uint32_t>(push.size()), push.data());
    const VkBuffer vertices = m_vertices.handle();
    const VkDeviceSize offset = 0;
    fn.vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
    fn.vkCmdBindIndexBuffer(commands, m_indices.handle(), 0, VK_INDEX_TYPE_UINT32);
    fn.vkCmdDrawIndexed(commands, m_index_count, 1, 0, 0, 0);
    fn.vkCmdEndRendering(commands);
}

} // namespace host
