// SPDX-License-Identifier: MIT
#include "bench/bench_queries.h"

#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "core/base/morton.h"
#include "core/query/query_list.h"
#include "runtime/trees.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kQueriesDepth = 9;
constexpr int kNear = 8;                                 // voxels beside a random one, where questions are asked
constexpr std::array<int, 3> kBody = {4, 8, 4};          // voxels: of boxes
constexpr std::uint32_t kNearReach = 16 * kLatticeVoxel; // of the nearest voxel, where it has a bound

struct QueriesRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::string kind;
    std::uint64_t found = 0;
    double octree_mqueries_per_s = 0;
    double dag_mqueries_per_s = 0;
};

// Questions around random voxels, of one kind after the other.
class QuestionMaker
{
public:
    QuestionMaker(const Grid& grid, const std::vector<std::uint64_t>& codes, std::uint32_t count)
        : m_grid(grid), m_codes(codes), m_count(count)
    {
    }

    template <typename Query, typename Make> std::vector<Query> make(const Make& make_one)
    {
        m_random.seed(1);
        std::vector<Query> queries(m_count);
        for (Query& query : queries)
        {
            query = make_one();
        }
        return queries;
    }

    std::vector<PointQuery> points()
    {
        return make<PointQuery>([&] { return PointQuery{position()}; });
    }

    std::vector<RayQuery> rays()
    {
        return make<RayQuery>(
            [&]
            {
                RayQuery query;
                const LatticePosition from = position();
                for (std::size_t axis = 0; axis < from.size(); ++axis)
                {
                    query.origin.at(axis) =
                        m_grid.origin[static_cast<int>(axis)] +
                        m_grid.voxel_size * static_cast<float>(from.at(axis)) / static_cast<float>(kLatticeVoxel);
                    query.direction.at(axis) = static_cast<float>(offset());
                }
                return query;
            });
    }

    std::vector<BoxQuery> boxes()
    {
        return make<BoxQuery>(
            [&]
            {
                const LatticePosition low = position();
                return BoxQuery{low, above(low)};
            });
    }

    std::vector<NearestQuery> nearest(std::uint32_t reach)
    {
        return make<NearestQuery>([&] { return NearestQuery{position(), reach}; });
    }

    std::vector<SweepQuery> sweeps()
    {
        return make<SweepQuery>(
            [&]
            {
                const LatticePosition low = position();
                return SweepQuery{low, above(low), {offset(), offset(), offset()}};
            });
    }

private:
    std::int32_t offset()
    {
        return std::uniform_int_distribution<std::int32_t>(-kNear * kLatticeVoxel, kNear * kLatticeVoxel)(m_random);
    }

    LatticePosition position()
    {
        const glm::uvec3 cell = cellOfCode(m_codes[m_random() % m_codes.size()]);
        LatticePosition result{};
        for (std::size_t axis = 0; axis < result.size(); ++axis)
        {
            result.at(axis) = static_cast<std::int32_t>(cell[static_cast<int>(axis)]) * kLatticeVoxel + offset();
        }
        return result;
    }

    static LatticePosition above(const LatticePosition& low)
    {
        return {low[0] + kBody[0] * kLatticeVoxel, low[1] + kBody[1] * kLatticeVoxel,
                low[2] + kBody[2] * kLatticeVoxel};
    }

    const Grid& m_grid;
    const std::vector<std::uint64_t>& m_codes;
    std::uint32_t m_count;
    std::mt19937 m_random;
};

// Million questions a second: the median, of all passes but those that read attributes.
double rateOf(vk::HeadlessDevice& device, const DeviceTree& tree, QueryBuffers& buffers, std::uint32_t run_count)
{
    const auto ask = [&]
    {
        double ms = 0;
        for (const vk::PassTime& pass : device.run([&](vk::FrameGraph& graph) { answerQueries(graph, tree, buffers); }))
        {
            ms += pass.name == "query/find" || pass.name == "trace/rays" ? pass.ms : 0.0;
        }
        return ms;
    };
    warmUp(device, ask);
    std::vector<double> times;
    for (std::uint32_t run = 0; run < run_count; ++run)
    {
        times.push_back(ask());
    }
    return static_cast<double>(buffers.count) / (Spread::of(times).median * 1e3);
}

