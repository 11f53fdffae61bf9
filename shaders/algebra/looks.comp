#version 460
// SPDX-License-Identifier: MIT
// The attributes of the result's voxels, or their emission: those that they have in an operand; of others, what their
// neighbours in it have, and what is beside them.
#extension GL_GOOGLE_include_directive : require
#include "algebra/algebra.h"

GPU_ENTRY(LooksParams, ALGEBRA_LOOKS_CONSTANTS);
layout(local_size_x = kAlgebraGroup) in;

#include "algebra/leaves_around.glsl"
#include "algebra/operand.glsl"
#include "algebra/place.glsl"
#include "lib/arithmetic.glsl"
#include "lib/attribute.glsl"
#include "lib/cell_masks.glsl"
#include "lib/dispatch.glsl"
#include "lib/emission.glsl"
#include "lib/normal.glsl"

const bool kTakesB = kOperation == kUnite || kOperation == kIntersect;
const uint kNeighbours = kOperation == kDilate && !kCorners ? 6u : 27u; // that are looked at; of 27, one is the voxel itself

shared uint s_bricks[27];        // references of the brick in a and of those around it
shared uint s_results[27];       // numbers of the same nodes in the result; 0: empty, kNothing: full
shared uvec2 s_result[kLeavesAround];  // voxels of the result
shared uvec2 s_surface[kLeavesAround]; // voxels of a that have attributes
shared uint s_first[kLeavesAround];    // index of the attributes of the first of these
shared uint s_inside[kBrickLeaves];    // of the brick's leaves, the node of a that what is inside of them looks like
shared uvec2 s_surface_of_b[kTakesB ? kBrickLeaves : 1u];
shared uint s_first_of_b[kTakesB ? kBrickLeaves : 1u];
shared uint s_has_new; // 1: voxels of the brick have no attributes in an operand

// The leaf in a cell of a brick, and the leaf's voxels that have attributes. reference: of the brick.
Found leafIn(Operand tree, uint reference, uint cell, out Node surface)
{
    Found leaf = Found(kNothing, reference, cell);
    surface = Node(0u, 0u, 0u, 0u);
    if (reference == kNothing)
        return leaf;
    Node brick = loadInner(tree.nodes, reference);
    if (hasChild(brick, cell))
        leaf.reference = childIndex(brick, cell);
    if (leaf.reference != kNothing && isLeafWord(leaf.reference))
        surface = loadNodeOf(tree.nodes, tree.leaf_groups, leaf.reference);
    return leaf;
}

// The brick of the result, as s_results has it.
uint resultBrick(uvec3 brick, uint levels)
{
    uint number = 0u;
    for (uint level = levels; level > 0u; --level)
    {
        Node node = params.nodes.data[number];
        if ((node.mask_lo | node.mask_hi) == 0u)
            return kNothing;
        uint child = cellInBlock(brick >> (2u * level - 2u));
        if (!hasChild(node, child))
            return 0u;
        number = childIndex(node, child);
    }
    Node node = params.nodes.data[number];
    return (node.mask_lo | node.mask_hi) == 0u ? kNothing : number + 1u;
}

// The voxels of the result in a leaf of a brick around.
uvec2 resultMask(uint brick, uint cell)
{
    if (brick == 0u || brick == kNothing)
        return brick == 0u ? uvec2(0u) : uvec2(~0u);
    Node node = params.nodes.data[brick - 1u];
    if (!hasChild(node, cell))
        return uvec2(0u);
    uint leaf = childIndex(node, cell);
    if (kFilled)
        return params.occupied.data[leaf - params.first_leaf];
    return uvec2(params.nodes.data[leaf].mask_lo, params.nodes.data[leaf].mask_hi);
}

bool isInGrid(ivec3 leaf)
{
    return all(greaterThanEqual(leaf, ivec3(0))) && all(lessThan(leaf, ivec3(params.leaf_edge)));
}

