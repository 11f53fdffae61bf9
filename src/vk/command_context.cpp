// SPDX-License-Identifier: MIT
#include "vk/command_context.h"

#include "vk/check.h"
#include "vk/device.h"

#include <cstdint>

namespace zvo::vk
{

CommandContext::CommandContext(Device& device, VkQueue queue) : m_device(device), m_queue(queue)
{
    try
    {
        create();
    }
    catch (...)
    {
        destroy();
        throw;
    }
}

CommandContext::~CommandContext()
{
    destroy();
}

VkCommandBuffer CommandContext::begin()
{
    const Functions& fn = m_device.fn();
    VK_CHECK(fn.vkResetCommandPool(m_device.handle(), m_pool, 0));
    VK_CHECK(fn.vkResetFences(m_device.handle(), 1, &m_fence)); // here: a submission may have failed after all else
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    VK_CHECK(fn.vkBeginCommandBuffer(m_commands, &info));

    // The barrier is needed although earlier work may be complete: a fence does not make its writes visible to this
    // work.
    VkMemoryBarrier2 memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    memory.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    memory.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    memory.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    memory.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &memory;
    fn.vkCmdPipelineBarrier2(m_commands, &dependency);
    return m_commands;
}

void CommandContext::submit(const SubmitSync& sync)
{
    const Functions& fn = m_device.fn();
    VK_CHECK(fn.vkEndCommandBuffer(m_commands));
    VkCommandBufferSubmitInfo commands{};
    commands.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    commands.commandBuffer = m_commands;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &commands;
    VkSemaphoreSubmitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    wait.semaphore = sync.wait;
    wait.stageMask = sync.wait_stages;
    submit.waitSemaphoreInfoCount = sync.wait != VK_NULL_HANDLE ? 1 : 0;
    submit.pWaitSemaphoreInfos = &wait;
    VkSemaphoreSubmitInfo signal{};
    signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    signal.semaphore = sync.signal;
    signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    submit.signalSemaphoreInfoCount = sync.signal != VK_NULL_HANDLE ? 1 : 0;
    submit.pSignalSemaphoreInfos = &signal;
    VK_CHECK(fn.vkQueueSubmit2(m_queue, 1, &submit, m_fence));
}

bool CommandContext::done() const
{
    return m_device.fn().vkWaitForFences(m_device.handle(), 1, &m_fence, VK_TRUE, 0) != VK_TIMEOUT;
}

void CommandContext::wait()
{
    const Functions& fn = m_device.fn();
    const VkResult result = fn.vkWaitForFences(m_device.handle(), 1, &m_fence, VK_TRUE, UINT64_MAX);
    if (result < 0)
    {
        fn.vkDeviceWaitIdle(m_device.handle()); // the resources of the work are about to be destroyed
        throwFailedCall(result, "vkWaitForFences", __FILE_NAME__, __LINE__);
    }
}

void CommandContext::create()
{
    const Functions& fn = m_device.fn();
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = m_device.handles().queue_family;
    VK_CHECK(fn.vkCreateCommandPool(m_device.handle(), &pool, m_device.allocationCallbacks(), &m_pool));
    VkCommandBufferAllocateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffer.commandPool = m_pool;
    buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffer.commandBufferCount = 1;
    VK_CHECK(fn.vkAllocateCommandBuffers(m_device.handle(), &buffer, &m_commands));
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VK_CHECK(fn.vkCreateFence(m_device.handle(), &fence, m_device.allocationCallbacks(), &m_fence));
    m_device.setName(VK_OBJECT_TYPE_COMMAND_POOL, reinterpret_cast<std::uint64_t>(m_pool), "headless commands");
    m_device.setName(VK_OBJECT_TYPE_COMMAND_BUFFER, reinterpret_cast<std::uint64_t>(m_commands), "headless commands");
    m_device.setName(VK_OBJECT_TYPE_FENCE, reinterpret_cast<std::uint64_t>(m_fence), "headless fence");
}

void CommandContext::destroy()
{
    m_device.fn().vkDestroyFence(m_device.handle(), m_fence, m_device.allocationCallbacks());
    m_device.fn().vkDestroyCommandPool(m_device.handle(), m_pool, m_device.allocationCallbacks());
}

} // namespace zvo::vk
