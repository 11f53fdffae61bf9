// SPDX-License-Identifier: MIT
// Rays through any tree by its table, and what they hit: a part of host/trace.glsl, which says how it is used.
#ifndef ZVO_SHADERS_TRACE_ANY_TREE_GLSL
#define ZVO_SHADERS_TRACE_ANY_TREE_GLSL

#include "lib/attribute_formats.glsl"
#include "lib/camera.glsl"
#include "lib/color.glsl"
#include "lib/emission.glsl"
#include "lib/half_node.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"
#include "lib/normal.glsl"
#include "shared/trace.h"
#include "shared/tree_table.h"

// These are constants in zvo's kernels (lib/traverse.glsl). Here trees differ, so setTree() sets those that are
// variables. A kernel of zvo's that defines TREE_CONSTANTS, and the two macros, declares the first two.
#ifndef TREE_CONSTANTS
#ifdef ZVO_NODE_LEVELS
const uint kNodeLevels = ZVO_NODE_LEVELS;
#else
uint kNodeLevels;
#define TRAVERSE_LEVELS kNodeLevelsMax
#endif
#ifdef ZVO_ENTRIES_PER_WORD
const uint kEntriesPerWord = ZVO_ENTRIES_PER_WORD;
#else
uint kEntriesPerWord;
#endif
#endif
#ifdef ZVO_DETAIL
const bool kDetail = true;
#else
const bool kDetail = false;
#endif
#ifndef ZVO_ITERATIONS_MAX
#define ZVO_ITERATIONS_MAX kTraceIterationsMax
#endif
const uint kIterationsMax = ZVO_ITERATIONS_MAX;

#include "lib/traverse.glsl"
#include "trace/hit_rank.glsl"

const vec3 kPlainColor = vec3(0.6); // used for trees without attributes

// The appearance of a hit. Vectors are in world space.
struct zvo_Surface
{
    vec3 base_color;  // linear, 0 to 1
    vec3 normal;      // of the surface that was voxelized, length 1; turned to the side that the ray came from
    vec3 face_normal; // of the voxel's face; against the ray if that began inside
    vec3 emission;    // radiance
    vec3 middle;      // of the voxel
    float edge;       // of the voxel, world units
    uvec3 cell;       // coordinates of the voxel, or of the node among those of its level
    bool is_voxel;    // not a node at which a level of detail stopped
    bool is_inside;   // the ray began inside
    bool is_dynamic;  // in a leaf, or a node, that a dynamic object or a brush has changed; false without attributes
};

// Edge of the root's cube in world units, which is 1 in unit space.
float zvo_unitEdge(TreeTable_ConstPtr tree)
{
    return tree.data[0].voxel_size * float(1u << (2u * tree.data[0].node_levels));
}

vec3 zvo_toUnit(TreeTable_ConstPtr tree, vec3 position)
{
    precise vec3 unit = 1.0 + (position - tree.data[0].origin) / zvo_unitEdge(tree);
    return unit;
}

vec3 zvo_toWorld(TreeTable_ConstPtr tree, vec3 position)
{
    precise vec3 world = tree.data[0].origin + (position - 1.0) * zvo_unitEdge(tree);
    return world;
}

Ray zvo_unitRay(vec3 origin, vec3 direction, float t_min, float t_max)
{
    return Ray(origin, t_min, inverseDirection(direction), t_max);
}

// Converts a world-space ray to unit space; t is unchanged.
Ray toUnitRay(TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float t_min, float t_max)
{
    precise vec3 unit_direction = direction / zvo_unitEdge(tree);
    return zvo_unitRay(zvo_toUnit(tree, origin), unit_direction, t_min, t_max);
}

// Origin and direction of a pixel's ray in unit space, as in zvo's pictures. pixel: from the top left of a picture of
// that size.
vec3 zvo_pixelOrigin(CameraRays camera, bool orthographic, uvec2 pixel, uvec2 size)
{
    vec3 offset = rayOffset(pixelOffset(pixel, size), camera.half_pixel_x, camera.half_pixel_y);
    precise vec3 origin = camera.origin + (orthographic ? offset : vec3(0.0));
    return origin;
}

