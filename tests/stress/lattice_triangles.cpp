// SPDX-License-Identifier: MIT
#include "stress/lattice_triangles.h"

#include <algorithm>
#include <cmath>

namespace zvo::stress
{
namespace
{

constexpr int kLatticeMax = 1 << 29;
constexpr int kDepthMax = 16; // single precision holds all its lattice points, 24 bits each; deep_grid_test goes on

/// Where the points of a triangle may lie: low to high in lattice units, on all axes.
struct Room
{
    int low = 0;
    int high = 0;
};

/// The nearest point whose coordinates single precision holds: 24 bits each.
glm::ivec3 representable(const glm::ivec3& p)
{
    return glm::ivec3(glm::vec3(p));
}

class Maker
{
public:
    explicit Maker(std::uint64_t seed) : m_random(seed) {}

    std::uint64_t bits() { return m_random(); }
    int pick(int low, int high) // both included
    {
        const auto count = static_cast<std::uint64_t>(std::int64_t{high} - low + 1);
        return static_cast<int>(low + static_cast<std::int64_t>(m_random() % count));
    }
    bool oneIn(int count) { return pick(1, count) == 1; }
    double fraction() { return static_cast<double>(m_random() >> 11) * 0x1p-53; }
    /// Between low and high, as likely in each octave.
    int pickSize(int low, int high)
    {
        return static_cast<int>(low * std::exp2(fraction() * std::log2(static_cast<double>(high) / low)));
    }
    glm::ivec3 point(int low, int high) { return {pick(low, high), pick(low, high), pick(low, high)}; }

    LatticeTriangle triangle(Shape shape, const Room& room, int resolution)
    {
        switch (shape)
        {
        case Shape::Random:
            return random(room);
        case Shape::Sliver:
            return sliver(room);
        case Shape::Needle:
            return needle(room);
        case Shape::Tiny:
            return tiny(room);
        case Shape::Aligned:
            return aligned(room);
        case Shape::Degenerate:
            return degenerate(room);
        case Shape::Border:
            return border(resolution);
        case Shape::Huge:
            return huge(resolution, false);
        case Shape::Threshold:
            return threshold(room);
        }
        return {};
    }

    /// slim: covers a line of voxels only.
    LatticeTriangle huge(int resolution, bool slim)
    {
        // Somewhere in the triangle lies a point of the grid.
        const glm::dvec3 inside = glm::dvec3(point(0, resolution * 256));
        const double reach = std::exp2(14 + 14.5 * fraction());
        const auto direction = [&](double size)
        { return glm::dvec3(2 * fraction() - 1, 2 * fraction() - 1, 2 * fraction() - 1) * size; };
        glm::dvec3 a = direction(reach);
        glm::dvec3 b = slim ? a * (0.5 + fraction()) : direction(oneIn(3) ? std::exp2(14 + 14.5 * fraction()) : reach);
        if (slim)
            b = (oneIn(2) ? b : -b) + direction(std::exp2(1 + 8 * fraction()));
        const int axis = pick(0, 2);
        if (!slim && oneIn(4)) // almost or exactly parallel to an axis' planes
        {
            a[axis] = oneIn(2) ? 0 : a[axis] * 1e-6;
            b[axis] = oneIn(2) ? 0 : b[axis] * 1e-6;
        }
        LatticeTriangle triangle{};
        const glm::dvec3 corners[3] = {inside + a, inside + b, inside - (a + b) * fraction()};
        constexpr double kEnd = kLatticeMax;
        for (std::size_t i = 0; i < 3; ++i)
            triangle[i] = representable(glm::ivec3(glm::clamp(glm::round(corners[i]), -kEnd, kEnd)));
        if (!slim && oneIn(8))
            triangle[0][axis] = oneIn(2) ? kLatticeMax : -kLatticeMax;
        return triangle;
    }

private:
    /// A cube of this size or less in room.
    Room cube(const Room& room, int size, glm::ivec3& corner)
    {
        const int edge = std::min(size, room.high - room.low);
        corner = point(room.low, room.high - edge);
        return {0, edge};
    }

