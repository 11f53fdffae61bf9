// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

namespace zvo::vk
{

class Device;

/// The semaphores that a submission waits for and signals on the device; each may be null.
struct SubmitSync
{
    VkSemaphore wait = VK_NULL_HANDLE;
    VkPipelineStageFlags2 wait_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT; // stages of this submission that wait
    VkSemaphore signal = VK_NULL_HANDLE;
};

/// A command buffer, and a fence that tells when the device is done with it. Only then it can be recorded again.
class CommandContext
{
public:
    CommandContext(Device& device, VkQueue queue);
    ~CommandContext();
    CommandContext(const CommandContext&) = delete;
    CommandContext& operator=(const CommandContext&) = delete;

    /// Starts recording. The commands will run after all that was submitted to the queue before, and see what that has
    /// written. The last submission must be finished.
    VkCommandBuffer begin();

    /// Ends recording and submits.
    void submit(const SubmitSync& sync = {});

    /// Whether wait() would return, or throw, without waiting.
    [[nodiscard]] bool done() const;

    /// Waits for the submission. Throws Error when the device was lost or memory ran out; the submission counts as
    /// finished then, too.
    void wait();

private:
    void create();
    void destroy();

    Device& m_device;
    VkQueue m_queue;
    VkCommandPool m_pool = VK_NULL_HANDLE;
    VkCommandBuffer m_commands = VK_NULL_HANDLE;
    VkFence m_fence = VK_NULL_HANDLE;
};

} // namespace zvo::vk
