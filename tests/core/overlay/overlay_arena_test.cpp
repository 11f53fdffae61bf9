// SPDX-License-Identifier: MIT
#include "core/overlay/overlay_arena.h"

#include "support/properties.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

namespace
{

using zvo::kVoxelBlock;
using zvo::OverlayArena;
using zvo::OverlayRegion;
using zvo::OverlaySpace;

constexpr OverlaySpace kSpace{.static_nodes = 10,
                              .node_capacity = 110,
                              .static_voxels = 33,
                              .voxel_capacity = 200,
                              .node_bytes = 24,
                              .voxel_block_bytes = 264};

TEST(OverlayArena, RegionsStandBehindTheStaticOctree)
{
    OverlayArena arena(kSpace);
    EXPECT_EQ(arena.largestFreeNodes(), 100u);
    EXPECT_EQ(arena.largestFreeVoxels(), 128u) << "voxels 64 to 191: whole blocks that no static voxel is in";
    EXPECT_EQ(arena.allocate(7, 40), (OverlayRegion{10, 7, 64, 64}));
    EXPECT_EQ(arena.allocate(3, 32), (OverlayRegion{17, 3, 128, 32}));
    EXPECT_EQ(arena.heldBytes(), 10u * 24 + 3u * 264);
    EXPECT_EQ(arena.largestFreeNodes(), 90u);
    EXPECT_EQ(arena.largestFreeVoxels(), 32u);
}

TEST(OverlayArena, WhereOnePartDoesNotFitNothingIsTaken)
{
    OverlayArena arena(kSpace);
    EXPECT_EQ(arena.allocate(101, 1), std::nullopt);
    EXPECT_EQ(arena.allocate(1, 129), std::nullopt);
    EXPECT_EQ(arena.allocate(UINT64_MAX, 1), std::nullopt);
    EXPECT_EQ(arena.allocate(1, UINT64_MAX), std::nullopt);
    EXPECT_EQ(arena.heldBytes(), 0u);
    EXPECT_EQ(arena.allocate(100, 128), (OverlayRegion{10, 100, 64, 128}));
}

TEST(OverlayArena, NodesAreGivenBackWhereVoxelsAreTooScattered)
{
    OverlayArena arena(kSpace);
    const auto low = arena.allocate(1, 32);
    const auto middle = arena.allocate(1, 32);
    const auto high = arena.allocate(1, 64);
    ASSERT_TRUE(low && middle && high);
    arena.release(*low);
    arena.release(*high);
    EXPECT_EQ(arena.allocate(50, 96), std::nullopt) << "three blocks are free, but not in one piece";
    EXPECT_EQ(arena.largestFreeNodes(), 98u);
    EXPECT_EQ(arena.heldBytes(), arena.bytes(*middle));
}

TEST(OverlayArena, PartsOfNoSizeTakeNoRoom)
{
    OverlayArena arena(kSpace);
    const auto all_nodes = arena.allocate(100, 0);
    const auto all_voxels = arena.allocate(0, 128);
    const auto nothing = arena.allocate(0, 0);
    EXPECT_EQ(all_nodes, (OverlayRegion{10, 100, 0, 0}));
    EXPECT_EQ(all_voxels, (OverlayRegion{0, 0, 64, 128}));
    EXPECT_EQ(nothing, OverlayRegion{});
    for (const auto& region : {nothing, all_voxels, all_nodes})
    {
        arena.release(*region);
    }
    EXPECT_EQ(arena.heldBytes(), 0u);
    EXPECT_EQ(arena.allocate(100, 128), (OverlayRegion{10, 100, 64, 128}));
}

TEST(OverlayArena, TailsAreFreeAgain)
{
    OverlayArena arena(kSpace);
    const auto region = arena.allocate(100, 128);
    ASSERT_TRUE(region);
    const OverlayRegion rest = arena.shrink(*region, 20, 33);
    EXPECT_EQ(rest, (OverlayRegion{10, 20, 64, 64}));
    EXPECT_EQ(arena.heldBytes(), arena.bytes(rest));
    EXPECT_EQ(arena.allocate(80, 64), (OverlayRegion{30, 80, 128, 64}));
}

TEST(OverlayArena, GrownBuffersOnlyAddRoom)
{
    OverlayArena arena(kSpace);
    const auto region = arena.allocate(95, 128);
    ASSERT_TRUE(region);
    arena.grow(120, 223);
    EXPECT_EQ(arena.largestFreeNodes(), 15u) << "the free end and the new part are one";
    EXPECT_EQ(arena.largestFreeVoxels(), 0u) << "still no whole block more";
    arena.grow(120, 224);
    EXPECT_EQ(arena.allocate(15, 32), (OverlayRegion{105, 15, 192, 32}));
    arena.release(*region);
    EXPECT_EQ(arena.allocate(95, 128), region);
}

TEST(OverlayArena, StaticOctreesMayFillTheirBuffers)
{
    OverlayArena arena({.static_nodes = 5, .node_capacity = 5, .static_voxels = 40, .voxel_capacity = 40});
    EXPECT_EQ(arena.allocate(1, 0), std::nullopt);
    EXPECT_EQ(arena.allocate(0, 1), std::nullopt);
    EXPECT_EQ(arena.allocate(0, 0), OverlayRegion{});
    arena.grow(6, 64);
    EXPECT_EQ(arena.allocate(0, 1), std::nullopt) << "the block of voxels 32 to 63 has static voxels";
    arena.grow(6, 96);
    EXPECT_EQ(arena.allocate(1, 1), (OverlayRegion{5, 1, 64, 32}));
}

TEST(OverlayArena, BuffersMayHaveAsManyElementsAs32BitsCount)
{
    OverlayArena arena({.static_nodes = 1,
                        .node_capacity = UINT32_MAX,
                        .static_voxels = 1,
                        .voxel_capacity = UINT32_MAX,
                        .node_bytes = 24,
                        .voxel_block_bytes = 264});
    const auto region = arena.allocate(UINT32_MAX - 1, UINT32_MAX - 63);
    EXPECT_EQ(region, (OverlayRegion{1, UINT32_MAX - 1, 32, UINT32_MAX - 63}));
    EXPECT_EQ(arena.heldBytes(), 24ull * (UINT32_MAX - 1) + 264ull * ((1u << 27) - 2));
    arena.release(*region);
    EXPECT_EQ(arena.heldBytes(), 0u);
    OverlayArena full({.static_nodes = UINT32_MAX,
                       .node_capacity = UINT32_MAX,
                       .static_voxels = UINT32_MAX,
                       .voxel_capacity = UINT32_MAX});
    EXPECT_EQ(full.allocate(1, 0), std::nullopt);
    EXPECT_EQ(full.allocate(0, 1), std::nullopt);
}

// A word for every node, or voxel: the region that has it.
class Line
{
public:
    static constexpr int kFree = 0;
    static constexpr int kStatic = -1;

