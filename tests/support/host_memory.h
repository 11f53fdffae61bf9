// SPDX-License-Identifier: MIT
#pragma once

#include "support/host_device.h"
#include "vk/functions.h"
#include "zvo/memory.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace zvo::test
{

/// A host's allocator of device memory: it hands out ranges of slabs, none at a slab's beginning. A slab goes back to
/// the driver when its last range is released. The test fails if zvo asks for what it may not, or releases what it did
/// not get.
class HostMemory
{
public:
    HostMemory() = default;
    ~HostMemory(); ///< all ranges must have been released
    HostMemory(const HostMemory&) = delete;
    HostMemory& operator=(const HostMemory&) = delete;

    /// For HostOptions::memory. They work once attach() was called.
    MemoryCallbacks callbacks();

    /// Sets the device whose memory is handed out. The device must outlive the ranges.
    void attach(const HostDevice& host);

    /// Forgets the count of requests, and lets count requests in a row fail with result, beginning with the one with
    /// this number (from 0 on); UINT64_MAX: none.
    void failRequests(std::uint64_t number, std::uint64_t count = UINT64_MAX,
                      VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY);

    /// From now on, requests for more bytes fail.
    void setLargest(std::uint64_t bytes) { m_largest_bytes = bytes; }

    [[nodiscard]] std::uint64_t requestCount() const { return m_request_count; }
    [[nodiscard]] bool hasFailed() const { return m_request_count > m_fail_number; }
    [[nodiscard]] std::uint64_t liveCount() const { return m_live.size(); }
    [[nodiscard]] std::uint64_t liveBytes() const;
    [[nodiscard]] std::vector<std::string> liveNames() const;

    /// For tests of zvo's own checks: spoil() changes every range that is handed out from now on.
    void setSpoiler(void (*spoil)(MemoryRange&)) { m_spoil = spoil; }

private:
    struct Slab
    {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::uint32_t type = 0;
        std::uint64_t bytes = 0;
        std::uint64_t end = 0; // of the ranges so far
        std::byte* mapped = nullptr;
        std::uint64_t live_count = 0;
    };

    struct Live
    {
        std::string name;
        MemoryRange range;
        std::uint64_t bytes;
        Slab* slab;
    };

    VkResult allocate(const MemoryRequest& request, MemoryRange& range);
    void release(const MemoryRange& range);
    Slab* slabFor(const MemoryRequest& request, std::uint32_t type);

    const vk::Functions* m_fn = nullptr;
    VkDevice m_device = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties m_properties{};
    std::uint64_t m_granularity = 1;
    std::uint64_t m_request_count = 0;
    std::uint64_t m_fail_number = UINT64_MAX;
    std::uint64_t m_fail_count = 0;
    VkResult m_result = VK_SUCCESS;
    std::uint64_t m_largest_bytes = UINT64_MAX;
    void (*m_spoil)(MemoryRange&) = nullptr;
    std::map<VkDeviceMemory, Slab> m_slabs;
    std::map<std::uint64_t, Live> m_live; // by the cookie's number
    std::uint64_t m_next_cookie = 1;
};

} // namespace zvo::test