    LatticeTriangle random(const Room& room)
    {
        glm::ivec3 corner{};
        const Room local = cube(room, pickSize(16, room.high - room.low), corner);
        LatticeTriangle triangle{};
        for (glm::ivec3& p : triangle)
            p = corner + point(local.low, local.high);
        if (oneIn(8)) // flat
        {
            const int axis = pick(0, 2);
            for (glm::ivec3& p : triangle)
                p[axis] = triangle[0][axis];
        }
        return clamped(triangle, room);
    }

    LatticeTriangle sliver(const Room& room)
    {
        LatticeTriangle triangle = random(room);
        const glm::dvec3 along = glm::dvec3(triangle[1] - triangle[0]) * (1.2 * fraction() - 0.1);
        const int width = pick(0, 4);
        triangle[2] = triangle[0] + glm::ivec3(glm::round(along)) + point(-width, width);
        return shuffled(clamped(triangle, room));
    }

    LatticeTriangle needle(const Room& room)
    {
        LatticeTriangle triangle = random(room);
        const int width = pick(1, 6);
        triangle[2] = triangle[1] + point(-width, width);
        if (oneIn(4)) // along an axis
        {
            const int axis = pick(0, 2);
            for (int k = 0; k < 3; ++k)
                if (k != axis)
                    triangle[0][k] = triangle[1][k] + pick(-1, 1);
        }
        return shuffled(clamped(triangle, room));
    }

    LatticeTriangle tiny(const Room& room)
    {
        // Corners, middles of edges and faces, centres; and points of the diamonds in between.
        const int step = oneIn(3) ? 64 : 128;
        const glm::ivec3 place = point(room.low / step, room.high / step) * step;
        const int size = pickSize(1, 400);
        LatticeTriangle triangle{};
        for (glm::ivec3& p : triangle)
            p = place + point(-size, size);
        if (oneIn(3))
            triangle[0] = place;
        if (oneIn(3)) // parallel to a plane, its edges at 45 degrees
        {
            const int axis = pick(0, 2);
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            triangle[1] = triangle[2] = triangle[0];
            triangle[1][u] += size;
            triangle[2][v] += oneIn(2) ? size : -size;
            if (oneIn(2))
                triangle[2][axis] += pick(-1, 1);
        }
        return clamped(triangle, room);
    }

    LatticeTriangle aligned(const Room& room)
    {
        const int step = 256 >> pick(0, 3);
        const int reach = std::max(1, pickSize(1, (room.high - room.low) / step + 1));
        const glm::ivec3 centre = point(room.low / step, room.high / step);
        LatticeTriangle triangle{};
        for (glm::ivec3& p : triangle)
            p = (centre + point(-reach, reach)) * step;
        const int axis = pick(0, 2);
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        switch (pick(0, 4))
        {
        case 0: // in a plane of the lattice, perhaps a unit beside it
            for (glm::ivec3& p : triangle)
                p[axis] = triangle[0][axis];
            if (oneIn(3))
                for (glm::ivec3& p : triangle)
                    p[axis] += pick(0, 2) - 1;
            break;
        case 1: // at 45 degrees: two components of the normal are equal
            for (glm::ivec3& p : triangle)
                p[u] = triangle[0][u] + (p[v] - triangle[0][v]);
            break;
        case 2: // all three components are equal
            for (glm::ivec3& p : triangle)
                p[axis] = triangle[0][axis] - (p[u] - triangle[0][u]) + (triangle[0][v] - p[v]);
            break;
        case 3: // edges along diagonals of voxels
            for (std::size_t i = 1; i < 3; ++i)
                for (int k = 0; k < 3; ++k)
                    triangle[i][k] = triangle[0][k] + (pick(0, 2) - 1) * reach * step;
            break;
        default:
            break;
        }
        return clamped(triangle, room);
    }

    LatticeTriangle degenerate(const Room& room)
    {
        const int step = oneIn(2) ? 1 : 64 << pick(0, 2);
        const glm::ivec3 start = point(room.low / step, room.high / step) * step;
        const int size = pickSize(1, std::max(2, (room.high - room.low) / (8 * step)));
        glm::ivec3 along = point(-size, size) * step;
        if (oneIn(3)) // along an axis or a diagonal
            along = point(-1, 1) * size * step;
        if (oneIn(5))
            along = glm::ivec3(0);
        LatticeTriangle triangle = {start, start + along * pick(-4, 4), start + along * pick(-4, 4)};
        for (int k = 0; k < 3; ++k) // moved back as a whole: clamping would bend it
        {
            const auto [low, high] = std::minmax({triangle[0][k], triangle[1][k], triangle[2][k]});
            const int move = low < room.low ? room.low - low : std::min(0, room.high - high);
            for (glm::ivec3& p : triangle)
                p[k] += move;
        }
        return clamped(triangle, room);
    }

