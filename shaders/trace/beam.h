// SPDX-License-Identifier: MIT
// What the kernel that finds where the rays of a picture's tiles may start shares with the host.
#ifndef ZVO_SHADERS_TRACE_BEAM_H
#define ZVO_SHADERS_TRACE_BEAM_H

#include "trace/trace.h"

GPU_NAMESPACE_BEGIN

const uint kBeamIterationsMax = 1024u; // after these, a beam ends at nodes of any size

struct BeamParams // push constants of trace/beam: one thread a tile
{
    GPU_CONST_PTR(Node) nodes;
    GPU_PTR(float) starts; // [tiles] row by row: where its rays may start, or kTileDead
    GPU_PTR(uvec2) live;   // [tiles] x | y << 16, bits of the start: of tiles that are not dead; filled with kNoTile
    GPU_PTR(DispatchArgs) args;  // [1] cleared; one workgroup a live tile
    GPU_PTR(TraceStatus) status; // [1]
    CameraRays camera;
    uint width; // pixels
    uint height;
    uint block_stride; // coprime to the number of blocks: the order in which they are taken
    vec2 detail;       // as traverse(), of the picture's rays
};
GPU_KERNEL_BEGIN(trace, beam, Beam, BeamParams)
    GPU_CONSTANT(uint, node_levels, 5u)
    GPU_CONSTANT(uint, entries_per_word, 0u)
    GPU_CONSTANT(uint, iterations_max, kBeamIterationsMax)
    GPU_CONSTANT(bool, orthographic, false)
    GPU_CONSTANT(bool, beam, true)
    GPU_CONSTANT(bool, empty, false)
GPU_KERNEL_END

GPU_NAMESPACE_END

#endif
