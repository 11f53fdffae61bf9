// SPDX-License-Identifier: MIT
// How the lists of a DAG's pool are packed (shaders/shared/svdag.h).
#pragma once

#include "core/base/divide_up.h"
#include "shared/svdag.h"

#include <cstdint>
#include <span>
#include <vector>

namespace zvo
{

/// Where the entries of lists are in a DAG's pool.
struct ListPacking
{
    std::uint64_t node_words = 0; // of 64 bits, of nodes and leaf words
    std::uint64_t entry_count = 0;
    std::uint32_t per_word = 2; // entries of a word: 2, 3 or 4

    /// The packing with as many entries to a word as the numbers allow, which are all less than number_end.
    static ListPacking tightest(std::uint64_t number_end, std::uint64_t node_words, std::uint64_t entry_count);

    /// Index of the first entry, counted as shaders/shared/svdag.h says.
    [[nodiscard]] std::uint64_t firstEntry() const { return node_words * per_word; }

    /// The number of words of all entries, their bytes, and how many nodes take as much room as nodes and entries
    /// together.
    [[nodiscard]] std::uint64_t wordCount() const { return divideUp(entry_count, per_word); }
    [[nodiscard]] std::uint64_t bytes() const { return wordCount() * sizeof(std::uint64_t); }
    [[nodiscard]] std::uint64_t poolNodes() const { return divideUp(node_words + wordCount(), kWordsOfNode); }

    /// Whether the base of a node can hold the index of every entry beside its flags, of which `flag` is the lowest:
    /// kLeafWords in device memory, kChildList in files.
    [[nodiscard]] bool fits(gpu::uint flag) const { return firstEntry() + wordCount() * per_word < flag; }

    static constexpr std::uint64_t kWordsOfNode = sizeof(gpu::Node) / sizeof(std::uint64_t);
};

/// Packs entries into words, with zeros behind the last one; and unpacks entry_count entries from words.
std::vector<std::uint64_t> packEntries(std::span<const std::uint32_t> entries, std::uint32_t per_word);
std::vector<std::uint32_t> unpackEntries(std::span<const std::uint64_t> words, std::uint64_t entry_count,
                                         std::uint32_t per_word);

/// The words of a pool, and the elements that hold words, with zeros behind the last one.
std::vector<std::uint64_t> wordsOf(std::span<const gpu::Node> nodes);
std::vector<gpu::Node> nodesOf(std::span<const std::uint64_t> words);

} // namespace zvo
