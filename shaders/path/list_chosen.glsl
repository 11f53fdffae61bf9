// SPDX-License-Identifier: MIT
// Lists paths by the light that they look for. The includer includes path/leave.glsl and path/lists.glsl before, and
// declares kEmission; params has numbers and batch, too.
#ifndef ZVO_SHADERS_PATH_LIST_CHOSEN_GLSL
#define ZVO_SHADERS_PATH_LIST_CHOSEN_GLSL

#include "path/leave.glsl"
#include "path/lists.glsl"
#include "path/path.h"

// set: of lists. All threads of a subgroup call this together.
void listChosen(NextRay next, uint path, uint set)
{
    bool in_map = seeksMapLight(next);
    uint map_light = appendTo(set, kListMapLights, in_map);
    if (in_map)
        params.numbers.data[kListMapLights * params.batch + map_light] = path;
    if (kEmission)
    {
        bool in_voxels = seeksVoxelLight(next);
        uint voxel_light = appendTo(set, kListVoxelLights, in_voxels);
        if (in_voxels)
            params.numbers.data[kListVoxelLights * params.batch + voxel_light] = path;
    }
}

#endif
