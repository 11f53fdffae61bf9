// SPDX-License-Identifier: MIT
// The masks of a listed brick's leaves, and whether a brick is full. Needs GPU_ENTRY with AlgebraParams,
// or AlgebraNodesParams.
#ifndef ZVO_SHADERS_ALGEBRA_BRICK_MASKS_GLSL
#define ZVO_SHADERS_ALGEBRA_BRICK_MASKS_GLSL

#include "algebra/operand.glsl"
#include "lib/brick_keys.glsl"

// Whether the mask of a node has the cell that something was found in.
bool hasKept(Found found)
{
    bool in_node = found.reference == kNothing || isFullNode(found.reference);
    uint node = in_node ? found.around : found.reference;
    return hasCell(params.masks.data[node], in_node ? found.cell : 0u);
}

// Whether a brick that is not listed is full in the result. A full node is kept, or not, as a whole.
bool isFullUnlisted(uvec3 brick)
{
    Found a = findNode(params.a, brick, params.brick_levels);
    bool in_a = isFullBelow(params.a, a.reference);
    if (kOperation == kKeep)
        return in_a && hasKept(a);
    if (kOperation == kEnclose)
        return in_a || (a.reference == kNothing && hasKept(a));
    if (kOperation >= kDilate)
        return in_a;
    bool in_b = isFullBelow(params.b, findNode(params.b, brick, params.brick_levels).reference);
    return kOperation == kUnite ? in_a || in_b : kOperation == kIntersect ? in_a && in_b : in_a && !in_b;
}

#endif
