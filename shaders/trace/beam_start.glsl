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
// Lanes. A thread takes a beam or, on devices with threads to spare, several do: its lanes, which stand side by side in
// a subgroup. Each takes a part of a node's children, consecutive ones, and notes those alone. In each iteration they
// agree on the time, and on the next child, so that the way is the same for any number of lanes.
//
// Needs the constants kNodeLevels, kEntriesPerWord, kLanes and kIterationsMax: after as many iterations, children of any
// size count as small.
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

struct MetChildren // of a lane's part of a node
{
    uvec2 children; // a bit each
    float first;    // when the beam meets the first one; kTraceTimeMax: there is none
    float last;     // when it has left the node
};

const uint kPart = 64u / kLanes; // children of a lane
// Layers of cells along each axis that they lie in.
const uvec3 kLayers = uvec3(kLanes <= 4u ? 4u : 2u, kLanes <= 2u ? 4u : 2u, kLanes == 1u ? 4u : kLanes <= 8u ? 2u : 1u);

uint g_nodes[kNodeLevelsMax]; // the current node and those above it, by level
uint g_lower[kNodeLevelsMax]; // of the lane's parts of these, children still to be taken
uint g_upper[kNodeLevelsMax]; // likewise, from the 32nd child of a part on

uint laneOfBeam()
{
    return gl_SubgroupInvocationID & (kLanes - 1u);
}

// The least value of a beam's lanes.
uint leastOfLanes(uint value)
{
    if (kLanes > 1u)
        value = min(value, subgroupShuffleXor(value, 1u));
    if (kLanes > 2u)
        value = min(value, subgroupShuffleXor(value, 2u));
    if (kLanes > 4u)
        value = min(value, subgroupShuffleXor(value, 4u));
    if (kLanes > 8u)
        value = min(value, subgroupShuffleXor(value, 8u));
    return value;
}

// The intervals in which the beam is between the planes of each of four layers of cells along an axis.
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

void meetAllLayers(Beam beam, uvec3 corner, uint size, out vec4 enter_x, out vec4 enter_y, out vec4 enter_z,
                   out vec4 leave_x, out vec4 leave_y, out vec4 leave_z)
{
    meetLayers(corner.x, size, beam.fast_origin.x, beam.slow_origin.x, beam.fast_inverse.x, beam.slow_inverse.x,
               enter_x, leave_x);
    meetLayers(corner.y, size, beam.fast_origin.y, beam.slow_origin.y, beam.fast_inverse.y, beam.slow_inverse.y,
               enter_y, leave_y);
    meetLayers(corner.z, size, beam.fast_origin.z, beam.slow_origin.z, beam.fast_inverse.z, beam.slow_inverse.z,
               enter_z, leave_z);
}

// The children of the lane's part of a node that the beam meets until a time. mask: those that exist.
MetChildren meetChildren(Beam beam, uvec3 corner, uint size, uvec2 mask, float until)
{
    vec4 enter_x, enter_y, enter_z, leave_x, leave_y, leave_z;
    meetAllLayers(beam, corner, size, enter_x, enter_y, enter_z, leave_x, leave_y, leave_z);
    MetChildren met;
    met.last = min(min(max(leave_x.x, leave_x.w), max(leave_y.x, leave_y.w)), max(leave_z.x, leave_z.w));
    if (kLanes != 1u)
        meetAllLayers(beam, corner + size * cellNumbered(laneOfBeam() * kPart), size, enter_x, enter_y, enter_z,
                      leave_x, leave_y, leave_z);
    enter_z = max(enter_z, kTraceTimeMin);
    leave_z = min(leave_z, until);
    uvec2 children = uvec2(0u);
    vec4 first = vec4(kTraceTimeMax);
    [[unroll]] for (uint i = 0u; i < 16u; ++i)
    {
        uint x = i & 3u;
        uint y = i >> 2;
        uvec2 in_part = x < kLayers.x && y < kLayers.y ? mask : uvec2(0u);
        uint c = cellInBlock(uvec3(x, y, 0u)); // then c + 4, c + 32 and c + 36 along z
        vec4 enter = max(enter_z, max(enter_x[x], enter_y[y]));
        vec4 leave = min(leave_z, min(leave_x[x], leave_y[y]));
        bvec4 meets = lessThanEqual(enter, leave);
        uvec4 bits = mix(uvec4(0u), uvec4(1u, kLayers.z > 1u ? 16u : 0u, 1u, 16u) << c, meets) & in_part.xxyy;
        children |= bits.xz | bits.yw;
        first = min(first, mix(vec4(kTraceTimeMax), enter, notEqual(bits, uvec4(0u))));
    }
    met.children = children;
    met.first = min(min(first.x, first.y), min(first.z, first.w));
    return met;
}

