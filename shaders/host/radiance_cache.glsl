// SPDX-License-Identifier: MIT
// The radiance cache, and what rays of a point find: a part of host/trace.glsl, which says how it is used and
// includes this file behind all else.
#ifndef ZVO_SHADERS_HOST_RADIANCE_CACHE_GLSL
#define ZVO_SHADERS_HOST_RADIANCE_CACHE_GLSL

#include "lib/face.glsl"
#include "lib/hit.glsl"
#include "lib/sampling.glsl"
#include "light/outside.glsl"
#include "radiance/cached_faces.h"
#include "shared/trace.h"
#include "shared/tree_table.h"
#include "trace/any_tree.glsl"

// These are parameters of zvo's kernels. Here tables differ, so setRadianceCache() sets them.
struct FaceTable
{
    CachedFace_ConstPtr faces;
    uint run_count;
};
FaceTable params;

#include "radiance/face_table.glsl"
#include "radiance/cached_face.glsl"

const uint kPointRaysMax = 256u;         // rays of a point: all of their iterations are one invocation's
const uint kSettledSamples = 8u;         // from which on a face's light counts in full where it is mixed with others'
const float kBrickKnown = 1.0 / 16.0;    // how well light is known that is a brick's
const float kFacingMin = 1.0 / 64.0;     // squared component of a normal below which faces of an axis do not count
const float kPlaneShareMin = 1.0 / 16.0; // of a plane of faces, where a point is on the next one

// Selects the cached light for what follows. Whether there is any.
bool setRadianceCache(RadianceCacheTable_ConstPtr light)
{
    params.faces = light.data[0].faces;
    params.run_count = light.data[0].run_count;
    return uint64_t(params.faces) != 0ul;
}

// Light of cached faces, by shares.
struct FaceSum
{
    vec3 light;    // times weight
    float weight;  // share times how settled the light is
    float present; // share of faces that are cached
};

// Adds a face to a sum, if it is cached.
void addFace(ivec3 cell, uint normal, float share, inout FaceSum sum)
{
    CachedFace face;
    bool is_cached = findFace(uvec3(cell) & kHitCoordinateMask, normal, 0u, face) != kNoFace;
    uint samples = is_cached ? min(cachedWeight(face.light), kSettledSamples) : 0u;
    float weight = share * float(samples) / float(kSettledSamples);
    sum.light += samples == 0u ? vec3(0.0) : weight * cachedRadiance(face.light);
    sum.weight += weight;
    sum.present += samples == 0u ? 0.0 : share;
}

// Adds the four faces with a normal, in the plane of a cell's face, whose middles are around a place. offset: of the
// place, from the middle of the cell. towards: 1; -1: the cells on the other side.
void addPlane(ivec3 cell, uint normal, vec3 offset, int towards, float share, inout FaceSum sum)
{
    for (uint k = 0u; k < 4u; ++k)
    {
        NearFace near = nearFace(k, normal, offset, towards);
        addFace(cell + near.steps, normal, share * near.share, sum);
    }
}

// The light of a sum, and from 0 to 1 how settled it is.
vec4 lightOfSum(FaceSum sum)
{
    return sum.weight > 0.0 ? vec4(sum.light / sum.weight, sum.weight / sum.present) : vec4(0.0);
}

// Light of the faces with a normal around a point (in voxels of the grid): of the planes of faces before and behind it,
// in between; else of those one voxel further; else of cells beside; else of the least brick around it that keeps any.
vec4 lightNearPoint(vec3 point, uint normal)
{
    ivec3 along = ivec3(abs(normalAxis(normal)));
    ivec3 cell = ivec3(floor(point));
    vec3 offset = point - floor(point) - 0.5;
    float ahead = clamp(dot(offset, vec3(along)) + 0.5, kPlaneShareMin, 1.0 - kPlaneShareMin);
    cell -= normal < 3u ? along : ivec3(0); // whose face is in the plane at the cell's lower side
    FaceSum sum = FaceSum(vec3(0.0), 0.0, 0.0);
    for (int attempt = 0; attempt < 3 && sum.weight == 0.0; ++attempt)
    {
        int ring = attempt == 1 ? 1 : 0;
        int towards = attempt == 2 ? -1 : 1;
        addPlane(cell - ring * along, normal, offset, towards, 1.0 - ahead, sum);
        addPlane(cell + (ring + 1) * along, normal, offset, towards, ahead, sum);
    }
    vec4 brick = lightOfBrick(uvec3(ivec3(floor(point))) & kHitCoordinateMask, normal, sum.weight == 0.0);
    return sum.weight > 0.0 ? lightOfSum(sum) : vec4(brick.rgb, kBrickKnown * brick.w);
}

