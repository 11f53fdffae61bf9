// SPDX-License-Identifier: MIT
// The squared distance of a point to a triangle in integers (docs/voxelization.md, Distance).
#ifndef ZVO_SHADERS_DISTANCE_EXACT_GLSL
#define ZVO_SHADERS_DISTANCE_EXACT_GLSL

#include "distance/distance.h"
#include "distance/wide.glsl"

// Compilers do not see that the factors of a 64-bit product are short, and take four products for it.
int64_t longProduct(int a, int b)
{
    int high;
    int low;
    imulExtended(a, b, high, low);
    return packInt2x32(ivec2(low, high));
}

int64_t longDot(ivec3 a, ivec3 b)
{
    return longProduct(a.x, b.x) + longProduct(a.y, b.y) + longProduct(a.z, b.z);
}

i64vec3 longCross(ivec3 a, ivec3 b)
{
    return i64vec3(longProduct(a.y, b.z) - longProduct(a.z, b.y), longProduct(a.z, b.x) - longProduct(a.x, b.z),
                   longProduct(a.x, b.y) - longProduct(a.y, b.x));
}

Wide squaredLength(i64vec3 a)
{
    u64vec3 size = u64vec3(abs(a));
    return sum(product64(size.x, size.x), sum(product64(size.y, size.y), product64(size.z, size.z)));
}

// n (b - a) for the normal n of a triangle.
Wide height(i64vec3 normal, ivec3 to)
{
    return sum(signedProduct(normal.x, int64_t(to.x)),
               sum(signedProduct(normal.y, int64_t(to.y)), signedProduct(normal.z, int64_t(to.z))));
}

// a^2 for one below 2^75; not negative.
Wide squareOf(Wide a)
{
    Wide low = product64(a.low, a.low);
    Wide cross = product64(a.low, a.middle);
    uint64_t top = cross.middle << 1 | cross.low >> 63;
    return sum(low, Wide(0ul, cross.low << 1, top + a.middle * a.middle));
}

// Whether the triangle's plane is nearest to the point within the triangle: its weights there are not negative.
bool isOverFace(ivec3 ab, ivec3 ac, ivec3 ap)
{
    int64_t e = longDot(ab, ab);
    int64_t f = longDot(ab, ac);
    int64_t g = longDot(ac, ac);
    int64_t d = longDot(ab, ap);
    int64_t h = longDot(ac, ap);
    Wide to_b = difference(signedProduct(g, d), signedProduct(f, h));
    Wide to_c = difference(signedProduct(e, h), signedProduct(f, d));
    Wide all = difference(signedProduct(e, g), signedProduct(f, f));
    return !isNegative(to_b) && !isNegative(to_c) && !isNegative(difference(all, sum(to_b, to_c)));
}

// min(floor(2^kDistanceBits d^2), kNoDistance) for the distance d in lattice units, except that distances beyond the
// largest band may be kNoDistance.
uint squaredDistance(ivec3 point, ivec3 v0, ivec3 v1, ivec3 v2)
{
    const uint64_t vertex_limit = uint64_t(kNoDistance >> kDistanceBits);
    i64vec3 normal = longCross(v1 - v0, v2 - v0);
    bool over_face = normal != i64vec3(0l) && isOverFace(v1 - v0, v2 - v0, point - v0);
    Wide up = absolute(height(normal, point - v0));
    const uint64_t height_limit = 1ul << 11; // of 2^64; in the band it is below 2^74
    over_face = over_face && up.high == 0ul && up.middle < height_limit;
    uint least = kNoDistance;
    ivec3 a = v0;
    ivec3 b = v1;
    ivec3 c = v2;
    for (uint i = 0u; i < 4u; ++i) // the edges, and the vertices where they begin; then the face
    {
        bool is_face = i == 3u;
        ivec3 edge = b - a;
        ivec3 to = point - a;
        int64_t along = longDot(to, edge);
        int64_t length = longDot(edge, edge);
        uint64_t vertex = uint64_t(longDot(to, to));
        if (vertex < vertex_limit)
            least = min(least, uint(vertex) << kDistanceBits);
        if (is_face ? over_face : along > 0l && along < length)
        {
            i64vec3 across = longCross(to, edge);
            if (is_face)
                across = normal;
            Wide size = squaredLength(across);
            Wide dividend = is_face ? squareOf(up) : size;
            Wide divisor = is_face ? size : Wide(uint64_t(length), 0ul, 0ul);
            least = min(least, quotient(shifted8(dividend), divisor));
        }
        ivec3 first = a;
        a = b;
        b = c;
        c = first;
    }
    return least;
}

#endif
