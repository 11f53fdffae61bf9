#version 460
// SPDX-License-Identifier: MIT
// Follows each path of a batch from the camera to its end, a thread a path: the other form of path tracing (path.h).
//
// In each turn of the loop a thread traces one ray, whether it is the path's next one or one to a light: all threads
// do that together, and then what follows from their rays. A ray that uses up its iterations resumes in the next turn.
//
// No thread goes on with another path where its own has ended (J. Novak, V. Havran, C. Dachsbacher, Path Regeneration
// for Interactive Path Tracing, 2010): a GPU that gets all paths at once takes less time (docs/performance.md).
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "path/path.h"

GPU_ENTRY(PathTraceParams, PATH_TRACE_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#define NODES_BINDING 0
#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/traverse.glsl"
#include "path/pixel.glsl"
#include "path/camera_ray.glsl"
#include "path/chosen_light.glsl"
#include "path/feature_sum.glsl"
#include "path/map_light.glsl"
#include "path/next_ray.glsl"
#include "path/voxel_light.glsl"
#include "trace/hit_rank.glsl"

const bool kRanked = kEntriesPerWord != 0u && kNodeLevels > 1u && kFormat != kFormatNone; // hits have indices by ranks

const uint kEnded = ~0u; // Path::bounce of a path that has ended

// A path on its way.
struct Path
{
    PathState state; // slot: the pixel's number
    vec3 radiance;
    float direct; // luminance of what the camera sees directly
    uint bounce;
    vec3 origin; // of its ray, and of the shadow ray from there
    vec3 inverse_direction;
};

// A shadow ray from where the path's ray begins.
struct Shadow
{
    bool exists;
    vec3 inverse_direction;
    vec3 light; // that it brings to the pixel
    uvec2 target;
};

Path beginPath(uint number)
{
    PathView view = params.view.data[0];
    uvec2 pixel = pixelOfNumber(number, uvec2(view.width, view.height));
    uint seed = seedOfPixel(view, pixel);
    Ray ray = cameraRay(view, pixel, seed, params.sample_index);
    return Path(stateOfCamera(number, seed), vec3(0.0), 0.0, 0u, ray.origin, ray.inverse_direction);
}

// Traces a ray, or resumes it. An invalid one is replaced by one that ends before it starts.
Traversal traceRay(Ray ray, uvec3 from)
{
    // No ray needs what another one has saved: the registers are free in between.
    [[unroll]] for (uint k = 0u; k < kSavedMax; ++k)
        g_saved[k] = 0u;
    bool valid = isTraceable(ray) && uint64_t(g_halves) != 0ul;
    return traverse(valid ? ray.origin : vec3(0.0), valid ? ray.inverse_direction : vec3(1.0), valid ? ray.t_min : 1.0,
                    valid ? ray.t_max : 0.0, vec2(0.0), from, kIterationsMax);
}

Hit hitOf(Traversal met)
{
    Hit hit =
        Hit(met.t, met.hit ? met.index : kHitMiss, unpackUint2x32(packHitCell(met.cell, met.level, met.face)));
    return hit;
}

// The index of the attributes of what was hit.
uint attributeIndexOf(Hit hit)
{
    RankSource source = RankSource(Node_ConstPtr(uint64_t(params.tree.data[0].source.pool)),
                                   BeforeChild_ConstPtr(uint64_t(params.tree.data[0].source.before)),
                                   uint_ConstPtr(uint64_t(params.tree.data[0].source.voxels_before_leaf)),
                                   params.tree.data[0].source.first_short_entry);
    return attributeIndex(source, BeforeChild_ConstPtr(uint64_t(params.tree.data[0].overlay_ranks)), kOverlays,
                          params.tree.data[0].attribute_offset, hitCell(hit), kNodeLevels, hit.index);
}

// A shadow ray to a light that is chosen for a path which goes on, if it can bring light.
Shadow chooseShadow(NextRay next, uint bounce)
{
    ChosenDirection chosen = ChosenDirection(vec3(1.0, 0.0, 0.0), 0.0, vec3(0.0), uvec2(kNoTarget));
    if (seeksMapLight(next))
        chosen = chooseMapLight(next.state, bounce);
    else if (kEmission && seeksVoxelLight(next))
        chosen = chooseVoxelLight(next.state, next.ray.origin, bounce);
    vec3 light = lightOfChoice(next.state, chosen);
    return Shadow(isLit(light), inverseDirection(chosen.direction), light, chosen.target);
}

// Adds the light that the path's ray has met, and takes the path on. Returns whether it goes on.
bool advance(Ray ray, Hit hit, inout Path path, inout Shadow shadow)
{
    if (isMiss(hit))
        path.radiance += lightOfMiss(path.state, ray);
    else if (kEmission && isEmissive(params.emission_words, hit.index))
        path.radiance += lightOfHit(path.state, ray, hit);
    if (kFeatures && path.bounce == 0u)
    {
        path.direct = luminance(path.radiance);
        addFeatures(path.state.slot, ray, hit, path.radiance, params.view.data[0].camera.origin,
                    params.view.data[0].axis);
    }

    NextRay next;
    next.exists = false;
    if (!isMiss(hit) && path.bounce < params.bounces)
    {
        Attribute stored = attributeAt(true, hit, params.attributes);
        next = nextRay(path.state, ray, true, hit, albedoOf(stored), stored.normal, kRoulette, path.bounce);
    }
    if (next.exists)
    {
        if (kSampling != kSampleChance)
            shadow = chooseShadow(next, path.bounce);
        path.state = next.state;
        path.origin = next.ray.origin;
        path.inverse_direction = next.ray.inverse_direction;
        ++path.bounce;
    }
    return next.exists;
}

void main()
{
    if (threadIndex() >= params.pixel_count)
        return;
    uint number = params.first_pixel + threadIndex();
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    g_leaf_groups = uint64_t_ConstPtr(uint64_t(params.tree.data[0].source.before));

    Path path = beginPath(number);
    Shadow shadow;
    shadow.exists = false;
    uvec3 from = uvec3(0u); // where the ray resumes
    uint round = 0u;
    uvec2 counts = uvec2(0u); // of rays of paths and of those to lights
    bool go = true;
    for (; go;)
    {
        Ray ray = Ray(path.origin, 0.0, shadow.exists ? shadow.inverse_direction : path.inverse_direction,
                      kTraceTimeMax);
        Traversal met = traceRay(ray, from);
        ++round;
        bool resumes = met.unfinished && round < kTraceRoundsMax;
        from = uvec3(0u);
        if (resumes)
        {
            from = limitsAfter(met.t, met.face);
        }
        else
        {
            round = 0u;
            counts += shadow.exists ? uvec2(0u, 1u) : uvec2(1u, 0u);
            if (met.unfinished)
                atomicAdd(params.status.data[0].capped_rays, 1u);
            Hit hit = hitOf(met);
            if (shadow.exists)
            {
                if (reachesLight(hit, shadow.target))
                    path.radiance += shadow.light;
                shadow.exists = false;
            }
            else
            {
                if (kRanked && !isMiss(hit))
                    hit.index = attributeIndexOf(hit);
                go = advance(ray, hit, path, shadow);
                path.bounce = go ? path.bounce : kEnded;
            }
        }
    }
    addSample(params.sums, number, path.radiance);
    if (kFeatures)
        addScattered(params.features, number, path.radiance, path.direct);
    counts = subgroupAdd(counts);
    if (subgroupElect())
    {
        uint_Ptr lengths = uint_Ptr(uint64_t(params.lists));
        atomicAdd(lengths.data[3u * kListLengths + kListPaths], counts.x);
        atomicAdd(lengths.data[3u * kListLengths + kListShadows], counts.y);
    }
    // A device that ends loops early (lavapipe, after 65,535 iterations) has lost a path. Of what the loop tests,
    // compilers know how it ends.
    if (path.bounce != kEnded)
        atomicAdd(params.status.data[0].capped_rays, 1u);
}
