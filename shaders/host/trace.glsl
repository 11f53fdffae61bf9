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
// Questions in integers, exact: positions are on the lattice of 256 units a voxel from the grid's corner on. What touches
// a box is outside of it. Answers are hits, for zvo_isHit() and so on, and zvo_surface():
//   ivec3 zvo_toLattice(tree, position)                               of a point in world space
//   zvo_Hit zvo_point(tree, position)                                 the voxel that a point is in
//   zvo_Hit zvo_box(tree, low, high)                                  a voxel in a box; a miss: it is empty
//   zvo_Hit zvo_nearest(tree, position, reach)                        the nearest voxel, at most that far away
//   zvo_Hit zvo_sweep(tree, low, high, motion)                        the first voxel that a moving box meets
//   uint64_t zvo_squaredDistance(position, hit), ivec2 zvo_sweepTime(low, high, motion, hit)   exact; hit.t is rounded
//
// The radiance cache (zvo::RadianceCache), a zvo_RadianceCacheTable_ConstPtr by its address, as trees:
//   vec4 zvo_irradiance(light, tree, position, normal)                light that arrives at a surface, without a ray
//   vec4 zvo_cachedRadiance(light, tree, hit, origin, direction)        light that comes from where a ray has hit
//   vec4 zvo_gatherIrradiance(light, tree, position, normal, rays, seed)     light that arrives, by rays
//   vec3 zvo_outside(light, direction)                                light from outside of the grid
//   float zvo_occlusion(tree, position, normal, rays, reach, seed)    the share of rays that meet nothing
//   vec4 zvo_cone(light, tree, origin, direction, aperture, reach, seed)     light through a cone, with ZVO_DETAIL
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
//   ZVO_NODE_LEVELS       zvo_TreeTable::node_levels of all trees, a constant or a specialization constant: rays take
//                         registers for so many levels, not for the most that there can be. Other trees are traced
//                         wrongly.
//   ZVO_ENTRIES_PER_WORD  zvo_TreeTable::entries_per_word of all trees, likewise; 0 leaves out what only DAGs need.
//   ZVO_DETAIL            rays may stop at nodes that are small enough: zvo_traceDetail, zvo_traceRayDetail, zvo_cone.
//   ZVO_ITERATIONS_MAX    iterations of a ray or a question in one call, 40,000 by default: enough for any ray through
//                         8192^3 voxels.
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

#include "trace/any_tree.glsl"
#include "host/queries.glsl"
#include "host/radiance_cache.glsl"

#endif
