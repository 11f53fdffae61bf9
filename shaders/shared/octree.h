// SPDX-License-Identifier: MIT
// The octree in device memory.
//
// One node stores the 64 children of two octree levels at once, a block of 4x4x4 cells. Cell (x, y, z) of the block is
// bit  x0 | y0 << 1 | z0 << 2 | x1 << 3 | y1 << 4 | z1 << 5  of the mask (its 6-bit Morton code), x = x0 + 2 x1 and so
// on; so each byte of the mask is one 2x2x2 octant, and the mask's lower half are the cells with z < 2.
//
//     byte 0        4        8        12       16
//          | mask_lo| base_lo| mask_hi| base_hi|
//
//   inner node: child c of a half is node             base + popcount(mask & bits below c)
//   leaf node:  voxel c of a half has attribute index base + popcount(mask & bits below c)
//
// Nodes stand breadth first, each level in Morton order; node 0 is the root. With L = nodeLevels(depth) levels the
// root covers 4^L voxels per edge: for an odd depth the grid is the lower octant of that cube.
//
// The leaves of a finished tree of several levels are *leaf words*: their masks alone. They stand behind the
// inner nodes, two in the room of a node. Bases with the flag kLeafWords count words of 64 bits, from node 0 on:
//
//     byte 0        4        8
//          | mask_lo| mask_hi|
//
//   node with leaf words: child c of a half is word  (base & ~kLeafWords) + popcount(mask & bits below c)
//
// What such a sum gives is the *reference* of a child: the number of a node, or kLeafWords | the number of a word. The
// i-th leaf of a tree with n inner nodes is node n + i and word 2 n + i. Leaf groups tell its first voxel:
//
//     element 0      x: n
//                    y: from the number of a node behind the pool to the index of its attributes, modulo 2^32
//     element 1      x: from a pair of leaf words to that of their surface masks, in nodes
//     element 2 + g  x: voxels before word 8 g
//                    y: voxels from there to word 8 g + 2: 8 bits | 8 g + 4: 9 | 8 g + 6: 9 | unused 6, the lowest
//                    first
//
// Words of inner nodes hold no voxels.
//
// In a *filled* tree, cells are occupied that are inside and not on the surface. They have no attributes: the voxels of
// a leaf word are those of its surface mask, a word of its own, which only hits need. In other trees that is the leaf
// word itself. Nodes above leaves that are occupied throughout are *full*: their mask has all bits, and their children
// are the 64 *full nodes* of the tree, which are each other's children in turn, at any level:
//
//     inner nodes | leaf words, to a whole node | 64 full nodes | surface masks, to a whole node
//
// Bases that name them have the flag kFullNodes, which vanishes where references become numbers of half nodes.
//
// A filled DAG has them in another form (shared/svdag.h).
//
// Leaves of overlays are nodes with one mask. One that is a copy of a filled tree's leaf word has, as both bases,
// kFullNodes | the reference of that word, whose voxels it has; a copy of a full node keeps the bases of a full node.
#ifndef ZVO_SHADERS_SHARED_OCTREE_H
#define ZVO_SHADERS_SHARED_OCTREE_H

#include "shared/gpu.h"

GPU_NAMESPACE_BEGIN

/// A 4x4x4 block of cells: 16 bytes, of which an iteration of a ray loads one half.
struct Node
{
    uint mask_lo; // cells with z < 2
    uint base_lo; // reference of the first child, or first voxel attribute in a leaf
    uint mask_hi; // cells with z >= 2
    uint base_hi;
};
GPU_BUFFER(Node, 16);

/// The attributes of a voxel, or of an inner node for level of detail: 8 bytes.
struct Attribute
{
    uint color;  // sRGB red | green << 8 | blue << 16 | flags << 24
    uint normal; // octahedral, snorm16 x | snorm16 y << 16; or kNoNormal
};
GPU_BUFFER(Attribute, 8);

/// The normal of a voxel or node whose surfaces face all ways, such as both sides of a shell that is thinner than a
/// voxel. It is shaded with the normal of the face that the ray comes in through. No direction has this code.
const uint kNoNormal = 0x80008000u;

const uint kColorMask = 0xffffffu; // of Attribute::color, without flags

const uint kAttributeEmissive = 1u; // flag: the voxel has an entry in the emission table
const uint kAttributeNone = 2u;     // flag: of a node that has no voxel of the surface

/// Voxels whose bits share a word of the emission table (lib/emission.glsl).
const uint kVoxelsPerEmissionWord = 32u;

const uint kNodeLevelsMax = 9u; // two octree levels each: depth 18

const uint kLeafWords = 0x40000000u;     // flag in Node::base_lo and base_hi, and in references
const uint kLeafGroup = 8u;              // words of a leaf group
const uint kFirstLeafGroup = 2u;         // among leaf groups
const uint kFullNodes = 0x80000000u;     // flag of references to full nodes, in an octree
const uint kFullNodeCount = 64u;         // in a filled tree
const uint kInteriorIndex = 0x80000000u; // in place of an attribute's index: the voxel is inside, and has none
const uint kGroupShift2 = 8u;            // in the y of a leaf group: voxels before its fifth word, and its seventh
const uint kGroupShift3 = 17u;

GPU_NAMESPACE_END

#endif
