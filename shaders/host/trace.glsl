// SPDX-License-Identifier: MIT
// zvo/trace.glsl: rays through zvo's voxels in shaders of your own. docs/host-glsl.md has examples.
//
// One file, for any stage, with whatever bindings: it declares none. All its names begin with zvo_, all its macros with
// ZVO_. It needs #version 460, Vulkan 1.3 (glslangValidator --target-env vulkan1.3, glslc --target-env=vulkan1.3) and
// the features bufferDeviceAddress, scalarBlockLayout and shaderInt64. A shader includes it behind its own #extension
// lines; it turns on GL_EXT_buffer_reference, GL_EXT_buffer_reference2, GL_EXT_scalar_block_layout,
// GL_EXT_shader_explicit_arithmetic_types_int64 and GL_EXT_control_flow_attributes.
//
// A tree is the address of a zvo_TreeTable, 8 bytes in a push constant or wherever you like: declare it as
// zvo_TreeTable_ConstPtr, or make one of a uint64_t: zvo_TreeTable_ConstPtr(address). The table tells whether it is an
// octree, a DAG, or one of them with overlays, how deep it is and what format its attributes have: one shader traces
// all.
//
// World space, lengths in world units, t in lengths of the direction that is given (which may have any):
//   zvo_Hit zvo_trace(tree, origin, direction, t_min, t_max)          the first voxel on the way
//   bool zvo_occluded(tree, origin, direction, t_min, t_max)          whether there is one
//   vec3 zvo_position(tree, hit, origin, direction)                   where on the voxel's face
//   zvo_Surface zvo_surface(tree, hit, direction)                     what it looks like
//   float zvo_depth(view_projection, position)                        for gl_FragDepth, or to compare with depths
// What zvo_Hit says: zvo_isHit(hit), zvo_isUnfinished(hit), hit.t, zvo_hitCell(hit), zvo_hitLevel(hit),
// zvo_hitFace(hit): the axis, or zvo_kFaceInside.
//
// Light that is kept on the voxels (zvo::KeptLight), a zvo_KeptLightTable_ConstPtr by its address, as trees:
//   vec4 zvo_irradiance(light, tree, position, normal)                light that arrives at a surface, without a ray
//   vec4 zvo_keptRadiance(light, tree, hit, origin, direction)        light that comes from where a ray has hit
//   vec4 zvo_gatherIrradiance(light, tree, position, normal, rays, seed)     light that arrives, by rays
//   vec3 zvo_outside(light, direction)                                light from outside of the grid
//   float zvo_occlusion(tree, position, normal, rays, reach, seed)    the share of rays that meet nothing
//
// Unit space, in which the root's cube is [1, 2)^3: nothing is rounded on the way to the traversal. Hits are those of
// zvo's own kernels, bit for bit, and hits of theirs may be given to the functions above.
//   zvo_Ray zvo_unitRay(origin, direction, t_min, t_max)              both in unit space
//   zvo_Hit zvo_traceRay(tree, ray), bool zvo_occludedRay(tree, ray)
//   zvo_Hit zvo_resume(tree, ray, hit)                                a ray that was left unfinished
//   vec3 zvo_pixelOrigin(camera, orthographic, pixel, size), zvo_pixelDirection(...)   rays of a zvo_CameraRays
//   vec3 zvo_toUnit(tree, position), vec3 zvo_toWorld(tree, position), float zvo_unitEdge(tree)
//
// Colours: zvo_encodeSrgb, zvo_decodeSrgb, zvo_packColor8 (the bytes of zvo's pictures), zvo_develop (its tone curve).
//
// Define before the include, where it helps:
//   ZVO_GROUP             threads of the workgroup: rays keep their stack in shared memory, 32 bytes a thread, in place
//                         of registers. Compute shaders only.
//   ZVO_NODE_LEVELS       zvo_TreeTable::node_levels of all trees, a constant or a specialization constant: rays take
//                         registers for so many levels, not for the most that there can be. Other trees are traced
//                         wrongly.
//   ZVO_ENTRIES_PER_WORD  zvo_TreeTable::entries_per_word of all trees, likewise; 0 leaves out what only DAGs need.
//   ZVO_DETAIL            rays may stop at nodes that are small enough: zvo_traceDetail, zvo_traceRayDetail.
//   ZVO_ITERATIONS_MAX    iterations of a ray in one call, 40,000 by default: enough for any ray through 8192^3 voxels.
//
// Cost: of a ray, its iterations, which lead far where there is nothing; of a hit in a DAG, two or three loads a level
// of nodes beside that, which zvo_occluded saves; of zvo_surface, ten loads or so. Nothing here writes, waits or needs
// barriers of its own.
//
// Limits: a ray that uses up its iterations is unfinished, and counts as not occluded. A ray with numbers that are NaN,
// or infinite but for t_max, hits nothing. World space is single precision: a ray is rounded to 2^-23 of the root's
// cube, a voxel of a grid of 2^23 and a 64th of one of 2^17, and to the spacing of floats where it begins. A miss has
// no position and no surface: what zvo_position and zvo_surface return of it means nothing.
#ifndef ZVO_TRACE_GLSL
#define ZVO_TRACE_GLSL

