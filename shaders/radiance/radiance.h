// SPDX-License-Identifier: MIT
// The radiance cache: what its kernels share with the host.
//
// A face keeps the light that arrives at it, irradiance over pi, as two means over samples: what it reflects is its
// albedo times that. Pictures show a mean of all samples. Other faces receive one of the last samples: what they have
// comes back from them, so that a mean of all would reach the sum of all bounces only slowly (docs/radiance.md).
//
// Faces stand in a hash table by position, whatever tree has the voxel: so an octree, a DAG and overlays share their
// light, a voxel keeps it while something else stands around it, and whoever knows a position and a normal finds it
// without a ray. A face enters the table when a ray from the camera, or from another face, hits it.
//
// A face notes when the first ray of a path from it, or the ray to its first light, hits a voxel of an overlay. While
// something moves, means of faces that have done so lately count fewer samples: few where the ray went to a light, or
// where it has happened twice within some frames, for then what moves matters there. So its shadows come and go within
// some frames, and other light stays smooth.
//
// Bricks have means, too: a brick of level l is a cube of 4^l cells, a node of the tree, and keeps the light of all
// faces in it that have the same normal. Its samples are theirs. A face with few samples shows a mean of its own light
// and of the light between bricks, with weights that follow from how much samples and faces differ
// (radiance/brick.glsl).
//
// A frame takes so many faces as its budget has rays, of those that were hit since the frame before. A sample of a face
// is a path of one bounce from a random point of it: a ray in a random direction, which brings emission, light from
// outside of the grid, or what the face that it hits reflects of the cached light there; and a light that is chosen,
// with a shadow ray to it (path/path.h). So light of one more bounce arrives with each frame.
//
// A face that has had no sample keeps no light. A path that hits one takes the light of the faces beside it, in the
// same plane, if they have had any; else it goes on by a second ray and a second light, and ends there. If it took no
// light, samples would be too dark until all faces have had some, and means would keep that for long.
//
//   radiance/request   faces that the camera sees: into the table, and into the frame's list
//   radiance/count     counts the faces of the list by their rank; its last threads find the rank that the budget ends
//   radiance/select    lists the faces of a lower rank
//   radiance/begin     a path from each of them
//     path/map_light, path/voxel_light, trace/rays, path/connect      light that was chosen
//     trace/rays, radiance/gather            what the paths hit, and the cached light there
//     path/miss, path/emitter                light that they have met
//   radiance/extend    paths that have hit a face without light; for their second rays, the same passes again
//   radiance/surround  the bricks of a level around these faces, or the bricks of the level before: into table and list
//   radiance/update    adds the samples to the means of faces, and to the sums of bricks of level 1
//   radiance/update_bricks   adds the sums to the means of bricks of a level, and to the sums of the next level
//   radiance/evict     into a larger table, or without faces that no ray has hit for long; only where there is little
//                      room, and while something moves
//   radiance/view, radiance/direct         what the camera sees of it, and of lamps and the sky
//   radiance/cones     in place of what it reflects in radiance/view: light through a cone, once for each of six
//
// Kernels read what the frame before has kept; only radiance/update and radiance/update_bricks write, and sums of
// samples are integers. So what comes out does not depend on the order of threads, though the places of faces in the
// table, and in lists, do.
#ifndef ZVO_SHADERS_RADIANCE_RADIANCE_H
#define ZVO_SHADERS_RADIANCE_RADIANCE_H

#include "path/path.h"
#include "radiance/cached_faces.h"

GPU_NAMESPACE_BEGIN

const uint kRadianceGroup = 64u; // threads of a workgroup

