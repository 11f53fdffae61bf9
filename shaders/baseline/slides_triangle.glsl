// SPDX-License-Identifier: MIT
// Which voxels a triangle covers (docs/voxelization.md), by the slides' walk: the rows of its bounding rectangle in the
// plane of its two minor axes, the columns of each row that all edge functions leave, the layers of each column that the
// plane leaves; what remains is tested against the edges in the other two planes. The slides' code does the same in
// floating point, which may miss or add voxels at edges; here all of it is exact.
//
// Axes are permuted so that w is the triangle's major axis; u and v follow in cyclic order. Lattice points are within
// +-2^24 = kSlidesLatticeLimit, so edges are below 2^25 and components of the normal at most 2^51. An edge function is
// below 2^54. The plane's height is a quotient whose numerator may wrap around, but the remainder by its divisor,
// 256 n_w <= 2^59, fits.
//
// Needs the constant kThin, params.depth, params.origin and params.lattice_scale, and params.scene.
#ifndef ZVO_SHADERS_BASELINE_SLIDES_TRIANGLE_GLSL
#define ZVO_SHADERS_BASELINE_SLIDES_TRIANGLE_GLSL

#include "baseline/slides.h"
#include "lib/arithmetic.glsl"
#include "voxelize/vertex.glsl"

// Edge functions in a projection, of the edges from each corner to the next: a x + b y + c for the voxel at (x, y), with
// the coverage's support added. A voxel is inside where all are not negative.
struct SlidesEdges
{
    ivec3 a; // in 256ths
    ivec3 b;
    i64vec3 c;
};

struct SlidesTriangle
{
    SlidesEdges uv;
    SlidesEdges vw;
    SlidesEdges wu;
    i64vec3 support; // that is contained in uv
    i64vec3 n;       // in u, v, w, turned so that n.z is not negative
    ivec3 corner;    // 0, in u, v, w
    uint axis;       // which of x, y, z is w
    ivec3 low;       // first voxel in u, v, w that the closed bounding box touches, inside the grid
    ivec3 high;      // last one
};

// Why a triangle is left out.
const uint kSlidesKept = 0u;
const uint kSlidesNonfinite = 1u;
const uint kSlidesOutOfRange = 2u;
const uint kSlidesOutside = 3u;
const uint kSlidesZeroArea = 4u;

struct SlidesSnapped
{
    ivec3 v0;
    ivec3 v1;
    ivec3 v2;
    uint fate;
};

int64_t wideProduct(int a, int b)
{
    int high;
    int low;
    imulExtended(a, b, high, low);
    return packInt2x32(ivec2(low, high));
}

i64vec3 wideProduct(ivec3 a, ivec3 b)
{
    return i64vec3(wideProduct(a.x, b.x), wideProduct(a.y, b.y), wideProduct(a.z, b.z));
}

i64vec3 wideProduct(ivec3 a, int b)
{
    return wideProduct(a, ivec3(b));
}

// Floor of numerator / divisor, which is positive. estimate: of the quotient, off by less than one where that is inside
// of any grid. The numerator may have wrapped around. rest: of the division.
int floorQuotient(float estimate, int64_t numerator, int64_t divisor, out int64_t rest)
{
    const float limit = float(1 << 22); // far outside of any grid
    int quotient = int(floor(clamp(estimate, -limit, limit)));
    rest = numerator - int64_t(quotient) * divisor;
    bool below = rest < 0;
    quotient -= below ? 1 : 0;
    rest += below ? divisor : 0l;
    bool above = rest >= divisor;
    quotient += above ? 1 : 0;
    rest -= above ? divisor : 0l;
    return quotient;
}

int slidesResolution()
{
    return 1 << params.depth;
}

ivec3 lowestVoxel(SlidesSnapped t)
{
    ivec3 least = min(t.v0, min(t.v1, t.v2));
    return ((least + (kVoxelLattice - 1)) >> kVoxelLatticeLog2) - 1;
}

ivec3 highestVoxel(SlidesSnapped t)
{
    return max(t.v0, max(t.v1, t.v2)) >> kVoxelLatticeLog2;
}

bool withinLimit(ivec3 q)
{
    return all(lessThanEqual(abs(q), ivec3(kSlidesLatticeLimit)));
}

i64vec3 slidesNormal(SlidesSnapped t)
{
    ivec3 a = t.v1 - t.v0;
    ivec3 b = t.v2 - t.v0;
    return wideProduct(a.yzx, b.zxy) - wideProduct(a.zxy, b.yzx);
}

