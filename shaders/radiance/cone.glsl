// SPDX-License-Identifier: MIT
// Light through a cone (C. Crassin et al., Interactive Indirect Illumination Using Voxel Cone Tracing, 2011).
// Needs params.faces and params.run_count, and trace/any_tree.glsl with ZVO_DETAIL.
#ifndef ZVO_SHADERS_RADIANCE_CONE_GLSL
#define ZVO_SHADERS_RADIANCE_CONE_GLSL

#include "lib/attribute_formats.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/ray.glsl"
#include "lib/sampling.glsl"
#include "radiance/face_table.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/cached_faces.h"
#include "shared/trace.h"
#include "shared/tree_table.h"
#include "trace/any_tree.glsl"

#ifndef ZVO_DETAIL
#error "radiance/cone.glsl needs ZVO_DETAIL"
#endif

const uint kConeSteps = 32u;             // nodes that a cone meets or leaves, at most
const float kConeStep = 0.01;            // out of a node, in voxels
const float kConeThrough = 1.0 / 64.0;   // of its light, at which a cone ends
const float kNodeOfCone = 1.0;           // the widest nodes, in radii of the cone: wider ones reach far out of it

// The share of the 4x4 columns of a node along an axis in which it has children, of its mask.
float coverageAlong(uvec2 mask, uint axis)
{
    uvec2 x = mask | (mask >> 1);
    x = (x | (x >> 8)) & 0x00550055u;
    uvec2 y = mask | (mask >> 2);
    y = (y | (y >> 16)) & 0x00003333u;
    uint z = mask.x | mask.y;
    z = (z | (z >> 4)) & 0x0F0F0F0Fu;
    int columns = axis == 0u   ? bitCount(x.x) + bitCount(x.y)
                  : axis == 1u ? bitCount(y.x) + bitCount(y.y)
                               : bitCount(z);
    return float(columns) / 16.0;
}

// Along all three.
vec3 coverageOf(uvec2 mask)
{
    return vec3(coverageAlong(mask, 0u), coverageAlong(mask, 1u), coverageAlong(mask, 2u));
}

// The share of the cross-sections of a node along the axes that what is in it covers, of the masks of the node and of
// its children. cell: of the node, among those of its level.
vec3 coverageOfNode(TreeTable_ConstPtr tree, uvec3 cell, uint level)
{
    Node_ConstPtr pool = tree.data[0].source.pool;
    uint reference = 0u;
    for (uint l = 1u; l <= level; ++l)
    {
        uint index = childIndex(loadInner(pool, reference), cellInBlock(cell >> (2u * (level - l))));
        reference = listedChild(pool, index, kEntriesPerWord);
    }
    uvec2 mask = nodeMask(pool, reference);
    vec3 blocks = coverageOf(mask);
    if (level + 1u >= kNodeLevels)
        return blocks;
    Node node = loadInner(pool, reference);
    vec3 covered = vec3(0.0);
    while (mask != uvec2(0u))
    {
        uint child = mask.x != 0u ? uint(findLSB(mask.x)) : 32u + uint(findLSB(mask.y));
        mask = mask.x != 0u ? uvec2(mask.x & (mask.x - 1u), mask.y) : uvec2(0u, mask.y & (mask.y - 1u));
        uint below = listedChild(pool, childIndex(node, child), kEntriesPerWord);
        covered += coverageOf(nodeMask(pool, below)) / 16.0;
    }
    return min(blocks, covered); // children behind each other count twice where they do not fill their columns
}

// Light of the faces of a node, or of a voxel, that are towards where a ray comes from, by the squares of the
// components of its direction (length 1): of white ones. Where there are none, that of the least brick around it.
// voxel: the cell of one where the ray enters it.
vec3 lightAgainst(uvec3 cell, uint level, uvec3 voxel, vec3 direction)
{
    uint known_level = min(level, kBrickLevels);
    // Far nodes are larger than bricks.
    uvec3 first = cell << (2u * (level - known_level));
    uvec3 last = first + (1u << (2u * (level - known_level))) - 1u;
    uvec3 known_cell = clamp(voxel >> (2u * known_level), first, last);
    vec4 sum = vec4(0.0);
    for (uint up = known_level; up <= kBrickLevels && sum.w == 0.0; ++up)
        for (uint axis = 0u; axis < 3u; ++axis)
        {
            float component = axis == 0u ? direction.x : axis == 1u ? direction.y : direction.z;
            CachedFace face;
            uint slot = findFace(known_cell >> (2u * (up - known_level)), axis + (component > 0.0 ? 3u : 0u), up, face);
            bool found = slot != kNoFace && cachedWeight(face.light) != 0u;
            sum += found ? component * component * vec4(cachedRadiance(face.light), 1.0) : vec4(0.0);
        }
    return sum.w > 0.0 ? sum.rgb / sum.w : vec3(0.0);
}

