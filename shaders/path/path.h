// SPDX-License-Identifier: MIT
// Path tracing: what its kernels share with the host.
//
// The voxels of a tree are cubes that reflect light diffusely: a face has the voxel's colour as its albedo, and gives
// off the voxel's emission to all sides. A sample of a pixel is one path: a ray from the camera, and from each hit one
// in a random direction, up to a number of bounces. At each hit one light is chosen, too: a direction to the map, a
// point of the sun, or one of a face of an emissive voxel, and its light counts if a shadow ray reaches it. Light that
// both ways find is weighted by the balance heuristic (E. Veach, L. Guibas, Optimally Combining Sampling Techniques,
// 1995).
//
// Paths are traced in one of two forms. What happens to a path stands in functions that both include (path/*.glsl), and
// its light is summed up in the same order, so both make the same picture, bit for bit.
//
// In stages, for devices that skip no branch: paths of a batch of pixels advance together, a bounce at a time. Those
// that go on stand in a list, and so do the shadow rays; lists are as long as the device says. Which path stands where
// in a list may differ from run to run, but each adds to its own pixel alone.
//
//   path/begin     a ray from the camera for each pixel
//     trace/rays     what the rays hit                                       these and the following for each bounce
//     path/shade     the next ray of each path that has hit something, and lists for the following kernels
//     path/miss, path/emitter                light that the rays have met
//     path/features                          sums of what the camera sees, where they are asked for
//     path/map_light, path/voxel_light       a chosen light, and a shadow ray to it
//     trace/rays, path/connect               shadow rays, and the light that they bring
//   path/finish    adds the sample to the pixels' sums
//
// So each kernel runs for those paths alone that need it, and what it loads is loaded for those alone.
//
// In one kernel, path/trace, for GPUs: a thread follows a path from the camera to its end. Nothing is stored between
// bounces.
//
// With PathOptions::smooth, paths leave what the camera sees by the normals of voxels (path/normal.glsl). Between
// surfaces light goes from face to face all the same, so there is as much of it as without.
//
// Pixels are numbered in strips of kStripRows rows, column by column within a strip.
#ifndef ZVO_SHADERS_PATH_PATH_H
#define ZVO_SHADERS_PATH_PATH_H

#include "light/environment.h"
#include "light/light_tree.h"
#include "trace/light.h"

GPU_ENUM(LightSampling) // kSampleBoth and so on
#define GPU_TYPE_LightSampling uint

GPU_NAMESPACE_BEGIN

const uint kPathGroup = 64u; // threads of a workgroup
const uint kStripRows = 8u;

// How light is found: a specialization constant of path/shade.
const uint kSampleBoth = 0u;   // in both ways
const uint kSampleChance = 1u; // only where rays happen to meet it
const uint kSampleLights = 2u; // only by shadow rays, but for what the camera sees

/// A path on its way along a ray.
struct PathState
{
    vec3 throughput; // of light from the ray to the pixel
    uint slot;       // of its pixel in the batch
    uint seed;       // of the pixel's random numbers
    uint normal;     // of the surface where the ray starts (path/normal.glsl)
    float density;   // by solid angle, with which the ray's direction was chosen; 0: by the camera
    vec3 kinds;      // probabilities with which light was looked for at the face: in the map, the sun, voxels
};
GPU_BUFFER(PathState, 8);

/// What a shadow ray brings if nothing is in its way.
struct ShadowState
{
    vec3 light; // at the pixel
    uint slot;
    uvec2 target; // Hit::where of the light's face; kNoTarget: the ray must not hit anything
};
GPU_BUFFER(ShadowState, 8);

const uint kNoTarget = ~0u; // in both words

// The lists of a bounce. Workgroups for each stand in a buffer of DispatchArgs, kListElements for a bounce; behind them
// stand the lists' lengths, a word each.
const uint kListPaths = 0u;       // of rays and states
const uint kListMapLights = 1u;   // this and the next: numbers of paths in the next bounce's list
const uint kListVoxelLights = 2u; // map (or sun) and voxels: what light is looked for
const uint kListShadows = 3u;     // of shadow rays
const uint kListMisses = 4u;      // this and the next: numbers of paths in the first list
const uint kListEmitters = 5u;    // paths that have hit an emissive voxel
const uint kListCount = 6u;
const uint kListLengths = 6u;  // element where the lengths begin
const uint kListElements = 8u; // of a bounce

