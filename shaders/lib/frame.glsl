// SPDX-License-Identifier: MIT
#ifndef ZVO_SHADERS_LIB_FRAME_GLSL
#define ZVO_SHADERS_LIB_FRAME_GLSL

// Axes orthogonal to a direction of length 1, which is the last one (T. Duff et al., Building an Orthonormal Basis,
// Revisited, 2017).
mat3 frameAround(vec3 n)
{
    float sign = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (sign + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n);
}

// A direction in such a frame, to the side of its last axis: of even u in [0, 1) and even angles about the axis, they
// are spread by the cosine with it, which is z.
vec3 cosineDirection(float u, float angle)
{
    return vec3(sqrt(u) * vec2(cos(angle), sin(angle)), sqrt(1.0 - u));
}

#endif
