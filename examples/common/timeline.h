// SPDX-License-Identifier: MIT
#pragma once

#include "common/host.h"

#include <cstdint>

namespace host
{

/// A semaphore whose value is the number of the newest frame that the device is done with.
class Timeline
{
public:
    /// Takes the feature timelineSemaphore.
    Timeline(const Device& device, std::uint64_t value);
    ~Timeline();
    Timeline(const Timeline&) = delete;
    Timeline& operator=(const Timeline&) = delete;

    /// Ends the command buffer and submits it; the value becomes frame when the device is done with it.
    void submit(VkCommandBuffer commands, std::uint64_t frame) const;

    /// Waits until the value is frame.
    void wait(std::uint64_t frame) const;

    [[nodiscard]] std::uint64_t value() const;

private:
    const Device& m_device;
    VkSemaphore m_semaphore = VK_NULL_HANDLE;
};

} // namespace host
