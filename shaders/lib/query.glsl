// SPDX-License-Identifier: MIT
// Questions to a tree that are answered in integers (docs/queries.md): which voxel a point is in, whether a box is
// empty, which voxel is nearest to a point, and what a box that moves meets first.
//
// Positions are on the lattice (shared/lattice.h). A voxel is the cube from 256 * cell to 256 * (cell + 1).
//   point     is in the voxel whose cell is its position / 256, rounded down
//   box       voxels whose inside it shares a point with: both are open, so that what only touches is outside
//   nearest   the voxel whose cube, with its faces, has the least squared distance from the point
//   sweep     the voxel whose inside the box shares a point with first, at a time of 0 to 1, below 1
// Of equals, the first one in Morton order counts: of all voxels of a box, too. So answers depend on the question and
// on the set of voxels, not on the way through the tree.
//
// Way. A walk goes down depth first. In each iteration it loads a node's masks, keeps the cells that can still matter,
// by masks of the ranges along the axes, and takes the next one in an order in which near cells come first: their
// numbers with some bits inverted. It goes down into that cell, or on to the next, or up. A cell is passed by if even
// all of its cube would not be better than the best voxel so far. What remains to be looked at in the nodes above
// follows from their masks and the number of the cell that the walk comes up from: the stack holds nodes alone.
//
// Nodes are at g_halves, leaf groups of an octree at g_leaf_groups (lib/half_node.glsl). Needs what lib/traverse.glsl
// needs. Numbers beyond kQueryReach, and boxes without an inside, find nothing.
#ifndef ZVO_SHADERS_LIB_QUERY_GLSL
#define ZVO_SHADERS_LIB_QUERY_GLSL

#include "lib/cell_masks.glsl"
#include "lib/half_node.glsl"
#include "lib/morton.glsl"
#include "lib/traverse.glsl"
#include "shared/lattice.h"
#include "shared/query.h"

const uint kNoCell = 64u;
const float kWider = 1.0 + 1.0 / 65536.0; // more than what floats lose in a product, a quotient or a root

bool isInReach(ivec3 position)
{
    return all(greaterThanEqual(position, ivec3(-kQueryReach))) && all(lessThanEqual(position, ivec3(kQueryReach)));
}

bool hasInside(ivec3 low, ivec3 high)
{
    return isInReach(low) && isInReach(high) && all(lessThan(low, high));
}

int64_t product(int a, int b)
{
    return int64_t(a) * int64_t(b);
}

// Whether a.x / a.y < b.x / b.y. Over 0, what is not 0 is infinite.
bool isLess(ivec2 a, ivec2 b)
{
    return product(a.x, b.y) < product(b.x, a.y);
}

// Whether cell a comes before cell b in Morton order.
bool isBefore(uvec3 a, uvec3 b)
{
    ivec3 highest = findMSB(a ^ b);
    bool z_decides = highest.z >= max(highest.x, highest.y);
    bool y_decides = highest.y >= highest.x;
    return z_decides ? a.z < b.z : y_decides ? a.y < b.y : a.x < b.x;
}

// The squared distance of a point from a cube of which it may be a part, in lattice units.
uint64_t squaredDistance(ivec3 position, ivec3 cube, int edge)
{
    ivec3 apart = max(max(cube - position, position - (cube + edge)), ivec3(0));
    return uint64_t(product(apart.x, apart.x)) + uint64_t(product(apart.y, apart.y)) +
           uint64_t(product(apart.z, apart.z));
}

// When a box on its way comes to share a point with the inside of a cube.
struct Contact
{
    bool happens;
    ivec2 time; // numerator and denominator; -1 / 1: the box begins there
    uint face;  // axis on which it comes last, the last one of equal times; kFaceInside
};

Contact contactWith(ivec3 low, ivec3 high, ivec3 motion, ivec3 cube, int edge)
{
    ivec3 speed = abs(motion);
    bvec3 backward = lessThan(motion, ivec3(0));
    // What the box moves along each axis until it is level with the cube, and until it is past it. Where it does not
    // move, the quotients by the speed are infinite.
    ivec3 to_cube = mix(cube - high, low - (cube + edge), backward);
    ivec3 past_cube = mix(cube + edge - low, high - cube, backward);
    ivec2 enter = ivec2(to_cube.x, speed.x);
    ivec2 leave = ivec2(past_cube.x, speed.x);
    ivec2 enter_y = ivec2(to_cube.y, speed.y);
    ivec2 leave_y = ivec2(past_cube.y, speed.y);
    ivec2 enter_z = ivec2(to_cube.z, speed.z);
    ivec2 leave_z = ivec2(past_cube.z, speed.z);
    bool y_later = !isLess(enter_y, enter);
    enter = y_later ? enter_y : enter;
    bool z_later = !isLess(enter_z, enter);
    enter = z_later ? enter_z : enter;
    leave = isLess(leave_y, leave) ? leave_y : leave;
    leave = isLess(leave_z, leave) ? leave_z : leave;
    bool is_inside = all(lessThan(to_cube, ivec3(0)));
    Contact contact;
    contact.happens = all(lessThan(to_cube, speed)) && all(greaterThan(past_cube, ivec3(0))) &&
                      (isLess(enter, leave) || enter.y == 0);
    contact.time = is_inside ? ivec2(-1, 1) : enter;
    contact.face = is_inside ? kFaceInside : z_later ? 2u : y_later ? 1u : 0u;
    return contact;
}

