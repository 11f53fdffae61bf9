// SPDX-License-Identifier: MIT
#include "voxelize.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "core/upload/gpu_scene.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "tree_export.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace zvo::cli
{

namespace
{

std::string formatOf(const VoxelizeOptions& options)
{
    if (!options.format.empty())
    {
        return options.format;
    }
    const std::string extension = extensionOf(options.output.path);
    if (extension != ".morton" && extension != ".ply")
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: the format is not clear; name it .morton or .ply, or say "
                                                  "--format morton or --format ply",
                                                  options.output.path));
    }
    return extension.substr(1);
}

} // namespace

void voxelize(const VoxelizeOptions& options)
{
    checkPaths(options.output, options.voxels.scenes);
    const std::string format = formatOf(options);
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
    const GpuScene gpu_scene = uploadWithWarnings(device, scene, options.voxels, grid, progress);
    scene = {};

    progress.begin("voxelizing");
    const BuildResult result =
        buildOctree(device, gpu_scene, grid, {options.voxels.coverage, options.voxels.hasAttributes(), {}});
    warnOfDropped(result.octree.voxel_count, result.dropped);

    progress.begin("writing");
    {
        const TreeData tree = downloadTree(device, result.octree);
        format == "morton" ? writeMorton(tree, output) : writePly(tree, output);
    }
    if (report)
    {
        const Json json = octreeJson("zvo.voxelize/1", device.device().report(), options.voxels, triangle_count, result,
                                     octreeSha256(device, result.octree), device.device().memory().peakBytes());
        report->write(jsonText(json));
    }
    checkValidation(device);
    output.finish();
    if (report)
    {
        report->finish();
    }
    talk(fmt::format("{} voxels of {}^3 from {} triangles; voxelize {:.1f} ms, build {:.1f} ms on {}",
                     result.octree.voxel_count, grid.resolution(), triangle_count, result.operationMs("voxelize"),
                     result.operationMs("octree"), device.device().report().name));
}

} // namespace zvo::cli