    LatticeTriangle border(int resolution)
    {
        const int end = resolution * 256;
        const auto coordinate = [&]
        {
            switch (pick(0, 5))
            {
            case 0:
                return pick(-2, 2);
            case 1:
                return end + pick(-2, 2);
            case 2:
                return pick(-end, 2 * end);
            case 3:
                return pick(-1, resolution + 1) * 256 + pick(-1, 1);
            default:
                return pick(0, end);
            }
        };
        LatticeTriangle triangle{};
        for (glm::ivec3& p : triangle)
            p = {coordinate(), coordinate(), coordinate()};
        const int axis = pick(0, 2);
        if (oneIn(3)) // in one of the grid's faces, or beside it
        {
            const int face = (oneIn(2) ? 0 : end) + (oneIn(2) ? 0 : pick(-1, 1));
            for (glm::ivec3& p : triangle)
                p[axis] = face;
        }
        if (oneIn(6)) // a slope that reaches a face at a column's centre
            triangle[0][axis] = end - 64 * pick(0, 8);
        return triangle;
    }

    /// A triangle whose box touches columns x rows voxels across its major axis.
    LatticeTriangle threshold(const Room& room)
    {
        static constexpr std::array<glm::ivec2, 18> kExtents{{{31, 1},
                                                              {32, 1},
                                                              {33, 1},
                                                              {16, 2},
                                                              {8, 4},
                                                              {11, 3},
                                                              {6, 5},
                                                              {7, 5},
                                                              {32, 7},
                                                              {33, 8},
                                                              {34, 9},
                                                              {255, 8},
                                                              {256, 7},
                                                              {257, 9},
                                                              {256, 16},
                                                              {258, 17},
                                                              {300, 1},
                                                              {64, 24}}};
        const int cells = (room.high - room.low) / 256;
        glm::ivec2 extent = kExtents[static_cast<std::size_t>(pick(0, kExtents.size() - 1))];
        while (std::max(extent.x, extent.y) > cells)
            extent = kExtents[static_cast<std::size_t>(pick(0, 9))];
        if (oneIn(2))
            std::swap(extent.x, extent.y);
        const auto size = [&](int columns) { return std::max(1, (columns - 1) * 256 + pick(-254, 254)); };
        glm::ivec2 edge = {size(extent.x), size(extent.y)};
        if (oneIn(3)) // the end of 32-bit arithmetic
            edge[pick(0, 1)] = std::min(8192 + pick(-1, 1), cells * 256);
        const int height = pick(0, std::min(edge.x, edge.y));
        const int axis = pick(0, 2);
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        glm::ivec3 corner{};
        corner[u] = pick(room.low, std::max(room.low, room.high - edge.x));
        corner[v] = pick(room.low, std::max(room.low, room.high - edge.y));
        corner[axis] = pick(room.low, std::max(room.low, room.high - height));
        LatticeTriangle triangle = {corner, corner, corner};
        triangle[1][u] += edge.x;
        triangle[1][axis] += pick(0, height);
        triangle[2][v] += edge.y;
        triangle[2][u] += pick(0, edge.x);
        triangle[2][axis] += height;
        if (oneIn(3))
            triangle[1][v] += edge.y;
        return shuffled(clamped(triangle, room));
    }

    LatticeTriangle shuffled(LatticeTriangle triangle)
    {
        std::swap(triangle[0], triangle[static_cast<std::size_t>(pick(0, 2))]);
        return triangle;
    }

    static LatticeTriangle clamped(LatticeTriangle triangle, const Room& room)
    {
        for (glm::ivec3& p : triangle)
            p = glm::clamp(p, glm::ivec3(room.low), glm::ivec3(room.high));
        return triangle;
    }

