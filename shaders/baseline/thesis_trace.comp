#version 460
// SPDX-License-Identifier: MIT
// Traces a ray for each pixel through a pointer octree: depth first, children in their order along the ray, on an
// explicit stack. Which cells a ray visits is zvo's rule (lib/traverse.glsl), taken from its definition: a cell is
// visited if the last of its entries, and the start, comes before the first of its exits, in the order (time, axis). So
// a hit is zvo's, bit for bit. The thesis compares boxes and rays by floating-point intervals instead.
//
// A ray's directions are mirrored to be positive (J. Revelles, C. Urena, M. Lastra, An Efficient Parametric Algorithm
// for Octree Traversal, 2000). Morton order is then an order along the ray, and what the stack keeps of a level are its
// tile and a mask of the children that are still to be visited.
#extension GL_GOOGLE_include_directive : require
#include "baseline/thesis.h"

GPU_ENTRY(ThesisTraceParams, BASELINE_THESIS_TRACE_CONSTANTS);
layout(local_size_x = kThesisTileEdge * kThesisTileEdge) in;

#include "lib/camera.glsl"
#include "lib/dispatch.glsl"
#include "lib/hit.glsl"
#include "lib/ray.glsl"

// A ray, mirrored, and the planes between voxels: bits of floats in [1, 2].
struct MirroredRay
{
    vec3 origin;
    vec3 inverse;
    uint plane_shift;
};

vec3 planeTimes(MirroredRay ray, uvec3 planes)
{
    precise vec3 distances = uintBitsToFloat(floatBitsToUint(1.0) + (planes << ray.plane_shift)) - ray.origin;
    precise vec3 times = distances * ray.inverse;
    return times;
}

// Whether a ray visits the cell that it enters and leaves through planes at these times.
bool isVisited(vec3 t_in, vec3 t_out)
{
    bvec3 x_before = bvec3(t_in.x < t_out.x, t_in.x <= t_out.y, t_in.x <= t_out.z);
    bvec3 y_before = bvec3(t_in.y < t_out.x, t_in.y < t_out.y, t_in.y <= t_out.z);
    bvec3 z_before = bvec3(t_in.z < t_out.x, t_in.z < t_out.y, t_in.z < t_out.z);
    return all(x_before) && all(y_before) && all(z_before) && all(greaterThan(t_out, vec3(kTraceTimeMin)));
}

// Mask of the children that the ray visits, of a node that begins at corner and whose children have this edge.
uint visitedChildren(MirroredRay ray, uvec3 corner, uint edge)
{
    vec3 low = planeTimes(ray, corner);
    vec3 middle = planeTimes(ray, corner + edge);
    vec3 high = planeTimes(ray, corner + 2u * edge);
    uint mask = 0u;
    [[unroll]] for (uint child = 0u; child < kTileNodes; ++child)
    {
        bvec3 upper = bvec3((child & 1u) != 0u, (child & 2u) != 0u, (child & 4u) != 0u);
        mask |= isVisited(mix(low, middle, upper), mix(middle, high, upper)) ? 1u << child : 0u;
    }
    return mask;
}

void main()
{
    uvec2 size = uvec2(params.width, params.height);
    uint row_tiles = (size.x + kThesisTileEdge - 1u) / kThesisTileEdge;
    uvec2 tile_position = uvec2(workgroupIndex() % row_tiles, workgroupIndex() / row_tiles);
    uvec2 pixel = kThesisTileEdge * tile_position + pixelInTile(gl_LocalInvocationIndex);
    CameraRays camera = params.camera;
    vec3 offset = rayOffset(pixelOffset(pixel, size), camera.half_pixel_x, camera.half_pixel_y);
    precise vec3 direction = camera.forward + (kOrthographic ? vec3(0.0) : offset);
    precise vec3 start = camera.origin + (kOrthographic ? offset : vec3(0.0));
    vec3 inverse = inverseDirection(direction);
    bvec3 mirrored = lessThan(inverse, vec3(0.0));
    precise vec3 flipped = 3.0 - start;
    uint unit_depth = 2u * ((params.depth + 1u) / 2u); // of the cube that is [1, 2)^3
    uint last = (1u << unit_depth) - 1u;
    uint resolution = 1u << params.depth;
    MirroredRay ray = MirroredRay(mix(start, flipped, mirrored), abs(inverse), kMantissaBits - unit_depth);
    uint mirror = (mirrored.x ? 1u : 0u) | (mirrored.y ? 2u : 0u) | (mirrored.z ? 4u : 0u);

    uint stack_tiles[kPointerDepthMax]; // of the nodes from the root down to the current one's parent
    uint stack_masks[kPointerDepthMax];
    uvec3 corner = mix(uvec3(0u), uvec3(last + 1u - resolution), mirrored);
    uint edge = resolution >> 1; // of a child, in voxels
    uint level = 0u;
    uint tile = params.nodes.data[params.root].child;
    uint mask = tile != 0u ? visitedChildren(ray, corner, edge) : 0u;
    uint hit_node = kHitMiss;
    uint iterations = 0u;
    bool go = mask != 0u;
    for (; go;)
    {
        ++iterations;
        bool down = mask != 0u;
        uint child = uint(findLSB(mask | (1u << kTileNodes))) & (kTileNodes - 1u);
        uint number = tile + (child ^ mirror);
        uint pointer = params.nodes.data[number].child;
        mask &= mask - 1u;
        if (down && pointer != 0u)
        {
            corner += uvec3(child & 1u, (child >> 1) & 1u, child >> 2) * edge;
            if (edge == 1u)
            {
                hit_node = number;
            }
            else
            {
                stack_tiles[level] = tile;
                stack_masks[level] = mask;
                ++level;
                tile = pointer;
                edge >>= 1;
                mask = visitedChildren(ray, corner, edge);
            }
        }
        else if (!down && level != 0u)
        {
            --level;
            tile = stack_tiles[level];
            mask = stack_masks[level];
            edge <<= 1;
            corner &= ~(2u * edge - 1u);
        }
        go = hit_node == kHitMiss && (mask != 0u || level != 0u) && iterations < kTraceIterationsMax;
    }

    if (any(greaterThanEqual(pixel, size)))
        return;
    uint i = pixel.y * size.x + pixel.x;
    if (hit_node == kHitMiss)
    {
        storeMiss(params.hits, i);
        if (mask != 0u || level != 0u)
            atomicAdd(params.status.data[0].capped_rays, 1u);
        return;
    }
    vec3 t_in = planeTimes(ray, corner);
    float t = max(max(t_in.x, t_in.y), max(t_in.z, kTraceTimeMin));
    uint face = t == kTraceTimeMin ? kFaceInside : (t == t_in.z ? 2u : (t == t_in.y ? 1u : 0u));
    storeHit(params.hits, i, t, hit_node, mix(corner, corner ^ last, mirrored), unit_depth / 2u, face);
}
