// SPDX-License-Identifier: MIT
// Exact coverage of one triangle, column by column (docs/voxelization.md; Schwarz and Seidel 2010, in integers).
//
// Needs the constants kCoverage and kThin, and the macros EDGE_INT and EDGE_IVEC3: int and ivec3 for triangles of at
// most kSmallExtent, else int64_t and i64vec3, with EDGE_WIDE. Arithmetic wraps; what is compared in the end fits
// (int64: vertices within kLatticeLimit).
//
// Axes are permuted so that w is the triangle's major axis; columns stand along w over the (u, v) plane. Then u and v
// are mirrored, and corners exchanged, so that every triangle with area has n_u <= 0, n_v <= 0 and n_w > 0: its plane
// rises along u and v by at most a layer for each column, and its edges have the same sign in each projection. Which
// sign a projection to a segment gets does not matter: its edges run both ways. Mirrored, column c is column ~c, and
// the columns above a leaf stay together.
//
// Component i of an EDGE_IVEC3 belongs to the edge from corner i to corner i + 1.
#ifndef ZVO_SHADERS_VOXELIZE_RASTER_GLSL
#define ZVO_SHADERS_VOXELIZE_RASTER_GLSL

#include "voxelize/axes.glsl"
#include "voxelize/voxelize.h"

#ifndef EDGE_INT
#error "voxelize/raster.glsl needs EDGE_INT: int or int64_t, and EDGE_IVEC3"
#endif

#ifndef RASTER_CELL_LOG2
#define RASTER_CELL_LOG2 kVoxelLatticeLog2
#endif

const int kCellLog2 = RASTER_CELL_LOG2;
const int kCell = 1 << kCellLog2; // lattice units of a cell: a voxel's edge, or a brick's

// A triangle set up for its grid.
struct RasterTriangle
{
    ivec3 u; // lattice coordinates of the three corners
    ivec3 v;
    ivec3 w;
    ivec3 edge_u; // edge vectors
    ivec3 edge_v;
    ivec3 edge_w;
    EDGE_INT rise_u; // minus n_u: what the plane rises by in a column, times n_w
    EDGE_INT rise_v; // what it rises by in a row, times n_w: both from 0 to n_w
    EDGE_INT n_w;    // 0 for a segment or a point
    uint axis;       // which of x, y, z is w
    ivec2 mirror;    // -1 where u or v is mirrored, else 0
    bool exchanged;  // corner 1 is vertex 2
    ivec3 low;       // first voxel in u, v, w that the bounding box touches, inside the grid
    ivec3 high;      // last one
    int layer_top;   // no layer above: keeps a triangle in the grid's upper face inside
};

// The state of the walk at one voxel: edge functions, and the crossing of plane and column.
struct RasterCell
{
    EDGE_IVEC3 uv; // edge functions in the (u, v) projection, support added: inside when >= 0
    EDGE_IVEC3 vw;
    EDGE_IVEC3 wu;
    int w;         // layer
    EDGE_INT rest; // remainder of the (lower) layer's division by n_w
    int w_high;    // conservative: the last layer the plane meets in this column
    EDGE_INT rest_high;
};

// a * b. Compilers do not see that the factors of a 64-bit product are short, and take four products for it.
EDGE_INT product(int a, int b)
{
#ifdef EDGE_WIDE
    int high;
    int low;
    imulExtended(a, b, high, low);
    return packInt2x32(ivec2(low, high));
#else
    return a * b;
#endif
}

EDGE_IVEC3 product(ivec3 a, ivec3 b)
{
    return EDGE_IVEC3(product(a.x, b.x), product(a.y, b.y), product(a.z, b.z));
}

// a, b: components of the edge vectors.
EDGE_IVEC3 edgeSupport(ivec3 a, ivec3 b)
{
    ivec3 size_a = abs(a);
    ivec3 size_b = abs(b);
    EDGE_IVEC3 size = kCoverage == kCoverageConservative ? EDGE_IVEC3(size_a) + EDGE_IVEC3(size_b)
                                                         : EDGE_IVEC3(max(size_a, size_b));
    return size * EDGE_INT(kCell / 2);
}

// What an edge function changes by from cell to cell. edge: components of the edge vectors.
EDGE_IVEC3 voxelStep(ivec3 edge)
{
    return EDGE_IVEC3(edge) * EDGE_INT(kCell);
}

