// SPDX-License-Identifier: MIT
// zvo voxelize and zvo build: the commands that make a file of a scene's voxels.
#include "commands.h"
#include "common/ground.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/tree_export.h"
#include "common/words.h"
#include "core/file/zvo_file.h"
#include "core/upload/gpu_scene.h"
#include "io/voxel/nvdb_distances.h"
#include "runtime/distances.h"
#include "runtime/octree_sha256.h"
#include "runtime/tiled_build.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

// A scene on the device, and the files that become of it, which are opened before the work begins.
class VoxelRun
{
public:
    // whole_textures: those that the scene would need in any grid.
    VoxelRun(const VoxelOptions& voxels, const DeviceOptions& device, const OutputOptions& outputs,
             bool whole_textures = false)
        : output(outputs.path, outputs.overwrite), m_report(openReport(outputs)), m_submission_ms(device.dispatch_ms)
    {
        progress.begin("loading");
        AnimatedScene animated =
            loadAnimatedSceneWithWarnings(voxels, voxels.time.has_value(), ImageDecoding::WhenUploaded);
        checkPaths(outputs, animated.files);
        warnOfMergeRule(animated);
        const Bounds bounds = boundsOverTime(animated);
        grid = placeGrid(voxels, animated, bounds);
        if (voxels.ground)
        {
            addGround(animated, bounds, grid);
        }
        const double seconds = loopedTime(animated, voxels.time.value_or(0.0));
        const Scene still = sceneAt(std::move(animated), seconds);
        counts = SceneCounts::of(still, grid, voxels.coverage);
        progress.begin("copying to the device");
        m_device = openDevice(device);
        m_scene.emplace(uploadWithWarnings(*m_device, still, voxels,
                                           whole_textures ? std::nullopt : std::optional(grid), progress));
    }

    [[nodiscard]] vk::HeadlessDevice& device() { return *m_device; }
    [[nodiscard]] GpuScene& scene() { return *m_scene; }
    void freeScene() { m_scene.reset(); }

    // Calls work, of which the progress bar shows that it goes on.
    void watch(const std::function<void()>& work)
    {
        m_device->withPauses([this] { progress.goOn(); }, m_submission_ms, work);
    }

    // Completes the files. json: makes the report, if one was asked for.
    void finish(const std::function<Json()>& json)
    {
        if (m_report)
        {
            m_report->write(jsonText(json()));
        }
        checkValidation(*m_device);
        output.finish();
        if (m_report)
        {
            m_report->finish();
        }
    }

    Output output;
    Progress progress{4};
    Grid grid;
    SceneCounts counts;

private:
    std::optional<Output> m_report;
    double m_submission_ms;
    std::shared_ptr<vk::HeadlessDevice> m_device;
    std::optional<GpuScene> m_scene;
};

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

void checkName(const OutputOptions& options, bool distances)
{
    if (distances && options.path != "-" && extensionOf(options.path) != ".nvdb")
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: distances are .nvdb files; name it .nvdb", options.path));
    }
    if (!distances && options.path != "-" && extensionOf(options.path) != ".zvo")
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
    OpenSurfaces open = {};
};

// An octree, or the DAG of a whole one.
Built buildWhole(VoxelRun& run, const BuildFileOptions& options, bool is_dag)
{
    BuildResult result = buildOctree(run.device(), run.scene(), run.grid, options.voxels.build());
    if (is_dag)
    {
        CompressResult compressed = compress(run.device(), std::move(result.octree));
        result.octree = std::move(compressed.dag);
        result.passes.insert(result.passes.end(), compressed.passes.begin(), compressed.passes.end());
    }
    const std::vector<vk::PassTime> packing = packTree(run.device(), options.voxels.attributes, result.octree);
    result.passes.insert(result.passes.end(), packing.begin(), packing.end());
    return {downloadTree(run.device(), result.octree),
            std::move(result.dropped),
            std::move(result.passes),
            result.retry_count,
            1,
            result.open};
}

Built buildTiledDag(VoxelRun& run, const BuildFileOptions& options)
{
    TiledOptions tiled{.coverage = options.voxels.coverage, .attributes = options.voxels.attributes};
    tiled.progress = [&run](double done) { run.progress.within(done); };
    TiledResult result = buildByTiles(run.device(), run.scene(), run.grid, tiled);
    return {std::move(result.tree), std::move(result.dropped), std::move(result.passes), result.retry_count,
            result.tile_count};
}

