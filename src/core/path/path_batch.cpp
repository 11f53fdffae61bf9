// SPDX-License-Identifier: MIT
#include "core/path/path_batch.h"

#include "core/base/divide_up.h"
#include "vk/device.h"

namespace zvo
{

namespace
{

// Records the pass of a kernel that takes a list of numbers of paths.
template <typename Kernel>
void takeList(vk::FrameGraph& graph, const Kernel& kernel, std::uint32_t list, const PathLight& light, PathBatch& batch,
              std::size_t paths, std::uint32_t bounce)
{
    vk::Pass pass = graph.addPass(kernel);
    gpu::PathLightParams params{};
    params.environment = light.environment.read(pass);
    light.lights.read(pass, light.tree, params);
    params.rays = pass.read(batch.rays.at(paths));
    params.states = pass.read(batch.states.at(paths));
    params.hits = pass.read(batch.hits);
    params.shadow_rays = pass.readWrite(batch.shadowRays(paths));
    params.shadow_states = batch.useShadowStates(pass, paths);
    params.radiance = pass.readWrite(batch.radiance);
    params.lists = pass.readWrite(batch.lists);
    params.numbers = {pass.read(batch.numbers).address + batch.firstNumber(list) * sizeof(gpu::uint)};
    params.bounce = bounce;
    params.sample_index = light.sample_index;
    pass.dispatchIndirect(batch.lists, listArgs(bounce, list), params, divideUp(light.path_count, gpu::kPathGroup));
}

// The lists of numbers that have elements of their own.
std::uint64_t listsOf(bool shares)
{
    return shares ? gpu::kListMisses : gpu::kListCount;
}

} // namespace

PathBatch::PathBatch(vk::Device& device, std::uint64_t path_count, bool shares, std::uint32_t set_count)
    : lists(device, "path/lists", std::uint64_t{set_count} * gpu::kListElements)
{
    if (path_count == 0)
    {
        return;
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
        rays.at(i) = {device, "path/rays", path_count};
        states.at(i) = {device, "path/states", path_count};
    }
    hits = {device, "path/hits", path_count};
    if (!shares)
    {
        shadow_rays = {device, "path/shadow_rays", path_count};
        shadow_states = {device, "path/shadow_states", path_count};
    }
    radiance = {device, "path/radiance", path_count};
    numbers = {device, "path/numbers", listsOf(shares) * path_count};
    rounds = {device, "path/rounds", gpu::kTraceRoundsMax};
}

std::uint64_t PathBatch::bytesFor(std::uint64_t path_count, bool shares)
{
    return path_count *
           (2 * (sizeof(gpu::Ray) + sizeof(gpu::PathState)) + sizeof(gpu::Hit) + sizeof(gpu::vec3) +
            listsOf(shares) * sizeof(gpu::uint) + (shares ? 0 : sizeof(gpu::Ray) + sizeof(gpu::ShadowState)));
}

std::uint64_t PathBatch::firstNumber(std::uint32_t list) const
{
    return capacity() * (numbers.count() == listsOf(true) * capacity() && list >= gpu::kListMisses
                             ? list - gpu::kListMisses + gpu::kListMapLights
                             : list);
}

std::uint64_t PathBatch::bytes() const
{
    // Every member has a name here, or this does not compile: none is forgotten.
    const auto& [rays_, states_, hits_, shadow_rays_, shadow_states_, radiance_, numbers_, rounds_, lists_] = *this;
    return rays_[0].bytes() + rays_[1].bytes() + states_[0].bytes() + states_[1].bytes() + hits_.bytes() +
           shadow_rays_.bytes() + shadow_states_.bytes() + radiance_.bytes() + numbers_.bytes() + rounds_.bytes() +
           lists_.bytes();
}

std::uint64_t listArgs(std::uint32_t bounce, std::uint32_t list)
{
    return std::uint64_t{bounce} * gpu::kListElements + list;
}

RayListLength listLength(const vk::BufferOf<gpu::DispatchArgs>& lists, std::uint32_t bounce, std::uint32_t list)
{
    constexpr std::uint64_t kWords = sizeof(gpu::DispatchArgs) / sizeof(gpu::uint);
    return {lists, listArgs(bounce, list), kWords * listArgs(bounce, gpu::kListLengths) + list};
}

void tracePaths(vk::FrameGraph& graph, const PathLight& light, PathBatch& batch, std::size_t paths,
                std::uint32_t bounce)
{
    const RayListLength length = listLength(batch.lists, bounce, gpu::kListPaths);
    traceRays(graph, light.tree, batch.rays.at(paths), batch.hits, batch.rounds, light.status, {}, &length);
}

void addMetLight(vk::FrameGraph& graph, const PathLight& light, PathBatch& batch, std::size_t paths,
                 std::uint32_t bounce)
{
    takeList(graph, gpu::path::Miss{.sampling = light.sampling, .smooth_normals = light.smooth}, gpu::kListMisses,
             light, batch, paths, bounce);
    if (hasEmission(light.tree))
    {
        takeList(graph,
                 gpu::path::Emitter{.sampling = light.sampling,
                                    .node_levels = light.tree.grid.nodeLevels(),
                                    .by_power = light.by_power,
                                    .smooth_normals = light.smooth},
                 gpu::kListEmitters, light, batch, paths, bounce);
    }
}

void addChosenLight(vk::FrameGraph& graph, const PathLight& light, PathBatch& batch, std::size_t paths,
                    std::uint32_t bounce)
{
    takeList(graph, gpu::path::MapLight{.sampling = light.sampling, .smooth_normals = light.smooth},
             gpu::kListMapLights, light, batch, paths, bounce);
    if (hasEmission(light.tree))
    {
        takeList(graph,
                 gpu::path::VoxelLight{.sampling = light.sampling,
                                       .node_levels = light.tree.grid.nodeLevels(),
                                       .by_power = light.by_power,
                                       .smooth_normals = light.smooth},
                 gpu::kListVoxelLights, light, batch, paths, bounce);
    }
    const RayListLength shadows = listLength(batch.lists, bounce, gpu::kListShadows);
    traceRays(graph, light.tree, batch.shadowRays(paths), batch.hits, batch.rounds, light.status, {}, &shadows);
    vk::Pass pass = graph.addPass(gpu::path::Connect{.notes = light.first_noted.has_value()});
    gpu::PathConnectParams params{};
    params.hits = pass.read(batch.hits);
    params.shadow_states = {batch.useShadowStates(pass, paths).address};
    params.radiance = pass.readWrite(batch.radiance);
    params.lists = pass.readWrite(batch.lists);
    if (light.first_noted)
    {
        params.numbers = pass.readWrite(batch.numbers);
        params.first_noted = *light.first_noted;
    }
    params.bounce = bounce;
    pass.dispatchIndirect(batch.lists, shadows.args, params, divideUp(light.path_count, gpu::kPathGroup));
}

gpu::ConstPtr<gpu::Attribute> readVoxelAttributes(vk::AnyPass& pass, const DeviceTree& tree)
{
    return isPacked(tree.attributeFormat()) ? gpu::ConstPtr<gpu::Attribute>{pass.read(tree.packed.voxels).address}
                                            : pass.read(tree.voxel_attributes);
}

} // namespace zvo
