// SPDX-License-Identifier: MIT
// The triangle of a thread in a pass over chunks: a workgroup takes a chunk or, with kSingle, a thread.
// Needs the constant kSingle, params.chunks and params.chunk_count, and workgroups of kChunkTriangles.
#ifndef ZVO_SHADERS_VOXELIZE_CHUNK_GLSL
#define ZVO_SHADERS_VOXELIZE_CHUNK_GLSL

#include "lib/dispatch.glsl"
#include "voxelize/loads.glsl"
#include "voxelize/voxelize.h"

// Workgroups that have chunks.
uint chunkGroups()
{
    return kSingle ? (params.chunk_count + kChunkTriangles - 1u) / kChunkTriangles : params.chunk_count;
}

struct ChunkTriangle
{
    bool exists; // else the thread has that of another one
    Draw draw;
    uint triangle; // of the draw
};

// Call where all threads are active: lavapipe then loads for one thread what is uniform.
ChunkTriangle loadChunkTriangle()
{
    uint group_count = chunkGroups();
    uint number = interleave(min(workgroupIndex(), group_count - 1u), group_count);
    if (kSingle)
        number = number * kChunkTriangles + gl_LocalInvocationIndex;
    uint64_t_ConstPtr chunks = uint64_t_ConstPtr(uint64_t(params.chunks)); // one load, not two
    uvec2 chunk = unpackUint2x32(chunks.data[min(number, params.chunk_count - 1u)]);
    uint triangle = chunk.y + (kSingle ? 0u : gl_LocalInvocationIndex);
    Draw draw = loadDraw(chunk.x);
    bool exists = workgroupIndex() < group_count && number < params.chunk_count && triangle < draw.triangle_count;
    return ChunkTriangle(exists, draw, min(triangle, draw.triangle_count - 1u));
}

#endif
