// SPDX-License-Identifier: MIT
// How much a place may receive of the lights of a node of the light tree (light/light_tree.h).
// Needs the constant kNodeLevels.
#ifndef ZVO_SHADERS_LIGHT_IMPORTANCE_GLSL
#define ZVO_SHADERS_LIGHT_IMPORTANCE_GLSL

#include "light/bounds.glsl"
#include "light/light_tree.h"

// A point of a surface with any normal (length 1).
struct LitPlace
{
    vec3 position; // unit space
    vec3 normal;
};

// How much a place may receive of the faces of a node in each direction, up to a common factor. With d the distance to
// the middle of the node's box and r half its diagonal, cosines at the light and at the place are bounded by those to
// the box's corners as seen from d, and 1 / distance^2 by 1 / max(d, r)^2. A bound is 0 only if none of the faces can be
// seen: where the place is behind the planes of all, or the box is behind the place's. by_power: whatever the place.
void weighFaces(LightNode_ConstPtr nodes, LitPlace place, uint node, bool by_power, out vec3 up, out vec3 down)
{
    // Three loads: lavapipe pays for each, not for its bytes.
    uint64_t_ConstPtr words = uint64_t_ConstPtr(uint64_t(nodes) + uint64_t(node) * kLightNodeBytes);
    const float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 low = 1.0 + edge * vec3(unpackLightCell(unpackUint2x32(words.data[0])));
    vec3 high = 1.0 + edge * vec3(unpackLightCell(unpackUint2x32(words.data[1])) + 1u);
    uvec2 power = unpackUint2x32(words.data[2]);

    if (by_power)
    {
        up = uintBitsToFloat(power.x) * unpackLightParts(power.y, 0u);
        down = uintBitsToFloat(power.x) * unpackLightParts(power.y, 3u);
        return;
    }
    vec3 above = place.position - low;
    vec3 below = high - place.position;
    vec3 to_middle = 0.5 * (below - above);
    vec3 half_size = 0.5 * (high - low);
    float inverse_square = 1.0 / max(dot(to_middle, to_middle), dot(half_size, half_size));
    float inverse = sqrt(inverse_square);
    float cosine = dot(max(place.normal, 0.0), below) + dot(max(-place.normal, 0.0), above);
    float factor = uintBitsToFloat(power.x) * clamp(cosine * inverse, 0.0, 1.0) * inverse_square;
    up = factor * unpackLightParts(power.y, 0u) * clamp(above * inverse, 0.0, 1.0);
    down = factor * unpackLightParts(power.y, 3u) * clamp(below * inverse, 0.0, 1.0);
}

// How much a place may receive of the lights below a node.
float lightImportance(LightNode_ConstPtr nodes, LitPlace place, uint node, bool by_power)
{
    vec3 up;
    vec3 down;
    weighFaces(nodes, place, node, by_power, up, down);
    return dot(up + down, vec3(1.0));
}

#endif
