// SPDX-License-Identifier: MIT
#include "support/host_allocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace zvo::test
{

namespace
{

HostAllocator& of(void* user)
{
    return *static_cast<HostAllocator*>(user);
}

} // namespace

HostAllocator::HostAllocator()
{
    m_callbacks.pUserData = this;
    m_callbacks.pfnAllocation = [](void* user, std::size_t bytes, std::size_t alignment, VkSystemAllocationScope)
    { return of(user).allocate(bytes, alignment); };
    m_callbacks.pfnReallocation =
        [](void* user, void* original, std::size_t bytes, std::size_t alignment, VkSystemAllocationScope)
    { return of(user).reallocate(original, bytes, alignment); };
    m_callbacks.pfnFree = [](void* user, void* memory) { of(user).release(memory); };
}

HostAllocator::~HostAllocator()
{
    for (const auto& [memory, bytes] : m_live)
    {
        std::free(memory);
    }
}

void HostAllocator::failCall(std::uint64_t number)
{
    const std::lock_guard lock(m_mutex);
    m_call_count = 0;
    m_fail_number = number;
}

std::uint64_t HostAllocator::callCount() const
{
    const std::lock_guard lock(m_mutex);
    return m_call_count;
}

std::uint64_t HostAllocator::liveCount() const
{
    const std::lock_guard lock(m_mutex);
    return m_live.size();
}

void* HostAllocator::allocate(std::size_t bytes, std::size_t alignment)
{
    const std::lock_guard lock(m_mutex);
    if (m_call_count++ == m_fail_number || bytes == 0)
    {
        return nullptr;
    }
    alignment = std::max(alignment, alignof(std::max_align_t));
    void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    m_live[memory] = bytes;
    return memory;
}

void* HostAllocator::reallocate(void* original, std::size_t bytes, std::size_t alignment)
{
    if (bytes == 0)
    {
        release(original);
        return nullptr;
    }
    void* memory = allocate(bytes, alignment);
    if (memory != nullptr && original != nullptr)
    {
        std::size_t old_bytes = 0;
        {
            const std::lock_guard lock(m_mutex);
            old_bytes = m_live.at(original);
        }
        std::memcpy(memory, original, std::min(bytes, old_bytes));
        release(original);
    }
    return memory; // if this is null, the original stays valid
}

void HostAllocator::release(void* memory)
{
    if (memory == nullptr)
    {
        return;
    }
    const std::lock_guard lock(m_mutex);
    EXPECT_EQ(m_live.erase(memory), 1u) << "the driver freed what it was not given";
    std::free(memory);
}

} // namespace zvo::test
