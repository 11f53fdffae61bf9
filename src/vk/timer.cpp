// SPDX-License-Identifier: MIT
#include "vk/timer.h"

#include "vk/check.h"
#include "vk/device.h"
#include "zvo/error.h"

namespace zvo::vk
{

namespace
{

constexpr double kMsPerNs = 1e-6;
constexpr std::uint32_t kFullTimestampBits = 64;

} // namespace

TimerPool::TimerPool(Device& device, std::uint32_t pass_capacity)
    : m_device(device), m_pass_capacity(pass_capacity), m_stamp_count(device.report().type == "cpu" ? 3 : 2)
{
    if (device.report().timestamp_period_ns == 0 || !device.isEnabled("hostQueryReset") || pass_capacity == 0)
    {
        m_pass_capacity = 0;
        return;
    }
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = m_stamp_count * pass_capacity;
    VK_CHECK(device.fn().vkCreateQueryPool(device.handle(), &info, device.allocationCallbacks(), &m_pool));
    device.setName(VK_OBJECT_TYPE_QUERY_POOL, reinterpret_cast<std::uint64_t>(m_pool), "zvo pass timers");
    device.fn().vkResetQueryPool(device.handle(), m_pool, 0, info.queryCount);
}

TimerPool::~TimerPool()
{
    m_device.fn().vkDestroyQueryPool(m_device.handle(), m_pool, m_device.allocationCallbacks());
}

void TimerPool::reset()
{
    if (!m_names.empty())
    {
        m_device.fn().vkResetQueryPool(m_device.handle(), m_pool, 0,
                                       m_stamp_count * static_cast<std::uint32_t>(m_names.size()));
    }
    m_names.clear();
    m_open = false;
}

// Both timestamps are taken when everything recorded before them is complete. So the difference is the pass's own time,
// even if passes could overlap.
void TimerPool::begin(VkCommandBuffer commands, const std::string& name)
{
    if (m_names.size() == m_pass_capacity)
    {
        return;
    }
    const std::uint32_t query = m_stamp_count * static_cast<std::uint32_t>(m_names.size());
    m_names.push_back(name);
    m_open = true;
    m_device.fn().vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, m_pool, query);
    // After draws, lavapipe takes a timestamp only when it waits for a later command, which would be the end of the
    // pass. A second timestamp, which nobody reads, is such a command.
    if (m_stamp_count == 3)
    {
        m_device.fn().vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, m_pool, query + 2);
    }
}

void TimerPool::end(VkCommandBuffer commands)
{
    if (m_open)
    {
        const std::uint32_t query = m_stamp_count * static_cast<std::uint32_t>(m_names.size() - 1) + 1;
        m_device.fn().vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, m_pool, query);
        m_open = false;
    }
}

std::vector<PassTime> TimerPool::collect() const
{
    std::optional<std::vector<PassTime>> times = collectIfReady();
    if (!times)
    {
        throw Error(ErrorCode::Other, "the pass times were asked for before the device was done with the passes");
    }
    return std::move(*times);
}

std::optional<std::vector<PassTime>> TimerPool::collectIfReady() const
{
    if (m_names.empty())
    {
        return std::vector<PassTime>();
    }
    std::vector<std::uint64_t> stamps(m_stamp_count * m_names.size());
    const VkResult result = m_device.fn().vkGetQueryPoolResults(
        m_device.handle(), m_pool, 0, static_cast<std::uint32_t>(stamps.size()), stamps.size() * sizeof(stamps[0]),
        stamps.data(), sizeof(stamps[0]), VK_QUERY_RESULT_64_BIT);
    if (result < 0)
    {
        throwFailedCall(result, "vkGetQueryPoolResults", __FILE_NAME__, __LINE__);
    }
    if (result == VK_NOT_READY)
    {
        return std::nullopt;
    }
    const std::uint32_t bits = m_device.report().timestamp_valid_bits;
    const std::uint64_t mask = bits >= kFullTimestampBits ? UINT64_MAX : (std::uint64_t{1} << bits) - 1;
    std::vector<PassTime> times;
    times.reserve(m_names.size());
    for (std::size_t i = 0; i < m_names.size(); ++i)
    {
        const std::uint64_t ticks = (stamps[m_stamp_count * i + 1] - stamps[m_stamp_count * i]) & mask;
        times.push_back({m_names[i], static_cast<double>(ticks) * m_device.report().timestamp_period_ns * kMsPerNs});
    }
    return times;
}

} // namespace zvo::vk
