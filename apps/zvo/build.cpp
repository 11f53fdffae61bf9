// SPDX-License-Identifier: MIT
#include "build.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "core/file/zvo_file.h"
#include "core/upload/gpu_scene.h"
#include "runtime/tiled_build.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

void checkName(const OutputOptions& options)
{
    if (options.path != "-" && extensionOf(options.path) != ".zvo")
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: trees are .zvo files; name it .zvo", options.path));
    }
}

// A tree, and numbers on how it was made.
struct Built
{
    TreeData tree;
    std::map<std::string, std::uint64_t> dropped; // dropped triangles, by reason
    std::vector<vk::PassTime> passes;
    std::uint32_t retry_count = 0;
    std::uint32_t tile_count = 1;
};

Built buildSvo(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid, const BuildFileOptions& options)
{
    BuildResult result =
        buildOctree(device, scene, grid, {options.voxels.coverage, options.voxels.hasAttributes(), {}});
    const std::vector<vk::PassTime> packing = packTree(device, options.voxels.attributes, result.octree);
    result.passes.insert(result.passes.end(), packing.begin(), packing.end());
    return {downloadTree(device, result.octree), std::move(result.dropped), std::move(result.passes),
            result.retry_count};
}

Built buildSvdag(vk::HeadlessDevice& device, const GpuScene& scene, const Grid& grid, const BuildFileOptions& options,
                 Progress& progress)
{
    TiledOptions tiled{.coverage = options.voxels.coverage, .attributes = options.voxels.attributes};
    tiled.progress = [&](double done) { progress.within(done); };
    TiledResult result = buildByTiles(device, scene, grid, tiled);
    return {std::move(result.tree), std::move(result.dropped), std::move(result.passes), result.retry_count,
            result.tile_count};
}

Json builtJson(vk::HeadlessDevice& device, const BuildFileOptions& options, std::uint64_t triangle_count,
               const Built& built)
{
    const TreeData& tree = built.tree;
    Json dropped = Json::object();
    for (const auto& [reason, count] : built.dropped)
    {
        dropped[reason] = count;
    }
    Json json = headJson("zvo.build/1", device.device().report(), options.voxels, tree.grid);
    json["scene"] = {{"triangles", triangle_count}, {"dropped", dropped}};
    json["structure"] = structureName(tree.structure);
    json["attribute_form"] = formatName(tree.attributeFormat());
    json["voxels"] = tree.voxel_count;
    json["nodes"] = tree.octree_node_count;
    json["nodes_stored"] = tree.nodes.size();
    json["tiles"] = built.tile_count;
    json["bytes"] = {{"geometry", tree.geometryBytes()},
                     {"attributes", tree.attributeBytes()},
                     {"peak_device", device.device().memory().peakBytes()}};
    json["cold_run"] = true; // times include what a device does only at first
    json["retries"] = built.retry_count;
    json["passes"] = passesJson(sumByName(built.passes));
    json["voxelize_ms"] = operationMs(built.passes, "voxelize");
    json["build_ms"] = operationMs(built.passes, "octree");
    json["compress_ms"] =
        tree.structure == TreeStructure::Svdag ? Json(operationMs(built.passes, "svdag")) : Json(nullptr);
    json["pack_ms"] =
        isPacked(options.voxels.attributes) ? Json(operationMs(built.passes, "attributes")) : Json(nullptr);
    json["trace_ms"] = nullptr;
    return json;
}

} // namespace

void buildFile(const BuildFileOptions& options)
{
    checkName(options.output);
    checkPaths(options.output, options.voxels.scenes);
    Output output(options.output.path, options.output.overwrite);
    std::optional<Output> report = openReport(options.output);

    Progress progress(4);
    progress.begin("loading");
    AnimatedScene animated =
        loadAnimatedSceneWithWarnings(options.voxels, options.voxels.time.has_value(), ImageDecoding::WhenUploaded);
    checkPaths(options.output, animated.files);
    warnOfMergeRule(animated);
    const Grid grid = placeGrid(options.voxels, animated, boundsOverTime(animated));
    Scene scene = sceneAt(std::move(animated), loopedTime(animated, options.voxels.time.value_or(0.0)));
    const std::uint64_t triangle_count = scene.triangleCount();

    progress.begin("copying to the device");
    const std::shared_ptr<vk::HeadlessDevice> opened = openDevice(options.device);
    vk::HeadlessDevice& device = *opened;
    std::optional<GpuScene> gpu_scene = uploadWithWarnings(device, scene, options.voxels, grid, progress);
    scene = {};

    progress.begin("building");
    const bool is_dag = options.structure == TreeStructure::Svdag;
    const Built built =
        is_dag ? buildSvdag(device, *gpu_scene, grid, options, progress) : buildSvo(device, *gpu_scene, grid, options);
    gpu_scene.reset();
    warnOfDropped(built.tree.voxel_count, built.dropped);

    progress.begin("writing");
    writeZvo(built.tree, [&output](std::span<const std::byte> bytes) { output.write(bytes); });
    const Json json = builtJson(device, options, triangle_count, built);
    if (report)
    {
        report->write(jsonText(json));
    }
    checkValidation(device);
    output.finish();
    if (report)
    {
        report->finish();
    }
    talk(fmt::format(
        "{} voxels of {}^3 from {} triangles; {} bytes of nodes, {} of attributes; voxelize {:.1f} ms, "
        "build {:.1f} ms{}{} on {}",
        built.tree.voxel_count, grid.resolution(), triangle_count, built.tree.geometryBytes(),
        built.tree.attributeBytes(), operationMs(built.passes, "voxelize"), operationMs(built.passes, "octree"),
        is_dag ? fmt::format(", compress {:.1f} ms", operationMs(built.passes, "svdag")) : "",
        isPacked(options.voxels.attributes) ? fmt::format(", pack {:.1f} ms", operationMs(built.passes, "attributes"))
                                            : "",
        device.device().report().name));
}

} // namespace zvo::cli
