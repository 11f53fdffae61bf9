#version 460
// SPDX-License-Identifier: MIT
// Starts a path for each pixel of a batch, with a ray from a random point of the lens through one of the pixel.
#extension GL_GOOGLE_include_directive : require
#include "path/path.h"

GPU_ENTRY(PathBeginParams, PATH_BEGIN_CONSTANTS);
layout(local_size_x = kPathGroup) in;

#include "lib/dispatch.glsl"
#include "lib/ray.glsl"
#include "path/pixel.glsl"
#include "path/state.glsl"
#include "path/camera_ray.glsl"

void main()
{
    uint slot = threadIndex();
    if (slot >= params.pixel_count)
        return;
    if (slot == 0u)
    {
        params.lists.data[kListPaths] = foldedArgs((params.pixel_count + kPathGroup - 1u) / kPathGroup, kTilesFold);
        params.lists.data[kListLengths].x = params.pixel_count;
    }
    PathView view = params.view;
    uvec2 pixel = pixelOfNumber(params.first_pixel + slot, uvec2(view.width, view.height));
    uint seed = seedOfPixel(view, pixel);
    storeRay(params.rays, slot, cameraRay(view, pixel, seed, params.sample_index));
    storeState(params.states, slot, stateOfCamera(slot, seed));
    params.radiance.data[slot] = vec3(0.0);
}
