// SPDX-License-Identifier: MIT
// The one traversal of the octree by rays: the first occupied cell along a ray. Rays are in unit space
// (shared/trace.h). Beams, which only find where rays may start, have trace/beam_start.glsl.
//
// Rule. A ray crosses plane p of axis i at t = (p - origin_i) * inverse_i: one rounded subtraction, one rounded
// product. Crossings are events (t, i), ordered by t, then by axis; the start is the event (t_min, 3). A ray visits a
// cell if the last of the start and its entries through the three lower planes comes before the first of its exits
// through the three upper ones. The hit is the visited occupied voxel with the earliest entry. Planes are taken one at
// a time, so visited cells are neighbours by a face and no ray slips diagonally through a 6-separating surface; and
// whether a cell is visited depends on the ray and that cell alone, not on the way there: all variants find the same
// hit, bit for bit.
//
// Way. Directions are mirrored to be positive (J. Revelles, C. Urena, M. Lastra, An Efficient Parametric Algorithm for
// Octree Traversal, 2000), positions are mantissa bits (S. Laine, T. Karras, Efficient Sparse Voxel Octrees, 2010). The
// state is the current node, its lower corner and the last event, kept as limits: a plane of axis i was crossed iff its
// t < limit_i, where limit_i is the float after the event's t for axes up to the event's and the event's t after that.
// Which cell of the node the ray is in follows from that anew in every iteration, whether it came by a descent, an
// advance or a pop. One uniform loop with its only test in the header; each iteration loads half a node, or a leaf
// word, and descends into the cell, or advances past it (past its 2x2x2 octant, or the half node, if that is empty) to
// the lowest node around both cells.
//
// Rays start in the node at g_halves; indices of hits in an octree need g_leaf_groups (lib/half_node.glsl). Needs what
// TRAVERSE_CONSTANTS (trace/trace.h) declares:
//   kNodeLevels        of the octree
//   kDetail            whether rays stop at small nodes
//   kIterationsMax
//   kEntriesPerWord    of lists; 0: there are none
// A kernel may define before:
//   TRAVERSE_PATHS             a constant, true where rays may begin below the root; not with kDetail or fewer than
//                              four levels (trace/traverse_paths.glsl, which declares the next two)
//   TRAVERSE_PATHS_RELATIVE    a constant, false where the root's first child is node 1
//   uvec2 loadPath(uint cell)  the nodes that contain a cell, as trace/node_paths.h describes it
//   TRAVERSE_WITHOUT_INDICES   hits have no index, and g_leaf_groups need not be set
//   TRAVERSE_ENTRIES           hits in a DAG come with the index of the entry that named their leaf
//   TRAVERSE_VARIABLES         kNodeLevels and kEntriesPerWord are variables, set before each ray
//   TRAVERSE_LEVELS            a constant, at least kNodeLevels, for registers; must be defined if that is a variable
#ifndef ZVO_SHADERS_LIB_TRAVERSE_GLSL
#define ZVO_SHADERS_LIB_TRAVERSE_GLSL

#include "lib/half_node.glsl"
#include "lib/morton.glsl"
#include "lib/ray.glsl"
#include "shared/svdag.h"
#include "shared/trace.h"

#ifdef TRAVERSE_VARIABLES
#define kLeafShift (kMantissaBits - 2u * kNodeLevels) // a variable makes no constant
#else
const uint kLeafShift = kMantissaBits - 2u * kNodeLevels;
#endif
const uint kSavedMax = 8u; // levels of nodes above a leaf
#ifndef TRAVERSE_LEVELS
#define TRAVERSE_LEVELS kNodeLevels
#endif

struct Traversal
{
    bool hit;
    bool unfinished; // out of iterations: (t, face) is the last event, from which the ray can resume
    uint iterations; // loop bodies
    float t;         // of a hit: of the entry, or t_min; of the last event otherwise
    uint index;      // of a hit: attribute index of the voxel, of a DAG its number in the leaf; node where a level of
                     // detail stopped, undefined for a DAG
    uint face;       // axis of the face, or kFaceInside
    uint level;      // of a hit: of nodes; kNodeLevels for a voxel
    uvec3 cell;      // of a hit: coordinates among the cells of that level
#ifdef TRAVERSE_ENTRIES
    uint leaf_entry; // of a hit in a DAG: of the entry that named the leaf, unless the ray began there
#endif
};

uint g_saved[kSavedMax]; // nodes above the current one, by level: registers, as no index is a variable

// The times at which the planes with these bits as coordinates are crossed.
vec3 planeTimes(uvec3 planes, vec3 origin, vec3 inverse)
{
    precise vec3 distances = uintBitsToFloat(planes) - origin;
    precise vec3 times = distances * inverse;
    return times;
}

