// SPDX-License-Identifier: MIT
// The 6^3 leaves of a brick and around it: numbers, and places from the lowest one on.
#ifndef ZVO_SHADERS_ALGEBRA_LEAVES_AROUND_GLSL
#define ZVO_SHADERS_ALGEBRA_LEAVES_AROUND_GLSL

const uint kLeavesEdge = 6u;
const uint kLeavesAround = kLeavesEdge * kLeavesEdge * kLeavesEdge;

uint leafAroundNumber(uvec3 at)
{
    return at.x + kLeavesEdge * (at.y + kLeavesEdge * at.z);
}

uvec3 leafAroundPlace(uint number)
{
    return uvec3(number, number / kLeavesEdge, number / (kLeavesEdge * kLeavesEdge)) % kLeavesEdge;
}

// The number of the brick that it is in, of 3^3.
uint brickOfLeafAround(uvec3 at)
{
    uvec3 brick = (at + 3u) / 4u;
    return brick.x + 3u * brick.y + 9u * brick.z;
}

#endif
