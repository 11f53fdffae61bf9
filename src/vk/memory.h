// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"
#include "zvo/memory.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace zvo::vk
{

class Device;

/// A range of device memory, as MemoryAllocator hands it out.
struct MemoryBlock
{
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    void* mapped = nullptr; // host address of the range when the memory is mapped
    std::uint32_t memory_type = 0;
    std::uint32_t block = UINT32_MAX; // index of the shared block; UINT32_MAX for a dedicated allocation
    MemoryRange taken{};              // of a dedicated allocation, as the driver or the host gave it
};

/// Hands out ranges of device memory: small ranges from shared blocks (first fit, coalescing), big ones as allocations
/// of their own. Blocks and big allocations come from the driver, or from DeviceHandles::memory. Their sum never
/// exceeds the limit, unused parts of blocks included. Not thread safe.
class MemoryAllocator
{
public:
    static constexpr std::uint64_t kBlockBytes = 64ull << 20;       // of a block, when there is no limit
    static constexpr std::uint64_t kLimitedBlockBytes = 1ull << 20; // of a block under a limit, whatever the limit

    /// limit_bytes: UINT64_MAX for none. limit_name: the name of the limit in messages to users.
    MemoryAllocator(Device& device, std::uint64_t limit_bytes, std::string limit_name = "the limit");
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    /// A range that meets requirements, in memory with the required properties and, where possible, the preferred ones.
    /// Throws Error{Memory}, with `what` in its message, when the limit or the device's memory does not suffice.
    MemoryBlock allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                         VkMemoryPropertyFlags preferred, const char* what);
    void release(const MemoryBlock& block) noexcept;

    /// Checks whether allocations of `bytes` in all would stay within the limit. If not, throws Error{Memory} with
    /// `what` in its message. To be called before the first of several allocations, so that one message names the sum.
    void require(std::uint64_t bytes, const char* what);

    /// How many bytes the limit leaves for big allocations.
    [[nodiscard]] std::uint64_t roomBytes() const;

    [[nodiscard]] std::uint64_t usedBytes() const { return m_used_bytes; } // handed out
    [[nodiscard]] std::uint64_t peakBytes() const { return m_peak_bytes; } // most of it at once
    [[nodiscard]] std::uint64_t heldBytes() const { return m_held_bytes; } // taken from the driver or the host
    [[nodiscard]] std::uint64_t peakHeldBytes() const { return m_peak_held_bytes; }
    void resetPeak();

private:
    struct Block;
    struct Wish; // the purpose of a range and its requirements

    // The following functions return false when the memory type cannot provide the memory.
    bool allocateFrom(std::uint32_t type, const Wish& wish, MemoryBlock& result);
    bool takeFrom(std::uint32_t index, std::uint64_t alignment, MemoryBlock& result);
    bool takeMemory(std::uint32_t type, std::uint64_t size, const Wish& wish, MemoryRange& range);
    VkResult takeOfDriver(std::uint32_t type, std::uint64_t size, MemoryRange& range);
    VkResult takeOfHost(std::uint32_t type, std::uint64_t size, const Wish& wish, MemoryRange& range);
    void checkOfHost(const MemoryRequest& request, const MemoryRange& range);
    void returnMemory(const MemoryRange& range, std::uint64_t size) noexcept;
    [[nodiscard]] std::uint64_t heldSize(std::uint64_t size) const;
    [[nodiscard]] bool isMapped(std::uint32_t type) const;
    void freeUnusedBlocks() noexcept;
    [[noreturn]] void throwOverLimit(std::uint64_t bytes, const char* what) const;

    Device& m_device;
    VkPhysicalDeviceMemoryProperties m_properties{};
    std::uint64_t m_limit_bytes;
    std::string m_limit_name;
    std::uint64_t m_block_bytes;
    std::uint64_t m_granularity; // granularity in bytes of requests to the host
    std::uint64_t m_used_bytes = 0;
    std::uint64_t m_peak_bytes = 0;
    std::uint64_t m_held_bytes = 0;
    std::uint64_t m_peak_held_bytes = 0;
    std::vector<std::unique_ptr<Block>> m_blocks;
};

} // namespace zvo::vk
