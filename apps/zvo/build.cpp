// SPDX-License-Identifier: MIT
#include "build.h"

#include "core/gpu_scene.h"
#include "core/kernels.h"
#include "core/pipeline.h"
#include "core/svdag.h"
#include "core/zvo_file.h"
#include "output.h"
#include "progress.h"
#include "report.h"
#include "session.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

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

} // namespace

void buildFile(const BuildFileOptions& options)
{
    checkName(options.output);
    checkPlaces(options.output, options.voxels.scenes);
    Output output(options.output.path, options.output.overwrite);
    std::optional<Output> report = openReport(options.output);

    const bool is_dag = options.structure == TreeStructure::Svdag;
    Progress progress(is_dag ? 5 : 4);
    progress.step("loading");
    Stage stage = loadStageWithWarnings(options.voxels, options.voxels.time.has_value());
    checkPlaces(options.output, stage.files);
    warnOfMergeRule(stage);
    const Grid grid = placeGrid(options.voxels, stage, stageBounds(stage));
    Scene scene = stageAt(std::move(stage), loopedTime(stage, options.voxels.time.value_or(0.0)));
    const std::uint64_t triangle_count = scene.triangleCount();

    progress.step("copying to the device");
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::optional<GpuScene> gpu_scene = uploadScene(device, scene, options.voxels.attributes);
    scene = {};

    progress.step("voxelizing");
    BuildResult result =
        buildOctree(device, *gpu_scene, grid, {options.voxels.coverage, options.voxels.attributes, {}});
    gpu_scene.reset();
    warnOfDropped(result.octree.voxel_count, result.dropped);
    Json json;
    if (report)
    {
        json = octreeJson("zvo.build/1", device.device().report(), options.voxels, triangle_count, result,
                          octreeSha256(device, result.octree), 0);
    }

    double compress_ms = 0;
    TreeData tree;
    if (is_dag)
    {
        progress.step("compressing");
        const CompressResult compressed = compress(device, std::move(result.octree));
        compress_ms = compressed.ms();
        if (report)
        {
            const Json passes = passesJson(compressed.passes);
            json["passes"].insert(json["passes"].end(), passes.begin(), passes.end());
            json["retries_compress"] = compressed.retry_count;
        }
        tree = downloadTree(device, compressed.dag);
    }
    else
    {
        tree = downloadTree(device, result.octree);
    }

    progress.step("writing");
    writeZvo(tree, [&output](std::span<const std::byte> bytes) { output.write(bytes); });
    if (report)
    {
        json["structure"] = structureName(tree.structure);
        json["nodes_stored"] = tree.nodes.size();
        json["compress_ms"] = is_dag ? Json(compress_ms) : Json(nullptr);
        json["bytes"]["geometry"] = tree.geometryBytes();
        json["bytes"]["peak_device"] = device.device().memory().peakBytes();
        report->write(jsonText(json));
    }
    checkValidation(device);
    output.finish();
    if (report)
    {
        report->finish();
    }
    talk(fmt::format("{} voxels of {}^3 from {} triangles; {} bytes of nodes, {} of attributes; voxelize {:.1f} ms, "
                     "build {:.1f} ms{} on {}",
                     tree.voxel_count, grid.resolution(), triangle_count, tree.geometryBytes(), tree.attributeBytes(),
                     result.stageMs("voxelize"), result.stageMs("octree"),
                     is_dag ? fmt::format(", compress {:.1f} ms", compress_ms) : "", device.device().report().name));
}

} // namespace zvo::cli