Traversal nothingFound()
{
    Traversal result;
    result.hit = false;
    result.unfinished = false;
    result.iterations = 0u;
    result.t = 0.0;
    result.index = 0u;
    result.face = kFaceInside;
    result.level = kNodeLevels;
    result.cell = uvec3(0u);
    return result;
}

// The voxel that a point is in.
Traversal findPoint(ivec3 position)
{
    Traversal result = nothingFound();
    result.cell = uvec3(position >> kVoxelLatticeLog2);
    uint shift = 2u * kNodeLevels - 2u;
    uint node = 0u;
    uint c = 0u;
    bool occupied = false;
    bool go = all(lessThan(result.cell, uvec3(1u << (2u * kNodeLevels))));
    for (; go;)
    {
        ++result.iterations;
        c = cellInBlock(result.cell >> shift);
        bool is_word = isLeafWord(node);
        uvec2 half_node = loadHalf(is_word ? leafWord(node) : 2u * node + (c >> 5));
        uint mask = is_word && c >= 32u ? half_node.y : half_node.x;
        uint up_to_cell = mask << (~c & 31u); // the cell's bit on top
        uint child = half_node.y + bitCount(up_to_cell << 1); // of no use in a leaf
        bool in_leaf = shift == 0u;
        occupied = int(up_to_cell) < 0;
        if (kEntriesPerWord != 0u)
        {
            bool listed = occupied && !in_leaf && int(child) < 0;
            uint named = loadEntry(listed ? child & ~kListFlags : 0u, kEntriesPerWord);
            child = listed ? named | (child & kLeafWords) : child;
        }
        go = occupied && !in_leaf;
        node = go ? child : node;
        shift = go ? shift - 2u : shift;
    }
    result.hit = occupied;
    if (occupied)
        result.index = voxelIndex(node, c);
    return result;
}

// What walks look for: a box's first voxel, the nearest one to a point, or the first one on a box's way.
const uint kWalkBox = 0u;
const uint kWalkNearest = 1u;
const uint kWalkSweep = 2u;

// The cells that can still matter, where they can lie in the root's cube.
struct CellRange
{
    ivec3 low;
    ivec3 high;
};

CellRange cellRange(ivec3 low, ivec3 high)
{
    int last = int(1u << (2u * kNodeLevels)) - 1;
    return CellRange(max(low >> kVoxelLatticeLog2, ivec3(0)), min(high >> kVoxelLatticeLog2, ivec3(last)));
}

// Those whose cubes are not farther from a point than `reach`.
CellRange cellsAround(ivec3 position, int reach)
{
    return cellRange(position - (reach + 1), position + reach);
}

// Those whose insides a box can come to share a point with until a part of its motion is over.
CellRange cellsOnWay(ivec3 low, ivec3 high, ivec3 motion)
{
    return cellRange(low + min(motion, ivec3(0)), high + max(motion, ivec3(0)) - 1);
}

