// SPDX-License-Identifier: MIT
// Lists that grow while kernels run (path/path.h).
// Needs params.lists.
#ifndef ZVO_SHADERS_PATH_LISTS_GLSL
#define ZVO_SHADERS_PATH_LISTS_GLSL

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "path/path.h"

uint listLength(uint bounce, uint list)
{
    return uint_ConstPtr(uint64_t(params.lists)).data[3u * (bounce * kListElements + kListLengths) + list];
}

// Adds an element for each thread that has one. Returns its index. All threads of a subgroup call this together.
uint appendTo(uint bounce, uint list, bool has_one)
{
    uint before = subgroupExclusiveAdd(has_one ? 1u : 0u);
    uint total = subgroupAdd(has_one ? 1u : 0u);
    uint first = 0u;
    if (subgroupElect() && total != 0u)
    {
        uint element = bounce * kListElements;
        first = atomicAdd(uint_Ptr(uint64_t(params.lists)).data[3u * (element + kListLengths) + list], total);
        uint groups = (first + total - 1u) / kPathGroup + 1u;
        // Most subgroups do not reach another workgroup.
        if (first % kPathGroup + total > kPathGroup || first % kPathGroup == 0u)
        {
            atomicMax(params.lists.data[element + list].x, min(groups, kTilesFold));
            atomicMax(params.lists.data[element + list].y, (groups - 1u) / kTilesFold + 1u);
            atomicMax(params.lists.data[element + list].z, 1u);
        }
    }
    return subgroupAdd(first) + before;
}

#endif
