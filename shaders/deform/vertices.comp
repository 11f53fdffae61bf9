#version 460
// SPDX-License-Identifier: MIT
// Morph targets and linear blend skinning, one vertex a thread, by the rule of docs/deformation.md. deformVertices()
// (core/scene/deform.cpp) gives the same bits.
#extension GL_GOOGLE_include_directive : require
#include "deform/deform.h"

GPU_ENTRY(DeformParams, DEFORM_VERTICES_CONSTANTS);
layout(local_size_x = kDeformGroup) in;

#include "deform/exact.glsl"
#include "lib/dispatch.glsl"

// Adds to value the deltas of count terms, from first on.
vec3 addTerms(vec3 value, uint first, uint count, uint vertex)
{
    for (uint i = 0u; i < count; ++i)
    {
        MorphTerm term = params.morph_terms.data[first + i];
        value = sum(value, product(params.deltas.data[term.first_delta + vertex], term.weight));
    }
    return value;
}

// Position and matrix of a vertex, blended over its joints.
struct Blend
{
    vec3 position;
    mat3 linear; // of the weighted matrices
};

// A joint of weight 0 adds nothing, whatever its matrix.
void addJoint(inout Blend blend, uint joint, float weight, vec3 rest)
{
    bool counts = (floatBitsToUint(weight) << 1) != 0u;
    mat4x3 m = params.joint_matrices.data[joint];
    vec3 moved = sum(transformed(mat3(m), rest), m[3]);
    blend.position = sum(blend.position, counts ? product(moved, weight) : vec3(0.0));
    if (kNormals)
        for (int column = 0; column < 3; ++column)
            blend.linear[column] = sum(blend.linear[column], counts ? product(m[column], weight) : vec3(0.0));
}

// Transforms normal by the cofactors of linear, scaled by a power of two, and reverses it if linear mirrors. If that
// has no direction, the result only tells whether the triangle's normal is to be reversed.
vec3 turnedNormal(mat3 linear, vec3 normal)
{
    uvec3 sizes = max(max(floatBitsToUint(linear[0]) << 1, floatBitsToUint(linear[1]) << 1),
                      floatBitsToUint(linear[2]) << 1);
    uint exponent = max(max(sizes.x, sizes.y), sizes.z) >> 24;
    bool usable = exponent >= kNormalExponentMin && exponent <= kNormalExponentMax;
    float scale = uintBitsToFloat((254u - (usable ? exponent : 127u)) << 23);
    mat3 m = mat3(product(linear[0], scale), product(linear[1], scale), product(linear[2], scale));
    mat3 cofactors = mat3(crossProduct(m[1], m[2]), crossProduct(m[2], m[0]), crossProduct(m[0], m[1]));
    vec3 terms = product(m[0], cofactors[0]);
    precise float determinant = terms.x + terms.y;
    determinant = determinant + terms.z;
    vec3 turned = transformed(cofactors, normal);
    turned = determinant < 0.0 ? -turned : turned;
    vec3 none = vec3(determinant < 0.0 ? uintBitsToFloat(kTurnedRoundBits) : 0.0, 0.0, 0.0);
    turned = isDirection(turned) ? turned : none;
    return usable ? turned : vec3(0.0);
}

void main()
{
    uint chunk_number = workgroupIndex();
    if (chunk_number >= params.chunk_count)
        return;
    DeformChunk chunk = params.chunks.data[params.first_chunk + chunk_number];
    DeformItem item = params.items.data[chunk.item];
    uint vertex = chunk.first_vertex + gl_LocalInvocationIndex;
    if (vertex >= item.vertex_count)
        return;
    vec3 position = params.positions.data[item.first_position + vertex];
    vec3 normal = kNormals ? params.normals.data[item.first_normal + vertex] : vec3(0.0);
    if (kMorphed)
    {
        MorphCounts counts = params.morph_counts.data[chunk.item];
        position = addTerms(position, item.first_term, counts.positions, vertex);
        if (kNormals)
            normal = addTerms(normal, item.first_normal_term, counts.normals, vertex);
    }
    if (kSkinned)
    {
        JointBinding binding = params.bindings.data[item.first_binding + vertex];
        Blend blend = Blend(vec3(0.0), mat3(0.0));
        addJoint(blend, item.first_joint + (binding.joints.x & 65535u), binding.weights.x, position);
        addJoint(blend, item.first_joint + (binding.joints.x >> 16), binding.weights.y, position);
        addJoint(blend, item.first_joint + (binding.joints.y & 65535u), binding.weights.z, position);
        addJoint(blend, item.first_joint + (binding.joints.y >> 16), binding.weights.w, position);
        position = blend.position;
        if (kNormals)
            normal = turnedNormal(blend.linear, normal);
    }
    params.out_positions.data[item.first_out_position + vertex] = canonicalBits(position);
    if (kNormals)
        params.out_normals.data[item.first_out_normal + vertex] = canonicalBits(normal);
}