/// What the camera sees: a picture with a lens.
struct PathView
{
    CameraRays camera;
    vec3 axis; // PictureCamera's
    uint width;
    uint height;
    uint seed;
    float lens_radius; // unit space
    float focus;       // distance of the plane in focus along the axis, unit space
};
GPU_BUFFER(PathView, 4);

struct PathBeginParams // push constants of path/begin: a thread a pixel
{
    GPU_PTR(Ray) rays;
    GPU_PTR(PathState) states;
    GPU_PTR(vec3) radiance; // [batch]
    GPU_PTR(DispatchArgs) lists;
    PathView view;
    uint first_pixel;
    uint pixel_count;
    uint sample_index;
};
#define PATH_BEGIN_CONSTANTS(CONSTANT) CONSTANT(0, bool, orthographic, kOrthographic, false)
GPU_KERNEL(path, begin, Begin, PathBeginParams, PATH_BEGIN_CONSTANTS)

struct PathShadeParams // push constants of path/shade: a thread a path
{
    GPU_CONST_PTR(Attribute) attributes;  // of voxels, in the format of kFormat
    GPU_CONST_PTR(uvec2) emission_words;  // kEmission only
    GPU_CONST_PTR(Hit) hits;              // of the paths' rays
    GPU_CONST_PTR(vec2) gives;            // [kNormals] as Environment::gives
    GPU_CONST_PTR(LightNode) light_nodes; // kEmission only
    GPU_CONST_PTR(Ray) rays;
    GPU_CONST_PTR(PathState) states;
    GPU_PTR(Ray) next_rays; // this and the next: of the next bounce
    GPU_PTR(PathState) next_states;
    GPU_PTR(DispatchArgs) lists; // [bounces + 2][kListElements]
    GPU_PTR(uint) numbers;       // [kListCount][batch] elements of the lists of numbers
    uint bounce;
    uint sample_index;
    uint batch;
};
#define PATH_SHADE_CONSTANTS(CONSTANT)                                                                                 \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, AttributeFormat, format, kFormat, kFormat8)      /* of attributes */                                   \
    CONSTANT(2, bool, emission, kEmission, false)                /* there are emissive voxels */                       \
    CONSTANT(3, LightSampling, sampling, kSampling, kSampleBoth) /* how light is found */                              \
    CONSTANT(4, bool, last, kLast, false)                        /* paths end here */                                  \
    CONSTANT(5, bool, roulette, kRoulette, false)                                                                      \
    CONSTANT(6, bool, smooth_normals, kSmooth, false) /* paths leave what they have hit by its normal */
GPU_KERNEL(path, shade, Shade, PathShadeParams, PATH_SHADE_CONSTANTS)

/// Push constants of the kernels that take a list of numbers of paths: a thread a number.
struct PathLightParams
{
    GPU_CONST_PTR(TreeTable) tree;
    GPU_CONST_PTR(Environment) environment;
    GPU_CONST_PTR(LightNode) light_nodes;
    GPU_CONST_PTR(LightBrick) light_bricks;
    GPU_CONST_PTR(Ray) rays; // of the paths that are listed, like the next two
    GPU_CONST_PTR(PathState) states;
    GPU_CONST_PTR(Hit) hits;  // path/emitter only
    GPU_PTR(Ray) shadow_rays; // path/map_light and path/voxel_light only, like the next
    GPU_PTR(ShadowState) shadow_states;
    GPU_PTR(vec3) radiance; // path/miss and path/emitter only
    GPU_PTR(DispatchArgs) lists;
    GPU_CONST_PTR(uint) numbers; // of the list
    uint bounce;
    uint sample_index;
};
#define PATH_MISS_CONSTANTS(CONSTANT)                                                                                  \
    CONSTANT(0, LightSampling, sampling, kSampling, kSampleBoth) /* how light is found */                              \
    CONSTANT(1, bool, smooth_normals, kSmooth, false) /* paths have left what the camera sees, by its normal */
