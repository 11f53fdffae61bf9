#version 460
// SPDX-License-Identifier: MIT
// A host's kernel: questions of all kinds.
#extension GL_GOOGLE_include_directive : require
#include "zvo/trace.glsl"

layout(local_size_x = 32) in;

struct Question
{
    ivec3 low; // the point, too
    ivec3 high;
    ivec3 motion;
    uint reach;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Questions
{
    Question question[];
};

struct Found
{
    zvo_Hit hits[4]; // point, box, nearest, sweep
    uint64_t squared_distance;
    ivec2 time;
    ivec3 position; // on the lattice, of the point in world space
    vec3 color;     // of what is nearest
};
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer Answers
{
    Found found[];
};

layout(push_constant, scalar) uniform Push
{
    zvo_TreeTable_ConstPtr tree;
    Questions questions;
    Answers answers;
    uint count;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count)
        return;
    Question q = questions.question[i];
    Found found;
    found.hits[0] = zvo_point(tree, q.low);
    found.hits[1] = zvo_box(tree, q.low, q.high);
    found.hits[2] = zvo_nearest(tree, q.low, q.reach);
    found.hits[3] = zvo_sweep(tree, q.low, q.high, q.motion);
    found.squared_distance = zvo_squaredDistance(q.low, found.hits[2]);
    found.time = zvo_sweepTime(q.low, q.high, q.motion, found.hits[3]);
    vec3 world = tree.data[0].origin + tree.data[0].voxel_size * ((vec3(q.low) + 0.5) / 256.0);
    found.position = zvo_toLattice(tree, world);
    found.color = zvo_surface(tree, found.hits[2], vec3(0.0, 0.0, 1.0)).base_color;
    answers.found[i] = found;
}
