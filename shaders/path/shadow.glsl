// SPDX-License-Identifier: MIT
// Shadow rays to lights. The includer includes path/path.h, lib/ray.glsl, path/lists.glsl, path/state.glsl and
// path/weights.glsl before
// and declares params.

// A light that was chosen for a place on a face.
struct ChosenDirection
{
    vec3 direction; // length 1
    float density;  // by solid angle, of choosing it; 0: no light can come from there
    vec3 light;     // radiance from there, if nothing is in the way
    uvec2 target;   // as in ShadowState
};

// Lists a shadow ray, unless it cannot bring light. Threads without a path take part, too.
void appendShadow(bool exists, vec3 origin, PathState state, vec3 normal, ChosenDirection chosen)
{
    const float pi = 3.14159265358979;
    float cosine = dot(normal, chosen.direction);
    vec3 light = vec3(0.0);
    if (exists && chosen.density > 0.0 && cosine > 0.0)
        light = state.throughput * chosen.light *
                (cosine / (pi * chosen.density) * balance(chosen.density, cosine / pi));
    bool brings_light = max(light.r, max(light.g, light.b)) > 0.0;
    uint shadow = appendTo(params.bounce, kListShadows, brings_light);
    if (!brings_light)
        return;
    storeRay(params.shadow_rays, shadow, Ray(origin, 0.0, inverseDirection(chosen.direction), kTraceTimeMax));
    uint64_t_Ptr words = uint64_t_Ptr(uint64_t(params.shadow_states));
    words.data[3u * shadow] = packUint2x32(floatBitsToUint(light.xy));
    words.data[3u * shadow + 1u] = packUint2x32(uvec2(floatBitsToUint(light.z), state.slot));
    words.data[3u * shadow + 2u] = packUint2x32(chosen.target);
}
