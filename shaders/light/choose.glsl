// SPDX-License-Identifier: MIT
// Chooses lights, and says with which probability (light/light_tree.h).
// Needs the constants kNodeLevels and kByPower.
#ifndef ZVO_SHADERS_LIGHT_CHOOSE_GLSL
#define ZVO_SHADERS_LIGHT_CHOOSE_GLSL

#include "lib/morton.glsl"
#include "lib/node.glsl"
#include "light/importance.glsl"
#include "light/light_tree.h"

// A chosen face of an emissive voxel.
struct ChosenLight
{
    float probability; // 0: no light can reach the place
    uint face;         // direction, as in LightBrick::exposed
    uvec3 cell;        // of the voxel
    uint voxel;        // index of its attributes
};

// Takes an element with a weight, after others with a total weight (which then includes it), as the choice of the
// random number u, with a probability in proportion. u stays a random number.
bool isChosen(float weight, inout float total, inout float u)
{
    total += weight;
    float part = u * total;
    bool chosen = part < weight;
    float rest = (chosen ? part : part - weight) / (chosen ? weight : total - weight);
    u = weight > 0.0 ? clamp(rest, 0.0, 0.99999994) : u;
    return chosen;
}

// The bit with this number, counted from 0, among the set bits of a mask.
uint bitWithRank(uvec2 mask, uint rank)
{
    uint low_count = bitCount(mask.x);
    bool high = rank >= low_count;
    uint word = high ? mask.y : mask.x;
    rank -= high ? low_count : 0u;
    uint position = 0u;
    [[unroll]] for (uint width = 16u; width != 0u; width >>= 1)
    {
        uint below = bitCount(bitfieldExtract(word, int(position), int(width)));
        bool above = rank >= below;
        rank -= above ? below : 0u;
        position += above ? width : 0u;
    }
    return position + (high ? 32u : 0u);
}

// Chooses an exposed face by two random numbers.
ChosenLight chooseLight(LightNode_ConstPtr nodes, LightBrick_ConstPtr bricks, LitPlace place, vec2 u)
{
    ChosenLight light = ChosenLight(1.0, 0u, uvec3(0u), 0u);
    uint node = 0u;
    for (uint level = 0u; level + 1u < kNodeLevels; ++level)
    {
        uint first = nodes.data[node].first_child;
        uint count = bitCount(nodes.data[node].mask_lo) + bitCount(nodes.data[node].mask_hi);
        float total = 0.0;
        float chosen_weight = 0.0;
        for (uint i = 0u; i < count; ++i)
        {
            float weight = lightImportance(nodes, place, first + i, kByPower);
            bool chosen = isChosen(weight, total, u.x);
            node = chosen ? first + i : node;
            chosen_weight = chosen ? weight : chosen_weight;
        }
        light.probability = total > 0.0 ? light.probability * chosen_weight / total : 0.0;
        node = total > 0.0 ? node : first;
    }
    vec3 up;
    vec3 down;
    weighFaces(nodes, place, node, kByPower, up, down);
    float total = 0.0;
    float chosen_weight = 0.0;
    [[unroll]] for (uint face = 0u; face < kLightFaces; ++face)
    {
        float weight = face < 3u ? up[face % 3u] : down[face % 3u];
        bool chosen = isChosen(weight, total, u.y);
        light.face = chosen ? face : light.face;
        chosen_weight = chosen ? weight : chosen_weight;
    }
    uint brick = nodes.data[node].first_child;
    uvec2 exposed = bricks.data[brick].exposed[light.face];
    uint count = bitCount(exposed.x) + bitCount(exposed.y);
    bool exists = total > 0.0 && count != 0u;
    uint cell = bitWithRank(exposed, min(uint(u.y * float(count)), max(count, 1u) - 1u));
    light.probability *= exists ? chosen_weight / (total * float(count)) : 0.0;
    light.cell = 4u * bricks.data[brick].cell + mortonDecode(cell);
    light.voxel = childIndex(bricks.data[brick].leaf, exists ? cell : 0u);
    return light;
}

// The probability with which chooseLight() chooses a face of a voxel.
float lightProbability(LightNode_ConstPtr nodes, LightBrick_ConstPtr bricks, LitPlace place, uvec3 voxel, uint face)
{
    float probability = 1.0;
    uint node = 0u;
    for (uint level = 0u; level + 1u < kNodeLevels; ++level)
    {
        uint first = nodes.data[node].first_child;
        uvec2 mask = uvec2(nodes.data[node].mask_lo, nodes.data[node].mask_hi);
        uint cell = cellInBlock(voxel >> (2u * (kNodeLevels - 1u - level)));
        uint bit = 1u << (cell & 31u);
        uint wanted = cell < 32u ? bitCount(mask.x & (bit - 1u)) : bitCount(mask.x) + bitCount(mask.y & (bit - 1u));
        bool exists = hasCell(mask, cell);
        uint count = bitCount(mask.x) + bitCount(mask.y);
        float total = 0.0;
        float wanted_weight = 0.0;
        for (uint i = 0u; i < count; ++i)
        {
            float weight = lightImportance(nodes, place, first + i, kByPower);
            total += weight;
            wanted_weight = i == wanted ? weight : wanted_weight;
        }
        probability = exists && wanted_weight > 0.0 ? probability * wanted_weight / total : 0.0;
        node = first + (exists ? wanted : 0u);
    }
    vec3 up;
    vec3 down;
    weighFaces(nodes, place, node, kByPower, up, down);
    float total = 0.0;
    float wanted_weight = 0.0;
    [[unroll]] for (uint i = 0u; i < kLightFaces; ++i)
    {
        float weight = i < 3u ? up[i % 3u] : down[i % 3u];
        total += weight;
        wanted_weight = i == face ? weight : wanted_weight;
    }
    uvec2 exposed = bricks.data[nodes.data[node].first_child].exposed[face];
    uint cell = cellInBlock(voxel);
    bool exists = hasCell(exposed, cell);
    return exists && wanted_weight > 0.0
               ? probability * wanted_weight / (total * float(bitCount(exposed.x) + bitCount(exposed.y)))
               : 0.0;
}

#endif
