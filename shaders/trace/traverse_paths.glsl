// SPDX-License-Identifier: MIT
// The traversal of lib/traverse.glsl for rays that begin below the root, at the nodes that trace/node_paths has
// written.
// Needs the constants kPaths and kPathsRelative. main() sets g_paths.
// PATHS_BINDING (optional): the binding of params.paths in the kernel's bound form (lib/bound.glsl).
#ifndef ZVO_SHADERS_TRACE_TRAVERSE_PATHS_GLSL
#define ZVO_SHADERS_TRACE_TRAVERSE_PATHS_GLSL

#include "lib/bound.glsl"
#include "trace/node_paths.h"

uint64_t_ConstPtr g_paths; // of trace/node_paths

#if defined(BOUND) && defined(PATHS_BINDING)
TEXELS_2(PATHS_BINDING, paths);

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

#ifdef ZVO_SHADERS_LIB_TRAVERSE_GLSL
#error "lib/traverse.glsl was included before trace/traverse_paths.glsl, which includes it"
#endif
#define TRAVERSE_PATHS kPaths
#define TRAVERSE_PATHS_RELATIVE kPathsRelative
#include "lib/traverse.glsl"

#endif
