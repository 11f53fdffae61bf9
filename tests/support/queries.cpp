// SPDX-License-Identifier: MIT
#include "support/queries.h"

#include "core/query/query_list.h"
#include "oracle/morton.h"
#include "oracle/trace.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace zvo::test
{

namespace
{

class Picker
{
public:
    Picker(std::mt19937& random, const Grid& grid, const Codes& codes) : m_random(random), m_grid(grid), m_codes(codes)
    {
    }

    int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(m_random); }

    // Anywhere around the grid, in a voxel, near one, or at the faces of voxels.
    LatticePosition position()
    {
        const int edge = static_cast<int>(m_grid.resolution()) * kLatticeVoxel;
        const int kind = number(0, 9);
        const glm::ivec3 voxel(oracle::mortonDecode(m_codes[m_random() % m_codes.size()]));
        LatticePosition result{};
        for (int axis = 0; axis < 3; ++axis)
        {
            int& at = result.at(static_cast<std::size_t>(axis));
            at = kind < 3   ? number(-edge / 2, edge + edge / 2)
                 : kind < 5 ? voxel[axis] * kLatticeVoxel + number(0, kLatticeVoxel - 1)
                            : voxel[axis] * kLatticeVoxel + number(-2 * kLatticeVoxel, 3 * kLatticeVoxel);
            at = kind >= 7 ? (at & ~(kLatticeVoxel - 1)) + number(-1, 1) : at;
            at = kind == 9 ? at & ~(kLatticeVoxel - 1) : at;
        }
        if (number(0, 999) == 0)
        {
            result.at(m_random() % 3) = number(0, 1) == 0 ? INT32_MIN : gpu::kQueryReach + 1; // no such position
        }
        return result;
    }

    // A box from low on: most of up to a few voxels, some without an inside.
    LatticePosition high(const LatticePosition& low)
    {
        const int kind = number(0, 4);
        const int most = kind == 0 ? static_cast<int>(m_grid.resolution()) * kLatticeVoxel : 4 * kLatticeVoxel;
        LatticePosition result{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const int extent = kind == 1 ? kLatticeVoxel * number(1, 3) : number(1, most);
            result.at(axis) = low.at(axis) + (number(0, 199) == 0 ? 0 : extent);
        }
        return result;
    }

    LatticePosition motion()
    {
        const int kind = number(0, 5);
        const int most = static_cast<int>(m_grid.resolution()) * kLatticeVoxel >> number(0, 5);
        LatticePosition result{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const int along = number(-most, most);
            result.at(axis) = kind == 0   ? (number(0, 2) == 0 ? along : 0) // along axes
                              : kind == 1 ? (along & ~(kLatticeVoxel - 1))  // by whole voxels
                              : kind == 2 ? (along < 0 ? -most : most)      // along diagonals
                                          : along;
        }
        return result;
    }

    RayQuery ray()
    {
        RayQuery query;
        const LatticePosition from = position();
        const LatticePosition to = position();
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            const float unit = m_grid.voxel_size / kLatticeVoxel;
            query.origin.at(axis) = m_grid.origin[static_cast<int>(axis)] + unit * static_cast<float>(from.at(axis));
            query.direction.at(axis) = unit * (static_cast<float>(to.at(axis)) - static_cast<float>(from.at(axis)));
        }
        query.t_max = number(0, 3) == 0 ? 0.5F : query.t_max;
        return query;
    }

private:
    std::mt19937& m_random;
    const Grid& m_grid;
    const Codes& m_codes;
};

glm::ivec3 vectorOf(const LatticePosition& position)
{
    return {position[0], position[1], position[2]};
}

bool isAllowed(const LatticePosition& position)
{
    return std::ranges::all_of(position, [](int at) { return std::abs(std::int64_t{at}) <= 1 << 27; });
}

using Answer = std::optional<oracle::QueryAnswer>;

Answer ask(const oracle::VoxelSet& voxels, const PointQuery& query)
{
    return voxels.atPoint(vectorOf(query.position));
}

Answer ask(const oracle::VoxelSet& voxels, const BoxQuery& query)
{
    return isAllowed(query.low) && isAllowed(query.high) ? voxels.inBox(vectorOf(query.low), vectorOf(query.high))
                                                         : Answer();
}

Answer ask(const oracle::VoxelSet& voxels, const NearestQuery& query)
{
    return isAllowed(query.position) ? voxels.nearest(vectorOf(query.position), query.reach) : Answer();
}

Answer ask(const oracle::VoxelSet& voxels, const SweepQuery& query)
{
    return isAllowed(query.low) && isAllowed(query.high)
               ? voxels.onWay(vectorOf(query.low), vectorOf(query.high), vectorOf(query.motion))
               : Answer();
}

Answer ask(const oracle::VoxelSet& /*voxels*/, const RayQuery& /*query*/)
{
    return std::nullopt; // oracle::VoxelTracer knows
}

std::string text(const std::optional<oracle::QueryAnswer>& answer)
{
    return answer ? fmt::format("({}, {}, {}) face {} {} / {}", answer->cell.x, answer->cell.y, answer->cell.z,
                                answer->face, answer->numerator, answer->denominator)
                  : "nothing";
}