vec3 zvo_pixelDirection(CameraRays camera, bool orthographic, uvec2 pixel, uvec2 size)
{
    vec3 offset = rayOffset(pixelOffset(pixel, size), camera.half_pixel_x, camera.half_pixel_y);
    precise vec3 direction = camera.forward + (orthographic ? vec3(0.0) : offset);
    return direction;
}

// Selects the tree for the rays that follow.
void setTree(TreeTable_ConstPtr tree)
{
    g_halves = uint64_t_ConstPtr(uint64_t(tree.data[0].source.pool));
    g_leaf_groups = uint64_t_ConstPtr(uint64_t(tree.data[0].source.before));
#ifndef ZVO_NODE_LEVELS
    kNodeLevels = tree.data[0].node_levels;
#endif
#ifndef ZVO_ENTRIES_PER_WORD
    kEntriesPerWord = tree.data[0].entries_per_word;
#endif
}

// An invalid ray, or one through a tree without nodes, is replaced by one that ends before it starts.
Traversal traverseTree(TreeTable_ConstPtr tree, Ray ray, vec2 detail, uvec3 from)
{
    setTree(tree);
    bool valid = isTraceable(ray) && uint64_t(g_halves) != 0ul;
    return traverse(valid ? ray.origin : vec3(0.0), valid ? ray.inverse_direction : vec3(1.0), valid ? ray.t_min : 1.0,
                    valid ? ray.t_max : 0.0, detail, from, kIterationsMax);
}

// The index of a hit's attributes.
uint rankOf(TreeTable_ConstPtr tree, Traversal met)
{
    RankSource source = RankSource(tree.data[0].source.pool, tree.data[0].source.before,
                                   tree.data[0].source.voxels_before_leaf, tree.data[0].source.first_short_entry);
    BeforeChild_ConstPtr overlay_ranks = tree.data[0].overlay_ranks;
    return attributeIndex(source, overlay_ranks, uint64_t(overlay_ranks) != 0ul, tree.data[0].attribute_offset,
                          met.cell, met.level, met.index);
}

Hit toHit(TreeTable_ConstPtr tree, Traversal met)
{
    uint index = met.unfinished ? kHitUnfinished : kHitMiss;
    if (met.hit)
    {
        index = met.index;
        if (kEntriesPerWord != 0u && kNodeLevels > 1u && uint64_t(tree.data[0].source.voxels_before_leaf) != 0ul)
            index = rankOf(tree, met);
    }
    return Hit(met.t, index, unpackUint2x32(packHitCell(met.cell, met.level, met.face)));
}

bool zvo_isHit(Hit hit)
{
    return hit.index < kHitUnfinished;
}

// The ray used up its iterations: zvo_resume() resumes it.
bool zvo_isUnfinished(Hit hit)
{
    return hit.index == kHitUnfinished;
}

Hit zvo_traceRay(TreeTable_ConstPtr tree, Ray ray)
{
    return toHit(tree, traverseTree(tree, ray, vec2(0.0), uvec3(0u)));
}

bool zvo_occludedRay(TreeTable_ConstPtr tree, Ray ray)
{
    return traverseTree(tree, ray, vec2(0.0), uvec3(0u)).hit;
}

// Resumes the same ray. Best done in another dispatch, as some devices count the iterations of an invocation.
Hit zvo_resume(TreeTable_ConstPtr tree, Ray ray, Hit hit)
{
    return toHit(tree, traverseTree(tree, ray, vec2(0.0), limitsAfter(hit.t, hitFace(hit))));
}

// The first voxel that the ray enters, or begins in, at t_min to t_max.
Hit zvo_trace(TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float t_min, float t_max)
{
    return zvo_traceRay(tree, toUnitRay(tree, origin, direction, t_min, t_max));
}

bool zvo_occluded(TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float t_min, float t_max)
{
    return zvo_occludedRay(tree, toUnitRay(tree, origin, direction, t_min, t_max));
}