// The light that arrives at a point of a surface with this normal (length 1), irradiance over pi: the radiance that the
// surface would have if it were white. It is that of cached faces within two voxels, which face along the axes as the
// normal does, by the squares of its components; without such faces, that of the least brick of 4^3, 16^3 or 64^3
// voxels around the point that keeps any. w: how well it is known, from 0, where nothing is cached and rgb is 0, to 1:
// less where faces of an axis are missing, or have few samples; a 16th where the light is a brick's.
vec4 zvo_irradiance(RadianceCacheTable_ConstPtr light, TreeTable_ConstPtr tree, vec3 position, vec3 normal)
{
    bool has_light = setRadianceCache(light);
    vec3 point = (position - tree.data[0].origin) / tree.data[0].voxel_size;
    vec4 sum = vec4(0.0);
    for (uint axis = 0u; axis < 3u && has_light; ++axis)
    {
        float component = axis == 0u ? normal.x : axis == 1u ? normal.y : normal.z;
        float share = component * component;
        if (share >= kFacingMin)
        {
            vec4 found = lightNearPoint(point, axis + (component < 0.0 ? 3u : 0u));
            sum += share * found.w * vec4(found.rgb, 1.0);
        }
    }
    return sum.w > 0.0 ? vec4(sum.rgb / sum.w, min(sum.w, 1.0)) : vec4(0.0);
}

// Radiance from outside of the grid, without the sun, from a direction of any length.
vec3 zvo_outside(RadianceCacheTable_ConstPtr light, vec3 direction)
{
    Environment_ConstPtr environment = light.data[0].environment;
    return uint64_t(environment) != 0ul ? mapRadiance(environment, normalize(direction)) : vec3(0.0);
}

// The light that comes from a hit, against its ray: what the voxel emits and reflects of the cached light, as zvo's
// pictures of it show; for a miss what is outside, without the sun. w: 1, or 0 where it is not known what it reflects
// or what is outside, and rgb is 0. origin, direction: of the ray in world space.
vec4 zvo_cachedRadiance(RadianceCacheTable_ConstPtr light, TreeTable_ConstPtr tree, Hit hit, vec3 origin,
                        vec3 direction)
{
    if (!zvo_isHit(hit))
    {
        bool is_known = !zvo_isUnfinished(hit) && uint64_t(light.data[0].environment) != 0ul;
        return is_known ? vec4(zvo_outside(light, direction), 1.0) : vec4(0.0);
    }
    zvo_Surface surface = zvo_surface(tree, hit, direction);
    vec3 position = zvo_position(tree, hit, origin, direction);
    vec4 cached = vec4(0.0);
    if (!surface.is_voxel)
        cached = zvo_irradiance(light, tree, position, surface.face_normal);
    else if (!surface.is_inside && setRadianceCache(light))
    {
        vec3 offset = clamp((position - surface.middle) / surface.edge, -0.5, 0.5);
        FaceSum sum = FaceSum(vec3(0.0), 0.0, 0.0);
        uint normal = normalOfHit(hitFace(hit), direction);
        addPlane(ivec3(surface.cell), normal, offset, 1, 1.0, sum);
        cached = lightOfSum(sum);
        cached += lightOfBrick(surface.cell, normal, cached.w == 0.0); // as radiance/view
    }
    bool is_known = cached.w > 0.0 || surface.emission != vec3(0.0);
    return vec4(surface.emission + surface.base_color * cached.rgb, is_known ? 1.0 : 0.0);
}

