// SPDX-License-Identifier: MIT
// The sort against std::stable_sort. ctest runs this file's tests again with other sizes of subgroups.
#include "baseline/radix_sort.h"
#include "baseline/slides_fixture.h"
#include "baseline/slides_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <vector>

namespace zvo::baseline
{
namespace
{

using test::slidesDevice;

using Keys = std::vector<std::uint64_t>;

// Sizes around the borders of subgroups, workgroups and blocks.
constexpr std::size_t kSizes[] = {1, 2, 27, 64, 127, 128, 129, 2047, 2048, 2049, 4096, 231917};

// Sorts keys by their lowest key_bits bits on the device. Expects what std::stable_sort gives.
void expectSorted(const Keys& keys, std::uint32_t key_bits)
{
    RadixSortBuffers buffers(slidesDevice().device(), keys.size());
    slidesDevice().upload(buffers.keys[0], std::span<const std::uint64_t>(keys));
    std::uint32_t half = 0;
    slidesDevice().run([&](vk::FrameGraph& graph) { half = radixSort(graph, buffers, keys.size(), key_bits); });
    const Keys sorted = slidesDevice().download(buffers.keys[half]);
    const auto indices = slidesDevice().download(buffers.indices[half]);

    const std::uint64_t mask = key_bits < 64 ? (std::uint64_t{1} << key_bits) - 1 : ~std::uint64_t{0};
    std::vector<gpu::uint> expected(keys.size());
    std::iota(expected.begin(), expected.end(), 0U);
    std::ranges::stable_sort(expected, {}, [&](gpu::uint i) { return keys[i] & mask; });
    EXPECT_TRUE(indices == expected) << keys.size() << " keys by " << key_bits << " bits";
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
        wrong += sorted[i] != keys[expected[i]] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U) << "of " << keys.size() << " keys by " << key_bits << " bits";
}

Keys keysOf(std::size_t count, const std::function<std::uint64_t(std::size_t)>& key)
{
    Keys keys(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        keys[i] = key(i);
    }
    return keys;
}

TEST(RadixSort, OfRandomKeysIsStableSort)
{
    std::mt19937_64 random(1);
    for (const std::size_t size : kSizes)
    {
        expectSorted(keysOf(size, [&](std::size_t) { return random(); }), 64);
    }
}

TEST(RadixSort, KeepsTheOrderOfEqualKeys)
{
    std::mt19937_64 random(2);
    for (const std::size_t size : kSizes)
    {
        expectSorted(keysOf(size, [](std::size_t) { return 7ULL << 40; }), 48);
        expectSorted(keysOf(size, [&](std::size_t) { return random() % 3 << 8; }), 16);
        expectSorted(keysOf(size, [](std::size_t i) { return i / 100; }), 16);
    }
}

TEST(RadixSort, OfSortedAndReversedKeysIsStableSort)
{
    for (const std::size_t size : kSizes)
    {
        expectSorted(keysOf(size, [](std::size_t i) { return i; }), 24);
        expectSorted(keysOf(size, [&](std::size_t i) { return size - i; }), 24);
    }
}

TEST(RadixSort, LooksAtWholeDigitsOnly)
{
    std::mt19937_64 random(3);
    for (const std::uint32_t bits : {8U, 16U, 24U, 32U, 40U, 56U})
    {
        expectSorted(keysOf(5000, [&](std::size_t) { return random(); }), bits);
    }
    expectSorted(keysOf(5000, [&](std::size_t) { return random() >> 61; }), 3);
}

TEST(RadixSort, OfMillionsOfKeysIsStableSort)
{
    std::mt19937_64 random(4);
    expectSorted(keysOf(2'500'000, [&](std::size_t) { return random() >> 40; }), 24);
}

TEST(RadixSort, OfNothingRecordsNothing)
{
    RadixSortBuffers buffers(slidesDevice().device(), 0);
    slidesDevice().run(
        [&](vk::FrameGraph& graph)
        {
            EXPECT_EQ(radixSort(graph, buffers, 0, 64), 0U);
            EXPECT_EQ(graph.passCount(), 0U);
        });
}

// Scans values on the device, and compares with std::exclusive_scan. Returns the total.
gpu::uint expectScanned(const std::vector<gpu::uint>& values)
{
    vk::BufferOf<gpu::uint> buffer(slidesDevice().device(), "values", values.size());
    vk::BufferOf<gpu::uint> partials(slidesDevice().device(), "partials", partialCount(values.size()));
    vk::BufferOf<gpu::uint> total(slidesDevice().device(), "total", 1);
    slidesDevice().upload(buffer, std::span<const gpu::uint>(values));
    slidesDevice().run([&](vk::FrameGraph& graph)
                       { scanValues(graph, buffer, values.size(), partials, totalAt(total)); });
    std::vector<gpu::uint> expected(values.size());
    std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0U);
    EXPECT_TRUE(slidesDevice().download(buffer) == expected) << values.size() << " values";
    return slidesDevice().download(total)[0];
}

TEST(SlidesScan, IsExclusiveScan)
{
    std::mt19937 random(5);
    for (const std::size_t size : {1UL, 27UL, 511UL, 512UL, 513UL, 2049UL, 262144UL, 262145UL, 1000003UL})
    {
        std::vector<gpu::uint> values(size);
        std::ranges::generate(values, [&] { return static_cast<gpu::uint>(random() % 1000); });
        EXPECT_EQ(expectScanned(values), std::accumulate(values.begin(), values.end(), 0U));
    }
}

TEST(SlidesScan, NotesATotalThatDoesNotFit)
{
    std::vector<gpu::uint> values(512 * 1024, 0);
    values.front() = 1U << 31;
    values.back() = 1U << 31;
    EXPECT_EQ(expectScanned(values), gpu::kSlidesTooMany);
}

} // namespace
} // namespace zvo::baseline