#include "lib/attribute_formats.glsl"
#include "lib/camera.glsl"
#include "lib/color.glsl"
#include "lib/emission.glsl"
#include "lib/hit.glsl"
#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "lib/octree_half.glsl"
#include "lib/ray.glsl"
#include "lib/surface_normal.glsl"
#include "shared/tree_table.h"

// These are constants in zvo's kernels (lib/traverse.glsl). Here trees differ, so setTree() sets those that are
// variables.
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
#ifdef ZVO_GROUP
#define TRAVERSE_GROUP ZVO_GROUP
const uint kStack = kStackShared;
#else
const uint kStack = kStackRegisters;
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
#include "lib/ranks.glsl"

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

// Computes the index of a hit's attributes from the number of the voxel in its leaf, which is all that a traversal of a
// DAG knows; as trace/ranks does.
uint rankOf(TreeTable_ConstPtr tree, Traversal met)
{
    RankSource source = RankSource(tree.data[0].source.pool, tree.data[0].source.before,
                                   tree.data[0].source.voxels_before_leaf, tree.data[0].source.first_short_entry);
    BeforeChild_ConstPtr overlay_ranks = tree.data[0].overlay_ranks;
    RankedNode at = RankedNode(0u, 0u, 0u);
    bool in_overlay = uint64_t(overlay_ranks) != 0ul;
    for (uint level = 1u; level <= met.level && level + 1u < kNodeLevels; ++level)
    {
        uint child = cellInBlock(met.cell >> (2u * (met.level - level)));
        in_overlay = in_overlay && descendInOverlay(source, overlay_ranks, child, at);
        if (!in_overlay)
            descend(source, child, at);
    }
    if (met.level + 1u >= kNodeLevels)
    {
        uint leaf = cellInBlock(met.cell >> (2u * (met.level + 1u - kNodeLevels)));
        in_overlay = in_overlay && descendInOverlay(source, overlay_ranks, leaf, at);
        if (!in_overlay)
            descendToLeaf(source, leaf, true, at);
    }
    uint voxel = met.index + (in_overlay ? 0u : at.voxels);
    uint node = in_overlay ? at.node + tree.data[0].attribute_offset : at.rank;
    return met.level == kNodeLevels ? voxel : node;
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

// The same with edges in world units.
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
vec3 emissionOf(TreeTable_ConstPtr tree, uint voxel)
{
    uvec2_ConstPtr words = tree.data[0].emission_words;
    vec3 radiance = vec3(0.0);
    if (uint64_t(words) != 0ul && ((words.data[voxel >> 5].x >> (voxel & 31u)) & 1u) != 0u)
        radiance =
            tree.data[0].emission_scale * decodeRgb9e5(tree.data[0].emission.data[emissionIndex(words, voxel)]);
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
            surface.emission = emissionOf(tree, hit.index);
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

#include "host/kept_light.glsl"

#endif
