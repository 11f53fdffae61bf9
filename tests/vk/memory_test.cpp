// SPDX-License-Identifier: MIT
#include "vk/kernels.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using namespace zvo;
using test::kMiB;
using vk::MemoryAllocator;
using vk::MemoryBlock;

MemoryBlock allocate(MemoryAllocator& memory, std::uint64_t bytes, std::uint64_t alignment = 1)
{
    const VkMemoryRequirements requirements{bytes, alignment, ~0u};
    return memory.allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, "a test range");
}

ErrorCode codeOf(const std::function<void()>& action)
{
    try
    {
        action();
    }
    catch (const Error& error)
    {
        return error.code();
    }
    ADD_FAILURE() << "nothing was thrown";
    return ErrorCode::Other;
}

TEST(MemoryAllocator, SmallRangesShareABlock)
{
    MemoryAllocator memory(test::device().device(), UINT64_MAX);
    const MemoryBlock a = allocate(memory, 1000);
    const MemoryBlock b = allocate(memory, 1000);
    EXPECT_EQ(a.memory, b.memory);
    EXPECT_NE(a.offset, b.offset);
    memory.release(a);
    memory.release(b);
}

TEST(MemoryAllocator, BigRangesHaveMemoryOfTheirOwn)
{
    MemoryAllocator memory(test::device().device(), UINT64_MAX);
    const MemoryBlock big = allocate(memory, MemoryAllocator::kBlockBytes);
    EXPECT_EQ(big.offset, 0u);
    EXPECT_EQ(big.block, UINT32_MAX);
    memory.release(big);
}

TEST(MemoryAllocator, ReleasedNeighborsCoalesceInAnyOrder)
{
    const int orders[][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& order : orders)
    {
        MemoryAllocator memory(test::device().device(), UINT64_MAX);
        const MemoryBlock parts[] = {allocate(memory, 20 * kMiB), allocate(memory, 20 * kMiB),
                                     allocate(memory, 20 * kMiB)};
        const MemoryBlock rest = allocate(memory, 4 * kMiB);
        EXPECT_EQ(rest.memory, parts[0].memory);
        for (const int part : order)
        {
            memory.release(parts[part]);
        }
        const MemoryBlock first = allocate(memory, 30 * kMiB);
        const MemoryBlock second = allocate(memory, 30 * kMiB);
        EXPECT_EQ(first.memory, rest.memory);
        EXPECT_EQ(second.memory, rest.memory) << "the gap was not one range";
        memory.release(first);
        memory.release(second);
        memory.release(rest);
    }
}

TEST(MemoryAllocator, TheFirstFittingGapIsUsed)
{
    MemoryAllocator memory(test::device().device(), UINT64_MAX);
    const MemoryBlock a = allocate(memory, 100);
    const MemoryBlock b = allocate(memory, 100);
    const MemoryBlock c = allocate(memory, 100);
    memory.release(a);
    const MemoryBlock too_big = allocate(memory, 101);
    EXPECT_GT(too_big.offset, c.offset);
    const MemoryBlock again = allocate(memory, 99);
    EXPECT_EQ(again.offset, a.offset);
    for (const MemoryBlock& block : {b, c, too_big, again})
    {
        memory.release(block);
    }
}

TEST(MemoryAllocator, BeyondTheBudgetIsAMemoryError)
{
    MemoryAllocator memory(test::device().device(), 10 * kMiB);
    const MemoryBlock most = allocate(memory, 9 * kMiB);
    EXPECT_EQ(codeOf([&] { allocate(memory, 2 * kMiB); }), ErrorCode::Memory);
    const MemoryBlock rest = allocate(memory, kMiB);
    EXPECT_EQ(codeOf([&] { allocate(memory, 1); }), ErrorCode::Memory);
    memory.release(most);
    memory.release(allocate(memory, 2 * kMiB));
    memory.release(rest);
    EXPECT_EQ(codeOf([&] { allocate(memory, UINT64_MAX); }), ErrorCode::Memory);
}

TEST(MemoryAllocator, MoreThanTheHeapIsAMemoryError)
{
    MemoryAllocator memory(test::device().device(), UINT64_MAX);
    EXPECT_EQ(codeOf([&] { allocate(memory, std::uint64_t{1} << 60); }), ErrorCode::Memory);
    EXPECT_EQ(memory.usedBytes(), 0u);
}

TEST(MemoryAllocator, PeakIsTheMostThatWasInUseAtOnce)
{
    MemoryAllocator memory(test::device().device(), UINT64_MAX);
    const MemoryBlock a = allocate(memory, 1000);
    const MemoryBlock b = allocate(memory, 500);
    memory.release(a);
    const MemoryBlock c = allocate(memory, 100);
    EXPECT_EQ(memory.usedBytes(), 600u);
    EXPECT_EQ(memory.peakBytes(), 1500u);
    memory.resetPeak();
    EXPECT_EQ(memory.peakBytes(), 600u);
    memory.release(b);
    memory.release(c);
    EXPECT_EQ(memory.usedBytes(), 0u);
}

TEST(MemoryAllocator, RandomRangesNeverOverlapAndAreAligned)
{
    MemoryAllocator memory(test::device().device(), UINT64_MAX);
    std::mt19937 random(3);
    std::vector<MemoryBlock> live;
    std::uint64_t bytes_in_use = 0;
    for (int round = 0; round < 4000; ++round)
    {
        if (live.empty() || random() % 5 < 3)
        {
            const std::uint64_t bytes = 1 + random() % (random() % 4 == 0 ? 5 * kMiB : 5000);
            const std::uint64_t alignment = std::uint64_t{1} << (random() % 12);
            const MemoryBlock block = allocate(memory, bytes, alignment);
            ASSERT_EQ(block.offset % alignment, 0u);
            ASSERT_LE(block.offset + bytes, MemoryAllocator::kBlockBytes);
            for (const MemoryBlock& other : live)
            {
                ASSERT_TRUE(other.memory != block.memory || other.offset + other.bytes <= block.offset ||
                            block.offset + block.bytes <= other.offset);
            }
            live.push_back(block);
            bytes_in_use += bytes;
        }
        else
        {
            std::swap(live[random() % live.size()], live.back());
            memory.release(live.back());
            bytes_in_use -= live.back().bytes;
            live.pop_back();
        }
        ASSERT_EQ(memory.usedBytes(), bytes_in_use);
    }
    for (const MemoryBlock& block : live)
    {
        memory.release(block);
    }
    EXPECT_EQ(memory.usedBytes(), 0u);
}

} // namespace