std::string rayDifference(const Grid& grid, const Codes& codes, std::span<const RayQuery> rays,
                          const std::vector<QueryAnswer>& answers, std::uint64_t* found)
{
    const oracle::VoxelTracer tracer(codes, grid.depth);
    const double edge = double{grid.voxel_size} * grid.rootResolution();
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
        glm::vec3 origin;
        glm::vec3 direction;
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto place = static_cast<std::size_t>(axis);
            origin[axis] = static_cast<float>(1 + (rays[i].origin.at(place) - double{grid.origin[axis]}) / edge);
            direction[axis] = static_cast<float>(rays[i].direction.at(place) / edge);
        }
        auto expected = tracer.trace(oracle::makeRay(origin, direction, gpu::kTraceTimeMin));
        expected = expected && expected->t <= rays[i].t_max ? expected : std::nullopt;
        const QueryAnswer& answer = answers[i];
        const glm::uvec3 cell(answer.cell[0], answer.cell[1], answer.cell[2]);
        if (expected.has_value() != (answer.state == QueryState::Found) ||
            (expected && (oracle::mortonEncode(cell) != expected->code || answer.face != expected->face ||
                          std::bit_cast<std::uint32_t>(answer.t) != std::bit_cast<std::uint32_t>(expected->t))))
        {
            return fmt::format("ray {}", i);
        }
        *found += expected ? 1 : 0;
    }
    return "";
}

} // namespace

QueryList Queries::list(QueryKind kind) const
{
    switch (kind)
    {
    case QueryKind::Point:
        return std::span(points);
    case QueryKind::Ray:
        return std::span(rays);
    case QueryKind::Box:
        return std::span(boxes);
    case QueryKind::Nearest:
        return std::span(nearest);
    case QueryKind::Sweep:
        break;
    }
    return std::span(sweeps);
}

Queries pickQueries(std::mt19937& random, const Grid& grid, const Codes& codes, std::size_t count)
{
    Picker picker(random, grid, codes);
    Queries queries;
    for (std::size_t i = 0; i < count; ++i)
    {
        queries.points.push_back({picker.position()});
        queries.rays.push_back(picker.ray());
        const LatticePosition low = picker.position();
        queries.boxes.push_back({low, picker.high(low)});
        queries.nearest.push_back({picker.position(), picker.number(0, 2) == 0
                                                          ? UINT32_MAX
                                                          : static_cast<std::uint32_t>(picker.number(
                                                                0, kLatticeVoxel << picker.number(0, 5)))});
        const LatticePosition from = picker.position();
        queries.sweeps.push_back({from, picker.high(from), picker.motion()});
    }
    return queries;
}

std::vector<std::optional<oracle::QueryAnswer>> expectedAnswers(const Codes& codes, const QueryList& queries)
{
    const oracle::VoxelSet voxels(codes);
    std::vector<std::optional<oracle::QueryAnswer>> answers;
    std::visit(
        [&](const auto& list)
        {
            for (const auto& query : list)
            {
                answers.push_back(ask(voxels, query));
            }
        },
        queries);
    return answers;
}

std::vector<QueryAnswer> askDevice(vk::HeadlessDevice& device, const DeviceTree& tree, const QueryList& queries,
                                   std::uint32_t* undecided, std::uint32_t iterations_max)
{
    QueryBuffers buffers(device, queries, tree.grid);
    device.run([&](vk::FrameGraph& graph) { answerQueries(graph, tree, buffers, iterations_max); });
    const std::uint32_t count = device.download(buffers.status).at(0).capped_rays;
    if (undecided != nullptr)
    {
        *undecided = count;
    }
    else
    {
        EXPECT_EQ(count, 0U);
    }
    std::vector<QueryAnswer> answers(buffers.count);
    readAnswers(QueriedTree(tree), queries, 0, device.download(buffers.hits), device.download(buffers.looks), answers);
    return answers;
}

std::string queryDifference(const Grid& grid, const Codes& codes, const QueryList& queries,
                            const std::vector<QueryAnswer>& answers, std::uint64_t* found)
{
    if (kindOf(queries) == QueryKind::Ray)
    {
        return rayDifference(grid, codes, std::get<std::span<const RayQuery>>(queries), answers, found);
    }
    const std::vector<std::optional<oracle::QueryAnswer>> expected = expectedAnswers(codes, queries);
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        const QueryAnswer& answer = answers[i];
        std::optional<oracle::QueryAnswer> actual;
        if (answer.state != QueryState::Nothing)
        {
            actual = {glm::ivec3(answer.cell[0], answer.cell[1], answer.cell[2]), answer.face, answer.numerator,
                      answer.denominator};
        }
        if (answer.state == QueryState::Undecided || actual != expected[i])
        {
            return fmt::format("kind {} number {}: {} instead of {}", queries.index(), i, text(actual),
                               text(expected[i]));
        }
        *found += actual ? 1 : 0;
    }
    return "";
}

} // namespace zvo::test
