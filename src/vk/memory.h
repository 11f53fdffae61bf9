// SPDX-License-Identifier: MIT
#pragma once

#include "vk/functions.h"

#include <cstdint>
#include <memory>
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
};

/// Hands out ranges of device memory: small ones from shared blocks of kBlockBytes (first fit, coalescing), big ones as
/// allocations of their own. Counts what is handed out against a budget. Not thread safe.
class MemoryAllocator
{
public:
    static constexpr std::uint64_t kBlockBytes = 64ull << 20;

    MemoryAllocator(Device& device, std::uint64_t budget_bytes);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    /// A range that meets requirements in memory with required properties, and preferred ones where there are any.
    /// Throws Error{Memory} naming what when the budget or the device's memory does not suffice.
    MemoryBlock allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                         VkMemoryPropertyFlags preferred, const char* what);
    void release(const MemoryBlock& block) noexcept;

    [[nodiscard]] std::uint64_t usedBytes() const { return m_used_bytes; }
    [[nodiscard]] std::uint64_t peakBytes() const { return m_peak_bytes; }
    [[nodiscard]] std::uint64_t budgetBytes() const { return m_budget_bytes; }
    void resetPeak() { m_peak_bytes = m_used_bytes; }

private:
    struct Block;

    // These return false when the memory type cannot provide the memory.
    bool allocateFrom(std::uint32_t type, std::uint64_t size, std::uint64_t alignment, MemoryBlock& result);
    bool takeFrom(std::uint32_t index, std::uint64_t alignment, MemoryBlock& result);
    bool allocateMemory(std::uint32_t type, std::uint64_t size, VkDeviceMemory& memory, void*& mapped);
    void freeMemory(VkDeviceMemory memory) noexcept;

    Device& m_device;
    VkPhysicalDeviceMemoryProperties m_properties{};
    std::uint64_t m_budget_bytes;
    std::uint64_t m_used_bytes = 0;
    std::uint64_t m_peak_bytes = 0;
    std::vector<std::unique_ptr<Block>> m_blocks;
};

} // namespace zvo::vk
