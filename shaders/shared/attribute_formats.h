// SPDX-License-Identifier: MIT
// Formats in which a tree's attributes are stored (docs/attributes.md). Whatever the format, what is read is an
// Attribute.
//
//   format 4: a word, from the lowest bit on
//
//     | red 5 | green 6 | blue 5 | x 8 | y 8 |       colour as fractions of 31 and 63, octahedral normal as two snorm8
//                                                    or kNoNormal4
//
//   format of blocks: 6 words for 16 voxels that follow each other in Morton order; the last block is filled up with
//   copies of the last voxel. Nodes have format 4.
//
//     word 0   | first colour 16 | second colour 16 |                   as in format 4
//     word 1   | 16 indices of 2 bits |                                 0: first, 3: second, 1 and 2: between them
//     word 2   | x first 7 | x second 7 | y first 7 | y second 7 | axis 2 | negative 1 | diagonal 1 |
//     word 3   | bit 0 of 16 indices of x | bit 0 of 16 indices of y |  0: first, 7: second, 1 to 6: between them
//     words 4, 5: bits 1 and 2
//
//   A block has octahedral coordinates of its own. Their pole is the axis 0 (x), 1 (y) or 2 (z), or its negative end; x
//   and y of the coordinates are the two axes that follow, cyclically. The ends of a scale are 0 to 126 for -63 to 63,
//   which are -1 to 1. Diagonal: what is stored are (x + y) / 2 and (x - y) / 2. With the axis 3 none of the voxels has
//   a normal.
//
// Flags are in the format of 8 bytes alone: a voxel emits if its bit in the emission table is set.
#ifndef ZVO_SHADERS_SHARED_ATTRIBUTE_FORMATS_H
#define ZVO_SHADERS_SHARED_ATTRIBUTE_FORMATS_H

#include "shared/octree.h"

GPU_NAMESPACE_BEGIN

// Specialization constants of the kernels that read attributes; AttributeFormat of the host.
const uint kFormatNone = 0u;
const uint kFormat4 = 1u;
const uint kFormat8 = 2u; // Attribute
const uint kFormatBlocks = 3u;

const uint kRedBits = 5u; // of a packed colour, red in the lowest
const uint kGreenBits = 6u;
const uint kBlueBits = 5u;
const uint kNormalShift4 = 16u;  // of x in format 4
const int kNormalOne4 = 127;     // 1 as a snorm8
const uint kNoNormal4 = 0x8080u; // kNoNormal

const uint kBlockVoxels = 16u;
const uint kBlockWords = 6u;
const uint kBlockColorIndices = 1u; // word of a block
const uint kBlockNormals = 2u;      // word of a block: ends and frame
const uint kBlockNormalIndices = 3u;
const uint kColorIndexMax = 3u;  // index that stands for the second colour; 0: the first
const uint kNormalIndexMax = 7u; // index that stands for the second end of a scale; 0: the first
const int kNormalEnd = 63;       // 1 as an end of such a scale
const uint kEndBits = 7u;
const uint kEndMax = 126u;
const uint kFrameShift = 28u; // of a frame in its word
const uint kFrameAxis = 3u;   // mask
const uint kFrameAxes = 3u;
const uint kFrameNone = 3u; // as an axis: no normals
const uint kFrameNegative = 4u;
const uint kFrameDiagonal = 8u;

GPU_NAMESPACE_END

#endif