// The first of some children of a part. mirror: the bits of a child's number that count backwards.
uint firstChild(uvec2 children, uint mirror)
{
    bool upper_first = (mirror & 32u) != 0u;
    bool upper = kLanes == 1u && (upper_first ? children.y != 0u : children.x == 0u);
    uint bits = upper ? children.y : children.x;
    uint child = upper ? 32u : 0u;
    [[unroll]] for (uint step = 16u; step != 0u; step >>= 1)
    {
        if (step < kPart)
        {
            uint low = bits & ((1u << step) - 1u);
            uint high = bits >> step;
            bool take_high = (mirror & step) != 0u ? high != 0u : low == 0u;
            bits = take_high ? high : low;
            child += take_high ? step : 0u;
        }
    }
    return child;
}

// Which children of the lane's part of a node exist.
uvec2 loadPart(uint node)
{
    bool is_word = isLeafWord(node);
    if (kLanes != 1u)
    {
        uint first = laneOfBeam() * kPart;
        uvec2 half_node = loadHalf(is_word ? leafWord(node) : 2u * node + first / 32u);
        uint bits = is_word && first >= 32u ? half_node.y : half_node.x;
        return uvec2(bitfieldExtract(bits, int(first % 32u), int(kPart)), 0u);
    }
    uvec2 lower = loadHalf(is_word ? leafWord(node) : 2u * node);
    uvec2 upper = loadHalf(is_word ? leafWord(node) : 2u * node + 1u);
    return uvec2(lower.x, is_word ? upper.y : upper.x);
}

// The time at which the beam meets the first occupied cell; kTraceTimeMax if it meets none. mirror: as of firstChild(),
// for the middle ray; the result does not depend on it.
float beamStart(Beam beam, uint mirror)
{
    [[unroll]] for (uint k = 0u; k < kNodeLevels - 1u; ++k)
    {
        g_lower[k] = 0u;
        g_upper[k] = 0u;
    }
    uvec3 corner = uvec3(floatBitsToUint(1.0));
    uint level = 0u;
    uint node = 0u;
    float start = kTraceTimeMax;
    uint iterations = 0u;
    for (bool go = true; go;)
    {
        ++iterations;
        uint size = 1u << (kRootShift - 2u * level);
        uvec2 mask = loadPart(node);
        MetChildren met = meetChildren(beam, corner, size, mask, start);
        // A ray that stops at cells of this size, for a level of detail, does so before the beam has left the node.
        bool ends = level + 1u == kNodeLevels || iterations >= kIterationsMax ||
                    edgeOf(size) <= max(beam.small.x * met.last, beam.small.y);
        float first = uintBitsToFloat(leastOfLanes(floatBitsToUint(met.first))); // times are not negative
        start = ends ? min(start, first) : start;

        // Note the children, and find the deepest node that has any.
        uint parent_level = 0u;
        uint parent = 0u;
        uvec2 children = uvec2(0u);
        [[unroll]] for (uint k = 0u; k < kNodeLevels - 1u; ++k)
        {
            g_nodes[k] = level == k ? node : g_nodes[k];
            bool notes = level == k && !ends;
            g_lower[k] = notes ? met.children.x : g_lower[k];
            if (kLanes == 1u)
                g_upper[k] = notes ? met.children.y : g_upper[k];
            bool any = (g_lower[k] | g_upper[k]) != 0u;
            parent_level = any ? k : parent_level;
            parent = any ? g_nodes[k] : parent;
            children = any ? uvec2(g_lower[k], g_upper[k]) : children;
        }
        go = (children.x | children.y) != 0u;

        // Go to its next child.
        uint child = firstChild(children, mirror);
        uvec2 left = children & ~(child < 32u ? uvec2(1u << child, 0u) : uvec2(0u, 1u << (child & 31u)));
        uint own_level = parent_level;
        if (kLanes != 1u)
        {
            // The deepest node comes first, then its children by their place on the middle ray's way.
            child += laneOfBeam() * kPart;
            uint own = go ? (kNodeLevels - own_level) * 64u + (child ^ mirror) : ~0u;
            uint taken = leastOfLanes(own);
            left = own == taken ? left : children;
            go = taken != ~0u;
            child = (taken & 63u) ^ mirror;
            parent_level = kNodeLevels - (taken >> 6);
            [[unroll]] for (uint k = 0u; k < kNodeLevels - 1u; ++k)
                parent = parent_level == k ? g_nodes[k] : parent;
        }
        [[unroll]] for (uint k = 0u; k < kNodeLevels - 1u; ++k)
        {
            g_lower[k] = own_level == k ? left.x : g_lower[k];
            if (kLanes == 1u)
                g_upper[k] = own_level == k ? left.y : g_upper[k];
        }
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
