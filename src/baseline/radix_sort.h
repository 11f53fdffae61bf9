// SPDX-License-Identifier: MIT
#pragma once

#include "baseline/sort.h"
#include "vk/buffer.h"
#include "vk/frame_graph.h"

#include <array>
#include <cstdint>

namespace zvo::baseline
{

/// The buffers of a sort of at most `capacity` keys. Passes move keys from one half of a pair to the other.
struct RadixSortBuffers
{
    RadixSortBuffers(vk::Device& device, std::uint64_t capacity);

    std::array<vk::BufferOf<uint64_t>, 2> keys;     // [capacity] each; the first one holds the input
    std::array<vk::BufferOf<gpu::uint>, 2> indices; // [capacity] each; no input
    vk::BufferOf<gpu::uint> counts;                 // [gpu::kSortDigits] for each block
    vk::BufferOf<gpu::uint> partials;               // of the scan of counts
    vk::BufferOf<gpu::uint> total;                  // [1]
};

/// Records the passes that sort the first `count` keys of buffers.keys[0] by their lowest key_bits bits (1 to 64),
/// rounded up to whole digits, keys with the same bits in the order of the input. Returns the number of the half that
/// holds the sorted keys and, at the same places, their indices in the input; with no keys, 0 and nothing is recorded.
/// The result is the same bytes on every device.
///
/// The least significant digit comes first, kSortDigitBits bits a pass: counts of each block's keys by digit, a scan of
/// the counts, and moves to the places that follow from them (D. Merrill and A. Grimshaw, High Performance and Scalable
/// Radix Sorting, 2011: reduce, then scan). Nothing waits for another workgroup, unlike in sorts
/// of a single sweep. Keys are written where they belong without being gathered in shared memory before.
///
/// Cost: ceil(key_bits / kSortDigitBits) times five dispatches. Each moves every key and index once and reads the keys
/// once more. Subgroups must have ballots and shuffles, and at least kSortSubgroupMin threads.
std::uint32_t radixSort(vk::FrameGraph& graph, RadixSortBuffers& buffers, std::uint64_t count, std::uint32_t key_bits);

} // namespace zvo::baseline