// Coordinates of the corners along an axis that may be mirrored.
ivec3 cornersOf(ivec3 vertices, int mirror, bool exchanged)
{
    ivec3 corners = exchanged ? vertices.xzy : vertices;
    return (corners ^ mirror) - mirror;
}

// RasterTriangle::layer_top, of which the other members are set.
int topLayer(RasterTriangle t, int resolution)
{
    return t.rise_u == 0 && t.rise_v == 0 ? resolution - 1 : kLatticeLimit;
}

// normal: exact (of the lattice points as they are); low, high: touched voxels in x, y, z.
RasterTriangle setupTriangle(ivec3 v0, ivec3 v1, ivec3 v2, i64vec3 normal, uint axis, ivec3 low, ivec3 high,
                             int resolution)
{
    RasterTriangle t;
    t.axis = axis;
    i64vec3 n = permuted(normal, axis);
    t.mirror = mirrorOf(n);
    t.exchanged = (n.z < 0) != (t.mirror.x != t.mirror.y);
    // Columns of the matrix are vertices.
    ivec3 x = ivec3(v0.x, v1.x, v2.x);
    ivec3 y = ivec3(v0.y, v1.y, v2.y);
    ivec3 z = ivec3(v0.z, v1.z, v2.z);
    bool is_x = axis == 0u;
    bool is_y = axis == 1u;
    t.u = cornersOf(is_x ? y : (is_y ? z : x), t.mirror.x, t.exchanged);
    t.v = cornersOf(is_x ? z : (is_y ? x : y), t.mirror.y, t.exchanged);
    t.w = cornersOf(is_x ? x : (is_y ? y : z), 0, t.exchanged);
    CellBox box = boxOf(axis, t.mirror, low, high);
    t.low = box.low;
    t.high = box.high;
    t.rise_u = abs(EDGE_INT(n.x));
    t.rise_v = abs(EDGE_INT(n.y));
    t.n_w = abs(EDGE_INT(n.z));
    t.edge_u = t.u.yzx - t.u;
    t.edge_v = t.v.yzx - t.v;
    t.edge_w = t.w.yzx - t.w;
    t.layer_top = topLayer(t, resolution);
    return t;
}

// floor(numerator / n_w) of the division that decides a column's layer, numerator being
//   (w_0 n_w + rise_u (c_u - u_0) + rise_v (c_v - v_0) + addend) / kCell
// with (c_u, c_v) the centre of column. Products with the low bits of a factor are kept apart so that dividing by kCell
// is exact; the quotient is estimated in floating point and corrected by the exact (wrapping) remainder.
int columnLayer(RasterTriangle t, ivec2 column, EDGE_INT addend_high, int addend_low, out EDGE_INT rest)
{
    int to_u = column.x * kCell + kCell / 2 - t.u.x;
    int to_v = column.y * kCell + kCell / 2 - t.v.x;
    int to_w = t.w.x;
    const int low_bits = kCell - 1;
    int low_u = to_u & low_bits;
    int low_v = to_v & low_bits;
    int low_w = to_w & low_bits;
    EDGE_INT high = EDGE_INT(to_w >> kCellLog2) * t.n_w + EDGE_INT(to_u >> kCellLog2) * t.rise_u +
                    EDGE_INT(to_v >> kCellLog2) * t.rise_v;
    EDGE_INT middle = EDGE_INT(low_w) * (t.n_w >> kCellLog2) +
                      EDGE_INT(low_u) * (t.rise_u >> kCellLog2) +
                      EDGE_INT(low_v) * (t.rise_v >> kCellLog2);
    int low = low_w * (int(t.n_w) & low_bits) + low_u * (int(t.rise_u) & low_bits) +
              low_v * (int(t.rise_v) & low_bits);
    EDGE_INT numerator = high + middle + addend_high + EDGE_INT((low + addend_low) >> kCellLog2);

    float inverse = 1.0 / float(t.n_w);
    float height = float(to_w) + (float(t.rise_u) * inverse) * float(to_u) + (float(t.rise_v) * inverse) * float(to_v) +
                   float(addend_high) * inverse * float(kCell);
    int layer = int(floor(height / float(kCell)));
    rest = numerator - EDGE_INT(layer) * t.n_w;
    bool below = rest < 0; // the estimate is at most four layers off
    layer -= below ? 4 : 0;
    rest += below ? t.n_w << 2 : EDGE_INT(0);
    for (int log2 = 2; log2 >= 0; --log2)
    {
        EDGE_INT part = t.n_w << log2;
        bool above = rest >= part;
        layer += above ? 1 << log2 : 0;
        rest -= above ? part : EDGE_INT(0);
    }
    return layer;
}

