// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/tree_input.h"
#include "common/words.h"
#include "core/base/input_error.h"
#include "core/query/query_list.h"
#include "query_files.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::size_t kAtOnce = std::size_t{1} << 20; // questions

// Rounded down on both sides, so that a box which moves ends where its end is on the lattice.
LatticePosition motionFrom(const Grid& grid, const glm::dvec3& low, const glm::dvec3& motion)
{
    const LatticePosition from = latticePosition(grid, low);
    const LatticePosition to = latticePosition(grid, low + motion);
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

std::uint32_t reachIn(const Grid& grid, double reach)
{
    return static_cast<std::uint32_t>(
        std::min(reach * kLatticeVoxel / double{grid.voxel_size}, double{gpu::kNearestReach}));
}

Vec3 floatsFrom(std::span<const double> numbers)
{
    return {static_cast<float>(numbers[0]), static_cast<float>(numbers[1]), static_cast<float>(numbers[2])};
}

// Questions of one kind, by the numbers of each.
template <typename Query, typename Make>
std::vector<Query> made(std::span<const double> numbers, std::size_t of_one, const Make& make)
{
    std::vector<Query> queries;
    for (std::size_t first = 0; first < numbers.size(); first += of_one)
    {
        queries.push_back(make(numbers.subspan(first, of_one)));
    }
    return queries;
}

class Asker
{
public:
    Asker(vk::HeadlessDevice& device, const DeviceTree& tree) : m_device(device), m_tree(tree) {}

    [[nodiscard]] std::vector<QueryAnswer> ask(QueryKind kind, std::span<const double> numbers)
    {
        const Grid& grid = m_tree.grid;
        const std::size_t of_one = numbersOf(kind);
        const auto at = [&](std::span<const double> one, std::size_t first) {
            return latticePosition(grid, {one[first], one[first + 1], one[first + 2]});
        };
        switch (kind)
        {
        case QueryKind::Point:
            return answersOf(made<PointQuery>(numbers, of_one, [&](auto one) { return PointQuery{at(one, 0)}; }));
        case QueryKind::Ray:
            return answersOf(made<RayQuery>(numbers, of_one,
                                            [&](auto one)
                                            {
                                                return RayQuery{floatsFrom(one), static_cast<float>(one[6]),
                                                                floatsFrom(one.subspan(3)), static_cast<float>(one[7])};
                                            }));
        case QueryKind::Box:
            return answersOf(made<BoxQuery>(numbers, of_one,
                                            [&](auto one) {
                                                return BoxQuery{at(one, 0), at(one, 3)};
                                            }));
        case QueryKind::Nearest:
            return answersOf(made<NearestQuery>(numbers, of_one,
                                                [&](auto one) {
                                                    return NearestQuery{at(one, 0), reachIn(grid, one[3])};
                                                }));
        case QueryKind::Sweep:
            break;
        }
        return answersOf(made<SweepQuery>(numbers, of_one,
                                          [&](auto one) {
                                              return SweepQuery{
                                                  at(one, 0), at(one, 3),
                                                  motionFrom(grid, {one[0], one[1], one[2]}, {one[6], one[7], one[8]})};
                                          }));
    }

private:
    template <typename Query> std::vector<QueryAnswer> answersOf(const std::vector<Query>& queries)
    {
        const QueryList list = std::span(queries);
        QueryBuffers buffers(m_device, list, m_tree.grid);
        m_device.run([&](vk::FrameGraph& graph) { answerQueries(graph, m_tree, buffers); });
        std::vector<QueryAnswer> answers(queries.size());
        readAnswers(QueriedTree(m_tree), list, 0, m_device.download(buffers.hits), m_device.download(buffers.looks),
                    answers);
        return answers;
    }

    vk::HeadlessDevice& m_device;
    const DeviceTree& m_tree;
};

} // namespace

void query(const QueryOptions& options)
{
    if (!options.kind)
    {
        throw Error(ErrorCode::Usage, "what is asked is missing: say --points, --rays, --boxes, --nearest or --sweeps");
    }
    const std::vector<std::filesystem::path> inputs = {options.file, options.questions};
    checkPaths(options.output, inputs);
    Output output(options.output.path, options.output.overwrite);
    if (!isTreeFile(options.file))
    {
        throw inputError(options.file, "neither a .zvo nor a .vox file; zvo build makes .zvo files of scenes");
    }
    const QueryFormat from = options.format.value_or(queryFormatOf(options.questions));
    const QueryFormat to = options.format.value_or(queryFormatOf(options.output.path));
    const std::vector<double> numbers = readQueries(options.questions, from, *options.kind);
    const std::size_t of_one = numbersOf(*options.kind);
    Progress progress(2);
    progress.begin("loading");
    const std::shared_ptr<vk::HeadlessDevice> device = openDevice(options.device);
    const DeviceTree tree =
        uploadTree(*device, loadTree(
                                options.file, [&]() -> vk::HeadlessDevice& { return *device; }, false));
    progress.begin("asking");
    output.write(queryHeader(to));
    Asker asker(*device, tree);
    std::uint64_t found = 0;
    std::uint64_t undecided = 0;
    for (std::size_t first = 0; first < numbers.size(); first += kAtOnce * of_one)
    {
        const std::size_t end = std::min(numbers.size(), first + kAtOnce * of_one);
        const std::vector<QueryAnswer> answers =
            asker.ask(*options.kind, std::span(numbers).subspan(first, end - first));
        found += static_cast<std::uint64_t>(std::ranges::count(answers, QueryState::Found, &QueryAnswer::state));
        undecided +=
            static_cast<std::uint64_t>(std::ranges::count(answers, QueryState::Undecided, &QueryAnswer::state));
        writeAnswers(output, to, answers, tree.hasAttributes());
        progress.within(static_cast<double>(end) / static_cast<double>(numbers.size()));
    }
    checkValidation(*device);
    output.finish();
    if (undecided != 0)
    {
        talk(fmt::format("{} undecided: the walk through the tree took too long", counted(undecided, "question")));
    }
    tellRun(fmt::format("{}, {} of which found a voxel", counted(numbers.size() / of_one, "question"), found));
}

} // namespace zvo::cli
