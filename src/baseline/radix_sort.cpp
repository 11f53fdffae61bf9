// SPDX-License-Identifier: MIT
#include "baseline/radix_sort.h"

#include "baseline/slides_scan.h"
#include "core/base/divide_up.h"

#include <cassert>

namespace zvo::baseline
{

namespace
{

static_assert(gpu::kSortBlock == gpu::kSortGroup * gpu::kSortItems);
static_assert(gpu::kSortDigits == 1U << gpu::kSortDigitBits);
static_assert(gpu::kSortDigits == 2 * gpu::kSortGroup, "a thread scans a word, which counts two digits");
static_assert(gpu::kSortBlock < 1U << 16);

constexpr std::uint64_t countsOf(std::uint64_t key_count)
{
    return divideUp(key_count, gpu::kSortBlock) * gpu::kSortDigits;
}

// Sorts by the digit at `shift`, from half `from` of the buffers to the other.
void sortByDigit(vk::FrameGraph& graph, RadixSortBuffers& buffers, std::uint64_t count, std::uint32_t from,
                 std::uint32_t shift)
{
    const std::uint64_t block_count = divideUp(count, gpu::kSortBlock);
    {
        vk::Pass pass = graph.addPass(gpu::baseline::SortCount{});
        pass.dispatch(block_count * gpu::kSortGroup, {.keys = pass.read(buffers.keys[from]),
                                                      .counts = pass.write(buffers.counts),
                                                      .key_count = static_cast<std::uint32_t>(count),
                                                      .block_count = static_cast<std::uint32_t>(block_count),
                                                      .shift = shift});
    }
    scanValues(graph, buffers.counts, countsOf(count), buffers.partials, totalAt(buffers.total));
    const bool is_first = shift == 0;
    vk::Pass pass = graph.addPass(gpu::baseline::SortScatter{.first = is_first});
    pass.dispatch(block_count * gpu::kSortGroup,
                  {.keys = pass.read(buffers.keys[from]),
                   .indices = is_first ? gpu::ConstPtr<gpu::uint>{} : pass.read(buffers.indices[from]),
                   .sorted_keys = pass.write(buffers.keys[1 - from]),
                   .sorted_indices = pass.write(buffers.indices[1 - from]),
                   .first_places = pass.read(buffers.counts),
                   .key_count = static_cast<std::uint32_t>(count),
                   .block_count = static_cast<std::uint32_t>(block_count),
                   .shift = shift});
}

} // namespace

RadixSortBuffers::RadixSortBuffers(vk::Device& device, std::uint64_t capacity)
    : counts(device, "sort/counts", countsOf(capacity)),
      partials(device, "sort/partials", partialCount(countsOf(capacity))), total(device, "sort/total", 1)
{
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
        keys[i] = {device, "sort/keys", capacity};
        indices[i] = {device, "sort/indices", capacity};
    }
}

std::uint32_t radixSort(vk::FrameGraph& graph, RadixSortBuffers& buffers, std::uint64_t count, std::uint32_t key_bits)
{
    assert(count <= buffers.keys[0].count() && key_bits >= 1 && key_bits <= 64);
    std::uint32_t half = 0;
    for (std::uint32_t shift = 0; shift < key_bits && count != 0; shift += gpu::kSortDigitBits)
    {
        sortByDigit(graph, buffers, count, half, shift);
        half = 1 - half;
    }
    return half;
}

} // namespace zvo::baseline