// The walk's state at the first layer of a column.
RasterCell startColumn(RasterTriangle t, ivec2 column)
{
    RasterCell cell;
    if (kCoverage == kCoverageConservative && t.n_w == 0) // a segment or a point: every layer of its box is a candidate
    {
        cell.w = t.low.z;
        cell.w_high = t.high.z;
        cell.rest = EDGE_INT(0);
        cell.rest_high = EDGE_INT(0);
    }
    else
    {
        // Conservative: the plane's range over the closed column is +-kCell / 2 (|n_u| + |n_v|); the lower end excludes
        // one unit, because a plane that touches a layer's upper face covers that layer too.
        EDGE_INT spread = kThin ? EDGE_INT(0) : t.rise_u + t.rise_v;
        EDGE_INT half_spread = spread >> 1;
        int odd = (int(spread) & 1) * (kCell / 2);
        int layer = columnLayer(t, column, -half_spread, kThin ? 0 : -odd - 1, cell.rest);
        cell.w = kThin ? min(layer, t.layer_top) : layer;
        cell.w_high = cell.w;
        cell.rest_high = EDGE_INT(0);
        if (!kThin)
            cell.w_high = columnLayer(t, column, half_spread, odd, cell.rest_high);
    }
    ivec3 to_u = column.x * kCell + kCell / 2 - t.u;
    ivec3 to_v = column.y * kCell + kCell / 2 - t.v;
    ivec3 to_w = cell.w * kCell + kCell / 2 - t.w;
    cell.uv = product(t.edge_u, to_v) - product(t.edge_v, to_u) + edgeSupport(t.edge_u, t.edge_v);
    cell.vw = product(t.edge_w, to_v) - product(t.edge_v, to_w) + edgeSupport(t.edge_v, t.edge_w);
    cell.wu = product(t.edge_u, to_w) - product(t.edge_w, to_u) + edgeSupport(t.edge_w, t.edge_u);
    return cell;
}

// Moves the remainder of a division by n_w by rise (0 to n_w) and returns whether the quotient moves up by one.
bool stepLayer(RasterTriangle t, EDGE_INT rise, inout EDGE_INT rest)
{
    rest += rise;
    bool up = rest >= t.n_w;
    rest -= up ? t.n_w : EDGE_INT(0);
    return up;
}

// Moves the edge functions up by one layer, if up.
void moveUp(RasterTriangle t, bool up, inout RasterCell cell)
{
    cell.w += up ? 1 : 0;
    cell.vw -= voxelStep(up ? t.edge_v : ivec3(0));
    cell.wu += voxelStep(up ? t.edge_u : ivec3(0));
}

void stepPlane(RasterTriangle t, EDGE_INT rise, inout RasterCell cell)
{
    if (t.n_w != 0)
    {
        moveUp(t, stepLayer(t, rise, cell.rest), cell);
        if (kCoverage == kCoverageConservative)
            cell.w_high += stepLayer(t, rise, cell.rest_high) ? 1 : 0;
    }
}

// To the first layer of the next column along u.
void nextColumn(RasterTriangle t, inout RasterCell cell)
{
    cell.uv -= voxelStep(t.edge_v);
    cell.wu -= voxelStep(t.edge_w);
    stepPlane(t, t.rise_u, cell);
}

// To the first layer of the next column along v.
void nextRow(RasterTriangle t, inout RasterCell cell)
{
    cell.uv += voxelStep(t.edge_u);
    cell.vw += voxelStep(t.edge_w);
    stepPlane(t, t.rise_v, cell);
}

bool isCovered(RasterTriangle t, RasterCell cell)
{
    EDGE_IVEC3 signs = cell.uv | cell.vw | cell.wu;
    return (signs.x | signs.y | signs.z) >= 0 && cell.w >= t.low.z && cell.w <= t.high.z;
}

// Voxel coordinates from (u, v, w).
ivec3 voxelOf(RasterTriangle t, ivec2 column, int w)
{
    return unpermuted(ivec3(column ^ t.mirror, w), t.axis);
}

// Barycentric edge functions at the column's centre: component i belongs to vertex i.
EDGE_IVEC3 cornerWeights(RasterTriangle t, RasterCell cell)
{
    EDGE_IVEC3 corners = (cell.uv - edgeSupport(t.edge_u, t.edge_v)).yzx;
    return t.exchanged ? corners.xzy : corners;
}

#endif
