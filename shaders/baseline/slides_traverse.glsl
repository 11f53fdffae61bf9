// SPDX-License-Identifier: MIT
// The traversal of baseline/slides_trace.
// Needs its constants, params.nodes, params.root and params.depth.
#ifndef ZVO_SHADERS_BASELINE_SLIDES_TRAVERSE_GLSL
#define ZVO_SHADERS_BASELINE_SLIDES_TRAVERSE_GLSL

#include "baseline/slides.h"
#include "lib/bound.glsl"

// Of a node that is being visited; the bits of the child that the ray is in, or one of these.
const uint kNotBegun = 8u;
const uint kDone = 9u;

struct State
{
    uint node;
    vec3 begin; // times of the lower planes
    uint level; // 0: the root
    uint child;
    uint voxels; // before the node
};

const uint kOctantShift = 8u; // in a word of g_places, behind the level or the level and the child

const uint kStackSize = kPushChildren ? kSlidesChildrenMax : kSlidesStatesMax;
uint g_nodes[kStackSize];
vec3 g_begins[kStackSize];
uint g_places[kStackSize]; // level | child << kOctantShift; of pushed children: their octants
uint g_voxels[kStackSize];
uint g_size;

void push(State state, uint place)
{
    g_nodes[g_size] = state.node;
    g_begins[g_size] = state.begin;
    g_places[g_size] = state.level | (place << kOctantShift);
    g_voxels[g_size] = state.voxels;
    ++g_size;
}

// Takes the state on top, where there is one. place: as it was pushed.
State pop(out uint place)
{
    g_size -= g_size != 0u ? 1u : 0u;
    place = g_places[g_size] >> kOctantShift;
    return State(g_nodes[g_size], g_begins[g_size], g_places[g_size] & ((1u << kOctantShift) - 1u), kNotBegun,
                 g_voxels[g_size]);
}

float powerOfTwo(int exponent)
{
    return ldexp(1.0, exponent);
}

float least(vec3 v)
{
    return min(v.x, min(v.y, v.z));
}

float greatest(vec3 v)
{
    return max(v.x, max(v.y, v.z));
}

bvec3 bitsOf(uint child)
{
    return bvec3((child & 1u) != 0u, (child & 2u) != 0u, (child & 4u) != 0u);
}

uint bitsFrom(bvec3 bits)
{
    return (bits.x ? 1u : 0u) | (bits.y ? 2u : 0u) | (bits.z ? 4u : 0u);
}

// The times at which the ray crosses a node's planes.
struct Planes
{
    vec3 begin;
    vec3 middle;
    vec3 end;
};

Planes planesOf(State state, vec3 span)
{
    vec3 end = state.begin + span * powerOfTwo(-int(state.level));
    return Planes(state.begin, 0.5 * (state.begin + end), end);
}

// The child by whose lower planes the ray has passed when it enters the node.
uint firstChild(Planes planes)
{
    return bitsFrom(lessThan(planes.middle, vec3(greatest(planes.begin))));
}

vec3 beginOf(Planes planes, uint child)
{
    return mix(planes.begin, planes.middle, bitsOf(child));
}

vec3 endOf(Planes planes, uint child)
{
    return mix(planes.middle, planes.end, bitsOf(child));
}

// The bit of the plane by which the ray leaves a child.
uint leavingBit(vec3 end)
{
    return end.x < end.y ? (end.x < end.z ? 1u : 4u) : (end.y < end.z ? 2u : 4u);
}

#ifdef BOUND
TEXELS_1(0, nodes);

uint nodeWord(uint node, uint word)
{
    return texelFetch(texels1_nodes, int(node * kNodeWords + word)).x;
}
#else
uint nodeWord(uint node, uint word)
{
    return params.nodes.data[node * kNodeWords + word];
}
#endif

uint voxelsBefore(State state, uint octant)
{
    return kHasSums ? state.voxels + nodeWord(state.node, 9u + octant) : 0u;
}

State childState(State state, Planes planes, uint child, uint octant)
{
    return State(nodeWord(state.node, 1u + octant), beginOf(planes, child), state.level + 1u, kNotBegun,
                 voxelsBefore(state, octant));
}

struct Found
{
    bool hit;
    vec3 begin; // of the voxel
    uint64_t code;
    uint voxel;
    bool capped;
};

// A path as the Morton code of its voxel, with another octant at a level of nodes. Octants of deeper levels are those of
// an earlier path, until the ray goes down to them.
uint64_t withOctant(uint64_t path, uint level, uint octant)
{
    uint shift = 3u * (params.depth - 1u - level);
    return (path & ~(7ul << shift)) | (uint64_t(octant) << shift);
}

Found noneFound()
{
    return Found(false, vec3(0.0), 0ul, 0u, false);
}

