// SPDX-License-Identifier: MIT
// What tests of the history share.
#pragma once

#include "core/overlay/root_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace zvo::test
{

constexpr HistoryBounds kUnbounded{.entries_max = SIZE_MAX, .bytes_max = UINT64_MAX};

// Regions of 10 nodes (a byte each) and no voxels.
constexpr OverlaySpace kTenRegions{.static_nodes = 1, .node_capacity = 101, .node_bytes = 1};

inline std::vector<LayerState> version(std::uint64_t number)
{
    return {{7, number}};
}

inline bool shows(const RootEntry& entry, std::uint64_t number)
{
    const std::vector<LayerState> expected = version(number);
    return std::equal(entry.layers.begin(), entry.layers.end(), expected.begin(), expected.end());
}

class RootHistoryTest : public testing::Test
{
protected:
    // An entry of 10 nodes, complete unless told otherwise, whose layers are version(id).
    static std::uint64_t pushPending(RootHistory& history, std::uint32_t nodes = 10)
    {
        const std::optional<OverlayRegion> region = history.allocate(nodes, 0);
        EXPECT_TRUE(region.has_value());
        return history.push(region, version(history.current().id + 1));
    }

    static std::uint64_t push(RootHistory& history, std::uint32_t nodes = 10)
    {
        const std::uint64_t id = pushPending(history, nodes);
        history.complete(id, nodes, 0);
        return id;
    }

    OverlayArena m_arena{kTenRegions};
};

} // namespace zvo::test