// low: the point for kWalkNearest. bound: the largest squared distance, for kWalkNearest. kind: a constant.
Traversal walk(uint kind, ivec3 low, ivec3 high, ivec3 motion, CellRange range, uint64_t bound, uint iterations_max)
{
    Traversal best = nothingFound();
    uint64_t best_distance = bound + 1ul; // squared
    ivec2 best_time = ivec2(1, 1);
    uint best_leaf = 0u;
    uint best_number = 0u; // of its cell in the leaf
    ivec3 point_cell = low >> kVoxelLatticeLog2;
    uint mirror = mirrorBits(lessThan(motion, ivec3(0)));

    uint root_shift = 2u * kNodeLevels - 2u;
    ivec3 corner = ivec3(0); // of the node, in voxels
    uint shift = root_shift; // its cells have 1 << shift voxels per edge
    uint node = 0u;
    uint last = kNoCell; // the cell of the node that the walk has just dealt with
    bool is_first = kind == kWalkBox; // the first voxel is the answer
    bool complete = any(greaterThan(range.low, range.high));
    bool go = !complete;
    for (; go;)
    {
        ++best.iterations;
        saveNode(shift + kLeafShift, node);
        bool is_word = isLeafWord(node);
        bool is_second = is_word && (node & 1u) != 0u;
        uvec4 words = loadPair(is_word ? leafWord(node) >> 1 : node);
        uvec2 mask = is_second ? words.zw : is_word ? words.xy : words.xz;

        // The next cell.
        uint flip = mirror;
        if (kind == kWalkNearest)
            flip = cellInBlock(uvec3(clamp((point_cell - corner) >> int(shift), ivec3(0), ivec3(3))));
        mask &= cellsBetween(max(range.low - corner, ivec3(0)) >> int(shift), (range.high - corner) >> int(shift));
        mask = flippedCells(mask, flip) & cellsFrom(last == kNoCell ? 0u : (last ^ flip) + 1u);
        bool is_any = (mask.x | mask.y) != 0u;
        uint c = is_any ? firstCell(mask) ^ flip : 0u;
        ivec3 cell = corner + (ivec3(cellNumbered(c)) << int(shift));
        bool is_upper = c >= 32u;
        uint below = (1u << (c & 31u)) - 1u;
        uint child = (is_upper ? words.w : words.y) + bitCount((is_upper ? words.z : words.x) & below);
        bool in_leaf = shift == 0u; // where a child means nothing
        if (kEntriesPerWord != 0u)
        {
            bool listed = is_any && !in_leaf && int(child) < 0;
            uint named = loadEntry(listed ? child & ~kListFlags : 0u, kEntriesPerWord);
            child = listed ? named | (child & kLeafWords) : child;
        }

        // Whether it can be better than the best voxel.
        bool is_better = is_any;
        ivec3 cube = cell << kVoxelLatticeLog2;
        int edge = kVoxelLattice << int(shift);
        uint64_t distance = 0ul;
        Contact contact = Contact(true, ivec2(-1, 1), kFaceInside);
        if (kind == kWalkNearest)
        {
            distance = squaredDistance(low, cube, edge);
            is_better = is_any && (distance < best_distance ||
                                   (distance == best_distance && isBefore(uvec3(cell), best.cell)));
        }
        if (kind == kWalkSweep)
        {
            contact = contactWith(low, high, motion, cube, edge);
            is_better = is_any && contact.happens &&
                        (isLess(contact.time, best_time) ||
                         (!isLess(best_time, contact.time) && isBefore(uvec3(cell), best.cell)));
        }
        if (is_better && in_leaf)
        {
            best.hit = true;
            best.face = contact.face;
            best.cell = uvec3(cell);
            best_distance = distance;
            best_time = contact.time;
            best_leaf = node;
            best_number = c;
            if (kind == kWalkNearest)
                range = cellsAround(low, int(sqrt(float(distance)) * kWider) + 1);
            if (kind == kWalkSweep)
            {
                float time = float(max(best_time.x, 0)) / float(best_time.y) * kWider;
                range = cellsOnWay(low, high, sign(motion) * min(abs(motion), ivec3(vec3(abs(motion)) * time) + 2));
            }
        }

        // Down, up, or on.
        bool down = is_better && !in_leaf;
        bool up = !is_any;
        uint up_shift = shift + 2u;
        complete = (up && shift == root_shift) || (is_first && best.hit);
        last = down ? kNoCell : up ? cellInBlock(uvec3(corner) >> up_shift) : c;
        corner = down ? cell : up ? corner & (~0 << int(up_shift + 2u)) : corner;
        node = down ? child : up ? savedNode(up_shift + kLeafShift) : node;
        shift = down ? shift - 2u : up ? up_shift : shift;
        if (kind == kWalkSweep && best.hit && best_time.x < 0 && !is_first)
        {
            // The box begins at voxels, perhaps many: the first one in Morton order counts.
            is_first = true;
            best.hit = false;
            best_time = ivec2(1, 1);
            mirror = 0u;
            range = cellRange(low, high - 1);
            corner = ivec3(0);
            node = 0u;
            shift = root_shift;
            last = kNoCell;
        }
        go = !complete && best.iterations < iterations_max;
    }
    best.unfinished = !complete;
    best.hit = best.hit && complete;
    if (best.hit)
        best.index = voxelIndex(best_leaf, best_number);
    if (kind == kWalkNearest)
        best.t = sqrt(float(best_distance)) / float(kVoxelLattice);
    if (kind == kWalkSweep)
        best.t = float(max(best_time.x, 0)) / float(best_time.y);
    return best;
}

// The first voxel in a box.
Traversal findInBox(ivec3 low, ivec3 high)
{
    if (!hasInside(low, high))
        return nothingFound();
    return walk(kWalkBox, low, high, ivec3(0), cellRange(low, high - 1), 0ul, kIterationsMax);
}

// The nearest voxel to a point, not farther than reach. t: about the distance in voxels.
Traversal findNearest(ivec3 position, uint reach)
{
    if (!isInReach(position))
        return nothingFound();
    reach = min(reach, uint(kNearestReach));
    return walk(kWalkNearest, position, position, ivec3(0), cellsAround(position, int(reach)),
                uint64_t(product(int(reach), int(reach))), kIterationsMax);
}

// What a box meets that moves in a line. t: about the time.
Traversal findOnWay(ivec3 low, ivec3 high, ivec3 motion)
{
    if (!hasInside(low, high) || !isInReach(motion))
        return nothingFound();
    return walk(kWalkSweep, low, high, motion, cellsOnWay(low, high, motion), 0ul, kIterationsMax);
}

#endif
