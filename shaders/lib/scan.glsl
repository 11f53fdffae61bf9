// SPDX-License-Identifier: MIT
// Prefix sums over a workgroup of SCAN_GROUP threads, whatever the subgroup size.
// Needs the macro SCAN_GROUP.
#ifndef ZVO_SHADERS_LIB_SCAN_GLSL
#define ZVO_SHADERS_LIB_SCAN_GLSL

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require

#ifndef SCAN_GROUP
#error "lib/scan.glsl needs SCAN_GROUP: the threads of a workgroup"
#endif

shared uint s_subgroup_sums[SCAN_GROUP];

// Sum of value over the threads before this one; total: over all threads. Call in uniform control flow.
uint workgroupExclusiveAdd(uint value, out uint total)
{
    uint before = subgroupExclusiveAdd(value);
    barrier(); // the array may still be read by an earlier call
    if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u)
        s_subgroup_sums[gl_SubgroupID] = before + value;
    barrier();
    uint offset = 0u;
    total = 0u;
    for (uint i = 0u; i < gl_NumSubgroups; ++i)
    {
        offset = i == gl_SubgroupID ? total : offset;
        total += s_subgroup_sums[i];
    }
    return offset + before;
}

#endif
