// SPDX-License-Identifier: MIT

// Axes orthogonal to a direction of length 1, which is the last one (T. Duff et al., Building an Orthonormal Basis,
// Revisited, 2017).
mat3 frameAround(vec3 n)
{
    float sign = n.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (sign + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), vec3(b, sign + n.y * n.y * a, -n.y), n);
}
