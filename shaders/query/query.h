// SPDX-License-Identifier: MIT
// What the kernels that answer lists of questions share with the host.
#ifndef ZVO_SHADERS_QUERY_QUERY_H
#define ZVO_SHADERS_QUERY_QUERY_H

#include "shared/attribute_formats.h"
#include "shared/query.h"
#include "shared/svdag.h"
#include "shared/trace.h"
#include "trace/trace.h"

GPU_ENUM(QueryKind) // kQueryPoint and so on
#define GPU_TYPE_QueryKind uint

GPU_NAMESPACE_BEGIN

const uint kQueryGroup = 64u; // threads of a workgroup

// Kinds of questions, with the numbers that one has: all are integers, of lattice units.
const uint kQueryPoint = 0u;   // 3: position
const uint kQueryRay = 1u;     // rays have a kernel of their own, trace/rays
const uint kQueryBox = 2u;     // 6: low and high corner
const uint kQueryNearest = 3u; // 4: position, and how far a voxel may be, unsigned
const uint kQuerySweep = 4u;   // 9: low and high corner, motion

struct FindParams // push constants of query/find
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) leaf_groups; // of an octree
    GPU_CONST_PTR(uint) numbers;      // [query_count * numbers of one]
    GPU_PTR(Hit) hits;                // [query_count] as trace/rays leaves them; kHitUnfinished: out of iterations
    GPU_PTR(TraceStatus) status;      // counts unfinished ones
    uint query_count;
};
#define QUERY_FIND_CONSTANTS(CONSTANT)                                                                                 \
    TRAVERSE_CONSTANTS(CONSTANT)                                                                                       \
    CONSTANT(4, QueryKind, kind, kKind, kQueryPoint)
GPU_KERNEL(query, find, Find, FindParams, QUERY_FIND_CONSTANTS)

/// The attributes of a voxel that was found; all 0 where there is none, or the tree has none.
struct QueryLook
{
    Attribute stored; // in 8 bytes, whatever the tree's format
    uint emission;    // radiance / emission_scale as RGB9E5
};
GPU_BUFFER(QueryLook, 4);

struct LookParams // push constants of query/look
{
    GPU_CONST_PTR(Hit) hits;             // [hit_count]
    GPU_CONST_PTR(Attribute) attributes; // of voxels, in the format of kFormat
    GPU_CONST_PTR(Attribute) nodes;      // of the nodes: what is inside has the root's
    GPU_CONST_PTR(uvec2) emission_words; // or null
    GPU_CONST_PTR(uint) emission;
    GPU_PTR(QueryLook) looks; // [hit_count]
    uint hit_count;
};
#define QUERY_LOOK_CONSTANTS(CONSTANT) CONSTANT(0, AttributeFormat, format, kFormat, kFormat8)
GPU_KERNEL(query, look, Look, LookParams, QUERY_LOOK_CONSTANTS)

GPU_NAMESPACE_END

#endif
