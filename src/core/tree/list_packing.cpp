// SPDX-License-Identifier: MIT
#include "core/tree/list_packing.h"

#include <array>
#include <bit>
#include <cassert>

namespace zvo
{

ListPacking ListPacking::tightest(std::uint64_t node_count, std::uint64_t entry_count)
{
    std::uint32_t per_word = 4;
    while (per_word > 2 && node_count > std::uint64_t{1} << gpu::kListWordBits / per_word)
    {
        --per_word;
    }
    return {node_count, entry_count, per_word};
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

std::vector<gpu::Node> entriesToNodes(std::span<const std::uint32_t> entries, std::uint32_t per_word)
{
    std::vector<std::uint64_t> words = packEntries(entries, per_word);
    words.resize(divideUp(words.size(), ListPacking::kWordsOfNode) * ListPacking::kWordsOfNode);
    std::vector<gpu::Node> nodes;
    nodes.reserve(words.size() / ListPacking::kWordsOfNode);
    for (std::size_t i = 0; i < words.size(); i += ListPacking::kWordsOfNode)
    {
        nodes.push_back(std::bit_cast<gpu::Node>(std::array{words[i], words[i + 1]}));
    }
    return nodes;
}

std::vector<std::uint32_t> nodesToEntries(std::span<const gpu::Node> nodes, const ListPacking& packing)
{
    std::vector<std::uint64_t> words;
    words.reserve(nodes.size() * ListPacking::kWordsOfNode);
    for (const gpu::Node& node : nodes)
    {
        const auto pair = std::bit_cast<std::array<std::uint64_t, ListPacking::kWordsOfNode>>(node);
        words.insert(words.end(), pair.begin(), pair.end());
    }
    return unpackEntries(std::span(words).first(packing.wordCount()), packing.entry_count, packing.per_word);
}

} // namespace zvo
