// SPDX-License-Identifier: MIT
// Bounds of distances to a triangle in floating point, for points within some thousand lattice units of an origin near
// it. What is large is exact until it is relative to the origin, so that the bounds hold for any triangle: there, the
// distance to an edge's line is off by some 2^-22 of it, which is below kSlack.
#ifndef ZVO_SHADERS_DISTANCE_ESTIMATE_GLSL
#define ZVO_SHADERS_DISTANCE_ESTIMATE_GLSL

#include "distance/exact.glsl"

const float kSlack = 0.5; // lattice units

// An edge, seen from the origin.
struct EdgeView
{
    vec3 direction; // of length 1; 0 for a point
    vec3 from_line; // the vector from the line's nearest point
    vec3 outward;   // of length 1, in the triangle's plane
    float start;    // the origin's place along the edge, from its first end
    float rest;     // and to its second end
};

struct TriangleView
{
    EdgeView e0;
    EdgeView e1;
    EdgeView e2;
    vec3 normal;
    float height;
    bool is_flat; // a segment or a point
};

EdgeView edgeView(ivec3 a, ivec3 b, ivec3 origin, vec3 normal)
{
    ivec3 edge = b - a;
    ivec3 to = origin - a;
    int64_t squared = longDot(edge, edge);
    int64_t along = longDot(to, edge);
    float inverse = squared == 0l ? 0.0 : 1.0 / sqrt(float(squared));
    EdgeView view;
    view.direction = vec3(edge) * inverse;
    view.from_line = squared == 0l ? vec3(to) : cross(view.direction, vec3(longCross(to, edge)) * inverse);
    view.outward = cross(view.direction, normal);
    view.start = float(along) * inverse;
    view.rest = float(squared - along) * inverse;
    return view;
}

TriangleView triangleView(ivec3 v0, ivec3 v1, ivec3 v2, ivec3 origin)
{
    i64vec3 normal = longCross(v1 - v0, v2 - v0);
    Wide up = height(normal, origin - v0);
    vec3 direction = vec3(normal);
    TriangleView view;
    view.is_flat = normal == i64vec3(0l);
    float inverse = view.is_flat ? 0.0 : 1.0 / length(direction);
    view.normal = direction * inverse;
    view.height = (isNegative(up) ? -1.0 : 1.0) * (scaled(absolute(up)) * inverse * exp2(64.0));
    view.e0 = edgeView(v0, v1, origin, view.normal);
    view.e1 = edgeView(v1, v2, origin, view.normal);
    view.e2 = edgeView(v2, v0, origin, view.normal);
    return view;
}

// The squared distance of a point to an edge, and how far outside of it the point is.
vec2 distanceToEdge(EdgeView edge, vec3 point)
{
    float along = dot(point, edge.direction);
    vec3 from_line = edge.from_line + point - along * edge.direction;
    float beyond = max(max(-(edge.start + along), along - edge.rest), 0.0);
    return vec2(dot(from_line, from_line) + beyond * beyond, dot(edge.outward, from_line));
}

// The least and the greatest distance that a point's distance may be. point: seen from the origin.
vec2 distanceBounds(TriangleView triangle, vec3 point)
{
    vec2 e0 = distanceToEdge(triangle.e0, point);
    vec2 e1 = distanceToEdge(triangle.e1, point);
    vec2 e2 = distanceToEdge(triangle.e2, point);
    float outside = max(e0.y, max(e1.y, e2.y));
    float to_edges = sqrt(min(e0.x, min(e1.x, e2.x)));
    float to_plane = abs(triangle.height + dot(triangle.normal, point));
    bool may_be_over = !triangle.is_flat && outside <= 2.0 * kSlack;
    bool is_over = may_be_over && outside <= -2.0 * kSlack;
    return vec2(may_be_over ? min(to_plane, to_edges) : to_edges, is_over ? to_plane : to_edges) +
           vec2(-kSlack, kSlack);
}

#endif