void hitVoxel(State state, Planes planes, uint64_t path, uint child, uint octant, inout Found found)
{
    found.hit = true;
    found.begin = beginOf(planes, child);
    found.code = withOctant(path, state.level, octant);
    found.voxel = voxelsBefore(state, octant);
}

// Goes down to the next child, and keeps the state of the node.
Found descend(vec3 begin, vec3 span, uint ray_bits)
{
    Found found = noneFound();
    State state = State(params.root, begin, 0u, kNotBegun, 0u);
    uint64_t path = 0ul;
    g_size = 0u;
    uint iterations = 0u;
    bool go = true;
    for (; go;)
    {
        ++iterations;
        Planes planes = planesOf(state, span);
        bool done = state.child == kDone;
        uint child = state.child == kNotBegun ? firstChild(planes) : state.child & 7u;
        vec3 end = endOf(planes, child);
        uint leaving = leavingBit(end);
        bool last = (child & leaving) != 0u;
        uint octant = child ^ ray_bits;
        bool exists = !done && ((nodeWord(state.node, 0u) >> octant) & 1u) != 0u;
        bool is_voxel = state.level + 1u == params.depth;
        bool ahead = least(end) > 0.0;
        bool enters = exists && (ahead || !(kSkipBehind || is_voxel));
        state.child = last ? kDone : child | leaving;
        if (enters && is_voxel)
            hitVoxel(state, planes, path, child, octant, found);
        else if (enters)
        {
            State below = childState(state, planes, child, octant);
            if (!last || !kStopAtFarSide)
                push(state, state.child);
            path = withOctant(path, state.level, octant);
            state = below;
        }
        bool pops = !enters && (done || last);
        go = !found.hit && !(pops && g_size == 0u) && iterations < kSlidesIterationsMax;
        if (pops)
        {
            uint resumed;
            state = pop(resumed);
            state.child = resumed;
        }
    }
    found.capped = !found.hit && iterations == kSlidesIterationsMax;
    return found;
}

// Puts all children that the ray meets on the stack.
Found pushChildren(vec3 begin, vec3 span, uint ray_bits)
{
    Found found = noneFound();
    State state = State(params.root, begin, 0u, kNotBegun, 0u);
    uint64_t path = 0ul;
    g_size = 0u;
    uint iterations = 0u;
    bool go = true;
    for (; go;)
    {
        ++iterations;
        Planes planes = planesOf(state, span);
        uint mask = nodeWord(state.node, 0u);
        bool is_voxel = state.level + 1u == params.depth;
        uint child = firstChild(planes);
        uint met = 0u; // children to be entered, 3 bits each, the nearest in the lowest ones
        uint count = 0u;
        bool over = false;
        for (uint i = 0u; i < 4u && !(over && kStopAtFarSide); ++i)
        {
            vec3 end = endOf(planes, child);
            bool ahead = least(end) > 0.0 || !(kSkipBehind || is_voxel);
            if (!over && ahead && ((mask >> (child ^ ray_bits)) & 1u) != 0u)
            {
                met |= child << (3u * count);
                ++count;
            }
            uint leaving = leavingBit(end);
            over = over || (child & leaving) != 0u;
            child |= over ? leavingBit(mix(planes.middle, vec3(kTraceTimeMax), bitsOf(child))) : leaving;
        }
        if (is_voxel && count != 0u)
            hitVoxel(state, planes, path, met & 7u, (met & 7u) ^ ray_bits, found);
        for (; !is_voxel && count != 0u;)
        {
            --count;
            uint farthest = (met >> (3u * count)) & 7u;
            uint octant = farthest ^ ray_bits;
            push(childState(state, planes, farthest, octant), octant);
        }
        go = !found.hit && g_size != 0u && iterations < kSlidesIterationsMax;
        uint octant;
        state = pop(octant);
        path = withOctant(path, max(state.level, 1u) - 1u, octant);
    }
    found.capped = !found.hit && iterations == kSlidesIterationsMax;
    return found;
}

// origin, inverse: of a ray in unit space.
Found traverse(vec3 origin, vec3 inverse)
{
    uint node_levels = (params.depth + 1u) / 2u;
    const float lower = 1.0;
    float upper = lower + powerOfTwo(int(params.depth) - 2 * int(node_levels));
    bvec3 mirrored = lessThan(inverse, vec3(0.0));
    origin = mix(origin, lower + upper - origin, mirrored);
    inverse = abs(inverse);
    vec3 begin = (lower - origin) * inverse;
    vec3 end = (upper - origin) * inverse;
    Found found = noneFound();
    if (greatest(begin) <= least(end) && least(end) > 0.0)
    {
        if (kPushChildren)
            found = pushChildren(begin, end - begin, bitsFrom(mirrored));
        else
            found = descend(begin, end - begin, bitsFrom(mirrored));
    }
    return found;
}

#endif
