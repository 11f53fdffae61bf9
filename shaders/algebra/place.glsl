// SPDX-License-Identifier: MIT
// Where nodes stand: coordinates among the nodes of their level, 16 bits each, then the level, 0 for the root.
#ifndef ZVO_SHADERS_ALGEBRA_PLACE_GLSL
#define ZVO_SHADERS_ALGEBRA_PLACE_GLSL

struct NodePlace
{
    uvec3 cell;
    uint level;
};

uvec2 packPlace(NodePlace place)
{
    return uvec2(place.cell.x | (place.cell.y << 16), place.cell.z | (place.level << 16));
}

NodePlace unpackPlace(uvec2 words)
{
    return NodePlace(uvec3(words.x & 0xFFFFu, words.x >> 16, words.y & 0xFFFFu), words.y >> 16);
}

#endif
