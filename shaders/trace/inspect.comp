#version 460
// SPDX-License-Identifier: MIT
// Reports on the hits of single pixels' rays. They are traced once more from the root, so that the number of iterations
// is that of the ray alone.
#extension GL_GOOGLE_include_directive : require
#include "trace/trace.h"

GPU_ENTRY(InspectParams, TRACE_INSPECT_CONSTANTS);
layout(local_size_x = kArgsGroup) in;

#include "lib/attribute_formats.glsl"
#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/half_node.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ray.glsl"
#include "lib/traverse.glsl"

// The node of a cell's level - 1 that it lies in.
uint nodeAround(uvec3 cell, uint level)
{
    uint node = 0u;
    for (uint k = 1u; k < level; ++k)
    {
        uint index = childIndex(loadInner(params.nodes, node), cellInBlock(cell >> (2u * (level - k))));
        node = kEntriesPerWord != 0u ? listedChild(params.nodes, index, kEntriesPerWord) : index;
    }
    if (kEntriesPerWord == 0u)
        node &= ~kFullNodes;
    return isLeafWord(node) ? leafWord(node) - (kEntriesPerWord == 0u ? params.leaf_groups.data[0].x : 0u) : node;
}

void main()
{
    uint index = threadIndex();
    if (index >= params.count)
        return;
    uint at = params.pixels.data[index];
    uvec2 size = uvec2(params.width, params.height);
    uvec2 pixel = uvec2(at % size.x, at / size.x);
    vec3 offset = rayOffset(pixelOffset(pixel, size), params.camera.half_pixel_x, params.camera.half_pixel_y);
    precise vec3 direction = params.camera.forward + (kOrthographic ? vec3(0.0) : offset);
    precise vec3 origin = params.camera.origin + (kOrthographic ? offset : vec3(0.0));
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    g_leaf_groups = uint64_t_ConstPtr(uint64_t(params.leaf_groups));
    Traversal met = traverse(origin, inverseDirection(direction), 0.0, kTraceTimeMax, params.detail);

    PixelReport report;
    report.hit = met.hit ? 1u : 0u;
    report.t = met.t;
    report.cell = met.cell;
    report.level = met.level;
    report.face = met.face;
    report.node = met.hit ? nodeAround(met.cell, met.level) : 0u;
    report.index = met.hit ? loadHit(params.hits, at).index : 0u;
    report.look = Attribute(0u, 0u);
    if (kFormat != kFormatNone && met.hit)
        report.look =
            readAttribute(kFormat, met.level == kNodeLevels, params.attributes, params.node_attributes, report.index);
    report.iterations = met.iterations;
    params.reports.data[index] = report;
}