// Notes the node whose cells are numbered by the mantissa bits at shift.
void saveNode(uint shift, uint node)
{
    [[unroll]] for (uint k = 1u; k < TRAVERSE_LEVELS - 1u; ++k)
        g_saved[k] = shift == kRootShift - 2u * k ? node : g_saved[k];
}

// The node that was noted; the root for shifts outside of the octree.
uint savedNode(uint shift)
{
    uint node = 0u;
    [[unroll]] for (uint k = 1u; k < TRAVERSE_LEVELS - 1u; ++k)
        node = shift == kRootShift - 2u * k ? g_saved[k] : node;
    return node;
}

#ifdef TRAVERSE_PATHS
// Finds a node that contains the cell after the event behind limits, as low as paths go. That cell is guessed from the
// ray's position; it counts only if the ray did enter it and did not leave it.
void beginBelowRoot(vec3 origin, vec3 inverse, uint mirror, uvec3 limits, inout uvec3 corner, inout uint shift,
                    inout uint node)
{
    const uint size = 1u << (kMantissaBits - kPathCellBits);
    float below_two = uintBitsToFloat(floatBitsToUint(2.0) - 1u);
    vec3 guess = clamp(origin + uintBitsToFloat(limits.x - 1u) / inverse, vec3(1.0), vec3(below_two));
    uvec3 low = floatBitsToUint(guess) & ~(size - 1u);
    vec3 crossed = uintBitsToFloat(limits);
    bool inside = all(lessThan(planeTimes(low, origin, inverse), crossed)) &&
                  all(greaterThanEqual(planeTimes(low + size, origin, inverse), crossed));
    uvec3 cell = (low >> (kMantissaBits - kPathCellBits)) & (kPathCells - 1u);
    cell ^= uvec3((mirror & 1u) != 0u ? kPathCells - 1u : 0u, (mirror & 2u) != 0u ? kPathCells - 1u : 0u,
                  (mirror & 4u) != 0u ? kPathCells - 1u : 0u);
    uvec2 path = loadPath(cell.x | (cell.y << kPathCellBits) | (cell.z << (2u * kPathCellBits)));
    path = inside ? path : uvec2(0u);
    uint node1 = path.x & ((1u << kPathLevel1Bits) - 1u);
    uint node2 = path.x >> kPathLevel2Shift;
    if (TRAVERSE_PATHS_RELATIVE)
    {
        uint first_child = loadHalf(0u).y;
        uint before_children = kEntriesPerWord != 0u && int(first_child) < 0 ? 0u : first_child - 1u;
        node1 += node1 != 0u ? before_children : 0u;
        node2 &= (1u << kPathLevel2Bits) - 1u;
        node2 += (path.x >> kPathRelativeShift) != 0u ? before_children : 0u;
    }
    saveNode(kRootShift, 0u);
    saveNode(kRootShift - 2u, node1);
    saveNode(kRootShift - 4u, node2);
    uint level = path.y != 0u ? 3u : node2 != 0u ? 2u : node1 != 0u ? 1u : 0u;
    node = path.y != 0u ? path.y : node2 != 0u ? node2 : node1;
    shift = kRootShift - 2u * level;
    corner = low & (~0u << (shift + 2u));
}
#endif

// The attribute index of the voxel in a cell of a leaf, or kInteriorIndex; of a leaf word of a DAG, the voxel's number
// in the leaf, or kInteriorIndex.
uint voxelIndex(uint leaf, uint cell)
{
    bool is_word = isLeafWord(leaf);
    bool filled_dag = isFilledDag(kEntriesPerWord);
    bool may_be_filled = kEntriesPerWord == 0u || filled_dag;
    uint pair = is_word ? leafWord(leaf) >> 1 : leaf;
    uint surface = pair;
    if (kEntriesPerWord == 0u && is_word)
        surface += loadLeafGroup(1u).x;
    uvec4 words = loadPair(surface);
    if (may_be_filled && !is_word && isFullNode(words.y)) // of a full node, or with the voxels of a leaf word
    {
        is_word = isLeafWord(words.y);
        if (filled_dag || !is_word)
            return kInteriorIndex;
        leaf = words.y & ~kFullNodes;
        pair = leafWord(leaf) >> 1;
        words = loadPair(pair + loadLeafGroup(1u).x);
    }
    bool is_second = is_word && (filled_dag || (leaf & 1u) != 0u);
    bool is_upper = cell >= 32u;
    uint below = (1u << (cell & 31u)) - 1u;
    uint low = is_second ? words.z : words.x;
    uint high = is_second ? words.w : is_word ? words.y : words.z;
    uint index = bitCount((is_upper ? high : low) & below);
    if (!is_word)
        return index + (is_upper ? words.w : words.y);
    index += is_upper ? bitCount(low) : 0u;
    if (kEntriesPerWord == 0u)
    {
        index += voxelsBeforePair(loadLeafGroup(kFirstLeafGroup + pair / (kLeafGroup / 2u)), pair) +
                 (is_second ? bitCount(words.x) + bitCount(words.y) : 0u);
    }
    if (may_be_filled)
    {
        bool on_surface = (((is_upper ? high : low) >> (cell & 31u)) & 1u) != 0u;
        index = on_surface ? index : kInteriorIndex;
    }
    return index;
}