SlidesSnapped slidesSnap(Draw draw, uvec3 vertices)
{
    vec3 p0 = worldPosition(draw, vertices.x);
    vec3 p1 = worldPosition(draw, vertices.y);
    vec3 p2 = worldPosition(draw, vertices.z);
    vec3 q0 = latticePosition(p0);
    vec3 q1 = latticePosition(p1);
    vec3 q2 = latticePosition(p2);
    bool finite = isFinite(p0) && isFinite(p1) && isFinite(p2);
    bool on_lattice = finite && onLattice(q0) && onLattice(q1) && onLattice(q2);
    SlidesSnapped t;
    t.v0 = on_lattice ? ivec3(q0) : ivec3(0);
    t.v1 = on_lattice ? ivec3(q1) : ivec3(0);
    t.v2 = on_lattice ? ivec3(q2) : ivec3(0);
    bool in_range = on_lattice && withinLimit(t.v0) && withinLimit(t.v1) && withinLimit(t.v2);
    bool outside = any(lessThan(highestVoxel(t), ivec3(0))) ||
                   any(greaterThanEqual(lowestVoxel(t), ivec3(slidesResolution())));
    bool flat_out = kThin && slidesNormal(t) == i64vec3(0);
    t.fate = !finite    ? kSlidesNonfinite
             : !in_range ? kSlidesOutOfRange
             : outside   ? kSlidesOutside
             : flat_out  ? kSlidesZeroArea
                         : kSlidesKept;
    return t;
}

ivec3 slidesPermuted(ivec3 p, uint axis)
{
    return axis == 0u ? p.yzx : (axis == 1u ? p.zxy : p);
}

i64vec3 slidesPermuted(i64vec3 p, uint axis)
{
    return axis == 0u ? p.yzx : (axis == 1u ? p.zxy : p);
}

// x, y: coordinates of the corners in a projection; turned: its normal points down. support: that is added.
SlidesEdges edgesOf(ivec3 x, ivec3 y, bool turned, out i64vec3 support)
{
    ivec3 edge_x = x.yzx - x;
    ivec3 edge_y = y.yzx - y;
    ivec3 sizes = kThin ? max(abs(edge_x), abs(edge_y)) : abs(edge_x) + abs(edge_y);
    support = wideProduct(sizes, kVoxelLattice / 2);
    SlidesEdges edges;
    edges.a = turned ? edge_y : -edge_y;
    edges.b = turned ? -edge_x : edge_x;
    edges.c = wideProduct(edges.a, kVoxelLattice / 2 - x) + wideProduct(edges.b, kVoxelLattice / 2 - y) + support;
    return edges;
}

// Values at the voxel (x, y).
i64vec3 edgesAt(SlidesEdges edges, int x, int y)
{
    return wideProduct(edges.a, kVoxelLattice * x) + wideProduct(edges.b, kVoxelLattice * y) + edges.c;
}

bool noneNegative(i64vec3 values)
{
    return (values.x | values.y | values.z) >= 0;
}

SlidesTriangle slidesTriangle(SlidesSnapped s, out i64vec3 normal)
{
    SlidesTriangle t;
    ivec3 low = max(lowestVoxel(s), ivec3(0));
    ivec3 high = min(highestVoxel(s), ivec3(slidesResolution() - 1));
    normal = slidesNormal(s);
    // Without area, w is the axis along which the box is thinnest: all its layers are tried.
    i64vec3 size = normal == i64vec3(0) ? i64vec3(low - high) : abs(normal);
    t.axis = size.x >= size.y && size.x >= size.z ? 0u : (size.y >= size.z ? 1u : 2u);
    ivec3 p0 = slidesPermuted(s.v0, t.axis);
    ivec3 p1 = slidesPermuted(s.v1, t.axis);
    ivec3 p2 = slidesPermuted(s.v2, t.axis);
    i64vec3 n = slidesPermuted(normal, t.axis);
    ivec3 u = ivec3(p0.x, p1.x, p2.x);
    ivec3 v = ivec3(p0.y, p1.y, p2.y);
    ivec3 w = ivec3(p0.z, p1.z, p2.z);
    i64vec3 unused;
    t.vw = edgesOf(v, w, n.x < 0, unused);
    t.wu = edgesOf(w, u, n.y < 0, unused);
    t.uv = edgesOf(u, v, n.z < 0, t.support);
    t.n = n.z < 0 ? -n : n;
    t.corner = p0;
    t.low = slidesPermuted(low, t.axis);
    t.high = slidesPermuted(high, t.axis);
    return t;
}

// First and last column of a row that no edge function excludes; last < first: none.
ivec2 slidesColumns(SlidesTriangle t, int row, int first, int last)
{
    i64vec3 at_zero = edgesAt(t.uv, 0, row);
    for (int i = 0; i < 3; ++i)
    {
        // a column + b >= 0, in 256ths.
        int64_t divisor = max(int64_t(abs(t.uv.a[i])), 1l) * kVoxelLattice;
        bool rises = t.uv.a[i] > 0;
        int64_t numerator = rises ? -at_zero[i] + (divisor - 1) : at_zero[i]; // rounds up, or down
        int64_t rest;
        int column = floorQuotient(float(numerator) / float(divisor), numerator, divisor, rest);
        first = rises ? max(first, column) : first;
        last = t.uv.a[i] < 0 ? min(last, column) : last;
        last = t.uv.a[i] == 0 && at_zero[i] < 0 ? first - 1 : last;
    }
    return ivec2(first, last);
}

