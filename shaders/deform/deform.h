// SPDX-License-Identifier: MIT
// What the deformation kernel shares with the host. docs/deformation.md has the rule that both follow.
#ifndef ZVO_SHADERS_DEFORM_DEFORM_H
#define ZVO_SHADERS_DEFORM_DEFORM_H

#include "shared/scene.h"

GPU_NAMESPACE_BEGIN

const uint kDeformGroup = 64u;        // vertices of one instance that one workgroup takes
const uint kMorphTargetsMax = 16384u; // of a mesh: bounds a thread's work

// Numbers whose biased exponent is below count as 0: those under 2^-100. Sums of others are multiples of 2^-123, never
// subnormal, so it does not matter what a device makes of subnormal numbers.
const uint kTinyExponent = 27u;

// The largest entry of a matrix that turns normals has a biased exponent in this range, 2^-100 to 2^101.
const uint kNormalExponentMin = 27u;
const uint kNormalExponentMax = 227u;

const uint kCanonicalNan = 2143289344u; // the bits of what is written for a number that is not finite

// Bits of a variant: what the vertices of an instance have. Each bit is a specialization constant. Skinned vertices
// always have normals, which may all be 0: the result of such a normal tells which side of the triangle is outside.
const uint kDeformMorphed = 1u; // constant 0
const uint kDeformSkinned = 2u; // constant 1
const uint kDeformNormals = 4u; // constant 2
const uint kDeformVariants = 8u;

/// The joints and weights of a vertex.
struct JointBinding
{
    uvec2 joints; // of the skin: the first two, the last two, 16 bits each; 0 where the weight is 0
    vec4 weights; // at least one is not 0
};
GPU_BUFFER(JointBinding, 4);

GPU_BUFFER(mat4x3, 4);

/// A morph target in a pose: its delta times weight is added to each vertex.
struct MorphTerm
{
    uint first_delta; // in DeformParams::deltas, of the primitive's first vertex
    float weight;     // not 0
};
GPU_BUFFER(MorphTerm, 4);

/// The numbers of terms of an instance in the present pose.
struct MorphCounts
{
    uint positions;
    uint normals;
};
GPU_BUFFER(MorphCounts, 4);

/// One instance that deforms.
struct DeformItem
{
    uint vertex_count;
    uint first_position;     // at rest
    uint first_normal;       // at rest; not used without kDeformNormals
    uint first_binding;      // not used without skin
    uint first_joint;        // in joint_matrices; not used without skin
    uint first_term;         // of positions; not used without morph targets
    uint first_normal_term;  // of normals; not used without morph targets
    uint first_out_position; // in out_positions
    uint first_out_normal;   // in out_normals; not used without kDeformNormals
};
GPU_BUFFER(DeformItem, 4);

/// Vertices [first_vertex, first_vertex + kDeformGroup) of an item.
struct DeformChunk
{
    uint item;
    uint first_vertex;
};
GPU_BUFFER(DeformChunk, 4);

struct DeformParams // push constants of deform/vertices
{
    GPU_CONST_PTR(DeformChunk) chunks;
    GPU_CONST_PTR(DeformItem) items;
    GPU_CONST_PTR(vec3) positions; // at rest
    GPU_CONST_PTR(vec3) normals;   // at rest
    GPU_CONST_PTR(JointBinding) bindings;
    GPU_CONST_PTR(vec3) deltas;           // of morph targets
    GPU_CONST_PTR(mat4x3) joint_matrices; // object to world
    GPU_CONST_PTR(MorphTerm) morph_terms;
    GPU_CONST_PTR(MorphCounts) morph_counts; // [items]
    GPU_PTR(uvec3) out_positions;            // the bits of floats
    GPU_PTR(uvec3) out_normals;              // the bits of floats; of any length
    uint first_chunk;
    uint chunk_count;
};
#define DEFORM_VERTICES_CONSTANTS(CONSTANT)                                                                            \
    CONSTANT(0, bool, morphed, kMorphed, false)                                                                        \
    CONSTANT(1, bool, skinned, kSkinned, false)                                                                        \
    CONSTANT(2, bool, normals, kNormals, false)
GPU_KERNEL(deform, vertices, Vertices, DeformParams, DEFORM_VERTICES_CONSTANTS)

GPU_NAMESPACE_END

#endif