Json builtJson(VoxelRun& run, const BuildFileOptions& options, const Built& built)
{
    const TreeData& tree = built.tree;
    Json json = headJson("zvo.build/1", run.device().device().report(), options.voxels, tree.grid);
    json["scene"] = sceneJson(run.counts, built.dropped);
    json["structure"] = structureName(tree.structure);
    json["attribute_form"] = formatName(tree.attributeFormat());
    json["voxels"] = tree.occupiedCount();
    json["interior_voxels"] = tree.interior_count;
    json["nodes"] = tree.octree_node_count;
    json["nodes_stored"] = tree.nodes.size();
    json["tiles"] = built.tile_count;
    json["bytes"] = {{"geometry", tree.geometryBytes()},
                     {"attributes", tree.attributeBytes()},
                     {"peak_device", run.device().device().memory().peakBytes()}};
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

void distanceFile(const BuildFileOptions& options)
{
    if (options.structure || options.voxels.attributes != VoxelOptions().attributes ||
        options.voxels.shell != VoxelOptions().shell)
    {
        throw Error(ErrorCode::Usage,
                    "--distance goes without --structure, --attributes and --shell: it makes no tree");
    }
    VoxelOptions voxels = options.voxels;
    voxels.fill = voxels.fill == Fill::None ? Fill::Solid : voxels.fill;
    voxels.attributes = AttributeFormat::None;
    voxels.default_margin = *options.distance + 1;
    VoxelRun run(voxels, options.device, options.output, true);

    run.progress.begin("measuring");
    BuildResult filled;
    DistanceResult result;
    run.watch(
        [&]
        {
            filled = buildOctree(run.device(), run.scene(), run.grid, voxels.build());
            result =
                findDistances(run.device(), run.scene(), run.grid, {.band = *options.distance, .fill = voxels.fill});
        });
    run.freeScene();
    warnOfDropped(result.distances.leaf_count, result.dropped, run.counts, voxels.load.strict);
    warnOfOpenSurfaces({result.open_lines, std::nullopt}, voxels.load.strict);

    run.progress.begin("writing");
    writeNvdbDistances(downloadDistances(run.device(), result.distances), downloadTree(run.device(), filled.octree),
                       [&run](std::span<const std::byte> bytes) { run.output.write(bytes); });
    const double ms = operationMs(result.passes, "distance");
    run.finish(
        [&]
        {
            Json json = headJson("zvo.distance/1", run.device().device().report(), voxels, run.grid);
            json["scene"] = sceneJson(run.counts, result.dropped);
            json["distance"] = *options.distance;
            json["leaves"] = result.distances.leaf_count;
            json["bytes"] = {{"distances", result.distances.squared.bytes() + result.distances.leaves.bytes()},
                             {"peak_device", run.device().device().memory().peakBytes()}};
            json["cold_run"] = true;
            json["retries"] = result.retry_count;
            json["passes"] = passesJson(sumByName(result.passes));
            json["voxelize_ms"] = operationMs(result.passes, "voxelize");
            json["distance_ms"] = ms;
            return json;
        });
    tellRun(fmt::format("{} of 4^3 distances up to {}, of {}^3 from {}; voxelize {:.1f} ms, measure {:.1f} ms on {}",
                        counted(result.distances.leaf_count, "block"), counted(*options.distance, "voxel"),
                        run.grid.resolution(), run.counts.told(), operationMs(result.passes, "voxelize"), ms,
                        run.device().device().report().name));
}

} // namespace

void voxelize(const VoxelizeOptions& options)
{
    checkPaths(options.output, options.voxels.scenes);
    const std::string format = formatOf(options);
    VoxelRun run(options.voxels, options.device, options.output);
    vk::HeadlessDevice& device = run.device();

    run.progress.begin("voxelizing");
    BuildResult result;
    run.watch([&] { result = buildOctree(device, run.scene(), run.grid, options.voxels.build()); });
    warnOfDropped(result.octree.voxel_count, result.dropped, run.counts, options.voxels.load.strict);
    warnOfOpenSurfaces(result.open, options.voxels.load.strict);

    run.progress.begin("writing");
    {
        const TreeData tree = downloadTree(device, result.octree);
        warnOfLostEmission(tree, format, options.voxels.load.strict);
        format == "morton" ? writeMorton(tree, run.output) : writePly(tree, run.output);
    }
    run.finish(
        [&]
        {
            return octreeJson("zvo.voxelize/1", device.device().report(), options.voxels, run.counts, result,
                              octreeSha256(device, result.octree), device.device().memory().peakBytes());
        });
    tellRun(fmt::format("{} of {}^3 from {}; voxelize {:.1f} ms, build {:.1f} ms on {}",
                        counted(result.octree.occupiedCount(), "voxel"), run.grid.resolution(), run.counts.told(),
                        result.operationMs("voxelize"), result.operationMs("octree"), device.device().report().name));
}

void buildFile(const BuildFileOptions& options)
{
    checkName(options.output, options.distance.has_value());
    if (options.distance)
    {
        distanceFile(options);
        return;
    }
    const bool is_tiled = options.voxels.fill == Fill::None && options.voxels.shell == Shell::Surface;
    const bool is_dag = options.structure.value_or(TreeStructure::Svdag) == TreeStructure::Svdag;
    checkPaths(options.output, options.voxels.scenes);
    VoxelRun run(options.voxels, options.device, options.output);

    run.progress.begin("building");
    Built built;
    run.watch([&] { built = is_dag && is_tiled ? buildTiledDag(run, options) : buildWhole(run, options, is_dag); });
    run.freeScene();
    warnOfDropped(built.tree.voxel_count, built.dropped, run.counts, options.voxels.load.strict);
    warnOfOpenSurfaces(built.open, options.voxels.load.strict);

    run.progress.begin("writing");
    writeZvo(built.tree, [&run](std::span<const std::byte> bytes) { run.output.write(bytes); });
    run.finish([&] { return builtJson(run, options, built); });
    tellRun(fmt::format(
        "{} of {}^3 from {}; {} bytes of nodes, {} of attributes; voxelize {:.1f} ms, build {:.1f} ms{}{} on {}",
        counted(built.tree.occupiedCount(), "voxel"), run.grid.resolution(), run.counts.told(),
        built.tree.geometryBytes(), built.tree.attributeBytes(), operationMs(built.passes, "voxelize"),
        operationMs(built.passes, "octree"),
        is_dag ? fmt::format(", compress {:.1f} ms", operationMs(built.passes, "svdag")) : "",
        isPacked(options.voxels.attributes) ? fmt::format(", pack {:.1f} ms", operationMs(built.passes, "attributes"))
                                            : "",
        run.device().device().report().name));
}

} // namespace zvo::cli