// A random direction to the side of a normal (length 1), by the cosine with it.
vec3 randomDirection(vec3 normal, vec2 u)
{
    return frameAround(normal) * cosineDirection(u.x, 2.0 * kPi * u.y);
}

// Where rays of a point of a surface begin: behind all voxels that its plane touches.
vec3 aboveVoxels(TreeTable_ConstPtr tree, vec3 position, vec3 normal)
{
    return position + 1.01 * tree.data[0].voxel_size * dot(abs(normal), vec3(1.0)) * normal;
}

// The share of so many rays, at most 256, from a point of a surface with this normal (length 1), by the cosine with it,
// that meet nothing within a reach in world units. seed: of their directions. lavapipe ends all loops of an invocation
// after 65,535 iterations, of all rays together.
float zvo_occlusion(TreeTable_ConstPtr tree, vec3 position, vec3 normal, uint rays, float reach, uint seed)
{
    vec3 origin = aboveVoxels(tree, position, normal);
    uint count = clamp(rays, 1u, kPointRaysMax);
    uint free = 0u;
    for (uint i = 0u; i < count; ++i)
    {
        vec3 direction = randomDirection(normal, samplePair(i, seed, 0u));
        free += zvo_occluded(tree, origin, direction, 0.0, reach) ? 0u : 1u;
    }
    return float(free) / float(count);
}

// The light that arrives at a point as zvo_irradiance() gives it, of so many rays, at most 256, which find what
// zvo_cachedRadiance() tells of their hits, and of one to the middle of the sun: where no faces are cached, or for what
// is not among the voxels. seed: of the directions. w: the share of rays that found light; 0: none, and rgb is 0.
vec4 zvo_gatherIrradiance(RadianceCacheTable_ConstPtr light, TreeTable_ConstPtr tree, vec3 position, vec3 normal,
                          uint rays, uint seed)
{
    vec3 origin = aboveVoxels(tree, position, normal);
    uint count = clamp(rays, 1u, kPointRaysMax);
    vec4 sum = vec4(0.0);
    for (uint i = 0u; i < count; ++i)
    {
        vec3 direction = randomDirection(normal, samplePair(i, seed, 0u));
        Hit hit = zvo_trace(tree, origin, direction, 0.0, kTraceTimeMax);
        vec4 found = zvo_cachedRadiance(light, tree, hit, origin, direction);
        sum += found.w > 0.0 ? found : vec4(0.0);
    }
    if (sum.w == 0.0)
        return vec4(0.0);
    vec3 irradiance = sum.rgb / sum.w;
    Environment_ConstPtr environment = light.data[0].environment;
    if (uint64_t(environment) != 0ul)
    {
        vec3 sun = sunIrradiance(environment, normal);
        if (sun != vec3(0.0) && !zvo_occluded(tree, origin, environment.data[0].to_sun, 0.0, kTraceTimeMax))
            irradiance += sun;
    }
    return vec4(irradiance, sum.w / float(count));
}

#ifdef ZVO_DETAIL
#include "radiance/cone.glsl"

// The light that comes to a point through a cone, and from outside of the grid through the share of it that has met
// nothing within a reach in world units: about the mean over the cone, of nodes along its axis that are up to half as
// wide as it, and have light as bricks. It has no sun. Nodes count that begin within the reach. direction: of the axis,
// of any length. aperture: radians from rim to rim, less than pi. seed: of the rays that find how much of a node emits,
// of which the mean over seeds is right. w: that share. Where no light is cached at all, 0.
vec4 zvo_cone(RadianceCacheTable_ConstPtr light, TreeTable_ConstPtr tree, vec3 origin, vec3 direction, float aperture,
              float reach, uint seed)
{
    if (!setRadianceCache(light))
        return vec4(0.0);
    vec4 found = lightThroughCone(tree, origin, normalize(direction), tan(0.5 * aperture), reach, seed);
    return vec4(found.rgb + found.w * zvo_outside(light, direction), found.w);
}
#endif

#endif
