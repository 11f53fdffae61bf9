// SPDX-License-Identifier: MIT
#include "support/host_memory.h"

#include "vk/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace zvo::test
{

namespace
{

constexpr std::uint64_t kSlabBytes = 100ull << 20; // more than a block of zvo's, less than two
constexpr std::uint64_t kFirstOffset = 3ull << 12; // the host keeps what is below for itself

std::uint64_t roundUp(std::uint64_t value, std::uint64_t unit)
{
    return (value + unit - 1) / unit * unit;
}

} // namespace

HostMemory::~HostMemory()
{
    EXPECT_TRUE(m_live.empty()) << m_live.size() << " ranges were not returned, the first for "
                                << m_live.begin()->second.name;
}

MemoryCallbacks HostMemory::callbacks()
{
    return {.user = this,
            .allocate = [](void* user, const MemoryRequest* request, MemoryRange* range)
            { return static_cast<HostMemory*>(user)->allocate(*request, *range); },
            .release = [](void* user, const MemoryRange* range) { static_cast<HostMemory*>(user)->release(*range); }};
}

void HostMemory::attach(const HostDevice& host)
{
    ASSERT_TRUE(m_slabs.empty());
    m_fn = &host.fn();
    m_device = host.device();
    m_fn->vkGetPhysicalDeviceMemoryProperties(host.physicalDevice(), &m_properties);
    VkPhysicalDeviceProperties properties{};
    m_fn->vkGetPhysicalDeviceProperties(host.physicalDevice(), &properties);
    m_granularity = properties.limits.bufferImageGranularity;
}

void HostMemory::failRequests(std::uint64_t number, std::uint64_t count, VkResult result)
{
    m_request_count = 0;
    m_fail_number = number;
    m_fail_count = count;
    m_result = result;
}

std::uint64_t HostMemory::liveBytes() const
{
    std::uint64_t bytes = 0;
    for (const auto& [cookie, live] : m_live)
    {
        bytes += live.bytes;
    }
    return bytes;
}

std::vector<std::string> HostMemory::liveNames() const
{
    std::vector<std::string> names;
    for (const auto& [cookie, live] : m_live)
    {
        names.push_back(live.name);
    }
    return names;
}

VkResult HostMemory::allocate(const MemoryRequest& request, MemoryRange& range)
{
    const VkMemoryRequirements& needs = request.requirements;
    EXPECT_NE(m_fn, nullptr) << "attach() comes first";
    EXPECT_TRUE(request.name != nullptr && *request.name != '\0');
    EXPECT_TRUE(std::has_single_bit(needs.memoryTypeBits));
    EXPECT_TRUE(std::has_single_bit(needs.alignment));
    EXPECT_EQ(needs.alignment % m_granularity, 0u);
    EXPECT_EQ(needs.size % m_granularity, 0u);
    EXPECT_GT(needs.size, 0u);
    EXPECT_EQ(request.device_address, VK_TRUE);
    const auto type = static_cast<std::uint32_t>(std::countr_zero(needs.memoryTypeBits));
    const VkMemoryPropertyFlags flags = m_properties.memoryTypes[type].propertyFlags;
    EXPECT_LT(type, m_properties.memoryTypeCount);
    EXPECT_EQ(flags & request.required, request.required);
    EXPECT_EQ(request.map == VK_TRUE, (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0);
    const std::uint64_t number = m_request_count++;
    if (number >= m_fail_number && number - m_fail_number < m_fail_count)
    {
        return m_result;
    }
    if (needs.size > m_largest_bytes)
    {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    Slab* slab = slabFor(request, type);
    if (slab == nullptr)
    {
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    range.memory = slab->memory;
    range.offset = roundUp(slab->end, needs.alignment);
    range.mapped = slab->mapped != nullptr ? slab->mapped + range.offset : nullptr;
    range.cookie = reinterpret_cast<void*>(m_next_cookie);
    slab->end = range.offset + needs.size;
    ++slab->live_count;
    m_live[m_next_cookie++] = {request.name, range, needs.size, slab};
    if (m_spoil != nullptr)
    {
        m_spoil(range);
    }
    return VK_SUCCESS;
}

void HostMemory::release(const MemoryRange& range)
{
    const auto found = m_live.find(reinterpret_cast<std::uint64_t>(range.cookie));
    ASSERT_NE(found, m_live.end()) << "a range that was never handed out, or was returned twice";
    if (m_spoil == nullptr)
    {
        EXPECT_EQ(range.memory, found->second.range.memory);
        EXPECT_EQ(range.offset, found->second.range.offset);
        EXPECT_EQ(range.mapped, found->second.range.mapped);
    }
    Slab& slab = *found->second.slab;
    m_live.erase(found);
    if (--slab.live_count == 0)
    {
        const VkDeviceMemory memory = slab.memory;
        m_fn->vkFreeMemory(m_device, memory, nullptr);
        m_slabs.erase(memory);
    }
}

HostMemory::Slab* HostMemory::slabFor(const MemoryRequest& request, std::uint32_t type)
{
    const VkMemoryRequirements& needs = request.requirements;
    for (auto& [memory, slab] : m_slabs)
    {
        if (slab.type == type && roundUp(slab.end, needs.alignment) + needs.size <= slab.bytes)
        {
            return &slab;
        }
    }
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = &flags;
    info.allocationSize = std::max(kSlabBytes, roundUp(kFirstOffset, needs.alignment) + needs.size);
    info.memoryTypeIndex = type;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    if (m_fn->vkAllocateMemory(m_device, &info, nullptr, &memory) != VK_SUCCESS)
    {
        return nullptr;
    }
    void* mapped = nullptr;
    if (request.map == VK_TRUE)
    {
        VK_CHECK(m_fn->vkMapMemory(m_device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    }
    Slab& slab = m_slabs[memory];
    slab = {memory, type, info.allocationSize, kFirstOffset, static_cast<std::byte*>(mapped), 0};
    return &slab;
}

} // namespace zvo::test
