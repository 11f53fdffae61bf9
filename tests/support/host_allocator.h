// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>

namespace zvo::test
{

/// Host memory for a Vulkan driver (VkAllocationCallbacks), which counts its calls and can fail. The test fails if
/// something is freed that was not allocated.
class HostAllocator
{
public:
    HostAllocator();
    ~HostAllocator(); ///< frees what the driver has not freed
    HostAllocator(const HostAllocator&) = delete;
    HostAllocator& operator=(const HostAllocator&) = delete;

    [[nodiscard]] const VkAllocationCallbacks* callbacks() const { return &m_callbacks; }

    /// Forgets the count of calls, and lets the allocation or reallocation with this number (from 0 on) fail;
    /// UINT64_MAX: none.
    void failCall(std::uint64_t number);

    [[nodiscard]] std::uint64_t callCount() const; // allocations and reallocations since failCall()
    [[nodiscard]] bool hasFailed() const { return callCount() > m_fail_number; }
    [[nodiscard]] std::uint64_t liveCount() const;

private:
    void* allocate(std::size_t bytes, std::size_t alignment);
    void* reallocate(void* original, std::size_t bytes, std::size_t alignment);
    void release(void* memory);

    VkAllocationCallbacks m_callbacks{};
    mutable std::mutex m_mutex; // drivers call from several threads
    std::uint64_t m_call_count = 0;
    std::uint64_t m_fail_number = UINT64_MAX;
    std::map<void*, std::size_t> m_live; // bytes
};

} // namespace zvo::test
