// SPDX-License-Identifier: MIT
// What the kernels that compress an octree share with the host (docs/svdag.md). Candidates are the nodes that are
// compressed: those of an octree, or of a DAG in which equal nodes may stand several times. The class of a candidate is
// the first candidate of its level that has the same subtree below it.
#ifndef ZVO_SHADERS_SVDAG_SVDAG_H
#define ZVO_SHADERS_SVDAG_SVDAG_H

#include "octree/octree.h"
#include "shared/svdag.h"

GPU_NAMESPACE_BEGIN

const uint kSvdagGroup = 64u;      // threads of a workgroup where one thread takes one node
const uint kClassProbesMax = 256u; // slots an insert looks at before the table counts as full
const uint kEmptySlot = ~0u; // a free slot; a taken one holds the first candidate of a class that has been found so far

/// Sizes and failures that the host reads.
struct ClassSizes
{
    uint node_count;                      // unique nodes
    uint entry_count;                     // of their lists
    uint first_nodes[kNodeLevelsMax];     // of each level
    uint first_entries[kNodeLevelsMax];   // of each level but that of the leaves
    uint overflow_counts[kNodeLevelsMax]; // nodes of each level that found no slot
};
GPU_BUFFER(ClassSizes, 4);

struct ClassHashParams // push constants of svdag/hash
{
    GPU_CONST_PTR(Node) nodes;   // the candidates, and their lists
    GPU_CONST_PTR(uint) classes; // [candidates] of the levels below
    GPU_PTR(uvec2) hashes;       // [node_count]
    uint first_node;
    uint node_count;
    uint hash_mask;       // bits of both halves of a hash that are kept
    uint child_reference; // from the number of a child to its reference
};
#define SVDAG_HASH_CONSTANTS(CONSTANT)                                                                                 \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 0u) /* of candidates' lists; 0: there are none */
GPU_KERNEL(svdag, hash, Hash, ClassHashParams, SVDAG_HASH_CONSTANTS)

struct ClassInsertParams // push constants of svdag/insert
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uvec2) hashes; // [node_count]; not for leaves
    GPU_PTR(uint) classes;       // [candidates] gets the level's slots
    GPU_PTR(uint) table;         // slots of all levels
    GPU_PTR(ClassSizes) sizes;   // [1]
    uint first_node;
    uint node_count;
    uint first_slot; // of the level
    uint slot_mask;  // its slots, a power of two, less one
    uint level;
    uint reference;       // from the number of a candidate to its reference
    uint child_reference; // from that of a child
    uint surface;         // from the reference of a leaf of a filled octree to that of its surface mask
};
#define SVDAG_INSERT_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 0u) /* of candidates' lists; 0: there are none */             \
    CONSTANT(1, bool, leaves, kLeaves, false)                /* of the level: equal masks are enough */                \
    CONSTANT(2, bool, filled, kFilled, false)                /* a filled octree is compressed */
GPU_KERNEL(svdag, insert, Insert, ClassInsertParams, SVDAG_INSERT_CONSTANTS)

struct ClassResolveParams // push constants of svdag/resolve
{
    GPU_PTR(uint) classes; // [candidates] slots of a level become classes
    GPU_CONST_PTR(uint) table;
    uint first_node;
    uint node_count;
};
GPU_KERNEL(svdag, resolve, Resolve, ClassResolveParams, GPU_NO_CONSTANTS)

struct ClassCountParams // push constants of svdag/count
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint) classes;
    GPU_PTR(uint) node_partials;  // [ceil(candidates / kScanBlock)] unique nodes
    GPU_PTR(uint) entry_partials; // [ceil(candidates / kScanBlock)] entries of their lists
    uint node_count;              // candidates
    uint inner_count;             // those above the leaves
};
#define SVDAG_COUNT_CONSTANTS(CONSTANT)                                                                                \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 0u) /* of candidates' lists; 0: there are none */
GPU_KERNEL(svdag, count, Count, ClassCountParams, SVDAG_COUNT_CONSTANTS)

struct ClassNumberParams // push constants of svdag/number
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint) classes;
    GPU_CONST_PTR(uint) node_partials;  // scanned
    GPU_CONST_PTR(uint) entry_partials; // scanned
    GPU_PTR(uint) numbers;              // [candidates] unique nodes before a candidate: the number of a unique one
    GPU_PTR(uint) first_entries;        // [inner candidates] entries before
    GPU_PTR(uint) unique_nodes;         // [unique nodes] the candidates that they are
    uint node_count;
    uint inner_count;
};
#define SVDAG_NUMBER_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 0u) /* of candidates' lists; 0: there are none */
GPU_KERNEL(svdag, number, Number, ClassNumberParams, SVDAG_NUMBER_CONSTANTS)

