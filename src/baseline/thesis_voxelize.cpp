// SPDX-License-Identifier: MIT
#include "baseline/thesis_voxelize.h"

#include "baseline/pointer_tree.h"
#include "core/base/divide_up.h"
#include "voxelize/window.h"

#include <iterator>

namespace zvo::baseline
{

namespace
{

// A thread has an iteration for each cell, column and fragment, and a subgroup of 16 threads at most as many as all of
// them: together below 65,535.
constexpr std::uint32_t kCellsPerPartOnCpus = 1300;
constexpr std::uint32_t kCellsPerPartOnGpus = 1U << 31; // more than a grid of dense cells has

std::uint64_t cellCount(const Grid& grid)
{
    return std::uint64_t{1} << (3 * grid.depth);
}

float latticeScale(const Grid& grid)
{
    return static_cast<float>(gpu::kVoxelLattice / static_cast<double>(grid.voxel_size));
}

void setUpChunks(vk::FrameGraph& graph, const ThesisJob& job, const vk::BufferOf<gpu::Chunk>& chunks,
                 std::uint32_t chunk_triangles, std::uint64_t first)
{
    if (chunks.count() == 0)
    {
        return;
    }
    vk::Pass pass = graph.addPass(gpu::baseline::ThesisSetup{.coverage = job.coverage});
    gpu::ThesisSetupParams params{};
    params.scene = job.scene.read(pass);
    params.chunks = pass.read(chunks);
    params.triangles = pass.accumulate(job.triangles.triangles); // each element once
    params.big = pass.accumulate(job.triangles.big);
    params.counters = pass.accumulate(job.triangles.counters);
    params.origin = job.grid.origin;
    params.lattice_scale = latticeScale(job.grid);
    params.window = gpu::packWindow(job.grid.depth, job.grid.depth, glm::uvec3(0U));
    params.chunk_count = static_cast<std::uint32_t>(chunks.count());
    params.chunk_triangles = chunk_triangles;
    params.first_triangle = static_cast<std::uint32_t>(first);
    params.cells_per_part = job.triangles.cells_per_part;
    pass.dispatch(chunks.count() * chunk_triangles, params);
}

// Records the pass over the boxes of a material class, or with listed over kThesisParts parts, from first_part on, of
// those that are listed. declare: sets the buffers of the target.
template <typename Declare>
void walkParts(vk::FrameGraph& graph, const ThesisJob& job, ThesisTarget target, MaterialClass material_class,
               std::uint32_t first_part, bool listed, const Declare& declare)
{
    const ThesisTriangles::Range range = job.triangles.ranges[static_cast<std::size_t>(material_class)];
    vk::Pass pass = graph.addPass(gpu::baseline::ThesisVoxelize{.coverage = job.coverage,
                                                                .material_class = material_class,
                                                                .target = static_cast<std::uint32_t>(target),
                                                                .bounds = job.bounds});
    gpu::ThesisVoxelizeParams params{};
    params.scene = job.scene.read(pass);
    readColorTables(pass, job.scene.uploaded());
    params.triangles = pass.read(job.triangles.triangles);
    params.big = pass.read(job.triangles.big);
    params.counters = pass.accumulate(job.triangles.counters);
    declare(pass, params);
    params.origin = job.grid.origin;
    params.lattice_scale = latticeScale(job.grid);
    params.window = gpu::packWindow(job.grid.depth, job.grid.depth, glm::uvec3(0U));
    params.first_triangle = static_cast<std::uint32_t>(range.first);
    params.triangle_count = static_cast<std::uint32_t>(range.count);
    params.big_count = listed ? job.triangles.big_count : 0;
    params.first_part = first_part;
    params.cells_per_part = job.triangles.cells_per_part;
    pass.dispatch(listed ? std::uint64_t{params.big_count} * gpu::kThesisParts : range.count, params);
}

// Records all of these passes.
template <typename Declare>
void walkAll(vk::FrameGraph& graph, const ThesisJob& job, ThesisTarget target, const Declare& declare)
{
    for (const MaterialClass material_class : kMaterialClasses)
    {
        if (job.triangles.ranges[static_cast<std::size_t>(material_class)].count != 0)
        {
            walkParts(graph, job, target, material_class, 0, false, declare);
            for (std::uint32_t part = 1; part < job.triangles.part_count; part += gpu::kThesisParts)
            {
                walkParts(graph, job, target, material_class, part, true, declare);
            }
        }
    }
}

// Sets up, and learns in how many parts the boxes are walked.
std::vector<vk::PassTime> setUpAndWait(vk::HeadlessDevice& device, const ThesisJob& job)
{
    std::vector<vk::PassTime> passes = device.run([&](vk::FrameGraph& graph) { setUpTriangles(graph, job); });
    const gpu::ThesisCounters counters = device.download(job.triangles.counters).front();
    job.triangles.part_count = counters.part_count;
    job.triangles.big_count = counters.big_count;
    return passes;
}

void appendTimes(std::vector<vk::PassTime> more, std::vector<vk::PassTime>& passes)
{
    passes.insert(passes.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

} // namespace

std::uint32_t ThesisTriangles::cellsPerPartOn(const vk::Device& device)
{
    return device.report().type == "cpu" ? kCellsPerPartOnCpus : kCellsPerPartOnGpus;
}

ThesisTriangles::ThesisTriangles(vk::Device& device, const GpuScene& scene)
    : counters(device, "baseline/thesis_counters", 1), cells_per_part(cellsPerPartOn(device))
{
    std::uint64_t count = 0;
    for (const MaterialClass material_class : kMaterialClasses)
    {
        const TriangleChunks& chunks = scene.chunksOf(material_class);
        const std::uint64_t own = chunks.whole.count() * gpu::kChunkTriangles + chunks.single.count();
        ranges[static_cast<std::size_t>(material_class)] = {count, own};
        count += own;
    }
    triangles = {device, "baseline/thesis_triangles", count};
    big = {device, "baseline/thesis_big_triangles", count};
}

ThesisCells::ThesisCells(vk::Device& device, const Grid& cells_grid, bool with_sums) : grid(cells_grid)
{
    requireDepth(grid, gpu::kThesisDepthMax, "the thesis's voxelization, with 8^depth dense cells,");
    voxels = {device, "baseline/thesis_voxels", cellCount(grid)};
    if (with_sums)
    {
        sums = {device, "baseline/thesis_sums", cellCount(grid)};
    }
}

void setUpTriangles(vk::FrameGraph& graph, const ThesisJob& job)
{
    graph.fill(job.triangles.counters, 0);
    for (const MaterialClass material_class : kMaterialClasses)
    {
        const TriangleChunks& chunks = job.scene.uploaded().chunksOf(material_class);
        const std::uint64_t first = job.triangles.ranges[static_cast<std::size_t>(material_class)].first;
        setUpChunks(graph, job, chunks.whole, gpu::kChunkTriangles, first);
        setUpChunks(graph, job, chunks.single, 1, first + chunks.whole.count() * gpu::kChunkTriangles);
    }
}

void walkTriangles(vk::FrameGraph& graph, const ThesisJob& job, ThesisTarget target, ThesisCells& cells)
{
    const gpu::ThesisCounters none{
        .part_count = 0, .big_count = 0, .fragment_count = 0, .code_min = UINT32_MAX, .code_max = 0};
    graph.update(job.triangles.counters, 0, std::span(&none, 1));
    const bool sums = target == ThesisTarget::Sums;
    graph.fill(sums ? static_cast<vk::Buffer&>(cells.sums) : cells.voxels, 0);
    walkAll(graph, job, target,
            [&](vk::AnyPass& pass, gpu::ThesisVoxelizeParams& params)
            {
                if (sums)
                {
                    params.sums = pass.accumulate(cells.sums);
                }
                else
                {
                    params.cells = pass.accumulate(cells.voxels); // any writer may be the last one
                }
            });
    if (sums)
    {
        vk::Pass pass = graph.addPass(gpu::baseline::ThesisResolve{});
        gpu::ThesisResolveParams params{};
        params.scene = readColorTables(pass, job.scene.uploaded());
        params.sums = pass.read(cells.sums);
        params.cells = pass.write(cells.voxels);
        params.cell_count = static_cast<std::uint32_t>(cells.voxels.count());
        pass.dispatch(cells.voxels.count(), params);
    }
}

void appendFragments(vk::FrameGraph& graph, const ThesisJob& job, vk::BufferOf<gpu::VoxelFragment>& fragments)
{
    graph.fill(job.triangles.counters, 0);
    walkAll(graph, job, ThesisTarget::Fragments,
            [&](vk::AnyPass& pass, gpu::ThesisVoxelizeParams& params)
            {
                params.fragments = pass.accumulate(fragments);
                params.fragment_capacity = static_cast<std::uint32_t>(fragments.count());
            });
}

std::vector<vk::PassTime> voxelizeThesis(vk::HeadlessDevice& device, const ThesisJob& job, ThesisTarget target,
                                         ThesisCells& cells, CodeRange* range)
{
    std::vector<vk::PassTime> passes = setUpAndWait(device, job);
    appendTimes(device.run([&](vk::FrameGraph& graph) { walkTriangles(graph, job, target, cells); }), passes);
    if (range != nullptr)
    {
        *range = {0, static_cast<std::uint32_t>(cellCount(job.grid) - 1)};
    }
    if (range != nullptr && job.bounds)
    {
        const gpu::ThesisCounters found = device.download(job.triangles.counters).front();
        *range = {found.code_min, found.code_max};
    }
    return passes;
}

FragmentList listFragments(vk::HeadlessDevice& device, const ThesisJob& job)
{
    requireDepth(job.grid, gpu::kPointerDepthMax, "a list of voxel fragments");
    FragmentList list{.fragments = {}, .passes = setUpAndWait(device, job)};
    appendTimes(device.run([&](vk::FrameGraph& graph) { appendFragments(graph, job, list.fragments); }), list.passes);
    const std::uint32_t count = device.download(job.triangles.counters).front().fragment_count;
    list.fragments = {device.device(), "baseline/fragments", count};
    appendTimes(device.run([&](vk::FrameGraph& graph) { appendFragments(graph, job, list.fragments); }), list.passes);
    return list;
}

} // namespace zvo::baseline
