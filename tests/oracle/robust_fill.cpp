// SPDX-License-Identifier: MIT
#include "oracle/robust_fill.h"

#include "oracle/winding.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace zvo::oracle
{
namespace
{

constexpr std::uint32_t kBrick = 16;
constexpr int kRounds = 4;

using Cell = std::array<std::uint32_t, 3>;

int signOf(int value)
{
    return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
}

/// A cube of cells around what the grid and its bricks need, by coordinates.
class Sides
{
public:
    Sides(std::span<const Triangle> triangles, const std::vector<bool>& on_surface, std::uint32_t resolution)
        : m_size(std::max(resolution, kBrick)), m_resolution(resolution), m_surface(count()), m_sides(count())
    {
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            addRays(triangles, axis);
        for (std::size_t i = 0; i < on_surface.size(); ++i)
            m_surface[numberOf(cellOf(i, resolution))] = on_surface[i];
        std::uint32_t root = kBrick;
        while (root < resolution)
            root *= 4;
        decide({0, 0, 0}, root);
    }

    [[nodiscard]] std::vector<std::int8_t> ofGrid() const
    {
        std::vector<std::int8_t> sides(std::size_t{m_resolution} * m_resolution * m_resolution);
        for (std::size_t i = 0; i < sides.size(); ++i)
            sides[i] = m_sides[numberOf(cellOf(i, m_resolution))];
        return sides;
    }

private:
    [[nodiscard]] std::size_t count() const { return std::size_t{m_size} * m_size * m_size; }
    [[nodiscard]] std::size_t numberOf(const Cell& cell) const
    {
        return cell[0] + std::size_t{m_size} * (cell[1] + std::size_t{m_size} * cell[2]);
    }
    static Cell cellOf(std::size_t number, std::uint32_t size)
    {
        return {static_cast<std::uint32_t>(number % size), static_cast<std::uint32_t>(number / size % size),
                static_cast<std::uint32_t>(number / size / size)};
    }

    /// Of each cell's rays ahead and behind along an axis, whether they have a winding number. Lines that meet an edge
    /// count as moved ahead along the axis but one, and less along the next one; windingNumbers() moves them back along
    /// x, and less ahead along y.
    void addRays(std::span<const Triangle> triangles, std::uint32_t axis)
    {
        const std::array<std::uint32_t, 3> from = {(axis + 2) % 3, (axis + 1) % 3, axis};
        std::vector<Triangle> turned;
        std::vector<std::vector<std::int16_t>> numbers;
        for (const bool back : {false, true})
        {
            turned.clear();
            for (const Triangle& triangle : triangles)
            {
                Triangle& result = turned.emplace_back();
                for (std::size_t corner = 0; corner < 3; ++corner)
                {
                    for (std::size_t i = 0; i < 3; ++i)
                    {
                        const bool mirrors = i == 0 || (i == 2 && back);
                        const Int128 at = triangle[corner][from[i]];
                        result[corner][i] = mirrors ? Int128{m_size} * kLatticeVoxel - at : at;
                    }
                }
            }
            numbers.push_back(windingNumbers(turned, m_size));
        }
        m_rays[axis].resize(count());
        for (std::size_t i = 0; i < count(); ++i)
        {
            const Cell cell = cellOf(i, m_size);
            const Cell place = {m_size - 1 - cell[from[0]], cell[from[1]], cell[axis]};
            const int behind = numbers[0][numberOf(place)] != 0 ? 1 : 0;
            const int ahead = numbers[1][numberOf({place[0], place[1], m_size - 1 - place[2]})] != 0 ? 1 : 0;
            m_rays[axis][i] = static_cast<std::int8_t>(behind + ahead);
        }
    }

    template <typename Visit> void forEach(const Cell& low, std::uint32_t size, const Visit& visit) const
    {
        const auto end = [&](std::size_t axis) { return std::min(low[axis] + size, m_size); };
        for (std::uint32_t z = low[2]; z < end(2); ++z)
            for (std::uint32_t y = low[1]; y < end(1); ++y)
                for (std::uint32_t x = low[0]; x < end(0); ++x)
                    visit(Cell{x, y, z});
    }

    void decide(const Cell& low, std::uint32_t size)
    {
        if (*std::max_element(low.begin(), low.end()) >= m_size)
            return;
        bool has_surface = false;
        forEach(low, size, [&](const Cell& cell) { has_surface = has_surface || m_surface[numberOf(cell)]; });
        if (!has_surface)
            decideWhole(low, size);
        else if (size == kBrick)
            decideBrick(low);
        else
            for (std::uint32_t child = 0; child < 64; ++child)
                decide(
                    {low[0] + child % 4 * size / 4, low[1] + child / 4 % 4 * size / 4, low[2] + child / 16 * size / 4},
                    size / 4);
    }

    /// The rays of the lines through the lowest brick decide, an axis having a vote.
    void decideWhole(const Cell& low, std::uint32_t size)
    {
        int votes = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            int rays = -static_cast<int>(kBrick * kBrick);
            forEach(low, kBrick,
                    [&](const Cell& cell) { rays += cell[axis] == low[axis] ? m_rays[axis][numberOf(cell)] : 0; });
            votes += signOf(rays);
        }
        forEach(low, size,
                [&](const Cell& cell) { m_sides[numberOf(cell)] = static_cast<std::int8_t>(signOf(votes)); });
    }

    void decideBrick(const Cell& low)
    {
        const auto votesOf = [&](std::size_t number)
        { return m_rays[0][number] + m_rays[1][number] + m_rays[2][number] - 3; };
        forEach(low, kBrick,
                [&](const Cell& cell)
                {
                    const std::size_t number = numberOf(cell);
                    m_sides[number] = static_cast<std::int8_t>(m_surface[number] ? 0 : signOf(votesOf(number)));
                });
        for (int round = 0; round < kRounds; ++round)
        {
            const std::vector<std::int8_t> before = m_sides;
            forEach(low, kBrick,
                    [&](const Cell& cell)
                    {
                        const std::size_t number = numberOf(cell);
                        int votes = votesOf(number);
                        for (std::size_t axis = 0; axis < 3; ++axis)
                        {
                            Cell next = cell;
                            ++next[axis];
                            votes += next[axis] < low[axis] + kBrick ? before[numberOf(next)] : 0;
                            next[axis] -= 2;
                            votes += cell[axis] > low[axis] ? before[numberOf(next)] : 0;
                        }
                        if (!m_surface[number] && votes != 0)
                            m_sides[number] = static_cast<std::int8_t>(signOf(votes));
                    });
        }
    }

    std::uint32_t m_size;
    std::uint32_t m_resolution;
    std::array<std::vector<std::int8_t>, 3> m_rays; // by axis
    std::vector<bool> m_surface;
    std::vector<std::int8_t> m_sides;
};

} // namespace

std::vector<std::int8_t> robustSides(std::span<const Triangle> triangles, const std::vector<bool>& on_surface,
                                     std::uint32_t resolution)
{
    return Sides(triangles, on_surface, resolution).ofGrid();
}

} // namespace zvo::oracle
