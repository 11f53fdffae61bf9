// SPDX-License-Identifier: MIT
// The brick table under the greatest contention.
#include "kernels/test/insert_bricks.h"
#include "vk/kernels.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using Key = std::pair<std::uint32_t, std::uint32_t>;

constexpr std::uint32_t kNoEntry = ~0U;

struct Table
{
    std::vector<gpu::BrickEntry> entries;
    std::vector<gpu::uvec2> inserted; // [key] entry, and 1 if its thread claimed it
    std::vector<gpu::uvec2> found;
};

// Whether kernels reach the table through descriptors.
class BrickTable : public testing::TestWithParam<vk::LoadForm>
{
};

INSTANTIATE_TEST_SUITE_P(LoadForms, BrickTable, testing::Values(vk::LoadForm::Addresses, vk::LoadForm::Atomics));

Table insertAndFind(const std::vector<gpu::uvec2>& keys, std::uint32_t capacity, bool wide)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning[vk::kLoadsName] = static_cast<std::uint32_t>(BrickTable::GetParam());
    vk::HeadlessDevice device(options, testKernels());
    vk::BufferOf<gpu::BrickEntry> bricks(device.device(), "bricks", capacity);
    const vk::BufferOf<gpu::uvec2> key_buffer = device.makeBuffer("keys", std::span(keys));
    vk::BufferOf<gpu::uvec2> inserted(device.device(), "inserted", keys.size());
    vk::BufferOf<gpu::uvec2> found(device.device(), "found", keys.size());
    device.run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(bricks, 0);
            for (const bool find : {false, true})
            {
                vk::Pass pass = graph.addPass(gpu::test::InsertBricks{.wide_keys = wide, .find = find});
                const gpu::InsertBricksParams params = {pass.readWrite(bricks), pass.read(key_buffer),
                                                        pass.write(find ? found : inserted),
                                                        static_cast<gpu::uint>(keys.size()), capacity - 1};
                pass.dispatch(keys.size(), params);
            }
        });
    return {device.download(bricks), device.download(inserted), device.download(found)};
}

// Expects that every key has one entry, which all its threads found and one of them claimed, and that the table has no
// others.
void expectIsTheSetOf(const std::vector<gpu::uvec2>& keys, const Table& table, bool wide)
{
    std::map<Key, std::uint32_t> entry_of;
    std::map<Key, std::uint32_t> claim_count;
    std::set<std::uint32_t> used;
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
        const Key key(keys[i].x, keys[i].y);
        const std::uint32_t entry = table.inserted[i].x;
        ASSERT_LT(entry, table.entries.size());
        ASSERT_EQ(entry_of.emplace(key, entry).first->second, entry) << "one key in two entries";
        ASSERT_EQ(table.found[i].x, entry);
        ASSERT_EQ(table.entries[entry].key, key.first);
        if (wide)
        {
            ASSERT_EQ(table.entries[entry].base, key.second);
        }
        claim_count[key] += table.inserted[i].y;
        used.insert(entry);
    }
    EXPECT_EQ(used.size(), entry_of.size()) << "two keys in one entry";
    for (const auto& [key, count] : claim_count)
    {
        EXPECT_EQ(count, 1U);
    }
    std::size_t occupied_count = 0;
    for (const gpu::BrickEntry& entry : table.entries)
    {
        occupied_count += entry.key != 0 ? 1 : 0;
        EXPECT_EQ(wide && entry.key != 0, entry.base != 0) << "half full";
    }
    EXPECT_EQ(occupied_count, entry_of.size());
}

// Copies of each key, in random order.
std::vector<gpu::uvec2> shuffledCopies(const std::set<Key>& keys, std::uint32_t copy_count, std::mt19937& random)
{
    std::vector<gpu::uvec2> copies;
    for (std::uint32_t i = 0; i < copy_count; ++i)
    {
        for (const Key& key : keys)
        {
            copies.emplace_back(key.first, key.second);
        }
    }
    std::shuffle(copies.begin(), copies.end(), random);
    return copies;
}

TEST_P(BrickTable, WideKeysThatShareWordsStayApart)
{
    std::mt19937 random(1);
    struct Words
    {
        std::uint32_t lower_count;
        std::uint32_t upper_count;
    };
    for (const Words& words : {Words{1, 230}, Words{230, 1}, Words{15, 15}, Words{3, 77}, Words{77, 3}})
    {
        std::vector<std::uint32_t> uppers;
        std::set<Key> keys;
        for (std::uint32_t i = 0; i < words.upper_count; ++i)
        {
            uppers.push_back(gpu::kBrickKeyTag | (static_cast<std::uint32_t>(random()) >> 14));
        }
        for (std::uint32_t i = 0; i < words.lower_count; ++i)
        {
            const std::uint32_t lower = gpu::kBrickKeyTag | (static_cast<std::uint32_t>(random()) >> 2);
            for (const std::uint32_t upper : uppers)
            {
                keys.emplace(lower, upper);
            }
        }
        const std::vector<gpu::uvec2> copies = shuffledCopies(keys, 200, random);
        for (int repetition = 0; repetition < 5; ++repetition)
        {
            const Table table = insertAndFind(copies, 256, true); // nine tenths full
            expectIsTheSetOf(copies, table, true);
        }
    }
}

TEST_P(BrickTable, NarrowKeysStayApart)
{
    std::mt19937 random(2);
    std::set<Key> keys;
    while (keys.size() < 230)
    {
        keys.emplace(static_cast<std::uint32_t>(random()) | 1U, 0);
    }
    const std::vector<gpu::uvec2> copies = shuffledCopies(keys, 200, random);
    expectIsTheSetOf(copies, insertAndFind(copies, 256, false), false);
}

TEST_P(BrickTable, KeysBeyondTheRoomAreTurnedAwayAndTheRestIsWhole)
{
    std::mt19937 random(3);
    std::set<Key> keys;
    while (keys.size() < 5000)
    {
        keys.emplace(gpu::kBrickKeyTag | static_cast<std::uint32_t>(random() % 64),
                     gpu::kBrickKeyTag | static_cast<std::uint32_t>(random() % 512));
    }
    const std::vector<gpu::uvec2> copies = shuffledCopies(keys, 10, random);
    const Table table = insertAndFind(copies, 64, true);
    std::set<Key> present;
    for (const gpu::BrickEntry& entry : table.entries)
    {
        EXPECT_TRUE(keys.contains({entry.key, entry.base}));
        present.emplace(entry.key, entry.base);
    }
    EXPECT_EQ(present.size(), 64U);
    for (std::size_t i = 0; i < copies.size(); ++i)
    {
        const bool here = present.contains({copies[i].x, copies[i].y});
        ASSERT_EQ(table.inserted[i].x != kNoEntry, here);
        ASSERT_EQ(table.found[i].x != kNoEntry, here);
    }
}

} // namespace
} // namespace zvo