struct UniqueLeavesParams // push constants of svdag/leaves
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint) unique_nodes;
    GPU_PTR(Node) pool;
    uint first_node; // of the DAG
    uint node_count;
    uint reference; // from the number of a candidate to its reference
    uint surface;   // as in ClassInsertParams
};
#define SVDAG_LEAVES_CONSTANTS(CONSTANT) CONSTANT(0, bool, filled, kFilled, false)
GPU_KERNEL(svdag, leaves, Leaves, UniqueLeavesParams, SVDAG_LEAVES_CONSTANTS)

struct UniqueListsParams // push constants of svdag/lists
{
    GPU_CONST_PTR(Node) nodes;
    GPU_CONST_PTR(uint) classes;
    GPU_CONST_PTR(uint) numbers;
    GPU_CONST_PTR(uint) unique_nodes;
    GPU_CONST_PTR(uint) first_entries;
    GPU_PTR(Node) pool;
    GPU_PTR(uint) halfwords;          // the same, as halves of the words of lists: zeros
    GPU_PTR(BeforeChild) below;       // [inner nodes of the DAG] voxels below, nodes below and itself
    GPU_PTR(BeforeChild) before;      // [long entries]
    GPU_PTR(uint) voxels_before_leaf; // [ceil(other entries / 2)] zeros
    uint first_node;                  // of the DAG
    uint node_count;
    uint first_index;      // of entries
    uint long_entry_count; // entries before those of the parents of leaves
    uint child_reference;  // from the number of a child among the candidates to its reference
    uint leaf_reference;   // from that among the DAG's nodes; 0 unless the children are leaves
    uint full_node;        // number of the full node of a filled DAG
};
#define SVDAG_LISTS_CONSTANTS(CONSTANT)                                                                                \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 0u) /* of candidates' lists; 0: there are none */             \
    CONSTANT(1, bool, before, kBefore, false)                /* there are attributes */                                \
    CONSTANT(2, bool, above_leaves, kAboveLeaves, false)     /* the children are leaves */                             \
    CONSTANT(3, uint, per_word, kPerWord, 2u)                /* entries of the lists that are written */               \
    CONSTANT(4, bool, filled, kFilled, false)                /* a filled octree is compressed */
GPU_KERNEL(svdag, lists, Lists, UniqueListsParams, SVDAG_LISTS_CONSTANTS)

struct DepthFirstParams // push constants of svdag/depth_first
{
    GPU_CONST_PTR(Node) nodes; // of the octree
    GPU_CONST_PTR(uint) classes;
    GPU_CONST_PTR(uint) first_entries;
    GPU_CONST_PTR(BeforeChild) before; // by entries without those of a full node
    GPU_CONST_PTR(Attribute) from;     // [nodes of the octree] breadth first; words if they are packed
    GPU_PTR(Attribute) to;             // [nodes of the octree] depth first; words if they are packed
    GPU_PTR(uint) ranks;               // [nodes of the octree] in depth-first order; the level's are known
    uint first_node;
    uint node_count;
    uint child_reference; // from the number of a child to its reference
};
#define SVDAG_DEPTH_FIRST_CONSTANTS(CONSTANT)                                                                          \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 0u) /* of candidates' lists; 0: there are none */             \
    CONSTANT(1, bool, above_leaves, kAboveLeaves, false)     /* the children are leaves */                             \
    CONSTANT(2, bool, packed, kPacked, false)                /* attributes are words */                                \
    CONSTANT(3, uint, lanes, kLanes, 1u)                     /* threads that share a node, a power of two */
GPU_KERNEL(svdag, depth_first, DepthFirst, DepthFirstParams, SVDAG_DEPTH_FIRST_CONSTANTS)

struct AppendParams // push constants of svdag/append: one thread a node
{
    GPU_CONST_PTR(Node) from;
    GPU_PTR(Node) to;
    GPU_PTR(uint) to_entries; // the same, as entries, two a word
    uint first_from;
    uint first_to;
    uint node_count;
    uint entry_shift; // from the index of an entry to that of its copy, modulo 2^32 as the next one
    uint child_shift; // from the number of a child, or of its word, to that of its copy
};
#define SVDAG_APPEND_CONSTANTS(CONSTANT)                                                                               \
    CONSTANT(0, uint, entries_per_word, kEntriesPerWord, 2u) /* of the lists that are copied */
GPU_KERNEL(svdag, append, Append, AppendParams, SVDAG_APPEND_CONSTANTS)

GPU_NAMESPACE_END

#endif
