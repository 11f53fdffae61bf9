// SPDX-License-Identifier: MIT
#include "common/timeline.h"

namespace host
{

Timeline::Timeline(const Device& device, std::uint64_t value) : m_device(device)
{
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    type.initialValue = value;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = &type;
    check(device.fn().vkCreateSemaphore(device.handle(), &info, nullptr, &m_semaphore), "vkCreateSemaphore");
}

Timeline::~Timeline()
{
    m_device.fn().vkDestroySemaphore(m_device.handle(), m_semaphore, nullptr);
}

void Timeline::submit(VkCommandBuffer commands, std::uint64_t frame) const
{
    check(m_device.fn().vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    buffer.commandBuffer = commands;
    VkSemaphoreSubmitInfo signal{};
    signal.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    signal.semaphore = m_semaphore;
    signal.value = frame;
    signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSubmitInfo2 info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &buffer;
    info.signalSemaphoreInfoCount = 1;
    info.pSignalSemaphoreInfos = &signal;
    check(m_device.fn().vkQueueSubmit2(m_device.queue(), 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
}

void Timeline::wait(std::uint64_t frame) const
{
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &m_semaphore;
    info.pValues = &frame;
    check(m_device.fn().vkWaitSemaphores(m_device.handle(), &info, UINT64_MAX), "vkWaitSemaphores");
}

std::uint64_t Timeline::value() const
{
    std::uint64_t value = 0;
    check(m_device.fn().vkGetSemaphoreCounterValue(m_device.handle(), m_semaphore, &value),
          "vkGetSemaphoreCounterValue");
    return value;
}

} // namespace host