GPU_KERNEL(path, miss, Miss, PathLightParams, PATH_MISS_CONSTANTS)
#define PATH_EMITTER_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, LightSampling, sampling, kSampling, kSampleBoth) /* how light is found */                              \
    CONSTANT(1, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(2, bool, by_power, kByPower, false)      /* lights are chosen whatever their place */                     \
    CONSTANT(3, bool, smooth_normals, kSmooth, false) /* as of path/miss */
GPU_KERNEL(path, emitter, Emitter, PathLightParams, PATH_EMITTER_CONSTANTS)
#define PATH_MAP_LIGHT_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, LightSampling, sampling, kSampling, kSampleBoth) /* how light is found */                              \
    CONSTANT(1, bool, smooth_normals, kSmooth, false) /* paths have left what the camera sees, by its normal */
GPU_KERNEL(path, map_light, MapLight, PathLightParams, PATH_MAP_LIGHT_CONSTANTS)
#define PATH_VOXEL_LIGHT_CONSTANTS(CONSTANT)                                                                           \
    CONSTANT(0, LightSampling, sampling, kSampling, kSampleBoth) /* how light is found */                              \
    CONSTANT(1, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(2, bool, by_power, kByPower, false)      /* lights are chosen whatever their place */                     \
    CONSTANT(3, bool, smooth_normals, kSmooth, false) /* as of path/miss */
GPU_KERNEL(path, voxel_light, VoxelLight, PathLightParams, PATH_VOXEL_LIGHT_CONSTANTS)

struct PathConnectParams // push constants of path/connect: a thread a shadow ray
{
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(ShadowState) shadow_states;
    GPU_PTR(vec3) radiance;
    GPU_PTR(DispatchArgs) lists;
    GPU_PTR(uint) numbers; // kNotes only, like the next: bit 31 of the number at a slot is set whose ray has hit one of
    uint first_noted;      // the voxels from this index of attributes on
    uint bounce;
};
#define PATH_CONNECT_CONSTANTS(CONSTANT) CONSTANT(0, bool, notes, kNotes, false)
GPU_KERNEL(path, connect, Connect, PathConnectParams, PATH_CONNECT_CONSTANTS)

/// The sums of all samples of a pixel.
struct PixelSum
{
    vec3 radiance;
    float luminance_squared;
};
GPU_BUFFER(PixelSum, 16);

/// The sums of what the camera's rays see, over all samples of a pixel.
struct PixelFeatures
{
    vec3 albedo;             // of faces; 0 where a ray hits none, like the next three
    float depth;             // unit space, along the camera's direction
    vec3 normal;             // of faces, or of voxels: as they are shaded
    float hits;              // number of samples that hit a face from outside of its voxel
    vec3 direct;             // radiance that the camera sees directly: of the map, the sun and emissive voxels
    float scattered_squared; // luminance of all other radiance, squared
};
GPU_BUFFER(PixelFeatures, 16);

struct PathFeaturesParams // push constants of path/features: a thread a pixel
{
    GPU_CONST_PTR(Attribute) attributes; // of voxels, in the format of kFormat
    GPU_CONST_PTR(Ray) rays;             // of the camera, like hits and radiance
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(vec3) radiance;    // [batch] that was met so far
    GPU_PTR(float) direct;           // [batch] its luminance
    GPU_PTR(PixelFeatures) features; // [width * height] in the order of strips
    vec3 origin;                     // of PictureCamera, as axis
    vec3 axis;
    uint first_pixel;
    uint pixel_count;
};
#define PATH_FEATURES_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    CONSTANT(2, bool, smooth_normals, kSmooth, false)       /* normals are those of voxels */
GPU_KERNEL(path, features, Features, PathFeaturesParams, PATH_FEATURES_CONSTANTS)

struct PathFinishParams // push constants of path/finish: a thread a pixel
{
    GPU_CONST_PTR(vec3) radiance;
    GPU_CONST_PTR(float) direct;     // kFeatures only, like the next
    GPU_PTR(PixelFeatures) features; // [width * height] in the order of strips
    GPU_PTR(PixelSum) sums;          // [width * height] in the order of strips
    uint first_pixel;
    uint pixel_count;
};
#define PATH_FINISH_CONSTANTS(CONSTANT) CONSTANT(0, bool, features, kFeatures, false)
GPU_KERNEL(path, finish, Finish, PathFinishParams, PATH_FINISH_CONSTANTS)

struct PathTraceParams // push constants of path/trace: a thread a pixel
{
    GPU_CONST_PTR(TreeTable) tree;
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(Attribute) attributes;    // of voxels, in the format of kFormat
    GPU_CONST_PTR(uvec2) emission_words;    // kEmission only
    GPU_CONST_PTR(LightNode) light_nodes;   // kEmission only
    GPU_CONST_PTR(LightBrick) light_bricks; // kEmission only
    GPU_CONST_PTR(Environment) environment;
    GPU_CONST_PTR(vec2) gives; // [kNormals] as Environment::gives
    GPU_CONST_PTR(PathView) view;
    GPU_PTR(PixelSum) sums;
    GPU_PTR(PixelFeatures) features; // kFeatures only
    GPU_PTR(DispatchArgs) lists;     // [kListElements] whose lengths count the rays of paths and those to lights
    GPU_PTR(TraceStatus) status;
    uint first_pixel; // numbers in the order of strips
    uint pixel_count;
    uint sample_index;
    uint bounces;
};
#define PATH_TRACE_CONSTANTS(CONSTANT)                                                                                 \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    CONSTANT(4, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(5, AttributeFormat, format, kFormat, kFormat8)      /* of attributes */                                   \
    CONSTANT(6, bool, emission, kEmission, false)                /* there are emissive voxels */                       \
    CONSTANT(7, LightSampling, sampling, kSampling, kSampleBoth) /* how light is found */                              \
    CONSTANT(8, bool, by_power, kByPower, false)                 /* lights are chosen whatever their place */          \
    CONSTANT(9, bool, roulette, kRoulette, false)                                                                      \
    CONSTANT(10, bool, overlays, kOverlays, false) /* of a DAG */                                                      \
    CONSTANT(11, bool, features, kFeatures, false)                                                                     \
    CONSTANT(12, bool, smooth_normals, kSmooth, false) /* what the camera sees is shaded by the normals of voxels */
GPU_KERNEL(path, trace, Trace, PathTraceParams, PATH_TRACE_CONSTANTS)

struct PathAddPictureParams // push constants of path/add_picture: a thread a pixel
{
    GPU_CONST_PTR(uint) picture; // [2 * width * height] texels of kTexelHalf
    GPU_PTR(PixelSum) sums;      // [width * height] in the order of strips
    uint width;
    uint height;
};
#define PATH_ADD_PICTURE_CONSTANTS(CONSTANT) CONSTANT(0, bool, adds, kAdds, false) /* to sums that are there */
GPU_KERNEL(path, add_picture, AddPicture, PathAddPictureParams, PATH_ADD_PICTURE_CONSTANTS)

// The automatic exposure: counts of pixels by the logarithm of their luminance.
const uint kMeterBins = 256u;
const uint kMeterPixels = 1024u;    // of a workgroup
const float kMeterDarkest = -20.0f; // log2 of the luminance of the first bin
const float kMeterStops = 40.0f;    // of all bins

struct PathMeterParams // push constants of path/meter
{
    GPU_CONST_PTR(PixelSum) sums;
    GPU_PTR(uint) counts; // [kMeterBins]
    uint pixel_count;
    float sample_part; // 1 / number of samples
};
GPU_KERNEL(path, meter, Meter, PathMeterParams, GPU_NO_CONSTANTS)

struct PathExposeParams // push constants of path/expose: one workgroup
{
    GPU_CONST_PTR(uint) counts;
    GPU_PTR(float) exposure; // [1]
    float factor;
};
GPU_KERNEL(path, expose, Expose, PathExposeParams, GPU_NO_CONSTANTS)

struct PathDevelopParams // push constants of path/develop: a thread a pixel
{
    GPU_CONST_PTR(PixelSum) sums;
    GPU_CONST_PTR(float) exposure; // [1]
    GPU_PTR(uint) image;           // as in SkyParams
    uint width;
    uint height;
    float sample_part; // 1 / number of samples
};
#define PATH_DEVELOP_CONSTANTS(CONSTANT) CONSTANT(0, TexelFormat, texels, kTexels, kTexelRgba8)
GPU_KERNEL(path, develop, Develop, PathDevelopParams, PATH_DEVELOP_CONSTANTS)

GPU_NAMESPACE_END

#endif
