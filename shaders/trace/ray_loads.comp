#version 460
// SPDX-License-Identifier: MIT
// Notes, for measurements, what the rays of a list load of a tree: the sector of each load, in the order of loads.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"

GPU_ENTRY(RayLoadsParams, TRACE_RAY_LOADS_CONSTANTS);
layout(local_size_x = kRaysGroup) in;

#include "lib/dispatch.glsl"
#include "lib/half_node.glsl"
#include "lib/ray.glsl"

uint g_ray;
uint g_load_count = 0u;

// word: of 64 bits, among those of the tree.
void noteLoad(uint word)
{
    if (g_load_count < kRayLoadsMax)
        params.sectors.data[g_load_count * params.ray_count + g_ray] = word / kSectorWords;
    ++g_load_count;
}

uvec2 noteHalf(uint half_index)
{
    noteLoad(half_index);
    return loadHalf(half_index);
}

uint noteEntry(uint index, uint per_word)
{
    noteLoad(index / (per_word & ~kFilledDag));
    return loadEntry(index, per_word);
}

// From here on, the traversal's loads are noted.
#define loadHalf noteHalf
#define loadEntry noteEntry
#define TRAVERSE_WITHOUT_INDICES
#include "lib/traverse.glsl"

void main()
{
    g_ray = threadIndex();
    if (g_ray >= params.ray_count)
        return;
    Ray ray = loadRay(params.rays, g_ray);
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    Traversal result = traverse(ray.origin, ray.inverse_direction, ray.t_min, ray.t_max, vec2(0.0));
    params.iterations.data[g_ray] = result.iterations;
}