    std::mt19937_64 m_random;
};

/// One triangle a block of edge^3 voxels, in blocks drawn without repetition. A voxel's width is left free at each side
/// of a block, as closed voxels touch.
void fillBlocks(Maker& maker, Batch& batch, int block_log2, std::size_t count_max)
{
    const int axis_log2 = static_cast<int>(batch.depth) - block_log2;
    const std::uint64_t block_count = std::uint64_t{1} << (3 * axis_log2);
    const std::uint64_t start = maker.bits();
    const std::uint64_t stride = maker.bits() | 1;
    const Room room = {256, ((1 << block_log2) - 1) * 256};
    const std::uint64_t axis_mask = (std::uint64_t{1} << axis_log2) - 1;
    batch.disjoint = true;
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(block_count, count_max); ++i)
    {
        const std::uint64_t block = (start + i * stride) & (block_count - 1);
        const glm::ivec3 corner =
            glm::ivec3(static_cast<int>(block & axis_mask), static_cast<int>(block >> axis_log2 & axis_mask),
                       static_cast<int>(block >> (2 * axis_log2)))
            << (block_log2 + 8);
        LatticeTriangle triangle = maker.triangle(batch.shape, room, 1 << batch.depth);
        for (glm::ivec3& p : triangle)
            p = representable(p + corner);
        batch.triangles.push_back(triangle);
    }
}

/// Triangles on top of each other, across a grid of low resolution. expected_voxels: of one triangle, about.
void fillPile(Maker& maker, Batch& batch, std::size_t expected_voxels, std::size_t count_max)
{
    const int resolution = 1 << batch.depth;
    const std::size_t voxels = std::size_t{1} << (3 * batch.depth);
    // Few enough that each fragment shows in its voxel's colour; sometimes a handful, so that each shows in the set.
    std::size_t count = std::clamp<std::size_t>(6 * voxels / expected_voxels, 12, 4096);
    count = maker.oneIn(4) ? static_cast<std::size_t>(maker.pick(1, 4)) : count;
    const int margin = maker.oneIn(2) ? 0 : maker.pick(1, 512);
    const Room room = {-margin, resolution * 256 + margin};
    while (batch.triangles.size() < std::min(count, count_max))
        batch.triangles.push_back(maker.triangle(batch.shape, room, resolution));
}

/// Long needles and slivers beyond the grid on all sides, at high resolution.
void fillHugeLines(Maker& maker, Batch& batch, std::size_t count_max)
{
    const std::size_t count = std::clamp<std::size_t>((std::size_t{1} << 17) >> batch.depth, 4, 256);
    for (std::size_t i = 0; i < std::min(count_max, count); ++i)
        batch.triangles.push_back(maker.huge(1 << batch.depth, true));
}

std::uint32_t pickDepth(Maker& maker, int low, int high)
{
    return static_cast<std::uint32_t>(maker.pick(low, high));
}

} // namespace

const char* nameOf(Shape shape)
{
    static constexpr std::array<const char*, kShapeCount> kNames{
        "random", "sliver", "needle", "tiny", "aligned", "degenerate", "border", "huge", "threshold"};
    return kNames[static_cast<std::size_t>(shape)];
}

Batch makeBatch(std::uint64_t seed, Shape shape, std::uint64_t number, std::size_t count_max)
{
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL; // spreads the seeds
    Maker maker((seed * kGolden + static_cast<std::uint64_t>(shape)) * kGolden + number);
    Batch batch;
    batch.shape = shape;
    const bool pile = number % 3 == 0;
    switch (batch.shape)
    {
    case Shape::Border:
        batch.depth = pickDepth(maker, 1, 6);
        fillPile(maker, batch, std::size_t{1} << (2 * batch.depth), count_max);
        break;
    case Shape::Huge:
        batch.depth = number % 4 == 1 ? pickDepth(maker, 7, kDepthMax) : pickDepth(maker, 1, 6);
        if (number % 32 == 31) // many row blocks
        {
            batch.depth = pickDepth(maker, 8, 10);
            batch.triangles.push_back(maker.huge(1 << batch.depth, false));
        }
        else if (batch.depth <= 6)
            fillPile(maker, batch, std::size_t{2} << (2 * batch.depth), count_max);
        else
            fillHugeLines(maker, batch, count_max);
        break;
    case Shape::Threshold:
        batch.depth = maker.oneIn(4) ? kDepthMax : pickDepth(maker, 9, kDepthMax);
        fillBlocks(maker, batch, maker.oneIn(4) ? 9 : 6, std::min<std::size_t>(count_max, 2048));
        break;
    default:
        if (pile)
        {
            batch.depth = pickDepth(maker, 1, 6);
            fillPile(maker, batch, batch.shape == Shape::Tiny ? 4 : 4U << batch.depth, count_max);
        }
        else
        {
            // Blocks of 8^3 or 16^3 voxels hold small triangles, blocks of 64^3 and more also such that go by rows.
            const int block_log2 = maker.oneIn(12) ? 6 : maker.oneIn(3) ? 4 : 3;
            batch.depth = pickDepth(maker, std::max(7, block_log2 + 3), kDepthMax);
            fillBlocks(maker, batch, block_log2, std::min<std::size_t>(count_max, block_log2 == 6 ? 1024 : 16384));
        }
        break;
    }
    return batch;
}

