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

namespace
{

constexpr const char* kBlockName = "a block of small buffers";

std::uint64_t roundUp(std::uint64_t value, std::uint64_t unit)
{
    return value > UINT64_MAX - (unit - 1) ? UINT64_MAX : (value + unit - 1) / unit * unit;
}

} // namespace

struct MemoryAllocator::Block
{
    MemoryRange taken{};
    std::uint32_t memory_type = 0;
    std::uint64_t bytes = 0;
    FreeRanges free; // in bytes, from the beginning of the VkDeviceMemory, to which alignments refer

    [[nodiscard]] bool unused() const { return free.total() == bytes; }
};

struct MemoryAllocator::Wish
{
    std::uint64_t size;
    std::uint64_t alignment;
    VkMemoryPropertyFlags required;
    VkMemoryPropertyFlags preferred;
    const char* name;
};

MemoryAllocator::MemoryAllocator(Device& device, std::uint64_t limit_bytes, std::string limit_name)
    : m_device(device), m_limit_bytes(limit_bytes), m_limit_name(std::move(limit_name)),
      m_block_bytes(limit_bytes == UINT64_MAX ? kBlockBytes : kLimitedBlockBytes),
      m_granularity(std::max<std::uint64_t>(1, device.limits().bufferImageGranularity))
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
            returnMemory(block->taken, block->bytes);
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
    const Wish wish = {size, std::max<std::uint64_t>(1, requirements.alignment), required, preferred, what};
    // Tries types with the preferred properties first, then those with only the required ones.
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
            if (allocateFrom(type, wish, block))
            {
                if ((required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0)
                {
                    block.mapped = nullptr; // the caller did not ask for visible memory, and must not rely on it
                }
                m_used_bytes += size;
                m_peak_bytes = std::max(m_peak_bytes, m_used_bytes);
                return block;
            }
        }
    }
    if (heldSize(size) > roomBytes())
    {
        throwOverLimit(heldSize(size), what);
    }
    throw Error(ErrorCode::Memory,
                fmt::format("the device has no {} bytes of memory left for {} ({} in use by zvo): close other programs "
                            "that use the device, or use a lower resolution",
                            size, what, m_used_bytes));
}

void MemoryAllocator::throwOverLimit(std::uint64_t bytes, const char* what) const
{
    m_device.log(LogSeverity::Warning, "{} bytes for {} exceed {} of {} bytes: {} are in use", bytes, what,
                 m_limit_name, m_limit_bytes, m_held_bytes);
    throw Error(
        ErrorCode::Memory,
        fmt::format("{} needs {} bytes in all, {} more than are in use, but the limit is {}: raise {}, or lower "
                    "the resolution",
                    what, bytes > UINT64_MAX - m_held_bytes ? UINT64_MAX : m_held_bytes + bytes, bytes, m_limit_bytes,
                    m_limit_name));
}