// When a ray enters, and leaves, a cube: x and y.
vec2 timesOfCube(vec3 middle, float edge, vec3 origin, vec3 direction)
{
    vec3 inverse = inverseDirection(direction);
    vec3 low = (middle - 0.5 * edge - origin) * inverse;
    vec3 high = (middle + 0.5 * edge - origin) * inverse;
    vec3 enters = min(low, high);
    vec3 leaves = max(low, high);
    return vec2(max(enters.x, max(enters.y, enters.z)), min(leaves.x, min(leaves.y, leaves.z)));
}

// The emission of what a ray towards a random place in a node meets in it; its mean over rays is that of the node. The
// node's middle and edge are those of its surface.
vec3 emissionInNode(TreeTable_ConstPtr tree, Hit hit, zvo_Surface node, vec3 origin, uint seed)
{
    if (uint64_t(tree.data[0].emission_words) == 0ul)
        return vec3(0.0);
    uint format = tree.data[0].attribute_format;
    Attribute_ConstPtr nodes = tree.data[0].node_attributes;
    if (format == kFormat8 && uint64_t(nodes) != 0ul)
    {
        Attribute mean = readAttribute(format, false, nodes, nodes, hit.index);
        if (((mean.color >> 24) & kAttributeEmissive) == 0u)
            return vec3(0.0);
    }
    vec3 place = vec3(samplePair(0u, seed, 0u), samplePair(0u, seed, 1u).x) - 0.5;
    vec3 towards = node.middle + node.edge * place - origin;
    vec2 times = timesOfCube(node.middle, node.edge, origin, towards);
    Hit voxel = zvo_trace(tree, origin, towards, max(times.x, 0.0), times.y);
    return zvo_isHit(voxel) ? emissionOrNone(tree, voxel.index) : vec3(0.0);
}

// A ray that goes on at t may be in a node that it has entered before, and of which it has met smaller ones: as a whole
// the node would count them again. x: the edge of nodes that may count, at most. y: until when. edge_max: of nodes that
// are not too wide at t.
vec2 nodesEnteredAt(TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float t, float edge_max)
{
    float edge = tree.data[0].voxel_size;
    vec3 point = origin + t * direction - tree.data[0].origin;
    float since = t - 4.0 * kConeStep * edge;
    for (float wider = 4.0 * edge; wider <= edge_max; wider *= 4.0)
    {
        vec3 middle = tree.data[0].origin + wider * (floor(point / wider) + 0.5);
        vec2 times = timesOfCube(middle, wider, origin, direction);
        if (times.x < since)
            return vec2(edge, times.y);
        edge = wider;
    }
    return vec2(edge, kTraceTimeMax);
}

// The light that comes through a cone, of the voxels and nodes that the ray along its axis meets: nodes that are up to
// half as wide as the cone, which let through the share of it that they do not cover. direction: length 1. spread: the
// tangent of the angle from the axis to the rim. seed: of rays to lamps. w: the share of the cone that has met nothing.
vec4 lightThroughCone(TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float spread, float t_max, uint seed)
{
    float voxel = tree.data[0].voxel_size;
    t_max = min(t_max, kTraceTimeMax);
    vec3 sum = vec3(0.0);
    float through = 1.0;
    float t = 0.0;
    for (uint i = 0u; i < kConeSteps && through > kConeThrough && t < t_max; ++i)
    {
        vec2 entered = nodesEnteredAt(tree, origin, direction, t, min(kNodeOfCone * spread * t, zvo_unitEdge(tree)));
        bool is_limited = entered.y < kTraceTimeMax;
        vec2 detail = is_limited ? vec2(0.0, entered.x) : vec2(kNodeOfCone * spread, voxel);
        Hit hit = zvo_traceDetail(tree, origin, direction, t, min(t_max, entered.y), detail);
        if (!zvo_isHit(hit))
        {
            t = entered.y + kConeStep * voxel;
            continue;
        }
        zvo_Surface surface = zvo_surface(tree, hit, direction);
        vec2 times = timesOfCube(surface.middle, surface.edge, origin, direction);
        uint level = tree.data[0].node_levels - hitLevel(hit);
        float coverage = 1.0;
        if (!surface.is_voxel)
        {
            coverage = dot(direction * direction, coverageOfNode(tree, surface.cell, hitLevel(hit)));
            vec3 emission = emissionInNode(tree, hit, surface, origin, hashPair(seed, i));
            surface.emission = emission / max(coverage, 1.0 / 16.0);
        }
        vec3 enters = (origin + hit.t * direction - tree.data[0].origin) / voxel;
        vec3 against = lightAgainst(surface.cell, level, uvec3(max(enters, vec3(0.0))), direction);
        vec3 light = surface.emission + surface.base_color * against;
        sum += through * coverage * light;
        through *= 1.0 - coverage;
        t = max(times.y, hit.t) + kConeStep * voxel;
    }
    // What too many nodes have let through has not met nothing.
    return vec4(sum, t >= t_max && through > kConeThrough ? through : 0.0);
}

#endif
