// SPDX-License-Identifier: MIT
#include "core/voxelize/fragment_sums.h"

#include "core/base/divide_up.h"
#include "core/base/tuning.h"
#include "octree/octree.h"

#include <cassert>
#include <string_view>

namespace zvo
{

static_assert(sizeof(gpu::VoxelSums) == gpu::kVoxelSumsBytes);

namespace
{

constexpr std::string_view kInt64Atomics = "shaderBufferInt64Atomics";

template <typename Kernel>
void recordFragments(vk::FrameGraph& graph, const VoxelizeJob& job, RasterMode mode, const FragmentTarget& sums,
                     std::uint64_t first, std::uint64_t count)
{
    VoxelizeBuffers& buffers = job.buffers;
    const bool emits = mode == RasterMode::Emission;
    vk::Pass pass = graph.addPass(Kernel{.wide_keys = hasWideKeys(job.tile.grid),
                                         .mixed = sums.mixed != nullptr,
                                         .material_class = job.scene.uploaded().highestClass(),
                                         .coverage = buffers.form.coverage,
                                         .mode = mode,
                                         .emits = buffers.form.emission,
                                         .centres = buffers.form.shell == Shell::None});
    readColorTables(pass, job.scene.uploaded());
    gpu::AttributesParams params{};
    params.scene = job.scene.read(pass);
    params.setups = pass.read(buffers.setups);
    params.surfaces = pass.read(buffers.surfaces);
    params.bricks = pass.read(buffers.table);
    params.items = pass.read(buffers.items);
    params.voxels = pass.read(buffers.voxels);
    params.nodes = pass.read(sums.nodes);
    params.counters = pass.read(buffers.counters);
    if (sums.mixed != nullptr)
    {
        params.mixed = pass.read(*sums.mixed);
        params.attributes = pass.accumulate(*sums.voxel_attributes); // each element once, in any order
    }
    params.sums = emits ? gpu::Ptr<gpu::VoxelSums>{} : pass.accumulate(sums.sums);
    params.emission_words =
        emits ? gpu::Ptr<gpu::uvec2>{pass.read(sums.emission_words).address} : pass.accumulate(sums.emission_words);
    params.emission_sums = emits ? pass.accumulate(sums.emission_sums) : gpu::Ptr<gpu::EmissionSums>{};
    params.window = windowOf(job.tile);
    params.first_leaf = sums.first_leaf;
    params.first_item = static_cast<std::uint32_t>(first);
    params.item_end = static_cast<std::uint32_t>(first + count);
    params.sum_shift = sums.sum_shift;
    pass.dispatch(count, params);
}

void resolveVoxels(vk::FrameGraph& graph, const GpuScene& scene, AttributeBuffers& attributes, DeviceTree& octree)
{
    vk::Pass pass = graph.addPass(gpu::voxelize::Resolve{});
    pass.dispatch(octree.voxel_count, {.scene = readColorTables(pass, scene),
                                       .sums = pass.read(attributes.sums),
                                       .emission_words = pass.read(octree.emission_words),
                                       .attributes = pass.write(octree.voxel_attributes),
                                       .max_fragments = pass.readWrite(attributes.max_fragments),
                                       .voxel_count = octree.voxel_count,
                                       .has_emission = octree.emission_words.count() != 0 ? 1U : 0U,
                                       .sum_shift = attributes.sum_shift});
}

void resolveMixed(vk::FrameGraph& graph, const GpuScene& scene, const vk::BufferOf<gpu::MixedVoxels>& mixed,
                  AttributeBuffers& attributes, DeviceTree& octree)
{
    const auto [first_leaf, leaf_count] = octree.levels.back();
    vk::Pass pass = graph.addPass(gpu::voxelize::ResolveLeaves{});
    pass.dispatch(leaf_count, {.scene = readColorTables(pass, scene),
                               .nodes = pass.read(octree.nodes),
                               .mixed = pass.read(mixed),
                               .sums = pass.read(attributes.sums),
                               .attributes = pass.readWrite(octree.voxel_attributes),
                               .max_fragments = pass.readWrite(attributes.max_fragments),
                               .first_leaf = first_leaf,
                               .leaf_count = leaf_count,
                               .sum_shift = attributes.sum_shift});
}

FragmentTarget sumsOf(AttributeBuffers& attributes, DeviceTree& octree)
{
    return {octree.nodes,          octree.levels.back().first_node, attributes.sums,
            octree.emission_words, attributes.emission_sums,        attributes.sum_shift};
}

} // namespace

SumForm SumForm::on(const vk::Device& device)
{
    return {.int64 = device.isEnabled(kInt64Atomics), .mixed = tunedValue(device, Tunable::MixedSums) != 0};
}

AttributeBuffers::AttributeBuffers(vk::Device& device, std::uint32_t voxel_count, std::uint32_t sum_count,
                                   bool emission)
    : sums(device, "voxelize/sums", sum_count), max_fragments(device, "voxelize/max_fragments", 1)
{
    if (emission)
    {
        partials = {device, "voxelize/partials",
                    divideUp(divideUp(voxel_count, gpu::kVoxelsPerEmissionWord), gpu::kScanBlock)};
        emissive_count = {device, "voxelize/emissive_count", 1};
    }
}

void rankBits(vk::FrameGraph& graph, vk::BufferOf<gpu::uvec2>& words, vk::BufferOf<gpu::uint>& partials,
              vk::BufferOf<gpu::uint>& total)
{
    const auto word_count = static_cast<std::uint32_t>(words.count());
    const std::uint64_t threads = divideUp(word_count, gpu::kScanItems);
    {
        vk::Pass pass = graph.addPass(gpu::voxelize::EmissionCount{});
        const gpu::EmissionRankParams params = {pass.readWrite(words), pass.write(partials), word_count};
        pass.dispatch(threads, params);
    }
    {
        vk::Pass pass = graph.addPass(gpu::octree::Scan{});
        const gpu::ScanParams params = {pass.readWrite(partials), pass.write(total),
                                        static_cast<std::uint32_t>(divideUp(word_count, gpu::kScanBlock))};
        pass.dispatch(gpu::kScanGroup, params);
    }
    vk::Pass pass = graph.addPass(gpu::voxelize::EmissionRank{});
    const gpu::EmissionRankParams params = {pass.readWrite(words), pass.readWrite(partials), word_count};
    pass.dispatch(threads, params);
}

void addFragments(vk::FrameGraph& graph, const VoxelizeJob& job, RasterMode mode, const FragmentTarget& sums,
                  std::uint64_t first, std::uint64_t count)
{
    if (mode == RasterMode::Attributes && sums.int64)
    {
        recordFragments<gpu::voxelize::AttributesInt64>(graph, job, mode, sums, first, count);
        return;
    }
    recordFragments<gpu::voxelize::Attributes>(graph, job, mode, sums, first, count);
}

void voxelizeAttributes(vk::FrameGraph& graph, const VoxelizeJob& job, std::uint32_t item_count, bool int64,
                        const vk::BufferOf<gpu::MixedVoxels>& mixed, AttributeBuffers& attributes, DeviceTree& octree)
{
    const bool emission = octree.emission_words.count() != 0;
    const GpuScene& scene = job.scene.uploaded();
    FragmentTarget sums = sumsOf(attributes, octree);
    sums.int64 = int64;
    graph.fill(attributes.sums, 0);
    graph.fill(attributes.max_fragments, 0);
    if (emission)
    {
        graph.fill(octree.emission_words, 0);
    }
    if (job.buffers.form.mixed)
    {
        assert(!emission);
        sums.mixed = &mixed;
        sums.voxel_attributes = &octree.voxel_attributes;
    }
    addFragments(graph, job, RasterMode::Attributes, sums, 0, item_count);
    if (job.buffers.form.mixed)
    {
        resolveMixed(graph, scene, mixed, attributes, octree);
        return;
    }
    resolveVoxels(graph, scene, attributes, octree);
    if (emission)
    {
        rankBits(graph, octree.emission_words, attributes.partials, attributes.emissive_count);
    }
}

void voxelizeEmission(vk::FrameGraph& graph, const VoxelizeJob& job, std::uint32_t item_count,
                      AttributeBuffers& attributes, DeviceTree& octree)
{
    graph.fill(attributes.emission_sums, 0);
    addFragments(graph, job, RasterMode::Emission, sumsOf(attributes, octree), 0, item_count);
    vk::Pass pass = graph.addPass(gpu::voxelize::ResolveEmission{});
    pass.dispatch(octree.voxel_count, {.sums = pass.read(attributes.sums),
                                       .emission_sums = pass.read(attributes.emission_sums),
                                       .emission_words = pass.read(octree.emission_words),
                                       .emission = pass.write(octree.emission),
                                       .voxel_count = octree.voxel_count,
                                       .sum_shift = attributes.sum_shift});
}

} // namespace zvo
