// SPDX-License-Identifier: MIT
#include "core/query/query_list.h"

#include "core/trace/trace_passes.h"
#include "core/trace/trace_ranks.h"
#include "core/tree/normal.h"
#include "core/tree/rgb9e5.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace zvo
{

namespace
{

// Questions as the device takes them.
static_assert(sizeof(PointQuery) == 3 * sizeof(gpu::uint) && sizeof(BoxQuery) == 6 * sizeof(gpu::uint) &&
              sizeof(NearestQuery) == 4 * sizeof(gpu::uint) && sizeof(SweepQuery) == 9 * sizeof(gpu::uint));

std::span<const gpu::uint> numbersOf(const QueryList& queries)
{
    return std::visit(
        [](const auto& list) -> std::span<const gpu::uint> {
            return {reinterpret_cast<const gpu::uint*>(list.data()), list.size_bytes() / sizeof(gpu::uint)};
        },
        queries);
}

// A ray in the unit space of a grid (shaders/shared/trace.h), whose small components of the direction are replaced as
// by lib/ray.glsl.
gpu::Ray unitRay(const Grid& grid, const RayQuery& query)
{
    constexpr float kDirectionMin = 1e-20F;
    const double edge = double{grid.voxel_size} * grid.rootResolution();
    gpu::Ray ray{};
    for (int axis = 0; axis < 3; ++axis)
    {
        const double origin = query.origin.at(static_cast<std::size_t>(axis));
        const auto along = static_cast<float>(query.direction.at(static_cast<std::size_t>(axis)) / edge);
        ray.origin[axis] = static_cast<float>(1.0 + (origin - double{grid.origin[axis]}) / edge);
        ray.inverse_direction[axis] =
            1.0F / (std::abs(along) < kDirectionMin ? std::copysign(kDirectionMin, along) : along);
    }
    ray.t_min = query.t_min;
    ray.t_max = query.t_max;
    return ray;
}

void findAll(vk::FrameGraph& graph, const DeviceTree& tree, QueryBuffers& buffers, const TraceOptions& options)
{
    vk::Pass pass = graph.addPass(traversing(gpu::query::Find{.kind = buffers.kind}, tree, options));
    gpu::FindParams params{};
    params.nodes = pass.read(tree.nodes);
    params.leaf_groups = pass.read(tree.leaf_groups);
    params.numbers = pass.read(buffers.numbers);
    params.hits = pass.write(buffers.hits);
    params.status = pass.readWrite(buffers.status);
    params.query_count = buffers.count;
    pass.dispatch(buffers.count, params);
    if (tree.isDag() && tree.hasAttributes())
    {
        rankHits(graph, tree, options, buffers.hits, buffers.count, nullptr);
    }
}

void lookAll(vk::FrameGraph& graph, const DeviceTree& tree, QueryBuffers& buffers)
{
    vk::Pass pass = graph.addPass(gpu::query::Look{.format = tree.attributeFormat()});
    gpu::LookParams params{};
    params.hits = pass.read(buffers.hits);
    params.attributes = isPacked(tree.attributeFormat())
                            ? gpu::ConstPtr<gpu::Attribute>{pass.read(tree.packed.voxels).address}
                            : pass.read(tree.voxel_attributes);
    params.nodes = isPacked(tree.attributeFormat())
                       ? gpu::ConstPtr<gpu::Attribute>{pass.read(tree.packed.nodes).address}
                       : pass.read(tree.node_attributes);
    params.emission_words = pass.read(tree.emission_words);
    params.emission = pass.read(tree.emission);
    params.looks = pass.write(buffers.looks);
    params.hit_count = buffers.count;
    pass.dispatch(buffers.count, params);
}

std::array<std::uint32_t, 3> cellOf(const gpu::Hit& hit)
{
    const std::uint64_t where = hit.where.x | std::uint64_t{hit.where.y} << 32;
    const std::uint64_t most = (std::uint64_t{1} << gpu::kHitCoordinateBits) - 1;
    return {static_cast<std::uint32_t>(where & most),
            static_cast<std::uint32_t>(where >> gpu::kHitCoordinateBits & most),
            static_cast<std::uint32_t>(where >> 2 * gpu::kHitCoordinateBits & most)};
}

// The numbers of an answer that are computed from the question and the voxel.
void measure(const QueriedTree& /*tree*/, const PointQuery& /*query*/, QueryAnswer& /*answer*/) {}
void measure(const QueriedTree& /*tree*/, const BoxQuery& /*query*/, QueryAnswer& /*answer*/) {}
void measure(const QueriedTree& /*tree*/, const RayQuery& /*query*/, QueryAnswer& /*answer*/) {}

void measure(const QueriedTree& tree, const NearestQuery& query, QueryAnswer& answer)
{
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        const std::int64_t low = std::int64_t{answer.cell.at(axis)} * kLatticeVoxel;
        const std::int64_t at = query.position.at(axis);
        const std::int64_t apart = std::max({low - at, at - (low + kLatticeVoxel), std::int64_t{0}});
        answer.numerator += apart * apart;
    }
    const double voxels = std::sqrt(static_cast<double>(answer.numerator)) / kLatticeVoxel;
    answer.t = static_cast<float>(voxels * double{tree.grid.voxel_size});
}

void measure(const QueriedTree& /*tree*/, const SweepQuery& query, QueryAnswer& answer)
{
    if (answer.face != kQueryInside)
    {
        const std::int64_t low = std::int64_t{answer.cell.at(answer.face)} * kLatticeVoxel;
        const std::int64_t motion = query.motion.at(answer.face);
        answer.numerator =
            motion < 0 ? query.low.at(answer.face) - (low + kLatticeVoxel) : low - query.high.at(answer.face);
        answer.denominator = std::abs(motion);
    }
    answer.t = static_cast<float>(static_cast<double>(answer.numerator) / static_cast<double>(answer.denominator));
}

Vec3 arrayOf(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

} // namespace

std::size_t sizeOf(const QueryList& queries)
{
    return std::visit([](const auto& list) { return list.size(); }, queries);
}

QueryBuffers::QueryBuffers(vk::Uploader& uploader, const QueryList& queries, const Grid& grid)
    : kind(kindOf(queries)), count(static_cast<std::uint32_t>(sizeOf(queries))),
      hits(uploader.device(), "query hits", count), looks(uploader.device(), "query looks", count),
      status(uploader.device(), "query status", 1)
{
    if (kind == QueryKind::Ray)
    {
        std::vector<gpu::Ray> unit_rays(count);
        std::ranges::transform(std::get<std::span<const RayQuery>>(queries), unit_rays.begin(),
                               [&](const RayQuery& query) { return unitRay(grid, query); });
        rounds = {uploader.device(), "query rounds", gpu::kTraceRoundsMax};
        rays = uploader.makeBuffer<gpu::Ray>("query rays", unit_rays);
        return;
    }
    numbers = uploader.makeBuffer("queries", numbersOf(queries));
}

void answerQueries(vk::FrameGraph& graph, const DeviceTree& tree, QueryBuffers& buffers, std::uint32_t iterations_max)
{
    TraceOptions options;
    options.iterations_max = iterations_max;
    graph.fill(buffers.status, 0);
    if (isEmpty(tree))
    {
        graph.fill(buffers.hits, gpu::kHitMiss);
        return;
    }
    if (buffers.kind == QueryKind::Ray)
    {
        traceRays(graph, tree, buffers.rays, buffers.hits, buffers.rounds, buffers.status, options);
    }
    else
    {
        findAll(graph, tree, buffers, options);
    }
    if (tree.hasAttributes())
    {
        lookAll(graph, tree, buffers);
    }
}

void readAnswers(const QueriedTree& tree, const QueryList& queries, std::size_t first, std::span<const gpu::Hit> hits,
                 std::span<const gpu::QueryLook> looks, std::span<QueryAnswer> answers)
{
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
        const gpu::Hit& hit = hits[i];
        QueryAnswer& answer = answers[i];
        answer = {};
        if (hit.index >= gpu::kHitUnfinished)
        {
            answer.state = hit.index == gpu::kHitMiss ? QueryState::Nothing : QueryState::Undecided;
            continue;
        }
        answer.state = QueryState::Found;
        answer.cell = cellOf(hit);
        answer.face = hit.where.y >> (gpu::kHitFaceShift - 32) & 3U;
        answer.t = kindOf(queries) == QueryKind::Ray ? hit.t : 0.0F;
        answer.denominator = 1;
        std::visit([&](const auto& list) { measure(tree, list[first + i], answer); }, queries);
        if (tree.has_attributes)
        {
            constexpr std::uint32_t kColorBits = 0xFFFFFF;
            answer.color = looks[i].stored.color & kColorBits;
            answer.normal = arrayOf(decodeNormal(looks[i].stored.normal));
            answer.emission = arrayOf(tree.emission_scale * decodeRgb9e5(looks[i].emission));
            answer.index = hit.index;
        }
    }
}

LatticePosition latticePosition(const Grid& grid, const glm::dvec3& world)
{
    constexpr double kBeyond = gpu::kQueryReach + 1.0;
    LatticePosition position{};
    for (int axis = 0; axis < 3; ++axis)
    {
        const double at =
            std::floor((world[axis] - double{grid.origin[axis]}) * kLatticeVoxel / double{grid.voxel_size});
        position.at(static_cast<std::size_t>(axis)) =
            static_cast<std::int32_t>(at <= kBeyond ? std::max(at, -kBeyond) : kBeyond); // NaN is beyond
    }
    return position;
}

} // namespace zvo
