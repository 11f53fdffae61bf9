// SPDX-License-Identifier: MIT
// Forms in which a tree's attributes are stored (docs/attributes.md). Whatever the form, what is read is an Attribute.
//
//   form 4: a word, from the lowest bit on
//
//     | red 5 | green 6 | blue 5 | x 8 | y 8 |       colour as fractions of 31 and 63, octahedral normal as two snorm8
//
// Flags are in the form of 8 bytes alone: a voxel emits if its bit in the emission table is set.
#ifndef ZVO_SHADERS_SHARED_ATTRIBUTE_FORMS_H
#define ZVO_SHADERS_SHARED_ATTRIBUTE_FORMS_H

#include "shared/octree.h"

GPU_NAMESPACE_BEGIN

// Specialization constants of the kernels that read attributes; AttributeForm of the host.
const uint kFormNone = 0u;
const uint kForm4 = 1u;
const uint kForm8 = 2u; // Attribute

const uint kRedBits = 5u; // of a packed colour, red in the lowest
const uint kGreenBits = 6u;
const uint kBlueBits = 5u;
const uint kNormalShift4 = 16u; // of x in form 4
const int kNormalOne4 = 127;    // 1 as a snorm8

GPU_NAMESPACE_END

#endif
