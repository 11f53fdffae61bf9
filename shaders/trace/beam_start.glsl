// SPDX-License-Identifier: MIT
// The octree's traversal by a beam: a box around the rays of a tile, which moves and grows with their time. It finds
// where the first occupied cells begin that the beam meets.
//
// Times. Along an axis, the beam is after time t between origin + t * slowest and origin + t * fastest of its rays. So
// it is between two planes from the time at which the fastest rays reach the first plane until the slowest ones have
// passed the second one; if rays go both ways, from when the first of them are there. The beam meets a cell where these
// intervals of all axes overlap. The kernel widens the beam by more than what the rays' own times are rounded by.
//
// Way. Nodes are taken depth first, children in the order in which the middle ray meets them. An iteration loads a node
// and finds which of its 64 children the beam meets before the earliest time so far. It notes them for later, or, where
// children are voxels or small compared with the beam, takes the first one's time. Then it goes to the next child of
// the deepest node that has any left. Children lie in their parents, in rounded times, too: a beam that ends at larger
// cells starts no later.
//
// A. Reshetov, A. Soupikov, J. Hurley, Multi-Level Ray Tracing Algorithm, 2005, find by such intervals where a tile's
// rays enter a kd-tree. S. Laine, T. Karras, Efficient Sparse Voxel Octrees, 2010, find times in an octree by a coarse
// picture, and may miss what falls between its rays.
//
// Needs the constants kNodeLevels, kEntriesPerWord and kIterationsMax: after as many iterations, children of any size
// count as small.
#ifndef ZVO_SHADERS_TRACE_BEAM_START_GLSL
#define ZVO_SHADERS_TRACE_BEAM_START_GLSL

#include "lib/half_node.glsl"
#include "lib/morton.glsl"
#include "lib/ray.glsl"
#include "shared/svdag.h"
#include "shared/trace.h"

struct Beam // inverse directions may have any sign, but are finite and not 0
{
    vec3 fast_origin;  // bound of the rays' origins, on the side of each axis to which the middle ray goes
    vec3 slow_origin;  // on the other side
    vec3 fast_inverse; // 1 / the bound of the rays' directions, on the same sides
    vec3 slow_inverse;
    vec2 small;        // cells are small whose edge is at most max(small.x * t, small.y) when the beam has left their node
};

struct MetChildren // of a node
{
    uvec2 children; // a bit each
    float first;    // when the beam meets the first one; kTraceTimeMax: there is none
    float last;     // when it has left the node
};

uint g_nodes[kNodeLevelsMax];     // the current node and those above it, by level
uvec2 g_children[kNodeLevelsMax]; // of these, still to be taken

// The intervals in which the beam is between the planes of each of the four layers of cells of a node along an axis.
void meetLayers(uint corner, uint size, float fast_origin, float slow_origin, float fast_inverse, float slow_inverse,
                out vec4 enter, out vec4 leave)
{
    bool upward = fast_inverse > 0.0;
    bool both_ways = upward != (slow_inverse > 0.0);
    uvec4 lower = corner + size * uvec4(0u, 1u, 2u, 3u);
    uvec4 first = lower + (upward ? 0u : size);
    uvec4 second = lower + (upward ? size : 0u);
    vec4 fast = (uintBitsToFloat(first) - fast_origin) * fast_inverse;
    vec4 slow = (uintBitsToFloat(second) - slow_origin) * slow_inverse;
    enter = both_ways ? max(fast, slow) : fast;
    leave = both_ways ? vec4(kTraceTimeMax) : slow;
}

// The children of a node that the beam meets until a time. mask: those that exist.
MetChildren meetChildren(Beam beam, uvec3 corner, uint size, uvec2 mask, float until)
{
    vec4 enter_x, enter_y, enter_z, leave_x, leave_y, leave_z;
    meetLayers(corner.x, size, beam.fast_origin.x, beam.slow_origin.x, beam.fast_inverse.x, beam.slow_inverse.x,
               enter_x, leave_x);
    meetLayers(corner.y, size, beam.fast_origin.y, beam.slow_origin.y, beam.fast_inverse.y, beam.slow_inverse.y,
               enter_y, leave_y);
    meetLayers(corner.z, size, beam.fast_origin.z, beam.slow_origin.z, beam.fast_inverse.z, beam.slow_inverse.z,
               enter_z, leave_z);
    MetChildren met;
    met.last = min(min(max(leave_x.x, leave_x.w), max(leave_y.x, leave_y.w)), max(leave_z.x, leave_z.w));
    enter_z = max(enter_z, kTraceTimeMin);
    leave_z = min(leave_z, until);
    uvec2 children = uvec2(0u);
    vec4 first = vec4(kTraceTimeMax);
    [[unroll]] for (uint i = 0u; i < 16u; ++i)
    {
        uint x = i & 3u;
        uint y = i >> 2;
        uint c = cellInBlock(uvec3(x, y, 0u)); // then c + 4, c + 32 and c + 36 along z
        vec4 enter = max(enter_z, max(enter_x[x], enter_y[y]));
        vec4 leave = min(leave_z, min(leave_x[x], leave_y[y]));
        bvec4 meets = lessThanEqual(enter, leave);
        uvec4 bits = mix(uvec4(0u), uvec4(1u, 16u, 1u, 16u) << c, meets) & mask.xxyy;
        children |= bits.xz | bits.yw;
        first = min(first, mix(vec4(kTraceTimeMax), enter, notEqual(bits, uvec4(0u))));
    }
    met.children = children;
    met.first = min(min(first.x, first.y), min(first.z, first.w));
    return met;
}