bool MemoryAllocator::allocateFrom(std::uint32_t type, const Wish& wish, MemoryBlock& result)
{
    result.memory_type = type;
    result.bytes = wish.size;
    if (wish.size > m_block_bytes / 2) // large requests get memory of their own, so that no block ends half empty
    {
        if (!takeMemory(type, wish.size, wish, result.taken))
        {
            return false;
        }
        result.memory = result.taken.memory;
        result.offset = result.taken.offset;
        result.mapped = result.taken.mapped;
        return true;
    }
    for (std::uint32_t i = 0; i < m_blocks.size(); ++i)
    {
        if (m_blocks[i] && m_blocks[i]->memory_type == type && takeFrom(i, wish.alignment, result))
        {
            return true;
        }
    }
    // A new block, which is only as large as the request if memory is short.
    Wish of_block = wish;
    of_block.name = kBlockName;
    for (const std::uint64_t bytes : {m_block_bytes, wish.size})
    {
        auto block = std::make_unique<Block>();
        if (takeMemory(type, bytes, of_block, block->taken))
        {
            block->memory_type = type;
            block->bytes = bytes;
            block->free.give(block->taken.offset, bytes);
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
            return takeFrom(index, wish.alignment, result);
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
    result.memory = block.taken.memory;
    result.offset = *offset;
    result.mapped = block.taken.mapped != nullptr
                        ? static_cast<std::byte*>(block.taken.mapped) + (*offset - block.taken.offset)
                        : nullptr;
    result.block = index;
    return true;
}

// A request to the host takes whole granules, because its neighbour may be of another kind.
std::uint64_t MemoryAllocator::heldSize(std::uint64_t size) const
{
    return m_device.handles().memory.allocate != nullptr ? roundUp(size, m_granularity) : size;
}

bool MemoryAllocator::isMapped(std::uint32_t type) const
{
    return (m_properties.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
}

bool MemoryAllocator::takeMemory(std::uint32_t type, std::uint64_t size, const Wish& wish, MemoryRange& range)
{
    const std::uint64_t held = heldSize(size);
    if (held > roomBytes())
    {
        freeUnusedBlocks();
    }
    if (held > roomBytes() || held > m_properties.memoryHeaps[m_properties.memoryTypes[type].heapIndex].size)
    {
        return false;
    }
    const bool of_host = m_device.handles().memory.allocate != nullptr;
    const VkResult result = of_host ? takeOfHost(type, held, wish, range) : takeOfDriver(type, held, range);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
    {
        return false; // another memory type may have some left
    }
    if (result != VK_SUCCESS)
    {
        throwFailedCall(result, of_host ? "MemoryCallbacks::allocate" : "vkAllocateMemory", __FILE_NAME__, __LINE__);
    }
    m_held_bytes += held;
    m_peak_held_bytes = std::max(m_peak_held_bytes, m_held_bytes);
    m_device.log(LogSeverity::Debug, "memory: took {} bytes of type {} for {}, {} bytes in all", held, type, wish.name,
                 m_held_bytes);
    return true;
}

VkResult MemoryAllocator::takeOfDriver(std::uint32_t type, std::uint64_t size, MemoryRange& range)
{
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = &flags;
    info.allocationSize = size;
    info.memoryTypeIndex = type;

    const Functions& fn = m_device.fn();
    const VkAllocationCallbacks* const callbacks = m_device.allocationCallbacks();
    range = {};
    const VkResult result = fn.vkAllocateMemory(m_device.handle(), &info, callbacks, &range.memory);
    if (result != VK_SUCCESS)
    {
        return result;
    }
    m_device.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, reinterpret_cast<std::uint64_t>(range.memory),
                     fmt::format("zvo memory of type {}", type));
    if (isMapped(type))
    {
        const VkResult map_result = fn.vkMapMemory(m_device.handle(), range.memory, 0, VK_WHOLE_SIZE, 0, &range.mapped);
        if (map_result != VK_SUCCESS)
        {
            fn.vkFreeMemory(m_device.handle(), range.memory, callbacks);
            throwFailedCall(map_result, "vkMapMemory", __FILE_NAME__, __LINE__);
        }
    }
    return VK_SUCCESS;
}

VkResult MemoryAllocator::takeOfHost(std::uint32_t type, std::uint64_t size, const Wish& wish, MemoryRange& range)
{
    const MemoryCallbacks& host = m_device.handles().memory;
    const MemoryRequest request = {.name = wish.name,
                                   .requirements = {.size = size,
                                                    .alignment = roundUp(wish.alignment, m_granularity),
                                                    .memoryTypeBits = 1u << type},
                                   .required = wish.required,
                                   .preferred = wish.preferred,
                                   .map = isMapped(type) ? VK_TRUE : VK_FALSE,
                                   .device_address = VK_TRUE};
    range = {};
    const VkResult result = host.allocate(host.user, &request, &range);
    if (result == VK_SUCCESS)
    {
        checkOfHost(request, range);
    }
    return result;
}

void MemoryAllocator::checkOfHost(const MemoryRequest& request, const MemoryRange& range)
{
    std::string fault;
    if (range.memory == VK_NULL_HANDLE)
    {
        fault = "no VkDeviceMemory";
    }
    else if (range.offset % request.requirements.alignment != 0)
    {
        fault = fmt::format("an offset of {} bytes, which is no multiple of {}", range.offset,
                            request.requirements.alignment);
    }
    else if (request.map == VK_TRUE && range.mapped == nullptr)
    {
        fault = "memory that is not mapped";
    }
    if (!fault.empty())
    {
        if (range.memory != VK_NULL_HANDLE)
        {
            m_device.handles().memory.release(m_device.handles().memory.user, &range);
        }
        throw Error(ErrorCode::Usage,
                    fmt::format("MemoryCallbacks::allocate gave {} for {}: see zvo/memory.h", fault, request.name));
    }
}

void MemoryAllocator::returnMemory(const MemoryRange& range, std::uint64_t size) noexcept
{
    const MemoryCallbacks& host = m_device.handles().memory;
    m_held_bytes -= heldSize(size);
    if (host.allocate != nullptr)
    {
        host.release(host.user, &range);
    }
    else
    {
        m_device.fn().vkFreeMemory(m_device.handle(), range.memory, m_device.allocationCallbacks());
    }
    m_device.log(LogSeverity::Debug, "memory: returned {} bytes, {} bytes in all", heldSize(size), m_held_bytes);
}

void MemoryAllocator::freeUnusedBlocks() noexcept
{
    for (std::unique_ptr<Block>& block : m_blocks)
    {
        if (block && block->unused())
        {
            returnMemory(block->taken, block->bytes);
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
        returnMemory(range.taken, range.bytes);
        return;
    }
    Block& block = *m_blocks[range.block];
    block.free.give(range.offset, range.bytes);
    if (!block.unused())
    {
        return;
    }
    // Keeps one unused block of each type, so that alternating allocations and releases do not reach the driver.
    const bool another = std::any_of(m_blocks.begin(), m_blocks.end(),
                                     [&](const std::unique_ptr<Block>& other) {
                                         return other && other.get() != &block && other->unused() &&
                                                other->memory_type == block.memory_type;
                                     });
    if (another)
    {
        returnMemory(block.taken, block.bytes);
        m_blocks[range.block].reset();
    }
}

} // namespace zvo::vk
