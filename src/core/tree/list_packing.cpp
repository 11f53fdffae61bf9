// SPDX-License-Identifier: MIT
#include "core/tree/list_packing.h"

#include <algorithm>
#include <cassert>

namespace zvo
{

ListPacking ListPacking::tightest(std::uint64_t number_end, std::uint64_t node_words, std::uint64_t entry_count)
{
    std::uint32_t per_word = 4;
    while (per_word > 2 && number_end > std::uint64_t{1} << gpu::kListWordBits / per_word)
    {
        --per_word;
    }
    return {node_words, entry_count, per_word};
}

std::vector<std::uint64_t> packEntries(std::span<const std::uint32_t> entries, std::uint32_t per_word)
{
    const std::uint32_t bits = gpu::kListWordBits / per_word;
    std::vector<std::uint64_t> words(divideUp(entries.size(), per_word));
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
        assert(std::uint64_t{entries[i]} >> bits == 0);
        words[i / per_word] |= std::uint64_t{entries[i]} << i % per_word * bits;
    }
    return words;
}

std::vector<std::uint32_t> unpackEntries(std::span<const std::uint64_t> words, std::uint64_t entry_count,
                                         std::uint32_t per_word)
{
    assert(words.size() == divideUp(entry_count, per_word));
    const std::uint32_t bits = gpu::kListWordBits / per_word;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    std::vector<std::uint32_t> entries(entry_count);
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
        entries[i] = static_cast<std::uint32_t>(words[i / per_word] >> i % per_word * bits & mask);
    }
    return entries;
}

std::vector<std::uint64_t> wordsOf(std::span<const gpu::Node> nodes)
{
    std::vector<std::uint64_t> words(nodes.size() * ListPacking::kWordsOfNode);
    std::ranges::copy(std::as_bytes(nodes), std::as_writable_bytes(std::span(words)).begin());
    return words;
}

std::vector<gpu::Node> nodesOf(std::span<const std::uint64_t> words)
{
    std::vector<gpu::Node> nodes(divideUp(words.size(), ListPacking::kWordsOfNode));
    std::ranges::copy(std::as_bytes(words), std::as_writable_bytes(std::span(nodes)).begin());
    return nodes;
}

} // namespace zvo
