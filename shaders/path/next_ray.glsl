// SPDX-License-Identifier: MIT
// How a path goes on from a hit. The includer includes path/path.h, lib/attribute_formats.glsl, lib/color.glsl,
// lib/frame.glsl, lib/hit.glsl, lib/ray.glsl, lib/sobol.glsl, light/importance.glsl, trace/surface.glsl, path/face.glsl
// and path/numbers.glsl before and declares kNodeLevels, kFormat, kEmission, kRoulette and params.

const float kRouletteMax = 0.95; // probability to go on
const uint kRouletteFirst = 3u;  // bounce

// How a path goes on.
struct NextRay
{
    bool exists; // else nothing else counts
    Ray ray;
    PathState state;
    float choice; // random number that chooses the kind of light to look for
};

// The attribute of a voxel that was hit.
Attribute attributeAt(bool hits, Hit hit)
{
    Attribute stored = Attribute(0u, 0u);
    if (kFormat != kFormatNone && hits)
        stored = readAttribute(kFormat, true, params.attributes, params.attributes, hit.index);
    return stored;
}

bool isEmitter(uint voxel)
{
    return ((params.emission_words.data[voxel >> 5].x >> (voxel & 31u)) & 1u) != 0u;
}

// The point of a hit: on its face exactly, and inside of the face's edges.
vec3 pointOfHit(Hit hit, Ray ray, vec3 normal)
{
    float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 low = 1.0 + edge * vec3(hitCell(hit));
    vec3 high = low + edge;
    vec3 inner_low = uintBitsToFloat(floatBitsToUint(low) + 1u);
    vec3 inner_high = uintBitsToFloat(floatBitsToUint(high) - 1u);
    vec3 point = clamp(ray.origin + hit.t / ray.inverse_direction, inner_low, inner_high);
    return mix(mix(point, high, greaterThan(normal, vec3(0.0))), low, lessThan(normal, vec3(0.0)));
}

// How probable it is that light is looked for in the map, the sun and voxels, at a place: half of it in the same way
// for all that may give any, half in proportion to how much it may give.
vec3 kindsAt(LitPlace place, uint normal)
{
    vec3 gives = vec3(uintBitsToFloat(unpackUint2x32(uint64_t_ConstPtr(uint64_t(params.gives)).data[normal])), 0.0);
    if (kEmission)
        gives.z = lightImportance(place, 0u, false) * exp2(-4.0 * float(kNodeLevels));
    vec3 present = vec3(gives.x > 0.0 ? 1.0 : 0.0, gives.y > 0.0 ? 1.0 : 0.0, gives.z > 0.0 ? 1.0 : 0.0);
    float count = present.x + present.y + present.z;
    return count == 0.0 ? vec3(0.0) : 0.5 * present / count + 0.5 * gives / (gives.x + gives.y + gives.z);
}

// The ray by which a path goes on from a hit, if it does.
NextRay nextRay(PathState state, Ray ray, bool hits, Hit hit, Attribute stored, uint bounce)
{
    const float pi = 3.14159265358979;
    vec3 albedo = kPlainAlbedo;
    if (kFormat != kFormatNone)
        albedo = decodeSrgb(unpackUnorm4x8(stored.color).rgb);
    state.throughput *= albedo;
    float strongest = max(state.throughput.r, max(state.throughput.g, state.throughput.b));
    NextRay next;
    next.exists = hits && hitFace(hit) != kFaceInside && strongest > 0.0;
    vec2 other = samplePair(params.sample_index, state.seed, bounce * kPathPairs + kPairOther);
    next.choice = other.x;
    if (kRoulette && bounce >= kRouletteFirst)
    {
        float survives = min(strongest, kRouletteMax);
        next.exists = next.exists && other.y < survives;
        state.throughput /= max(survives, 1e-20);
    }

    // Directions by their cosine with the normal.
    state.normal = normalOfHit(min(hitFace(hit), 2u), ray.inverse_direction);
    vec3 normal = normalAxis(state.normal);
    LitPlace place = LitPlace(pointOfHit(hit, ray, normal), normal);
    vec2 u = samplePair(params.sample_index, state.seed, bounce * kPathPairs + kPairDirection);
    float angle = 2.0 * pi * u.y;
    float cosine = sqrt(1.0 - u.x);
    vec3 direction = frameAround(normal) * vec3(sqrt(u.x) * vec2(cos(angle), sin(angle)), cosine);
    state.density = cosine / pi;
    state.kinds = kindsAt(place, state.normal);
    next.ray = Ray(place.position, 0.0, inverseDirection(direction), kTraceTimeMax);
    next.state = state;
    return next;
}

// The light that a path looks for as it goes on: from outside of the grid, of voxels, or none.
bool seeksMapLight(NextRay next)
{
    return next.exists && next.choice < next.state.kinds.x + next.state.kinds.y;
}

bool seeksVoxelLight(NextRay next)
{
    return next.exists && !seeksMapLight(next) && next.state.kinds.z > 0.0;
}