/// What else is known of the face in a slot.
///
///     mark    the last frame in which a ray has hit the face, modulo 2^15, 15 | the last one in which a ray of the
///             face has hit what moves, modulo 2^14 - 1, plus 1, or 0: none, 14 | kFaceMoved | kFaceSeen | kFaceListed
///     recent  red 8 | green 8 | blue 8 | exponent 8 (radiance/cached_face.glsl): a mean of the last samples
///             of a brick: its index in BrickSums, while it is listed
///     own     as CachedFace::light, of the face's samples alone
///             of a brick: BrickSpread, and the number of samples that it is of (radiance/brick.glsl)
struct FaceState
{
    uint mark;
    uint recent;
    uvec2 own;
};
GPU_BUFFER(FaceState, 16);

/// Sums of a brick over the samples of a frame, or over the means of the bricks in it: 64 at most.
struct BrickSum
{
    uvec3 light; // in steps that depend on the light that the brick keeps (radiance/brick.glsl)
    uint counts; // of samples 8 | of those where what moves matters, or has touched rays, 8 | of what follows 8
    int total;   // BrickSpread (radiance/brick.glsl), in steps of 2^-kSpreadShift
    int between;
};
GPU_BUFFER(BrickSum, 4);

const uint kSpreadShift = 14u;
const uint kDiffuseCones = 6u; // through which radiance/cones gathers light
const uint kBrickFaces = 4u;   // what means of bricks count in samples, over what those of faces do

// How many samples of a face the light of its brick counts as, at most, and how many times so many a face has that
// shows its own light alone.
const float kBrickSamplesMax = 128.0;
const float kBrickShareEnds = 16.0;

const uint kCachedWeightMax = 1023u;
const uint kRecentSamples = 16u; // that FaceState::recent counts

// How many samples both means count of a face whose rays have hit what moves, for so many frames: once, or often.
const uint kTouchedSamples = 64u;
const uint kMovedSamples = 12u;
const uint kMovedFrames = 128u;
const uint kMovedAgain = 6u; // frames between two hits that are often, at most
const uint kMovedRare = 32u; // between two that are not, at least

const uint kMarkFrames = (1u << 15) - 1u; // of a mark
const uint kMarkMovedShift = 15u;
const uint kMarkMovedFrames = (1u << 14) - 1u;

// In PathBatch::numbers, of kListPaths, beside a slot: the path's first ray has hit what moves; that to its first
// light has.
const uint kFaceSlotsMax = 1u << 30;
const uint kPathTouched = 1u << 30;
const uint kPathMoved = 1u << 31;

const uint kFaceListed = 1u << 31; // in the frame's list, or the next frame's
const uint kFaceSeen = 1u << 30;   // by the camera, since it was listed
const uint kFaceMoved = 1u << 29;  // what moves matters for its light

// Elements of PathBatch::lists, as bounces: of the first and the second rays of paths, then of paths that have hit a
// face without light, then of the faces of even and odd frames, then of the bricks of each level, in kListPaths.
const uint kUnlitPaths = 2u;
const uint kWantedEven = 3u;
const uint kWantedOdd = 4u;
const uint kFirstBricks = 5u;

// Faces are ranked by a random number, less for those with few samples and those that the camera sees, in steps of a
// 32nd of it. A frame takes all ranks below a limit.
const uint kFaceRanks = 1024u;
const uint kRankShift = 18u; // of the bits of a float
const uint kRankFirst = (127u - kFaceRanks / 32u) << (23u - kRankShift);

/// Counters of the table, of all frames or of one.
struct RadianceCounters
{
    uint face_count;  // in the table, without bricks
    uint brick_count; // in the table
    uint refused;     // inserts of faces that found no slot
    uint rank_limit;  // of the frame, like what follows
    uint arrived;     // threads that have counted (lib/arrivals.glsl)
    uint ranks[1024]; // [kFaceRanks] faces of each
};
GPU_BUFFER(RadianceCounters, 4);

const uint kCountersOfFrame = 3u; // words before those that a frame clears

