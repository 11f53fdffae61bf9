#version 460
// SPDX-License-Identifier: MIT
// Answers a list of questions of one kind, a thread each.
#extension GL_GOOGLE_include_directive : require
#include "query/query.h"

GPU_ENTRY(FindParams, QUERY_FIND_CONSTANTS);
layout(local_size_x = kQueryGroup) in;

#define NODES_BINDING 0
#define GROUPS_BINDING 1
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/half_node.glsl"
#include "lib/hit.glsl"
#include "lib/query.glsl"

// Three numbers of a question.
ivec3 loadVector(uint at)
{
    return ivec3(params.numbers.data[at], params.numbers.data[at + 1u], params.numbers.data[at + 2u]);
}

void main()
{
    uint i = threadIndex();
    if (i >= params.query_count)
        return;
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    g_leaf_groups = uint64_t_ConstPtr(uint64_t(params.leaf_groups));
    Traversal found = nothingFound();
    if (kKind == kQueryPoint)
        found = findPoint(loadVector(3u * i));
    else if (kKind == kQueryBox)
        found = findInBox(loadVector(6u * i), loadVector(6u * i + 3u));
    else if (kKind == kQueryNearest)
        found = findNearest(loadVector(4u * i), params.numbers.data[4u * i + 3u]);
    else if (kKind == kQuerySweep)
        found = findOnWay(loadVector(9u * i), loadVector(9u * i + 3u), loadVector(9u * i + 6u));
    if (found.unfinished)
        atomicAdd(params.status.data[0].capped_rays, 1u);
    uint index = found.hit ? found.index : found.unfinished ? kHitUnfinished : kHitMiss;
    storeHit(params.hits, i, found.t, index, found.cell, found.level, found.face);
}
