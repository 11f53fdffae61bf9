// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"
#include "zvo/types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace zvo::vk
{

class Device;

using zvo::PassTime;

/// Timestamps around passes, in one query pool. On a device without timestamps the pool stays empty.
class TimerPool
{
public:
    TimerPool(Device& device, std::uint32_t pass_capacity);
    ~TimerPool();
    TimerPool(const TimerPool&) = delete;
    TimerPool& operator=(const TimerPool&) = delete;

    /// Forgets all passes, so that the pool can be recorded to again. The device must be done with it.
    void reset();
    void begin(VkCommandBuffer commands, const std::string& name);
    void end(VkCommandBuffer commands);

    /// The times of the recorded passes, in order. The device must be done with them. Passes beyond the capacity are
    /// left out.
    [[nodiscard]] std::vector<PassTime> collect() const;

    /// The same; nothing if the device has not carried out all passes.
    [[nodiscard]] std::optional<std::vector<PassTime>> collectIfReady() const;

private:
    Device& m_device;
    VkQueryPool m_pool = VK_NULL_HANDLE;
    std::uint32_t m_pass_capacity;
    std::uint32_t m_stamp_count; // stamps for each pass: begin, end and, on software devices, one more
    bool m_open = false;
    std::vector<std::string> m_names;
};

} // namespace zvo::vk
