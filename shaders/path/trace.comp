#version 460
// SPDX-License-Identifier: MIT
// Follows each path of a batch from the camera to its end: the other form of path tracing (path.h).
//
// A thread takes one path after the other: where a path ends, its thread takes the next pixel of the workgroup that no
// thread has (regeneration: J. Novak, V. Havran, C. Dachsbacher, Path Regeneration for Interactive Path Tracing, 2010).
// So threads that run together stay busy as long as the workgroup has pixels, no workgroup knows of another, and none
// waits. Workgroups take tiles in turns, so that each has a part of the sky, where paths are short, and of whatever
// makes them long.
//
// In each turn of the loop a thread traces one ray, whether it is the path's next one or one to a light: all threads
// do that together, and then what follows from their rays. A ray that uses up its iterations resumes in the next turn.
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

shared uint s_taken; // pixels of the workgroup

// The pixel that the workgroup takes after so many others; params.end_pixel or more: there is none.
uint pixelTaken(uint taken)
{
    uint tile = taken / kPathGroup * params.workgroups + workgroupIndex();
    uint number = params.first_pixel + tile * kPathGroup + taken % kPathGroup;
    return workgroupIndex() < params.workgroups ? number : params.end_pixel;
}

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
        CameraRays camera = params.view.data[0].camera;
        path.direct = luminance(path.radiance);
        addFeatures(path.state.slot, ray, hit, path.radiance, camera.origin, camera.forward);
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
    if (gl_LocalInvocationIndex == 0u)
        s_taken = kPathGroup;
    barrier();
    uint number = pixelTaken(gl_LocalInvocationIndex);
    g_halves = uint64_t_ConstPtr(uint64_t(params.nodes));
    g_leaf_groups = uint64_t_ConstPtr(uint64_t(params.tree.data[0].source.before));

    Path path;
    Shadow shadow;
    shadow.exists = false;
    uvec3 from = uvec3(0u); // where the ray resumes
    uint round = 0u;
    uvec2 counts = uvec2(0u); // of rays of paths and of those to lights
    bool begins = true;
    bool go = number < params.end_pixel;
    for (; go;)
    {
        if (begins)
            path = beginPath(number);
        Ray ray = Ray(path.origin, 0.0, shadow.exists ? shadow.inverse_direction : path.inverse_direction,
                      kTraceTimeMax);
        Traversal met = traceRay(ray, from);
        ++round;
        bool resumes = met.unfinished && round < kTraceRoundsMax;
        begins = false;
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
                begins = !advance(ray, hit, path, shadow);
            }
            if (begins)
            {
                addSample(params.sums, number, path.radiance);
                if (kFeatures)
                    addScattered(params.features, number, path.radiance, path.direct);
                number = pixelTaken(atomicAdd(s_taken, 1u));
            }
        }
        go = number < params.end_pixel;
    }
    counts = subgroupAdd(counts);
    if (subgroupElect())
    {
        uint_Ptr lengths = uint_Ptr(uint64_t(params.lists));
        atomicAdd(lengths.data[3u * kListLengths + kListPaths], counts.x);
        atomicAdd(lengths.data[3u * kListLengths + kListShadows], counts.y);
    }
    // A device that ends loops early (lavapipe, after 65,535 iterations) has lost a path.
    if (number < params.end_pixel)
        atomicAdd(params.status.data[0].capped_rays, 1u);
}
