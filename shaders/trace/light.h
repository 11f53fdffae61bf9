// SPDX-License-Identifier: MIT
// What the kernels for the light at hits, and for pictures of hits, share with the host.
#ifndef ZVO_SHADERS_TRACE_LIGHT_H
#define ZVO_SHADERS_TRACE_LIGHT_H

#include "shared/sky.h"
#include "trace/trace.h"

GPU_ENUM(TexelFormat) // kTexelRgba8 and so on
#define GPU_TYPE_TexelFormat uint
GPU_ENUM(View) // kViewColor and so on
#define GPU_TYPE_View uint

GPU_NAMESPACE_BEGIN

const uint kSkyRows = 8u;   // pixels that a thread of trace/sky takes: one division finds their column
const uint kSkyGroup = 64u; // threads of a workgroup of trace/sky

// The light that arrives at a hit. Each part: 0 is none, 255 is all.
const uint kLightSun = 255u; // mask
const uint kLightSkyShift = 8u;
const uint kLightAll = 65535u;

// What a picture shows. The first is made by trace/shade; the others are values of a specialization constant of
// trace/views.
const uint kViewColor = 0u;      // lit
const uint kViewAlbedo = 1u;     // base colour alone
const uint kViewNormal = 2u;     // 0.5 + 0.5 * shading normal
const uint kViewDepth = 3u;      // from white to a dark grey over the depths of the grid
const uint kViewLevel = 4u;      // how much coarser than a voxel the hit is
const uint kViewIterations = 5u; // heat map, logarithmic up to 127
const uint kViewVoxel = 6u;      // a colour for each voxel, by its coordinates
const uint kViewBricks = 7u;     // base colour, with the borders of nodes
const uint kViewOrigin = 8u;     // grey: static; orange: in a leaf that a dynamic update made

// How a picture stores a pixel: a specialization constant of trace/shade, views and sky. All but the last hold sRGB
// codes.
const uint kTexelRgba8 = 0u; // red | green << 8 | blue << 16 | alpha << 24
const uint kTexelBgra8 = 1u; // blue | green << 8 | red << 16 | alpha << 24
const uint kTexelRgb10 = 2u; // red | green << 10 | blue << 20 | alpha << 30
const uint kTexelHalf = 3u;  // two words of half floats, red | green << 16 and blue | alpha << 16: linear

const float kHalfMax = 65504.0f; // largest half float

struct ShadowParams // push constants of trace/shadow
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(Attribute) attributes;      // of voxels, in the format of kFormat
    GPU_CONST_PTR(Attribute) node_attributes; // kDetail only
    GPU_CONST_PTR(uint64_t) paths;            // of trace/node_paths; kPaths only
    GPU_PTR(TraceStatus) status;
    GPU_PTR(DispatchArgs) next_round; // [1] cleared: of the round that unfinished rays wait for; kMore only
    GPU_PTR(uint) light;              // [width * height] light that arrives; undefined in dead tiles
    vec3 forward;                     // of the camera
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    vec3 to_sun; // length 1
    uint width;
    uint height;
};
#define TRACE_SHADOW_CONSTANTS(CONSTANT)                                                                               \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    CONSTANT(4, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(5, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    PATHS_CONSTANTS(CONSTANT, 6)                                                                                       \
    CONSTANT(8, bool, resume, kResume, false)         /* only rays that the round before left unfinished */            \
    CONSTANT(9, bool, more, kMore, false)             /* another round follows */                                      \
    CONSTANT(10, bool, smooth_normals, kSmooth, true) /* light arrives at voxels by their normals */
GPU_KERNEL(trace, shadow, Shadow, ShadowParams, TRACE_SHADOW_CONSTANTS)

struct OcclusionParams // push constants of trace/occlusion
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(Attribute) attributes;
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_CONST_PTR(uint64_t) paths;
    GPU_PTR(TraceStatus) status;
    GPU_PTR(uint) light;
    vec3 forward;
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    uint width;
    uint height;
    uint ray_count;
    float radius; // unit space
    float turn;   // of the pattern, radians
};
#define TRACE_OCCLUSION_CONSTANTS(CONSTANT)                                                                            \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    CONSTANT(4, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(5, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    PATHS_CONSTANTS(CONSTANT, 6)                                                                                       \
    CONSTANT(8, bool, shadows, kShadows, true)       /* trace/shadow has run */                                        \
    CONSTANT(9, bool, smooth_normals, kSmooth, true) /* as of trace/shadow */
GPU_KERNEL(trace, occlusion, Occlusion, OcclusionParams, TRACE_OCCLUSION_CONSTANTS)

struct SkyParams // push constants of trace/sky: one thread kSkyRows pixels of a column
{
    GPU_CONST_PTR(Sky) sky; // [1]
    GPU_PTR(uint) image;    // [width * height] texels of one word or two, as kTexels says
    vec3 forward;           // of the camera
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    uint width;
    uint height;
    float sun; // strength
    float exposure;
};
#define TRACE_SKY_CONSTANTS(CONSTANT)                                                                                  \
    CONSTANT(0, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(1, TexelFormat, texels, kTexels, kTexelRgba8)                                                             \
    CONSTANT(2, bool, black, kBlack, false)
GPU_KERNEL(trace, sky, Sky, SkyParams, TRACE_SKY_CONSTANTS)

struct ShadeParams // push constants of trace/shade
{
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(uint) light;           // of trace/shadow and trace/occlusion; kLight only
    GPU_CONST_PTR(Attribute) attributes; // of voxels, as above
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_CONST_PTR(uvec2) emission_words;
    GPU_CONST_PTR(uint) emission;
    GPU_CONST_PTR(Sky) sky; // [1]
    GPU_PTR(uint) image;    // as in SkyParams
    vec3 forward;
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    uint width;
    uint height;
    float sun; // strength
    float emission_scale;
    float exposure;
};
#define TRACE_SHADE_CONSTANTS(CONSTANT)                                                                                \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(2, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    CONSTANT(3, bool, emission, kEmission, false)                                                                      \
    CONSTANT(4, bool, light, kLight, true) /* params.light was filled */                                               \
    CONSTANT(5, TexelFormat, texels, kTexels, kTexelRgba8)                                                             \
    CONSTANT(6, bool, smooth_normals, kSmooth, true) /* as of trace/shadow */
GPU_KERNEL(trace, shade, Shade, ShadeParams, TRACE_SHADE_CONSTANTS)

struct ViewsParams // push constants of trace/views
{
    GPU_CONST_PTR(uvec2) live;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(uint) iterations;      // of trace/primary; kViewIterations only
    GPU_CONST_PTR(Attribute) attributes; // of voxels, as above
    GPU_CONST_PTR(Attribute) node_attributes;
    GPU_PTR(uint) image; // as in SkyParams
    vec3 forward;
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    vec2 depth_range;         // kViewDepth only: the depth that is white, and the one that is dark
    uint first_changed_voxel; // kViewOrigin only: the first index of an attribute that is not a static voxel's
    uint first_changed_node;  // kViewOrigin only: the first index of an attribute that is not a static node's
    uint width;
    uint height;
};
#define TRACE_VIEWS_CONSTANTS(CONSTANT)                                                                                \
    CONSTANT(0, View, view, kView, kViewAlbedo)                                                                        \
    CONSTANT(1, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(2, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(3, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    CONSTANT(4, TexelFormat, texels, kTexels, kTexelRgba8)
GPU_KERNEL(trace, views, Views, ViewsParams, TRACE_VIEWS_CONSTANTS)

GPU_NAMESPACE_END

#endif