struct RadianceRequestParams // push constants of radiance/request: a workgroup for each live tile
{
    GPU_PTR(CachedFace) faces;
    GPU_PTR(FaceState) states;
    GPU_PTR(RadianceCounters) counters;
    GPU_PTR(uint) wanted; // [RadianceLists::wanted] slots
    GPU_PTR(DispatchArgs) lists;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(uvec2) live;
    vec3 forward; // of the camera
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    uint width;
    uint height;
    uint run_count;
    uint frame; // some pixels of each 2x2 take part, in turns
};
#define RADIANCE_REQUEST_CONSTANTS(CONSTANT)                                                                           \
    CONSTANT(0, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(1, uint, turns, kTurns, 1u) /* pixels of each 2x2 that take part: 1 to 4 */
GPU_KERNEL(radiance, request, Request, RadianceRequestParams, RADIANCE_REQUEST_CONSTANTS)

struct RadianceCountParams // push constants of radiance/count: a thread a listed face
{
    GPU_CONST_PTR(CachedFace) faces;
    GPU_CONST_PTR(FaceState) states;
    GPU_CONST_PTR(uint) wanted;
    GPU_PTR(RadianceCounters) counters;
    GPU_PTR(DispatchArgs) lists;
    uint frame;
    uint budget; // the most faces that a frame takes
};
GPU_KERNEL(radiance, count, Count, RadianceCountParams, GPU_NO_CONSTANTS)

struct RadianceSelectParams // push constants of radiance/select: a thread a listed face
{
    GPU_CONST_PTR(CachedFace) faces;
    GPU_PTR(FaceState) states;
    GPU_CONST_PTR(uint) wanted;
    GPU_CONST_PTR(RadianceCounters) counters;
    GPU_PTR(DispatchArgs) lists;
    GPU_PTR(uint) numbers; // as in RadianceBeginParams
    uint frame;
};
GPU_KERNEL(radiance, select, Select, RadianceSelectParams, GPU_NO_CONSTANTS)

struct RadianceBeginParams // push constants of radiance/begin: a thread a path
{
    GPU_CONST_PTR(CachedFace) faces;
    GPU_CONST_PTR(vec2) gives;            // [kNormals] as Environment::gives
    GPU_CONST_PTR(LightNode) light_nodes; // kEmission only
    GPU_PTR(DispatchArgs) lists;
    GPU_PTR(uint) numbers; // [kListMisses][batch] as in PathBatch; of kListPaths, the first list: slots
    GPU_PTR(Ray) rays;
    GPU_PTR(PathState) path_states;
    GPU_PTR(vec3) radiance; // [batch]
    uint batch;
    uint sample_index;
    uint seed;
};
#define RADIANCE_BEGIN_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, bool, emission, kEmission, false) /* there are emissive voxels */
GPU_KERNEL(radiance, begin, Begin, RadianceBeginParams, RADIANCE_BEGIN_CONSTANTS)

struct RadianceSurroundParams // push constants of radiance/surround: a thread a listed face, or brick
{
    GPU_PTR(CachedFace) faces;
    GPU_PTR(FaceState) states;
    GPU_PTR(RadianceCounters) counters;
    GPU_PTR(DispatchArgs) lists;
    GPU_CONST_PTR(uint) slots; // as in PathBatch::numbers, of the first list; or of bricks of the level before
    GPU_PTR(uint) bricks;      // of the level
    uint of;                   // the list of slots, as a bounce
    uint run_count;
    uint level;
};
GPU_KERNEL(radiance, surround, Surround, RadianceSurroundParams, GPU_NO_CONSTANTS)

struct RadianceGatherParams // push constants of radiance/gather: a thread a path
{
    GPU_PTR(CachedFace) faces;
    GPU_PTR(FaceState) states;
    GPU_PTR(RadianceCounters) counters;
    GPU_PTR(uint) wanted; // of the next frame, as in RadianceRequestParams
    GPU_PTR(DispatchArgs) lists;
    GPU_PTR(uint) numbers; // as in RadianceBeginParams; of kListShadows, paths that have hit a face without light
    GPU_CONST_PTR(Attribute) attributes; // of voxels, in the format of kFormat
    GPU_CONST_PTR(uvec2) emission_words; // kEmission only
    GPU_CONST_PTR(Ray) rays;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(PathState) path_states; // kEnds only
    GPU_PTR(vec3) radiance;
    uint batch;
    uint run_count;
    uint frame;
    uint first_moving; // index of attributes from which on voxels are those of overlays; kHitMiss: none
};
#define RADIANCE_GATHER_CONSTANTS(CONSTANT)                                                                            \
    CONSTANT(0, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    CONSTANT(1, bool, emission, kEmission, false)           /* there are emissive voxels */                            \
    CONSTANT(2, bool, ends, kEnds, false)                   /* the second rays of paths, with which these end */
GPU_KERNEL(radiance, gather, Gather, RadianceGatherParams, RADIANCE_GATHER_CONSTANTS)

struct RadianceExtendParams // push constants of radiance/extend: a thread a path that has hit a face without light
{
    GPU_CONST_PTR(CachedFace) faces;
    GPU_CONST_PTR(FaceState) states;
    GPU_CONST_PTR(Attribute) attributes; // of voxels, in the format of kFormat
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(vec2) gives;            // [kNormals] as Environment::gives
    GPU_CONST_PTR(LightNode) light_nodes; // kEmission only
    GPU_CONST_PTR(Ray) rays;              // [batch] first rays of paths, like the next
    GPU_CONST_PTR(PathState) path_states;
    GPU_PTR(Ray) next_rays; // [batch] second ones, like the next
    GPU_PTR(PathState) next_states;
    GPU_PTR(DispatchArgs) lists;
    GPU_PTR(uint) numbers;  // as in RadianceGatherParams
    GPU_PTR(vec3) radiance; // [batch]
    uint batch;
    uint run_count;
    uint sample_index;
};
#define RADIANCE_EXTEND_CONSTANTS(CONSTANT)                                                                            \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    CONSTANT(2, bool, emission, kEmission, false)           /* there are emissive voxels */
GPU_KERNEL(radiance, extend, Extend, RadianceExtendParams, RADIANCE_EXTEND_CONSTANTS)

struct RadianceUpdateParams // push constants of radiance/update: a thread a path
{
    GPU_PTR(CachedFace) faces;
    GPU_PTR(FaceState) states;
    GPU_CONST_PTR(uint) numbers;
    GPU_CONST_PTR(vec3) radiance;
    GPU_PTR(DispatchArgs) lists;
    GPU_PTR(BrickSum) sums; // of level 1
    uint run_count;
    uint frame;
    uint window;         // the most samples that the mean's weight counts, at least 1 and at most kCachedWeightMax
    uint touched_window; // the most samples of a face one of whose rays has hit what moves
    uint moved_window;   // the most samples where what moves matters
};
GPU_KERNEL(radiance, update, Update, RadianceUpdateParams, GPU_NO_CONSTANTS)

struct RadianceUpdateBricksParams // push constants of radiance/update_bricks: a thread a listed brick of a level
{
    GPU_PTR(CachedFace) faces;
    GPU_PTR(FaceState) states;
    GPU_CONST_PTR(uint) bricks; // of the level
    GPU_PTR(DispatchArgs) lists;
    GPU_PTR(BrickSum) sums;
    GPU_PTR(BrickSum) outer_sums; // of the next level
    uint run_count;
    uint frame;
    uint level;
    uint window;       // the most samples that means count
    uint moved_window; // the most samples where something moves
};
GPU_KERNEL(radiance, update_bricks, UpdateBricks, RadianceUpdateBricksParams, GPU_NO_CONSTANTS)

struct RadianceEvictParams // push constants of radiance/evict: a thread a slot of what moves
{
    GPU_PTR(CachedFace) faces; // of the table that they move to, like the next one: empty
    GPU_PTR(FaceState) states;
    GPU_PTR(RadianceCounters) counters; // of the table: faces without a place are taken off
    GPU_CONST_PTR(CachedFace) old_faces;
    GPU_CONST_PTR(FaceState) old_states;
    GPU_PTR(uint) wanted; // as in RadianceRequestParams
    GPU_PTR(DispatchArgs) lists;
    uint run_count;
    uint old_slots;
    uint frame;
    uint age_max; // frames; faces that no ray has hit for longer are left out
};
#define RADIANCE_EVICT_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, bool, relists, kRelists, false)  /* faces that are listed stay so; else marks say that none is */      \
    CONSTANT(1, bool, in_place, kInPlace, false) /* both tables are the same one: only marks change */
GPU_KERNEL(radiance, evict, Evict, RadianceEvictParams, RADIANCE_EVICT_CONSTANTS)

struct RadianceViewParams // push constants of radiance/view: a thread a pixel, in the order of path/path.h
{
    GPU_CONST_PTR(CachedFace) faces;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(float) starts;         // of tiles
    GPU_CONST_PTR(Attribute) attributes; // of voxels, in the format of kFormat
    GPU_CONST_PTR(uvec2) emission_words; // kEmission only
    GPU_PTR(PixelSum) sums;
    GPU_PTR(DispatchArgs) lists; // [kListElements] cleared; of kListMisses: pixels that see light directly
    GPU_PTR(uint) direct;        // [pixels] their numbers
    CameraRays camera;
    uint width;
    uint height;
    uint run_count;
};
#define RADIANCE_VIEW_CONSTANTS(CONSTANT)                                                                              \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(2, AttributeFormat, format, kFormat, kFormat8) /* of attributes */                                        \
    CONSTANT(3, bool, emission, kEmission, false)           /* there are emissive voxels */                            \
    CONSTANT(4, bool, reflects, kReflects, true)            /* false: pixels are only listed */                        \
    CONSTANT(5, bool, adds, kAdds, true)                    /* false: sets the sums */                                 \
    CONSTANT(6, bool, smooth_normals, kSmooth, false)       /* shows light by the voxel's normal */
GPU_KERNEL(radiance, view, View, RadianceViewParams, RADIANCE_VIEW_CONSTANTS)

struct RadianceConesParams // push constants of radiance/cones: a thread a pixel, in the order of path/path.h
{
    GPU_CONST_PTR(TreeTable) tree;
    GPU_CONST_PTR(CachedFace) faces;
    GPU_CONST_PTR(Environment) environment;
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(float) starts; // of tiles
    GPU_PTR(PixelSum) sums;
    CameraRays camera;
    uint width;
    uint height;
    uint run_count;
    uint cone; // of kDiffuseCones
    uint frame;
    uint seed;
};
#define RADIANCE_CONES_CONSTANTS(CONSTANT)                                                                             \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)                                                                    \
    CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 0u)                                                           \
    CONSTANT(2, bool, orthographic, kOrthographic, false)
GPU_KERNEL(radiance, cones, Cones, RadianceConesParams, RADIANCE_CONES_CONSTANTS)

struct RadianceDirectParams // push constants of radiance/direct: a thread a pixel that sees light directly
{
    GPU_CONST_PTR(Hit) hits;
    GPU_CONST_PTR(float) starts;
    GPU_CONST_PTR(TreeTable) tree; // kEmission only
    GPU_CONST_PTR(Environment) environment;
    GPU_PTR(PixelSum) sums;
    GPU_PTR(DispatchArgs) lists;
    GPU_CONST_PTR(uint) direct;
    vec3 forward; // of the camera
    vec3 half_pixel_x;
    vec3 half_pixel_y;
    uint width;
    uint height;
};
#define RADIANCE_DIRECT_CONSTANTS(CONSTANT)                                                                            \
    CONSTANT(0, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(1, bool, emission, kEmission, false) /* there are emissive voxels */
GPU_KERNEL(radiance, direct, Direct, RadianceDirectParams, RADIANCE_DIRECT_CONSTANTS)

GPU_NAMESPACE_END

#endif
