// SPDX-License-Identifier: MIT
// What the kernel that finds where the rays of a picture's tiles may start shares with the host.
#ifndef ZVO_SHADERS_TRACE_BEAM_H
#define ZVO_SHADERS_TRACE_BEAM_H

#include "trace/trace.h"

GPU_NAMESPACE_BEGIN

const uint kBeamIterationsMax = 1024u; // after these, a beam ends at nodes of any size

struct BeamParams // push constants of trace/beam: kLanes threads a tile
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
#define TRACE_BEAM_CONSTANTS(CONSTANT)                                                                                 \
    CONSTANT(0, uint, node_levels, kNodeLevels, 5u)          /* of the octree */                                       \
    CONSTANT(1, uint, entries_per_word, kEntriesPerWord, 0u) /* of lists; 0: there are none */                         \
    CONSTANT(2, uint, iterations_max, kIterationsMax, kBeamIterationsMax)                                              \
    CONSTANT(3, bool, orthographic, kOrthographic, false)                                                              \
    CONSTANT(4, bool, beam, kBeam, true)    /* false: every tile lives from kTraceTimeMin on */                        \
    CONSTANT(5, bool, empty, kEmpty, false) /* every tile is dead */                                                   \
    CONSTANT(6, uint, lanes, kLanes, 1u)    /* threads that share a beam, a power of two up to 16 */
GPU_KERNEL(trace, beam, Beam, BeamParams, TRACE_BEAM_CONSTANTS)

GPU_NAMESPACE_END

#endif
