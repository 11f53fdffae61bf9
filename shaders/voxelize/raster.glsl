// SPDX-License-Identifier: MIT
// Exact coverage of one triangle, column by column (docs/voxelization.md; Schwarz and Seidel 2010, in integers).
//
// Before it is included, EDGE_INT and EDGE_IVEC3 are defined: int and ivec3 for triangles of at most kSmallExtent, else
// int64_t and i64vec3. Arithmetic wraps; what is compared in the end fits (int64: vertices within kLatticeLimit).
//
// Axes are permuted so that w is the triangle's major axis; columns stand along w over the (u, v) plane. Component i of
// an EDGE_IVEC3 belongs to the edge from vertex i to vertex i + 1.

// A triangle set up for its grid.
struct RasterTriangle
{
    ivec3 u; // lattice coordinates of the three vertices
    ivec3 v;
    ivec3 w;
    EDGE_IVEC3 du; // edge vectors times 256: steps of the edge functions
    EDGE_IVEC3 dv;
    EDGE_IVEC3 dw;
    EDGE_INT n_u; // normal, times the sign that makes n_w positive
    EDGE_INT n_v;
    EDGE_INT n_w; // 0 for a segment or a point
    EDGE_INT s_u; // signs of the original normal's components, +1 for 0
    EDGE_INT s_v;
    EDGE_INT s_w;
    uint axis;     // which of x, y, z is w
    ivec3 low;     // first voxel in u, v, w that the bounding box touches, inside the grid
    ivec3 high;    // last one
    int layer_top; // no layer above: keeps a triangle in the grid's upper face inside
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

EDGE_IVEC3 edgeSupport(EDGE_IVEC3 a, EDGE_IVEC3 b)
{
    EDGE_IVEC3 half_a = abs(a) >> 1; // a and b are edge vectors times 256
    EDGE_IVEC3 half_b = abs(b) >> 1;
    return kCoverage == kCoverageConservative ? half_a + half_b : max(half_a, half_b);
}

// Which of x, y, z is w. A triangle without area has no major axis: w is the axis along which its box is thinnest, so
// that a column has few layers to try. low, high: touched voxels.
uint majorAxis(i64vec3 n, ivec3 low, ivec3 high)
{
    i64vec3 size = n == i64vec3(0) ? i64vec3(low - high) : abs(n);
    return size.x >= size.y && size.x >= size.z ? 0u : (size.y >= size.z ? 1u : 2u);
}

// n: the exact normal (of the lattice points as they are); low, high: touched voxels in x, y, z.
RasterTriangle setupTriangle(ivec3 v0, ivec3 v1, ivec3 v2, EDGE_IVEC3 n, uint axis, ivec3 low, ivec3 high,
                             int resolution)
{
    RasterTriangle t;
    t.axis = axis;
    // Rows of the matrix are vertices; columns are picked in cyclic order from the axis after w.
    ivec3 x = ivec3(v0.x, v1.x, v2.x);
    ivec3 y = ivec3(v0.y, v1.y, v2.y);
    ivec3 z = ivec3(v0.z, v1.z, v2.z);
    bool is_x = t.axis == 0u;
    bool is_y = t.axis == 1u;
    t.u = is_x ? y : (is_y ? z : x);
    t.v = is_x ? z : (is_y ? x : y);
    t.w = is_x ? x : (is_y ? y : z);
    EDGE_IVEC3 m = is_x ? n.yzx : (is_y ? n.zxy : n);
    t.low = is_x ? low.yzx : (is_y ? low.zxy : low);
    t.high = is_x ? high.yzx : (is_y ? high.zxy : high);
    t.s_u = m.x < 0 ? EDGE_INT(-1) : EDGE_INT(1);
    t.s_v = m.y < 0 ? EDGE_INT(-1) : EDGE_INT(1);
    t.s_w = m.z < 0 ? EDGE_INT(-1) : EDGE_INT(1);
    t.n_u = m.x * t.s_w;
    t.n_v = m.y * t.s_w;
    t.n_w = m.z * t.s_w;
    t.du = EDGE_IVEC3(t.u.yzx - t.u) * EDGE_INT(kVoxelLattice);
    t.dv = EDGE_IVEC3(t.v.yzx - t.v) * EDGE_INT(kVoxelLattice);
    t.dw = EDGE_IVEC3(t.w.yzx - t.w) * EDGE_INT(kVoxelLattice);
    t.layer_top = m.x == 0 && m.y == 0 ? resolution - 1 : kLatticeLimit;
    return t;
}

// floor(numerator / n_w) of the division that decides a column's layer, numerator being
//   (w_0 n_w - n_u (c_u - u_0) - n_v (c_v - v_0) + addend) / 256
// with (c_u, c_v) the centre of column. Products with the low byte of a factor are kept apart so that dividing by 256
// is exact; the quotient is estimated in floating point and corrected by the exact (wrapping) remainder.
int columnLayer(RasterTriangle t, ivec2 column, EDGE_INT addend_high, int addend_low, out EDGE_INT rest)
{
    EDGE_INT to_u = EDGE_INT(column.x * kVoxelLattice + kVoxelLattice / 2 - t.u.x);
    EDGE_INT to_v = EDGE_INT(column.y * kVoxelLattice + kVoxelLattice / 2 - t.v.x);
    EDGE_INT to_w = EDGE_INT(t.w.x);
    EDGE_INT low_byte = EDGE_INT(kVoxelLattice - 1);
    EDGE_INT low_u = to_u & low_byte;
    EDGE_INT low_v = to_v & low_byte;
    EDGE_INT low_w = to_w & low_byte;
    EDGE_INT high = (to_w >> kVoxelLatticeLog2) * t.n_w - (to_u >> kVoxelLatticeLog2) * t.n_u -
                    (to_v >> kVoxelLatticeLog2) * t.n_v;
    EDGE_INT middle = low_w * (t.n_w >> kVoxelLatticeLog2) - low_u * (t.n_u >> kVoxelLatticeLog2) -
                      low_v * (t.n_v >> kVoxelLatticeLog2);
    EDGE_INT low = low_w * (t.n_w & low_byte) - low_u * (t.n_u & low_byte) - low_v * (t.n_v & low_byte);
    EDGE_INT numerator = high + middle + addend_high + ((low + EDGE_INT(addend_low)) >> kVoxelLatticeLog2);

    float inverse = 1.0 / float(t.n_w);
    float height = float(t.w.x) - (float(t.n_u) * inverse) * float(to_u) - (float(t.n_v) * inverse) * float(to_v) +
                   float(addend_high) * inverse * float(kVoxelLattice);
    int layer = int(floor(height / float(kVoxelLattice)));
    rest = numerator - EDGE_INT(layer) * t.n_w;
    for (int i = 0; i < 4; ++i) // the estimate is at most a few layers off
    {
        int fix = rest < 0 ? -1 : (rest >= t.n_w ? 1 : 0);
        layer += fix;
        rest -= EDGE_INT(fix) * t.n_w;
    }
    return layer;
}

// Where the first row block of a triangle begins, whose box begins at low: tiles are aligned to leaves.
ivec2 blockOrigin(ivec2 low)
{
    return kCoverage == kCoverageThin ? low & ~3 : low;
}

// The walk's state at the first layer of a column.
RasterCell startColumn(RasterTriangle t, ivec2 column)
{
    RasterCell cell;
    if (kCoverage == kCoverageThin)
    {
        cell.w = min(columnLayer(t, column, EDGE_INT(0), 0, cell.rest), t.layer_top);
        cell.w_high = cell.w;
        cell.rest_high = EDGE_INT(0);
    }
    else if (t.n_w == 0) // a segment or a point: every layer of its box is a candidate
    {
        cell.w = t.low.z;
        cell.w_high = t.high.z;
        cell.rest = EDGE_INT(0);
        cell.rest_high = EDGE_INT(0);
    }
    else
    {
        // The plane's range over the closed column is +-128 (|n_u| + |n_v|); the lower end excludes one unit, because
        // a plane that touches a layer's upper face covers that layer too.
        EDGE_INT spread = abs(t.n_u) + abs(t.n_v);
        EDGE_INT half_spread = spread >> 1;
        int odd = int(spread & EDGE_INT(1)) * (kVoxelLattice / 2);
        cell.w = columnLayer(t, column, -half_spread, -odd - 1, cell.rest);
        cell.w_high = columnLayer(t, column, half_spread, odd, cell.rest_high);
    }
    EDGE_IVEC3 to_u = EDGE_IVEC3(column.x * kVoxelLattice + kVoxelLattice / 2 - t.u);
    EDGE_IVEC3 to_v = EDGE_IVEC3(column.y * kVoxelLattice + kVoxelLattice / 2 - t.v);
    EDGE_IVEC3 to_w = EDGE_INT(cell.w) * EDGE_INT(kVoxelLattice) + EDGE_INT(kVoxelLattice / 2) - EDGE_IVEC3(t.w);
    EDGE_IVEC3 edge_u = t.du >> kVoxelLatticeLog2;
    EDGE_IVEC3 edge_v = t.dv >> kVoxelLatticeLog2;
    EDGE_IVEC3 edge_w = t.dw >> kVoxelLatticeLog2;
    cell.uv = (edge_u * to_v - edge_v * to_u) * t.s_w + edgeSupport(t.du, t.dv);
    cell.vw = (edge_v * to_w - edge_w * to_v) * t.s_u + edgeSupport(t.dv, t.dw);
    cell.wu = (edge_w * to_u - edge_u * to_w) * t.s_v + edgeSupport(t.dw, t.du);
    return cell;
}

// Moves the remainder of a division by n_w by step (|step| <= n_w) and returns how many layers the quotient moves.
int stepLayer(RasterTriangle t, EDGE_INT step, inout EDGE_INT rest)
{
    rest += step;
    int move = rest < 0 ? -1 : (rest >= t.n_w ? 1 : 0);
    rest -= EDGE_INT(move) * t.n_w;
    return move;
}

// Moves the edge functions by a number of layers.
void moveLayers(RasterTriangle t, int layers, inout RasterCell cell)
{
    cell.w += layers;
    cell.vw += t.dv * (t.s_u * EDGE_INT(layers));
    cell.wu -= t.du * (t.s_v * EDGE_INT(layers));
}

void stepPlane(RasterTriangle t, EDGE_INT step, inout RasterCell cell)
{
    if (t.n_w != 0)
    {
        moveLayers(t, stepLayer(t, step, cell.rest), cell);
        if (kCoverage == kCoverageConservative)
            cell.w_high += stepLayer(t, step, cell.rest_high);
    }
}

// To the first layer of the next column along u.
void nextColumn(RasterTriangle t, inout RasterCell cell)
{
    cell.uv -= t.dv * t.s_w;
    cell.wu += t.dw * t.s_v;
    stepPlane(t, -t.n_u, cell);
}

// To the first layer of the next column along v.
void nextRow(RasterTriangle t, inout RasterCell cell)
{
    cell.uv += t.du * t.s_w;
    cell.vw -= t.dw * t.s_u;
    stepPlane(t, -t.n_v, cell);
}

bool isCovered(RasterTriangle t, RasterCell cell)
{
    EDGE_IVEC3 least = min(cell.uv, min(cell.vw, cell.wu));
    return min(least.x, min(least.y, least.z)) >= 0 && cell.w >= t.low.z && cell.w <= t.high.z;
}

// Voxel coordinates from (u, v, w).
ivec3 voxelOf(RasterTriangle t, ivec2 column, int w)
{
    ivec3 cell = ivec3(column, w);
    return t.axis == 0u ? cell.zxy : (t.axis == 1u ? cell.yzx : cell);
}

// Barycentric edge functions at the column's centre: component i belongs to vertex i.
EDGE_IVEC3 cornerWeights(RasterTriangle t, RasterCell cell)
{
    return (cell.uv - edgeSupport(t.du, t.dv)).yzx;
}