// The attribute index of a node of an octree.
uint nodeIndex(uint node)
{
    uint index = node;
    if (kEntriesPerWord == 0u && uint64_t(g_leaf_groups) != 0ul)
        index = nodeIndexBy(loadLeafGroup(0u), node);
    return index;
}

// The state after the event (t, axis); axis 2 for the start, too.
uvec3 limitsAfter(float t, uint axis)
{
    return floatBitsToUint(t) + uvec3(1u, axis >= 1u ? 1u : 0u, axis >= 2u ? 1u : 0u);
}

// The first occupied cell that the ray enters in [t_min, t_max], found in at most steps_max iterations (at least one).
// A ray that was left unfinished resumes from the state `from`; 0 for a new one. With kDetail, nodes count as occupied
// whose edge is at most max(detail.x * t, detail.y) in unit space. Nothing may be NaN; origin must be finite and
// inverse as lib/ray.glsl's inverseDirection() makes it. What would be entered at an infinite time is never entered.
Traversal traverse(vec3 ray_origin, vec3 ray_inverse, float t_min, float t_max, vec2 detail, uvec3 from,
                   uint iterations_max)
{
    const uint one = floatBitsToUint(1.0);
    bvec3 mirrored = lessThan(ray_inverse, vec3(0.0));
    precise vec3 flipped = 3.0 - ray_origin;
    vec3 origin = mix(ray_origin, flipped, mirrored);
    vec3 inverse = abs(ray_inverse);
    uint mirror = mirrorBits(mirrored);

    // The event that enters the root, or the start.
    t_min = max(t_min, kTraceTimeMin);
    vec3 t_in = planeTimes(uvec3(one), origin, inverse);
    float t = max(max(t_in.x, t_in.y), max(t_in.z, t_min));
    bool z_in = t == t_min || t == t_in.z;
    bool y_in = z_in || t == t_in.y;
    uvec3 limits = floatBitsToUint(t) + uvec3(1u, y_in ? 1u : 0u, z_in ? 1u : 0u); // bits of floats
    limits = max(limits, from);
    uint limit_max = floatBitsToUint(clamp(t_max, 0.0, kTraceTimeMax)) + 1u;

    uvec3 corner = uvec3(one);
    uint shift = kRootShift;
    uint node = 0u;
    uint iterations = 0u;
    bool stopped = false; // by the level of detail
#ifdef TRAVERSE_ENTRIES
    uint leaf_entry = 0u;
#endif
    bool go = limits.x <= limit_max &&
              all(greaterThanEqual(planeTimes(uvec3(one + (4u << kRootShift)), origin, inverse),
                                   uintBitsToFloat(limits)));
#ifdef TRAVERSE_PATHS
    if (TRAVERSE_PATHS)
        beginBelowRoot(origin, inverse, mirror, limits, corner, shift, node);
#endif
    shift = go ? shift : kMantissaBits;
    for (; go;)
    {
        ++iterations;
        saveNode(shift, node);

        // Find the cell of the node that the last event led to.
        vec3 crossed = uintBitsToFloat(limits);
        uint size = 1u << shift;
        uvec3 middle = corner + (size << 1);
        bvec3 upper = lessThan(planeTimes(middle, origin, inverse), crossed);
        uvec3 cell = mix(corner, middle, upper);
        uvec3 quarter = cell + size;
        bvec3 odd = lessThan(planeTimes(quarter, origin, inverse), crossed);
        uint c = (odd.x ? 1u : 0u) | (odd.y ? 2u : 0u) | (odd.z ? 4u : 0u) | (upper.x ? 8u : 0u) |
                 (upper.y ? 16u : 0u) | (upper.z ? 32u : 0u);
        c ^= mirror;

        bool is_word = isLeafWord(node);
        uvec2 half_node = loadHalf(is_word ? leafWord(node) : 2u * node + (c >> 5));
        uint mask = is_word && c >= 32u ? half_node.y : half_node.x;
        uint up_to_cell = mask << (~c & 31u); // the cell's bit on top
        uint child = half_node.y + bitCount(up_to_cell << 1); // of no use in a leaf
        bool octant_empty = ((mask >> (c & 24u)) & 255u) == 0u;

        // The planes at which the ray leaves the cell, its octant if that is empty, or the whole half node.
        bvec3 far = bvec3(odd.x || octant_empty, odd.y || octant_empty, odd.z || octant_empty);
        bvec2 farther = bvec2(mask == 0u && !upper.x, mask == 0u && !upper.y);
        uvec3 leave = quarter + mix(uvec3(0u), uvec3(size), far);
        leave.xy += mix(uvec2(0u), uvec2(size << 1), farther);
        vec3 t_leave = planeTimes(leave, origin, inverse);
        // From far away, planes of one axis can be crossed at the same time; a voxel between them is not visited.
        bool visited = all(greaterThanEqual(t_leave, crossed));
        bool in_leaf = shift == kLeafShift;
        bool ends = in_leaf;
        if (kDetail)
            ends = ends || edgeOf(size) <= max(detail.x * crossed.x, detail.y);
        bool occupied = int(up_to_cell) < 0 && (!ends || visited);
        bool y_before_x = t_leave.y < t_leave.x;
        float t_xy = y_before_x ? t_leave.y : t_leave.x;
        bool z_first = t_leave.z < t_xy;
        bool x_first = !y_before_x && !z_first;
        bool y_first = y_before_x && !z_first;
        uint leave_bits = floatBitsToUint(z_first ? t_leave.z : t_xy);

        // The lowest node around this cell and the next.
        uint leave_plane = z_first ? leave.z : y_before_x ? leave.y : leave.x;
        uint from_plane = z_first ? corner.z : y_before_x ? corner.y : corner.x;
        uint around_shift = uint(findMSB(leave_plane ^ from_plane) - 1) | 1u;
        uvec3 around = uvec3(x_first ? leave_plane : corner.x, y_first ? leave_plane : corner.y,
                             z_first ? leave_plane : corner.z) & (~0u << (around_shift + 2u));
        uint around_node = around_shift == shift ? node : savedNode(around_shift);

        if (kEntriesPerWord != 0u)
        {
            // Every ray loads it, needed or not: on lavapipe, a load that some lanes skip costs more.
            bool listed = occupied && !in_leaf && int(child) < 0;
            uint named = loadEntry(listed ? child & ~kListFlags : 0u, kEntriesPerWord);
#ifdef TRAVERSE_ENTRIES
            // No ray leaves a leaf for another one without a list.
            leaf_entry = listed ? child & ~kListFlags : leaf_entry;
#endif
            child = listed ? named | (child & kLeafWords) : child;
        }

        // Down, or on.
        stopped = kDetail && occupied && ends;
        limits.x = occupied ? limits.x : leave_bits + 1u;
        limits.y = occupied ? limits.y : x_first ? leave_bits : leave_bits + 1u;
        limits.z = occupied ? limits.z : z_first ? leave_bits + 1u : leave_bits;
        corner = occupied ? mix(cell, quarter, odd) : around;
        node = !occupied ? around_node : in_leaf ? node : child;
        shift = occupied ? shift - 2u : around_shift;
        go = shift - kLeafShift <= kRootShift - kLeafShift && limits.x <= limit_max && iterations < iterations_max;
        if (kDetail)
            go = go && !stopped;
    }

    Traversal result;
    result.hit = stopped || shift == kLeafShift - 2u;
    result.unfinished = !result.hit && shift - kLeafShift <= kRootShift - kLeafShift && limits.x <= limit_max;
    result.iterations = iterations;
    result.t = uintBitsToFloat(limits.x - 1u);
    result.face = limits.y < limits.x ? 0u : limits.z < limits.x ? 1u : result.t == t_min ? kFaceInside : 2u;
    result.level = (kRootShift - shift) >> 1;
    result.cell = ((corner - one) >> (shift + 2u)) ^ mix(uvec3(0u), uvec3((1u << (2u * result.level)) - 1u), mirrored);
    result.index = 0u;
#ifndef TRAVERSE_WITHOUT_INDICES
    if (result.hit)
        result.index =
            kDetail && result.level != kNodeLevels ? nodeIndex(node) : voxelIndex(node, cellInBlock(result.cell));
#endif
#ifdef TRAVERSE_ENTRIES
    result.leaf_entry = leaf_entry;
#endif
    return result;
}

// A new ray with all the iterations that an invocation has.
Traversal traverse(vec3 ray_origin, vec3 ray_inverse, float t_min, float t_max, vec2 detail)
{
    return traverse(ray_origin, ray_inverse, t_min, t_max, detail, uvec3(0u), kIterationsMax);
}

#endif
