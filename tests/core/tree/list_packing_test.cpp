// SPDX-License-Identifier: MIT
#include "core/tree/list_packing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace zvo
{
namespace
{

TEST(SvdagLists, WordsHaveAsManyEntriesAsNumbersAllow)
{
    const std::pair<std::uint64_t, std::uint32_t> expected[] = {{0, 4},       {1, 4},       {65536, 4},     {65537, 3},
                                                                {2097152, 3}, {2097153, 2}, {UINT32_MAX, 2}};
    for (const auto& [node_count, per_word] : expected)
    {
        EXPECT_EQ(ListPacking::tightest(node_count, 0, 0).per_word, per_word) << node_count;
    }
}

TEST(SvdagLists, PackedByHandAreTheseWords)
{
    const std::vector<std::uint32_t> entries = {1, 0xFFFF, 0x8001, 2, 3};
    EXPECT_EQ(packEntries(entries, 4), (std::vector<std::uint64_t>{0x00028001FFFF0001, 3}));
    EXPECT_EQ(packEntries(entries, 3),
              (std::vector<std::uint64_t>{std::uint64_t{0x8001} << 42 | std::uint64_t{0xFFFF} << 21 | 1, 3 << 21 | 2}));
    EXPECT_EQ(packEntries(entries, 2), (std::vector<std::uint64_t>{0x0000FFFF00000001, 0x0000000200008001, 3}));
    EXPECT_TRUE(packEntries({}, 3).empty());
}

TEST(SvdagLists, UnpackedAreWhatWasPacked)
{
    std::mt19937 random(1);
    for (const std::uint32_t per_word : {2U, 3U, 4U})
    {
        const auto largest = static_cast<std::uint32_t>((std::uint64_t{1} << 64 / per_word) - 1);
        for (const std::size_t count : {0, 1, 27, 64, 2049})
        {
            std::vector<std::uint32_t> entries(count, largest);
            std::generate(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(count / 2),
                          [&] { return static_cast<std::uint32_t>(random()) & largest; });
            const ListPacking packing = {10, count, per_word};
            const std::vector<std::uint64_t> words = packEntries(entries, per_word);
            EXPECT_EQ(words.size(), packing.wordCount());
            EXPECT_EQ(unpackEntries(words, count, per_word), entries);
            const std::vector<gpu::Node> nodes = nodesOf(words);
            EXPECT_EQ(nodes.size(), packing.poolNodes() - packing.node_words / 2);
            std::vector<std::uint64_t> padded = wordsOf(nodes);
            padded.resize(words.size());
            EXPECT_EQ(padded, words);
        }
    }
}

TEST(SvdagLists, EntriesFitIntoTheBaseOfANode)
{
    const std::uint64_t most = (std::uint64_t{1} << 30) - 8; // positions of words and entries
    EXPECT_TRUE((ListPacking{2000, most - 4000, 2}.fits(gpu::kLeafWords)));
    EXPECT_FALSE((ListPacking{2000, most - 4000 + 8, 2}.fits(gpu::kLeafWords)));
    EXPECT_TRUE((ListPacking{most / 2, 0, 2}.fits(gpu::kLeafWords)));
    EXPECT_FALSE((ListPacking{most / 2 + 4, 0, 2}.fits(gpu::kLeafWords)));
}

} // namespace
} // namespace zvo
