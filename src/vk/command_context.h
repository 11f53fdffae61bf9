// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

namespace zvo::vk
{

class Device;

/// What a submission waits for on the device, and what it tells when it is done: semaphores, or null.
struct SubmitSync
{
    VkSemaphore wait = VK_NULL_HANDLE;
    VkPipelineStageFlags2 wait_stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT; // of this submission: they wait
    VkSemaphore signal = VK_NULL_HANDLE;
};

/// A command buffer and the fence that says when the device is done with it. It is recorded again only then.
class CommandContext
{
public:
    CommandContext(Device& device, VkQueue queue);
    ~CommandContext();
    CommandContext(const CommandContext&) = delete;
    CommandContext& operator=(const CommandContext&) = delete;

    /// Starts recording. What is recorded runs after, and sees, all that was submitted to the queue before. Nothing may
    /// be under way.
    VkCommandBuffer begin();

    /// Ends recording and submits.
    void submit(const SubmitSync& sync = {});

    /// Whether wait() would return, or throw, at once.
    [[nodiscard]] bool done() const;

    /// Waits for what was submitted. Throws Error when the device was lost or memory ran out; nothing is under way
    /// then, either.
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