// The first of some children. mirror: the bits of a child's number that count backwards.
uint firstChild(uvec2 children, uint mirror)
{
    bool upper_first = (mirror & 32u) != 0u;
    bool upper = upper_first ? children.y != 0u : children.x == 0u;
    uint bits = upper ? children.y : children.x;
    uint child = upper ? 32u : 0u;
    [[unroll]] for (uint step = 16u; step != 0u; step >>= 1)
    {
        uint low = bits & ((1u << step) - 1u);
        uint high = bits >> step;
        bool take_high = (mirror & step) != 0u ? high != 0u : low == 0u;
        bits = take_high ? high : low;
        child += take_high ? step : 0u;
    }
    return child;
}

// The time at which the beam meets the first occupied cell; kTraceTimeMax if it meets none. mirror: as of firstChild(),
// for the middle ray; the result does not depend on it.
float beamStart(Beam beam, uint mirror)
{
    [[unroll]] for (uint k = 0u; k < kNodeLevels - 1u; ++k)
        g_children[k] = uvec2(0u);
    uvec3 corner = uvec3(floatBitsToUint(1.0));
    uint level = 0u;
    uint node = 0u;
    float start = kTraceTimeMax;
    uint iterations = 0u;
    for (bool go = true; go;)
    {
        ++iterations;
        uint size = 1u << (kRootShift - 2u * level);
        bool is_word = isLeafWord(node);
        uvec2 lower = loadHalf(is_word ? leafWord(node) : 2u * node);
        uvec2 upper = loadHalf(is_word ? leafWord(node) : 2u * node + 1u);
        uvec2 mask = uvec2(lower.x, is_word ? upper.y : upper.x);
        MetChildren met = meetChildren(beam, corner, size, mask, start);
        // A ray that stops at cells of this size, for a level of detail, does so before the beam has left the node.
        bool ends = level + 1u == kNodeLevels || iterations >= kIterationsMax ||
                    edgeOf(size) <= max(beam.small.x * met.last, beam.small.y);
        start = ends ? min(start, met.first) : start;

        // Note the children, and find the deepest node that has any.
        uint parent_level = 0u;
        uint parent = 0u;
        uvec2 children = uvec2(0u);
        [[unroll]] for (uint k = 0u; k < kNodeLevels - 1u; ++k)
        {
            g_nodes[k] = level == k ? node : g_nodes[k];
            g_children[k] = level == k && !ends ? met.children : g_children[k];
            bool any = (g_children[k].x | g_children[k].y) != 0u;
            parent_level = any ? k : parent_level;
            parent = any ? g_nodes[k] : parent;
            children = any ? g_children[k] : children;
        }
        go = (children.x | children.y) != 0u;

        // Go to its next child.
        uint child = firstChild(children, mirror);
        uvec2 taken = child < 32u ? uvec2(1u << child, 0u) : uvec2(0u, 1u << (child & 31u));
        [[unroll]] for (uint k = 0u; k < kNodeLevels - 1u; ++k)
            g_children[k] = parent_level == k ? children & ~taken : g_children[k];
        uvec2 half_node = loadHalf(2u * parent + (child >> 5));
        node = half_node.y + bitCount(half_node.x & ((1u << (child & 31u)) - 1u));
        if (kEntriesPerWord != 0u)
        {
            bool listed = go && int(node) < 0; // every beam loads an entry: lib/traverse.glsl says why
            uint named = loadEntry(listed ? node & ~kListFlags : 0u, kEntriesPerWord);
            node = listed ? named | (node & kLeafWords) : node;
        }
        uint shift = kRootShift - 2u * parent_level;
        corner = (corner & (~0u << (shift + 2u))) + (cellNumbered(child) << shift);
        level = parent_level + 1u;
    }
    return start;
}

#endif