oracle::Triangle exact(const LatticeTriangle& triangle)
{
    oracle::Triangle result;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            result[i][k] = triangle[i][static_cast<int>(k)];
    return result;
}

Scene latticeScene(std::span<const LatticeTriangle> triangles, std::span<const std::array<std::uint16_t, 3>> colors)
{
    Scene scene;
    scene.materials.emplace_back();
    Primitive& primitive = scene.primitives.emplace_back();
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
        const auto first = static_cast<std::uint32_t>(3 * i);
        primitive.triangles.emplace_back(first, first + 1, first + 2);
        for (const glm::ivec3& p : triangles[i])
        {
            primitive.positions.push_back(glm::vec3(p) / 256.0F);
            if (!colors.empty())
                primitive.colors.emplace_back(static_cast<float>(colors[i][0]) / 65535.0F,
                                              static_cast<float>(colors[i][1]) / 65535.0F,
                                              static_cast<float>(colors[i][2]) / 65535.0F, 1.0F);
        }
    }
    scene.instances.emplace_back();
    return scene;
}

PlacedScene makePlacedScene(std::uint64_t seed, std::uint64_t number)
{
    std::mt19937_64 random(seed * 1'000'003 + number);
    const auto uniform = [&](float low, float high)
    { return std::uniform_real_distribution<float>(low, high)(random); };
    const auto vector = [&](float reach)
    { return glm::vec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)); };

    PlacedScene placed;
    placed.grid.depth = 5 + static_cast<std::uint32_t>(random() % 4);
    placed.grid.voxel_size = std::exp2(uniform(-20.0F, 12.0F));
    const float edge = placed.grid.voxel_size * static_cast<float>(placed.grid.resolution());
    placed.grid.origin = vector(edge * std::exp2(uniform(-2.0F, 8.0F)));
    constexpr std::uint32_t kPlaces = 8;
    constexpr std::uint32_t kTrianglesPerPlace = 250;
    for (std::uint32_t place = 0; place < kPlaces; ++place)
    {
        std::vector<LatticeTriangle> triangles(kTrianglesPerPlace);
        std::vector<std::array<std::uint16_t, 3>> colors(kTrianglesPerPlace);
        for (std::array<std::uint16_t, 3>& color : colors)
            for (std::uint16_t& channel : color)
                channel = static_cast<std::uint16_t>(random() & 65535);
        Scene part = latticeScene(triangles, colors);
        std::vector<glm::vec3>& points = part.primitives[0].positions;
        for (std::size_t i = 0; i < points.size(); i += 3)
        {
            const glm::vec3 middle = vector(1.0F);
            const float size = std::exp2(uniform(-9.0F, -2.0F));
            for (std::size_t k = 0; k < 3; ++k)
                points[i + k] = middle + vector(size);
        }
        glm::mat4& transform = part.instances[0].transform;
        for (int column = 0; column < 3; ++column)
            transform[column] = glm::vec4(vector(edge * 0.3F), 0.0F);
        transform[3] = glm::vec4(placed.grid.origin + 0.5F * edge + vector(0.2F * edge), 1.0F);
        placed.scene.append(std::move(part));
    }
    return placed;
}

std::string toText(const LatticeTriangle& triangle)
{
    std::string text;
    for (const glm::ivec3& p : triangle)
        text += (text.empty() ? "(" : " (") + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                std::to_string(p.z) + ")";
    return text;
}

} // namespace zvo::stress