    Line(std::uint32_t static_count, std::uint32_t count) : m_owners(count, kFree)
    {
        std::fill_n(m_owners.begin(), static_count, kStatic);
    }

    // The lowest multiple of step at which count free ones begin.
    [[nodiscard]] std::optional<std::uint32_t> find(std::uint64_t count, std::uint32_t step) const
    {
        for (std::uint64_t first = 0; first + count <= m_owners.size(); first += step)
        {
            const auto begin = m_owners.begin() + static_cast<std::ptrdiff_t>(first);
            if (std::all_of(begin, begin + static_cast<std::ptrdiff_t>(count),
                            [](int owner) { return owner == kFree; }))
            {
                return static_cast<std::uint32_t>(first);
            }
        }
        return std::nullopt;
    }

    void mark(std::uint32_t first, std::uint32_t count, int owner)
    {
        std::fill_n(m_owners.begin() + first, count, owner);
    }

    void grow(std::uint32_t count) { m_owners.resize(m_owners.size() + count, kFree); }

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(m_owners.size()); }
    [[nodiscard]] std::uint64_t heldCount() const
    {
        return static_cast<std::uint64_t>(std::count_if(m_owners.begin(), m_owners.end(), [](int o) { return o > 0; }));
    }

private:
    std::vector<int> m_owners;
};

std::uint32_t wholeBlocks(std::uint32_t voxels)
{
    return (voxels + 31) / 32 * 32;
}

enum class Act
{
    Allocate,
    Shrink,
    Release,
    Grow
};

std::ostream& operator<<(std::ostream& out, Act act)
{
    return out << std::vector<const char*>{"allocate", "shrink", "release", "grow"}[static_cast<std::size_t>(act)];
}

