// SPDX-License-Identifier: MIT
// A host's kernel: a camera's picture of a tree, by rays of pixels in unit space, with all that there is to know of
// what they hit. Whoever includes it has said how (the macros of zvo/trace.glsl). glsl/zvo_picture.h has the same
// structs.
#include "zvo/trace.glsl"

layout(local_size_x = 64) in;

struct Frame
{
    zvo_CameraRays camera;
    uint orthographic;
    uint width;
    uint height;
    mat4 view_projection;
    vec2 detail; // of ZVO_DETAIL, unit space
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FrameAddress
{
    Frame frame;
};

struct Pixel
{
    zvo_Hit hit;
    uint albedo; // encoded as zvo's pictures are
    uint normal;
    vec3 emission;
    vec3 position;
    vec3 face_normal;
    vec3 middle;
    float edge;
    float depth;
    uint is_voxel;
    uint is_inside;
    uint is_dynamic;
};
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer Pixels
{
    Pixel pixel[];
};

layout(push_constant, scalar) uniform Push
{
    uint64_t tree;
    FrameAddress of;
    Pixels pixels;
};

void main()
{
    uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64 + gl_LocalInvocationIndex;
    uvec2 size = uvec2(of.frame.width, of.frame.height);
    bool is_pixel = i < size.x * size.y;
    zvo_TreeTable_ConstPtr table = zvo_TreeTable_ConstPtr(tree);
    zvo_CameraRays camera = of.frame.camera;
    bool orthographic = of.frame.orthographic != 0u;
    uvec2 at = uvec2(i % size.x, i / size.x);
    vec3 origin = zvo_pixelOrigin(camera, orthographic, at, size);
    vec3 direction = zvo_pixelDirection(camera, orthographic, at, size);
    zvo_Ray ray = zvo_unitRay(origin, direction, 0.0, zvo_kTraceTimeMax);
#ifdef ZVO_DETAIL
    zvo_Hit hit = zvo_traceRayDetail(table, ray, of.frame.detail);
#else
    zvo_Hit hit = zvo_traceRay(table, ray);
#endif
    zvo_Surface surface = zvo_surface(table, hit, direction);
    vec3 position = zvo_position(table, hit, zvo_toWorld(table, origin), direction * zvo_unitEdge(table));
    Pixel result;
    result.hit = hit;
    result.albedo = zvo_packColor8(zvo_encodeSrgb(surface.base_color));
    result.normal = zvo_packColor8(0.5 + 0.5 * surface.normal);
    result.emission = surface.emission;
    result.position = position;
    result.face_normal = surface.face_normal;
    result.middle = surface.middle;
    result.edge = surface.edge;
    result.depth = zvo_depth(of.frame.view_projection, position);
    result.is_voxel = surface.is_voxel ? 1u : 0u;
    result.is_inside = surface.is_inside ? 1u : 0u;
    result.is_dynamic = surface.is_dynamic ? 1u : 0u;
    if (is_pixel)
        pixels.pixel[i] = result;
}