// The first or the last layer of a column, with the rest of its division.
struct SlidesLayer
{
    int layer;
    int64_t rest;
};

struct SlidesLayers
{
    SlidesLayer first;
    SlidesLayer last; // conservative only
};

// The layer of the plane over a column's centre, raised by addend / (256 n_w).
SlidesLayer slidesLayer(SlidesTriangle t, ivec2 column, int64_t addend)
{
    ivec2 to = column * kVoxelLattice + kVoxelLattice / 2 - t.corner.xy;
    int64_t numerator = int64_t(t.corner.z) * t.n.z - t.n.x * int64_t(to.x) - t.n.y * int64_t(to.y) + addend;
    float inverse = 1.0 / float(t.n.z);
    float height = float(t.corner.z) - float(t.n.x) * inverse * float(to.x) - float(t.n.y) * inverse * float(to.y) +
                   float(addend) * inverse;
    SlidesLayer result;
    result.layer = floorQuotient(height / float(kVoxelLattice), numerator, t.n.z * kVoxelLattice, result.rest);
    return result;
}

// Of a column. Conservative: those that the plane meets over the closed column. Its lower end excludes a unit, because a
// plane that touches a layer's upper face covers that layer too. Thin: the one of the plane over the column's centre.
SlidesLayers slidesLayers(SlidesTriangle t, ivec2 column)
{
    SlidesLayers layers;
    if (t.n.z == 0) // a segment or a point
    {
        layers.first = SlidesLayer(t.low.z, 0l);
        layers.last = SlidesLayer(t.high.z, 0l);
        return layers;
    }
    int64_t spread = kThin ? 0l : (abs(t.n.x) + abs(t.n.y)) * (kVoxelLattice / 2);
    layers.first = slidesLayer(t, column, -spread - (kThin ? 0l : 1l));
    layers.last = layers.first;
    if (!kThin)
        layers.last = slidesLayer(t, column, spread);
    return layers;
}

void stepLayer(SlidesTriangle t, inout SlidesLayer layer)
{
    int64_t divisor = t.n.z * kVoxelLattice;
    layer.rest -= t.n.x * kVoxelLattice;
    bool up = layer.rest >= divisor;
    bool down = layer.rest < 0 && t.n.z != 0;
    layer.layer += up && t.n.z != 0 ? 1 : (down ? -1 : 0);
    layer.rest += down ? divisor : (up ? -divisor : 0l);
}

// To the next column of the row. The plane rises or falls by at most a layer.
void stepLayers(SlidesTriangle t, inout SlidesLayers layers)
{
    stepLayer(t, layers.first);
    if (!kThin)
        stepLayer(t, layers.last);
}

// First and last layer to be tested.
ivec2 layerRange(SlidesTriangle t, SlidesLayers layers)
{
    // A triangle in the grid's upper face belongs to the last layer.
    bool is_level = t.n.x == 0 && t.n.y == 0;
    int top = kThin && is_level ? slidesResolution() - 1 : layers.first.layer;
    int first = min(layers.first.layer, top);
    int last = kThin ? first : layers.last.layer;
    return ivec2(max(first, t.low.z), min(last, t.high.z));
}

// Whether the edges in the two planes along w leave a voxel. vw, wu: their functions at layer 0 of its row and column.
bool leftByEdges(SlidesTriangle t, i64vec3 vw, i64vec3 wu, int layer)
{
    return noneNegative(vw + wideProduct(t.vw.b, kVoxelLattice * layer)) &&
           noneNegative(wu + wideProduct(t.wu.a, kVoxelLattice * layer));
}

// Edge functions at the centre of a column: component i belongs to vertex i.
i64vec3 slidesCorners(SlidesTriangle t, ivec2 column)
{
    return (edgesAt(t.uv, column.x, column.y) - t.support).yzx;
}

uvec3 slidesVoxel(SlidesTriangle t, ivec2 column, int layer)
{
    ivec3 cell = ivec3(column, layer);
    return uvec3(t.axis == 0u ? cell.zxy : (t.axis == 1u ? cell.yzx : cell));
}

// The pieces of a triangle: rectangles of rows and columns of its box in u and v.
struct SlidesPieces
{
    int columns;        // of a piece
    int rows;           // of a piece
    uint count_columns; // pieces side by side
    uint count;
};

SlidesPieces slidesPieces(SlidesTriangle t)
{
    ivec2 extent = t.high.xy - t.low.xy + 1;
    SlidesPieces pieces;
    pieces.columns = min(extent.x, int(kSlidesPieceWidth));
    pieces.rows = max(int(kSlidesPieceColumns) / max(pieces.columns, 1), 1);
    pieces.count_columns = uint((extent.x + pieces.columns - 1) / max(pieces.columns, 1));
    pieces.count = pieces.count_columns * uint((extent.y + pieces.rows - 1) / pieces.rows);
    return pieces;
}

#endif
