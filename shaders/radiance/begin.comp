#version 460
// SPDX-License-Identifier: MIT
// Starts a path from a random point of each face that the frame samples, and lists the bricks around these faces.
#extension GL_GOOGLE_include_directive : require
#include "radiance/radiance.h"

GPU_ENTRY(RadianceBeginParams, RADIANCE_BEGIN_CONSTANTS);
layout(local_size_x = kRadianceGroup) in;

#include "lib/bound.glsl"
#include "lib/dispatch.glsl"
#include "lib/face.glsl"
#include "lib/ray.glsl"
#include "lib/sampling.glsl"
#include "path/state.glsl"

const bool kSmooth = false; // light goes from face to face

#define FACES_BINDING 0
#define STATES_BINDING 1
#include "path/lists.glsl"
#include "path/next_ray.glsl"
#include "radiance/cached_face.glsl"
#include "radiance/list_faces.glsl"

// The number of a face's next sample. Each face counts its own, whatever frames it is taken in, so that the first few
// are spread well over directions and lights. Where its mean counts no more samples, frames are counted.
uint sampleOfFace(FaceState state)
{
    uint count = cachedWeight(state.own);
    bool counts = count + 1u < params.window && ((state.mark >> kMarkMovedShift) & kMarkMovedFrames) == 0u;
    return counts ? count : kCachedWeightMax + params.frame;
}

void main()
{
    uint path = threadIndex();
    uint count = listLength(0u, kListPaths);
    bool exists = path < count;
    uint slot = params.numbers.data[min(path, count - 1u)]; // of kListPaths, the first list
    uvec2 key = loadFace(slot).key;

    NextRay next;
    next.exists = exists;
    uint seed = hashPair(hashPair(key.x, key.y), params.seed);
    uvec3 cell = cellOfFace(key);
    uint face_normal = normalOfFace(key);
    uint index = sampleOfFace(loadFaceState(slot));
    next.state = PathState(vec3(1.0), path, seed, face_normal + (index << kPathFaceBits), 0.0, vec3(0.0));
    next.choice = samplePair(index, seed, kPairOther).x;
    vec3 normal = normalAxis(face_normal);
    float edge = exp2(-2.0 * float(kNodeLevels));
    vec3 point = pointOfFace(cell, face_normal, edge, samplePair(index, seed, kPairPixel));
    leaveFace(pointOnFace(point, cell, normal), 0u, next);
    if (exists)
    {
        storeRay(params.rays, path, next.ray);
        storeState(params.path_states, path, next.state);
        params.radiance.data[path] = vec3(0.0);
    }

    listBrick(params.bricks, params.batch, cell, face_normal, 1u, exists);
    listChosen(params.numbers, params.batch, next, path, 0u);
}
