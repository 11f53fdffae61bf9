// SPDX-License-Identifier: MIT
// Loads the nodes with which rays begin below the root, for lib/traverse.glsl. The includer declares the constants
// kPaths and kPathsRelative, has buffer parameter `paths`, and sets g_paths.
#ifndef ZVO_SHADERS_TRACE_PATH_LOADS_GLSL
#define ZVO_SHADERS_TRACE_PATH_LOADS_GLSL

#include "trace/node_paths.h"

uint64_t_ConstPtr g_paths; // of trace/node_paths

#ifdef BOUND
TEXELS_2(1, paths);

uvec2 loadPath(uint cell)
{
    return texelFetch(texels2_paths, int(cell)).xy;
}
#else
uvec2 loadPath(uint cell)
{
    return unpackUint2x32(g_paths.data[cell]);
}
#endif

#define TRAVERSE_PATHS kPaths
#define TRAVERSE_PATHS_RELATIVE kPathsRelative

#endif