// A brick around this one, by each of the first threads.
void findBricks(NodePlace place)
{
    uint i = gl_LocalInvocationIndex;
    if (i >= 27u)
        return;
    ivec3 brick = ivec3(place.cell) + ivec3(i % 3u, i / 3u % 3u, i / 9u) - 1;
    bool in_grid = isInGrid(4 * brick);
    uint reference = kNothing;
    uint result = kNothing;
    if (in_grid)
        reference = findNode(params.a, uvec3(brick), place.level).reference;
    if (in_grid && kOperation != kDilate)
        result = resultBrick(uvec3(brick), place.level);
    s_bricks[i] = reference;
    s_results[i] = result;
}

// What leaf `at` of those around is in the result and in a. Outside of the grid, nothing is empty and nothing is in a.
void findLeaf(NodePlace place, uvec3 at)
{
    uint i = leafAroundNumber(at);
    uint brick = brickOfLeafAround(at);
    uint cell = cellInBlock(at + 3u);
    bool in_grid = isInGrid(4 * ivec3(place.cell) + ivec3(at) - 1);
    Node surface;
    leafIn(params.a, in_grid ? s_bricks[brick] : kNothing, cell, surface);
    s_surface[i] = uvec2(surface.mask_lo, surface.mask_hi);
    s_first[i] = surface.base_lo;
    s_result[i] = uvec2(~0u);
    if (in_grid && kOperation != kDilate)
        s_result[i] = resultMask(s_results[brick], cell);
}

// The leaf of the brick with this thread's number.
void findOwnLeaf(NodePlace place)
{
    uint lane = gl_LocalInvocationIndex;
    uint i = leafAroundNumber(cellNumbered(lane) + 1u);
    Found at = findNode(params.a, place.cell, place.level);
    Node surface;
    Found leaf = leafIn(params.a, at.reference, lane, surface);
    s_surface[i] = uvec2(surface.mask_lo, surface.mask_hi);
    s_first[i] = surface.base_lo;
    bool is_brick = at.reference != kNothing && !isFullNode(at.reference);
    s_inside[lane] = is_brick ? at.reference : at.around;
    if (leaf.reference != kNothing && isLeafWord(leaf.reference))
        s_inside[lane] = nodeIndexOf(params.a.leaf_groups, leaf.reference);
    if (kTakesB)
    {
        leafIn(params.b, findNode(params.b, place.cell, place.level).reference, lane, surface);
        s_surface_of_b[lane] = uvec2(surface.mask_lo, surface.mask_hi);
        s_first_of_b[lane] = surface.base_lo;
    }
}

// The index of the attributes of a voxel that has some.
uint indexIn(uvec2 surface, uint first, uint bit)
{
    uvec2 before = surface & ~cellsFrom(bit);
    return first + bitCount(before.x) + bitCount(before.y);
}

// What the neighbours of a voxel are.
struct Around
{
    uvec3 color; // sums over those that have attributes in a
    ivec3 normal;
    uint count;
    ivec3 open; // sum of the directions to those that are empty in the result
};

// voxel: from the lowest corner of the leaves around on.
Around lookAround(uvec3 voxel)
{
    LinearTable to_linear = LINEAR_TABLE(params.scene);
    Attribute_ConstPtr voxels = params.looks.data[0].voxels;
    Around sums = Around(uvec3(0u), ivec3(0), 0u, ivec3(0));
    for (uint i = 0u; i < kNeighbours; ++i)
    {
        ivec3 direction = ivec3(i % 3u, i / 3u % 3u, i / 9u) - 1;
        if (kNeighbours == 6u)
            direction = ivec3(equal(uvec3(i >> 1), uvec3(0u, 1u, 2u))) * (int(i & 1u) * 2 - 1);
        uvec3 beside = uvec3(ivec3(voxel) + direction);
        uint leaf = leafAroundNumber(beside / 4u);
        uint bit = cellInBlock(beside);
        if (kOperation != kDilate && !hasCell(s_result[leaf], bit))
            sums.open += direction;
        ivec3 steps = abs(direction);
        uint distance = uint(steps.x + steps.y + steps.z);
        bool is_neighbour = kCorners || kOperation == kSubtract ? distance != 0u : distance == 1u;
        if (is_neighbour && hasCell(s_surface[leaf], bit))
        {
            Attribute look = voxels.data[indexIn(s_surface[leaf], s_first[leaf], bit)];
            sums.color += linearColor(to_linear, look.color);
            sums.normal += decodeNormal(look.normal);
            ++sums.count;
        }
    }
    return sums;
}

