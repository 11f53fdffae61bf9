// SPDX-License-Identifier: MIT
#include "host_kernel.h"

#include "glsl/host_kernels.h"
#include "vk/check.h"

#include <algorithm>

namespace zvo::test
{

HostBuffer::HostBuffer(HostDevice& host, std::uint64_t bytes) : m_host(host)
{
    const vk::Functions& fn = host.fn();
    VkBufferCreateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    buffer.size = bytes;
    buffer.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    VK_CHECK(fn.vkCreateBuffer(host.device(), &buffer, nullptr, &m_buffer));
    VkMemoryRequirements requirements{};
    fn.vkGetBufferMemoryRequirements(host.device(), m_buffer, &requirements);
    VkPhysicalDeviceMemoryProperties properties{};
    fn.vkGetPhysicalDeviceMemoryProperties(host.physicalDevice(), &properties);
    constexpr VkMemoryPropertyFlags kWanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    memory.pNext = &flags;
    memory.allocationSize = requirements.size;
    while ((requirements.memoryTypeBits & (1U << memory.memoryTypeIndex)) == 0 ||
           (properties.memoryTypes[memory.memoryTypeIndex].propertyFlags & kWanted) != kWanted)
    {
        ++memory.memoryTypeIndex;
    }
    VK_CHECK(fn.vkAllocateMemory(host.device(), &memory, nullptr, &m_memory));
    VK_CHECK(fn.vkBindBufferMemory(host.device(), m_buffer, m_memory, 0));
    VK_CHECK(fn.vkMapMemory(host.device(), m_memory, 0, VK_WHOLE_SIZE, 0, &m_mapped));
    VkBufferDeviceAddressInfo address{};
    address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    address.buffer = m_buffer;
    m_address = fn.vkGetBufferDeviceAddress(host.device(), &address);
}

HostBuffer::~HostBuffer()
{
    m_host.fn().vkDestroyBuffer(m_host.device(), m_buffer, nullptr);
    m_host.fn().vkFreeMemory(m_host.device(), m_memory, nullptr);
}

HostKernel::HostKernel(HostDevice& host, std::string_view name, std::uint32_t push_bytes) : m_host(host)
{
    const vk::Functions& fn = host.fn();
    const auto kernel = std::ranges::find(hostKernels(), name, &vk::EmbeddedKernel::name);
    const VkPushConstantRange push = {VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &push;
    VK_CHECK(fn.vkCreatePipelineLayout(host.device(), &layout, nullptr, &m_layout));
    VkShaderModuleCreateInfo module{};
    module.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module.codeSize = kernel->words.size_bytes();
    module.pCode = kernel->words.data();
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.layout = m_layout;
    VK_CHECK(fn.vkCreateShaderModule(host.device(), &module, nullptr, &info.stage.module));
    VK_CHECK(fn.vkCreateComputePipelines(host.device(), VK_NULL_HANDLE, 1, &info, nullptr, &m_pipeline));
    fn.vkDestroyShaderModule(host.device(), info.stage.module, nullptr);
}

HostKernel::~HostKernel()
{
    m_host.fn().vkDestroyPipeline(m_host.device(), m_pipeline, nullptr);
    m_host.fn().vkDestroyPipelineLayout(m_host.device(), m_layout, nullptr);
}

void HostKernel::run(VkCommandBuffer commands, std::uint32_t groups, std::span<const std::byte> push) const
{
    const vk::Functions& fn = m_host.fn();
    fn.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_pipeline);
    fn.vkCmdPushConstants(commands, m_layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(push.size()),
                          push.data());
    fn.vkCmdDispatch(commands, groups, 1, 1);
}

} // namespace zvo::test
