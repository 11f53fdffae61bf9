// SPDX-License-Identifier: MIT
#include "vk/memory.h"

#include "vk/check.h"
#include "vk/device.h"
#include "vk/free_ranges.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

namespace zvo::vk
{

struct MemoryAllocator::Block
{
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint32_t memory_type = 0;
    std::byte* mapped = nullptr;
    std::uint64_t bytes = 0;
    FreeRanges free; // bytes

    [[nodiscard]] bool unused() const { return free.total() == bytes; }
};

MemoryAllocator::MemoryAllocator(Device& device, std::uint64_t limit_bytes, std::string limit_name)
    : m_device(device), m_limit_bytes(limit_bytes), m_limit_name(std::move(limit_name)),
      m_block_bytes(limit_bytes == UINT64_MAX ? kBlockBytes : kLimitedBlockBytes)
{
    device.fn().vkGetPhysicalDeviceMemoryProperties(device.handles().physical_device, &m_properties);
}

MemoryAllocator::~MemoryAllocator()
{
    assert(m_used_bytes == 0 && "buffers and images must be destroyed before their device");
    for (const std::unique_ptr<Block>& block : m_blocks)
    {
        if (block)
        {
            freeMemory(block->memory, block->bytes);
        }
    }
}

void MemoryAllocator::require(std::uint64_t bytes, const char* what)
{
    if (bytes > roomBytes())
    {
        freeUnusedBlocks();
        if (bytes > roomBytes())
        {
            throwOverLimit(bytes, what);
        }
    }
}

std::uint64_t MemoryAllocator::roomBytes() const
{
    return m_limit_bytes - m_held_bytes;
}

void MemoryAllocator::resetPeak()
{
    m_peak_bytes = m_used_bytes;
    m_peak_held_bytes = m_held_bytes;
}

MemoryBlock MemoryAllocator::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                                      VkMemoryPropertyFlags preferred, const char* what)
{
    const std::uint64_t size = requirements.size;
    // Types with the preferred properties first, then those that merely suffice.
    for (const VkMemoryPropertyFlags wanted : {required | preferred, required})
    {
        for (std::uint32_t type = 0; type < m_properties.memoryTypeCount; ++type)
        {
            const VkMemoryPropertyFlags flags = m_properties.memoryTypes[type].propertyFlags;
            if ((requirements.memoryTypeBits & (1u << type)) == 0 || (flags & wanted) != wanted)
            {
                continue;
            }
            MemoryBlock block;
            if (allocateFrom(type, size, requirements.alignment, block))
            {
                if ((required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0)
                {
                    block.mapped = nullptr; // it happens to be visible, but the caller may not count on it
                }
                m_used_bytes += size;
                m_peak_bytes = std::max(m_peak_bytes, m_used_bytes);
                return block;
            }
        }
    }
    if (size > roomBytes())
    {
        throwOverLimit(size, what);
    }
    throw Error(ErrorCode::Memory,
                fmt::format("the device has no {} bytes of memory left for {} ({} in use by zvo): close other programs "
                            "that use the device, or use a lower resolution",
                            size, what, m_used_bytes));
}

void MemoryAllocator::throwOverLimit(std::uint64_t bytes, const char* what) const
{
    throw Error(
        ErrorCode::Memory,
        fmt::format("{} needs {} bytes in all, {} more than are in use, but the limit is {}: raise {}, or lower "
                    "the resolution",
                    what, bytes > UINT64_MAX - m_held_bytes ? UINT64_MAX : m_held_bytes + bytes, bytes, m_limit_bytes,
                    m_limit_name));
}

bool MemoryAllocator::allocateFrom(std::uint32_t type, std::uint64_t size, std::uint64_t alignment, MemoryBlock& result)
{
    result.memory_type = type;
    result.bytes = size;
    if (size > m_block_bytes / 2) // so that a block never ends half empty because of one of these
    {
        return allocateMemory(type, size, result.memory, result.mapped);
    }
    for (std::uint32_t i = 0; i < m_blocks.size(); ++i)
    {
        if (m_blocks[i] && m_blocks[i]->memory_type == type && takeFrom(i, alignment, result))
        {
            return true;
        }
    }
    // A new block; where memory is short, one that just suffices.
    for (const std::uint64_t bytes : {m_block_bytes, size})
    {
        auto block = std::make_unique<Block>();
        void* mapped = nullptr;
        if (allocateMemory(type, bytes, block->memory, mapped))
        {
            block->memory_type = type;
            block->mapped = static_cast<std::byte*>(mapped);
            block->bytes = bytes;
            block->free.give(0, bytes);
            const auto slot = std::find(m_blocks.begin(), m_blocks.end(), nullptr);
            const auto index = static_cast<std::uint32_t>(slot - m_blocks.begin());
            if (slot == m_blocks.end())
            {
                m_blocks.push_back(std::move(block));
            }
            else
            {
                *slot = std::move(block);
            }
            return takeFrom(index, alignment, result);
        }
    }
    return false;
}

bool MemoryAllocator::takeFrom(std::uint32_t index, std::uint64_t alignment, MemoryBlock& result)
{
    Block& block = *m_blocks[index];
    const std::optional<std::uint64_t> offset = block.free.take(result.bytes, alignment);
    if (!offset)
    {
        return false;
    }
    result.memory = block.memory;
    result.offset = *offset;
    result.mapped = block.mapped != nullptr ? block.mapped + *offset : nullptr;
    result.block = index;
    return true;
}

bool MemoryAllocator::allocateMemory(std::uint32_t type, std::uint64_t size, VkDeviceMemory& memory, void*& mapped)
{
    const VkMemoryType& memory_type = m_properties.memoryTypes[type];
    if (size > roomBytes())
    {
        freeUnusedBlocks();
    }
    if (size > roomBytes() || size > m_properties.memoryHeaps[memory_type.heapIndex].size)
    {
        return false;
    }
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = &flags;
    info.allocationSize = size;
    info.memoryTypeIndex = type;

    const Functions& fn = m_device.fn();
    const VkResult result = fn.vkAllocateMemory(m_device.handle(), &info, m_device.allocationCallbacks(), &memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
    {
        return false; // another memory type may have some left
    }
    if (result != VK_SUCCESS)
    {
        throwFailedCall(result, "vkAllocateMemory", __FILE_NAME__, __LINE__);
    }
    m_held_bytes += size;
    m_peak_held_bytes = std::max(m_peak_held_bytes, m_held_bytes);
    m_device.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, reinterpret_cast<std::uint64_t>(memory),
                     fmt::format("zvo memory of type {}", type));
    if ((memory_type.propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0)
    {
        const VkResult map_result = fn.vkMapMemory(m_device.handle(), memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (map_result != VK_SUCCESS)
        {
            freeMemory(memory, size);
            throwFailedCall(map_result, "vkMapMemory", __FILE_NAME__, __LINE__);
        }
    }
    return true;
}

void MemoryAllocator::freeMemory(VkDeviceMemory memory, std::uint64_t size) noexcept
{
    m_held_bytes -= size;
    m_device.fn().vkFreeMemory(m_device.handle(), memory, m_device.allocationCallbacks());
}

void MemoryAllocator::freeUnusedBlocks() noexcept
{
    for (std::unique_ptr<Block>& block : m_blocks)
    {
        if (block && block->unused())
        {
            freeMemory(block->memory, block->bytes);
            block.reset();
        }
    }
}

void MemoryAllocator::release(const MemoryBlock& range) noexcept
{
    if (range.memory == VK_NULL_HANDLE)
    {
        return;
    }
    m_used_bytes -= range.bytes;
    if (range.block == UINT32_MAX)
    {
        freeMemory(range.memory, range.bytes);
        return;
    }
    Block& block = *m_blocks[range.block];
    block.free.give(range.offset, range.bytes);
    if (!block.unused())
    {
        return;
    }
    // One unused block of a type stays, so that allocating and releasing in turn does not reach the driver every time.
    const bool another = std::any_of(m_blocks.begin(), m_blocks.end(),
                                     [&](const std::unique_ptr<Block>& other) {
                                         return other && other.get() != &block && other->unused() &&
                                                other->memory_type == block.memory_type;
                                     });
    if (another)
    {
        freeMemory(block.memory, block.bytes);
        m_blocks[range.block].reset();
    }
}

} // namespace zvo::vk