// Of a voxel that has no attributes in an operand. inside: the node that what is inside looks like.
Attribute newLook(uvec3 voxel, uint inside)
{
    Around around = lookAround(voxel);
    uint divisor = max(around.count, 1u);
    uvec3 size = uvec3(abs(around.normal)); // components of each normal add up to kNormalOne
    bool is_short = (size.x + size.y + size.z) * kNoNormalRatio < divisor * uint(kNormalOne);
    uint normal = is_short ? kNoNormal : encodeNormal(around.normal);
    if (kOperation != kDilate)
        normal = around.open == ivec3(0) ? kNoNormal : encodeNormal(around.open);
    if (around.count == 0u)
        return Attribute(interiorLook(params.node_looks.data[inside]).color, normal);
    return Attribute(packColor(params.scene, divideSmall(around.color + divisor / 2u, divisor), 0u), normal);
}

void copyEmission(uint index, uint of, uint source)
{
    uvec2_ConstPtr written = uvec2_ConstPtr(uint64_t(params.emission_words));
    if (!isEmissive(written, index))
        return;
    uvec2_ConstPtr words = uvec2_ConstPtr(uint64_t(params.looks.data[of].emission_words));
    params.emission.data[emissionIndex(written, index)] =
        params.looks.data[of].emission.data[emissionIndex(words, source)];
}

// Writes what a voxel of a leaf of the result has. cell: of the leaf in the brick.
void writeVoxel(Node leaf, uint cell, uint bit)
{
    uint index = childIndex(leaf, bit);
    uint i = leafAroundNumber(cellNumbered(cell) + 1u);
    bool in_a = hasCell(s_surface[i], bit);
    bool in_b = false;
    uint source = indexIn(s_surface[i], s_first[i], bit);
    if (kTakesB && !in_a && hasCell(s_surface_of_b[cell], bit))
    {
        in_b = true;
        source = indexIn(s_surface_of_b[cell], s_first_of_b[cell], bit);
    }
    if (kEmission)
    {
        copyEmission(index, in_b ? 1u : 0u, source);
        return;
    }
    Attribute look = Attribute(0u, kNoNormal);
    if (in_a || in_b)
        look = params.looks.data[in_b ? 1u : 0u].voxels.data[source];
    else
        look = newLook(4u * (cellNumbered(cell) + 1u) + cellNumbered(bit), s_inside[cell]);
    params.attributes.data[index] = look;
    if (kEmits && ((look.color >> 24) & kAttributeEmissive) != 0u)
        atomicOr(params.emission_words.data[index / kVoxelsPerEmissionWord].x, 1u << (index % kVoxelsPerEmissionWord));
}

void main()
{
    uint lane = gl_LocalInvocationIndex;
    uint number = params.first_brick + workgroupIndex();
    if (workgroupIndex() >= params.brick_count)
        return;
    Node brick = params.nodes.data[number];
    NodePlace place = unpackPlace(params.places.data[number]);
    if (lane == 0u)
        s_has_new = 0u;
    findOwnLeaf(place);
    barrier();
    if (!kEmission && hasChild(brick, lane))
    {
        Node leaf = params.nodes.data[childIndex(brick, lane)];
        uvec2 known = s_surface[leafAroundNumber(cellNumbered(lane) + 1u)];
        if (kTakesB)
            known |= s_surface_of_b[lane];
        if (((leaf.mask_lo & ~known.x) | (leaf.mask_hi & ~known.y)) != 0u)
            atomicOr(s_has_new, 1u);
    }
    barrier();
    if (s_has_new != 0u)
    {
        findBricks(place);
        barrier();
        for (uint i = lane; i < kLeavesAround; i += kAlgebraGroup)
            findLeaf(place, leafAroundPlace(i));
    }
    barrier();
    for (uvec2 rest = uvec2(brick.mask_lo, brick.mask_hi); (rest.x | rest.y) != 0u;)
    {
        uint cell = firstCell(rest);
        rest &= ~cellBit(cell);
        Node leaf = params.nodes.data[childIndex(brick, cell)];
        if (hasChild(leaf, lane))
            writeVoxel(leaf, cell, lane);
    }
}
