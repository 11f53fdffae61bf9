#version 460
// SPDX-License-Identifier: MIT
// Writes the alias tables from the lists: each cell finds the other one by which it is filled up.
#extension GL_GOOGLE_include_directive : require
#include "light/environment.h"

GPU_ENTRY(AliasParams, GPU_NO_CONSTANTS);
layout(local_size_x = kAliasGroup) in;

#include "lib/dispatch.glsl"
#include "light/alias.glsl"

// The number of items of a list whose stretches begin at most at a place.
uint countUpTo(AliasItem_Ptr items, uint first, uint count, uint64_t place)
{
    uint low = 0u;
    uint high = count;
    for (; low < high;)
    {
        uint middle = (low + high) / 2u;
        bool before = items.data[first + middle].before <= place;
        low = before ? middle + 1u : low;
        high = before ? high : middle;
    }
    return low;
}

void main()
{
    uint i = threadIndex();
    uint normal = i / params.cell_count;
    if (normal >= kNormals)
        return;
    uint base = normal * params.cell_count;
    uint k = i - base;
    uint64_t total = totalOf(normal);
    AliasSums all = params.sums.data[kNormals * params.block_count + normal];
    bool light = k < all.light_count;
    uint own = light ? k : k - all.light_count;
    AliasItem item;
    if (light)
        item = params.light.data[base + own];
    else
        item = params.heavy.data[base + own];
    uint weight = weightOf(normal, item.cell);
    uint alias = item.cell;
    uint64_t kept = total;
    if (light && item.before < all.gives)
    {
        kept = uint64_t(weight) * params.cell_count;
        alias = params.heavy.data[base + countUpTo(params.heavy, base, all.heavy_count, item.before) - 1u].cell;
    }
    if (!light)
    {
        uint64_t end = own + 1u < all.heavy_count ? params.heavy.data[base + own + 1u].before : all.gives;
        // The light cell whose stretch begins before that end (which is above 0), and ends at it or after it. One that
        // begins there is filled up by the next heavy cell.
        uint next = countUpTo(params.light, base, all.light_count, end - 1u);
        uint64_t next_before = next < all.light_count ? params.light.data[base + next].before : all.lacks;
        if (next_before > end && own + 1u < all.heavy_count)
        {
            kept = total + end - next_before;
            alias = params.heavy.data[base + own + 1u].cell;
        }
    }
    bool full = kept >= total;
    uint threshold = full ? ~0u : uint(min(float(kept) / float(total) * 4294967296.0, 4294967040.0));
    params.cells.data[base + item.cell] =
        AliasCell(threshold, full ? item.cell : alias, total == uint64_t(0) ? 0.0 : float(weight) / float(total));
}