std::vector<QueriesRow> measure(vk::HeadlessDevice& device, const BenchQueriesOptions& options, const std::string& name,
                                const DeviceTree& octree, const DeviceTree& dag)
{
    const std::vector<std::uint64_t> codes = voxelCodes(device, octree);
    std::vector<QueriesRow> rows;
    if (codes.empty())
    {
        return rows;
    }
    QuestionMaker maker(octree.grid, codes, options.count);
    const auto add = [&](const char* kind, const auto& queries)
    {
        const QueryList list = std::span(queries);
        QueryBuffers buffers(device, list, octree.grid);
        QueriesRow row{name, octree.grid.resolution(), kind};
        row.octree_mqueries_per_s = rateOf(device, octree, buffers, options.run_count);
        for (const gpu::Hit& hit : device.download(buffers.hits))
        {
            row.found += hit.index < gpu::kHitUnfinished ? 1 : 0;
        }
        row.dag_mqueries_per_s = rateOf(device, dag, buffers, options.run_count);
        rows.push_back(std::move(row));
    };
    add("point", maker.points());
    add("ray", maker.rays());
    add("box", maker.boxes());
    add("nearest", maker.nearest(UINT32_MAX));
    add("nearest within 16", maker.nearest(kNearReach));
    add("sweep", maker.sweeps());
    return rows;
}

const Columns<QueriesRow>& queryColumns(std::uint32_t count)
{
    static const Columns<QueriesRow> all = {
        {"scene", 12, [](const QueriesRow& row) { return row.scene; }},
        {"resolution", 10, [](const QueriesRow& row) { return fmt::format("{}", row.resolution); }},
        {"question", 17, [](const QueriesRow& row) { return row.kind; }},
        {"found %", 7,
         [count](const QueriesRow& row)
         { return fmt::format("{:.0f}", 100.0 * static_cast<double>(row.found) / count); }},
        {"octree", 7, [](const QueriesRow& row) { return fmt::format("{:.2f}", row.octree_mqueries_per_s); }},
        {"DAG", 7, [](const QueriesRow& row) { return fmt::format("{:.2f}", row.dag_mqueries_per_s); }},
    };
    return all;
}

std::string tableText(const vk::DeviceReport& device, const BenchQueriesOptions& options,
                      const std::vector<QueriesRow>& rows)
{
    std::string text = fmt::format(
        "zvo {} on {} ({}, {}). Questions around random voxels, million a second: median of {} runs of {}. Boxes of "
        "{}x{}x{} voxels, which move by up to {} along each axis.\n\n{}",
        ZVO_VERSION_TEXT, device.name, device.type, device.driver, options.run_count, options.count, kBody[0], kBody[1],
        kBody[2], kNear, columnNames(queryColumns(options.count)));
    for (const QueriesRow& row : rows)
    {
        text += columnValues(queryColumns(options.count), row);
    }
    return text;
}

Json queriesJson(const vk::DeviceReport& device, const BenchQueriesOptions& options,
                 const std::vector<QueriesRow>& rows)
{
    Json json = headJson("zvo.bench_queries/1", device);
    json["runs"] = options.run_count;
    json["count"] = options.count;
    json["rows"] = Json::array();
    for (const QueriesRow& row : rows)
    {
        json["rows"].push_back({{"scene", row.scene},
                                {"resolution", row.resolution},
                                {"question", row.kind},
                                {"found", row.found},
                                {"octree_mqueries_per_s", row.octree_mqueries_per_s},
                                {"dag_mqueries_per_s", row.dag_mqueries_per_s}});
    }
    return json;
}

} // namespace

void benchQueries(const BenchQueriesOptions& options)
{
    const std::vector<std::filesystem::path> paths = benchScenes(options);
    const std::vector<std::uint32_t> depths = options.depths.value_or(std::vector{kQueriesDepth});
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::vector<QueriesRow> rows;
    Progress progress(paths.size() * depths.size());
    for (const std::filesystem::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        for (const std::uint32_t depth : depths)
        {
            const std::string name = path.stem().string();
            const Grid grid = Grid::around(scene.bounds(), depth);
            progress.begin(fmt::format("{} at {}", name, grid.resolution()));
            const DeviceTree octree = buildOctree(device, uploadScene(device, scene, options.attributes), grid,
                                                  {options.coverage, options.attributes, {}})
                                          .octree;
            const DeviceTree dag = compress(device, uploadTree(device, downloadTree(device, octree))).dag;
            const std::vector<QueriesRow> more = measure(device, options, name, octree, dag);
            rows.insert(rows.end(), more.begin(), more.end());
        }
    }
    clearProgressBar();
    if (options.output.json != "-")
    {
        Output("-", true).write(tableText(device.device().report(), options, rows));
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, queriesJson(device.device().report(), options, rows));
    }
}

} // namespace zvo::cli
