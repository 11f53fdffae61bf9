// SPDX-License-Identifier: MIT
#include "common/image_kernel.h"

namespace host
{

ImageKernel::ImageKernel(const Device& device, std::span<const std::uint32_t> shader, const Image& image,
                         std::uint32_t push_bytes)
    : m_device(device)
{
    bindImage(image);
    makePipeline(shader, push_bytes);
}

void ImageKernel::bindImage(const Image& image)
{
    const Functions& fn = m_device.fn();
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT,
                                                  nullptr};
    VkDescriptorSetLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = 1;
    layout.pBindings = &binding;
    check(fn.vkCreateDescriptorSetLayout(m_device.handle(), &layout, nullptr, &m_set_layout),
          "vkCreateDescriptorSetLayout");
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(fn.vkCreateDescriptorPool(m_device.handle(), &pool, nullptr, &m_pool), "vkCreateDescriptorPool");
    VkDescriptorSetAllocateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = m_pool;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &m_set_layout;
    check(fn.vkAllocateDescriptorSets(m_device.handle(), &set, &m_set), "vkAllocateDescriptorSets");
    const VkDescriptorImageInfo bound = {VK_NULL_HANDLE, image.view(), kWrites.layout};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = m_set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
    write.pImageInfo = &bound;
    fn.vkUpdateDescriptorSets(m_device.handle(), 1, &write, 0, nullptr);
}

void ImageKernel::makePipeline(std::span<const std::uint32_t> shader, std::uint32_t push_bytes)
{
    const Functions& fn = m_device.fn();
    const VkPushConstantRange push = {VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &m_set_layout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &push;
    check(fn.vkCreatePipelineLayout(m_device.handle(), &layout, nullptr, &m_layout), "vkCreatePipelineLayout");
    VkShaderModuleCreateInfo module{};
    module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module.codeSize = shader.size_bytes();
    module.pCode = shader.data();
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.layout = m_layout;
    check(fn.vkCreateShaderModule(m_device.handle(), &module, nullptr, &info.stage.module), "vkCreateShaderModule");
    const VkResult result =
        fn.vkCreateComputePipelines(m_device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &m_pipeline);
    fn.vkDestroyShaderModule(m_device.handle(), info.stage.module, nullptr);
    check(result, "vkCreateComputePipelines");
}

ImageKernel::~ImageKernel()
{
    const Functions& fn = m_device.fn();
    fn.vkDestroyPipeline(m_device.handle(), m_pipeline, nullptr);
    fn.vkDestroyPipelineLayout(m_device.handle(), m_layout, nullptr);
    fn.vkDestroyDescriptorPool(m_device.handle(), m_pool, nullptr);
    fn.vkDestroyDescriptorSetLayout(m_device.handle(), m_set_layout, nullptr);
}

void ImageKernel::run(VkCommandBuffer commands, VkExtent2D size, std::span<const std::byte> push) const
{
    constexpr std::uint32_t kGroup = 8;
    const Functions& fn = m_device.fn();
    fn.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_pipeline);
    fn.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_layout, 0, 1, &m_set, 0, nullptr);
    fn.vkCmdPushConstants(commands, m_layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(push.size()),
                          push.data());
    fn.vkCmdDispatch(commands, (size.width + kGroup - 1) / kGroup, (size.height + kGroup - 1) / kGroup, 1);
}

} // namespace host