#ifdef ZVO_DETAIL
// Nodes count as occupied whose edge is at most max(detail.x * t, detail.y), in unit space.
Hit zvo_traceRayDetail(TreeTable_ConstPtr tree, Ray ray, vec2 detail)
{
    return toHit(tree, traverseTree(tree, ray, detail, uvec3(0u)));
}

// In world space: nodes count as occupied whose edge is at most max(detail.x * t, detail.y), in world units.
Hit zvo_traceDetail(TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float t_min, float t_max, vec2 detail)
{
    return zvo_traceRayDetail(tree, toUnitRay(tree, origin, direction, t_min, t_max), detail / zvo_unitEdge(tree));
}
#endif

// Edge of a hit's cell in world units.
float cellEdge(TreeTable_ConstPtr tree, Hit hit)
{
    return tree.data[0].voxel_size * float(1u << (2u * (tree.data[0].node_levels - hitLevel(hit))));
}

// The point of a hit in world space: exactly on the face by which the ray entered, or inside of the voxel if it began
// there. origin, direction: of the ray in world space.
vec3 zvo_position(TreeTable_ConstPtr tree, Hit hit, vec3 origin, vec3 direction)
{
    float edge = cellEdge(tree, hit);
    vec3 low = tree.data[0].origin + edge * vec3(hitCell(hit));
    vec3 high = tree.data[0].origin + edge * vec3(hitCell(hit) + 1u);
    vec3 point = clamp(origin + hit.t * direction, low, high);
    vec3 entry = mix(low, high, lessThan(direction, vec3(0.0)));
    return mix(point, entry, equal(uvec3(hitFace(hit)), uvec3(0u, 1u, 2u)));
}

// The radiance of a voxel that may emit.
vec3 emissionOrNone(TreeTable_ConstPtr tree, uint voxel)
{
    uvec2_ConstPtr words = tree.data[0].emission_words;
    vec3 radiance = vec3(0.0);
    if (uint64_t(words) != 0ul && isEmissive(words, voxel))
        radiance = emissionOf(tree, voxel);
    return radiance;
}

// direction: of the ray that hit, in world or unit space, of any length. Without attributes, or at a node of a tree
// without attributes of nodes, the colour is grey and the normal is the face's.
zvo_Surface zvo_surface(TreeTable_ConstPtr tree, Hit hit, vec3 direction)
{
    zvo_Surface surface;
    surface.cell = hitCell(hit);
    surface.edge = cellEdge(tree, hit);
    surface.middle = tree.data[0].origin + surface.edge * (vec3(surface.cell) + 0.5);
    surface.is_voxel = hitLevel(hit) == tree.data[0].node_levels;
    surface.is_inside = hitFace(hit) == kFaceInside;
    surface.is_dynamic = false;
    surface.face_normal = faceNormal(hitFace(hit), direction);
    surface.base_color = kPlainColor;
    surface.normal = surface.face_normal;
    surface.emission = vec3(0.0);
    uint format = tree.data[0].attribute_format;
    Attribute_ConstPtr voxels = tree.data[0].attributes;
    Attribute_ConstPtr nodes = tree.data[0].node_attributes;
    if (zvo_isHit(hit) && format != kFormatNone && (surface.is_voxel || uint64_t(nodes) != 0ul))
    {
        Attribute stored = readAttribute(format, surface.is_voxel, voxels, nodes, hit.index);
        surface.base_color = decodeSrgb(unpackUnorm4x8(stored.color).rgb);
        surface.normal = shadingNormal(stored.normal, surface.face_normal, direction);
        surface.is_dynamic =
            hit.index >= (surface.is_voxel ? tree.data[0].first_dynamic_voxel : tree.data[0].first_dynamic_node);
        if (surface.is_voxel && (format != kFormat8 || ((stored.color >> 24) & kAttributeEmissive) != 0u))
            surface.emission = emissionOrNone(tree, hit.index);
    }
    return surface;
}

// The depth that a rasterizer gives a point in world space, for viewports with a depth range of 0 to 1. The matrix
// decides the convention, from near to far or reversed. The point must be in front of the camera.
float zvo_depth(mat4 view_projection, vec3 position)
{
    vec4 clip = view_projection * vec4(position, 1.0);
    return clip.z / clip.w;
}

#endif