TEST(OverlayArena, DoesWhatMarkingEveryNodeAndVoxelDoes)
{
    zvo::test::checkProperty(
        2000,
        []
        {
            OverlaySpace space{.node_bytes = 24, .voxel_block_bytes = 264};
            space.static_nodes = *rc::gen::inRange<std::uint32_t>(0, 20);
            space.node_capacity = space.static_nodes + *rc::gen::inRange<std::uint32_t>(0, 100);
            space.static_voxels = *rc::gen::inRange<std::uint32_t>(0, 100);
            space.voxel_capacity = space.static_voxels + *rc::gen::inRange<std::uint32_t>(0, 1000);
            // (operation; nodes, voxels; number of a region)
            const auto operations =
                *rc::gen::container<std::vector<std::tuple<Act, std::uint32_t, std::uint32_t, std::size_t>>>(
                    rc::gen::tuple(rc::gen::weightedElement<Act>(
                                       {{10, Act::Allocate}, {4, Act::Shrink}, {5, Act::Release}, {1, Act::Grow}}),
                                   rc::gen::inRange<std::uint32_t>(0, 40), rc::gen::inRange<std::uint32_t>(0, 300),
                                   rc::gen::inRange<std::size_t>(0, 1000)));

            OverlayArena arena(space);
            Line nodes(space.static_nodes, space.node_capacity);
            Line voxels(space.static_voxels, space.voxel_capacity);
            std::vector<std::pair<int, OverlayRegion>> held;
            int last_owner = 0;
            const auto mark = [&](const OverlayRegion& region, int owner)
            {
                nodes.mark(region.first_node, region.node_capacity, owner);
                voxels.mark(region.first_voxel, region.voxel_capacity, owner);
            };
            for (const auto& [act, node_count, voxel_count, which] : operations)
            {
                if (act == Act::Allocate)
                {
                    const std::uint32_t rounded = wholeBlocks(voxel_count);
                    const auto first_node = node_count == 0 ? 0 : nodes.find(node_count, 1);
                    const auto first_voxel = rounded == 0 ? 0 : voxels.find(rounded, kVoxelBlock);
                    const auto region = arena.allocate(node_count, voxel_count);
                    RC_ASSERT(region.has_value() == (first_node && first_voxel));
                    if (region)
                    {
                        RC_ASSERT((*region == OverlayRegion{*first_node, node_count, *first_voxel, rounded}));
                        held.emplace_back(++last_owner, *region);
                        mark(*region, last_owner);
                    }
                }
                else if (act == Act::Grow)
                {
                    nodes.grow(node_count);
                    voxels.grow(voxel_count);
                    arena.grow(nodes.size(), voxels.size());
                }
                else if (!held.empty())
                {
                    auto& [owner, region] = held[which % held.size()];
                    mark(region, Line::kFree);
                    if (act == Act::Shrink)
                    {
                        const OverlayRegion before = region;
                        const std::uint32_t nodes_left = node_count % (region.node_capacity + 1);
                        const std::uint32_t voxels_left = voxel_count % (region.voxel_capacity + 1);
                        region = arena.shrink(region, nodes_left, voxels_left);
                        RC_ASSERT((region == OverlayRegion{before.first_node, nodes_left, before.first_voxel,
                                                           wholeBlocks(voxels_left)}));
                        mark(region, owner);
                    }
                    else
                    {
                        arena.release(region);
                        held.erase(held.begin() + static_cast<std::ptrdiff_t>(which % held.size()));
                    }
                }
                RC_ASSERT(arena.heldBytes() == nodes.heldCount() * 24 + voxels.heldCount() / 32 * 264);
                const std::uint64_t most_nodes = arena.largestFreeNodes();
                const std::uint64_t most_voxels = arena.largestFreeVoxels();
                RC_ASSERT(most_nodes == 0 || nodes.find(most_nodes, 1).has_value());
                RC_ASSERT(!nodes.find(most_nodes + 1, 1).has_value());
                RC_ASSERT(most_voxels == 0 || voxels.find(most_voxels, kVoxelBlock).has_value());
                RC_ASSERT(!voxels.find(most_voxels + kVoxelBlock, kVoxelBlock).has_value());
            }
            for (const auto& [owner, region] : held)
            {
                arena.release(region);
            }
            const OverlayArena fresh(arena.space());
            RC_ASSERT(arena.heldBytes() == 0u);
            RC_ASSERT(arena.largestFreeNodes() == fresh.largestFreeNodes());
            RC_ASSERT(arena.largestFreeVoxels() == fresh.largestFreeVoxels());
        });
}

} // namespace
