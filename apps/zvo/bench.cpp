// SPDX-License-Identifier: MIT
#include "bench.h"

#include "bench_table.h"
#include "core/gpu_scene.h"
#include "core/kernels.h"
#include "core/pipeline.h"
#include "core/trace.h"
#include "output.h"
#include "progress.h"
#include "session.h"
#include "view.h"
#include "zvo/error.h"

#ifdef ZVO_EMBREE
#include "bench_embree.h"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr std::uint32_t kWidth = 1920;
constexpr std::uint32_t kHeight = 1080;
constexpr std::array kUsualScenes = {"bunny_low.glb", "dragon.glb", "sponza.glb"};

// The project's own scenes: beside the working directory's or the program's source tree.
std::vector<fs::path> ownScenes()
{
    std::error_code ignored;
    std::vector<fs::path> folders = {"scenes"};
    for (fs::path folder = fs::read_symlink("/proc/self/exe", ignored); folder.has_relative_path();)
    {
        folder = folder.parent_path();
        folders.push_back(folder / "scenes");
    }
    for (const fs::path& folder : folders)
    {
        std::vector<fs::path> scenes;
        for (const char* name : {"cornell_box.glb", "knot.glb", "atrium.glb"})
        {
            if (fs::exists(folder / name, ignored))
            {
                scenes.push_back(folder / name);
            }
        }
        if (!scenes.empty())
        {
            return scenes;
        }
    }
    return {};
}

std::vector<fs::path> scenesOf(const BenchOptions& options)
{
    if (!options.scenes.empty())
    {
        return options.scenes;
    }
    std::error_code missing;
    if (options.scene_folder && !fs::is_directory(*options.scene_folder, missing))
    {
        throw Error(ErrorCode::Input, fmt::format("--scenes {} is not a folder", options.scene_folder->string()));
    }
    const fs::path folder = options.scene_folder.value_or("scenes");
    std::vector<fs::path> scenes;
    std::vector<std::string> absent;
    for (const char* name : kUsualScenes)
    {
        std::error_code ignored;
        const fs::path path = folder / name;
        if (fs::exists(path, ignored))
        {
            scenes.push_back(path);
        }
        else
        {
            absent.emplace_back(name);
        }
    }
    if (!scenes.empty())
    {
        if (!absent.empty())
        {
            talk(fmt::format("warning: {} has no {}", folder.string(), fmt::join(absent, ", ")));
        }
        return scenes;
    }
    scenes = ownScenes();
    if (scenes.empty())
    {
        throw Error(ErrorCode::Input, fmt::format("{} has none of {}; name scenes to measure, or their folder by "
                                                  "--scenes",
                                                  folder.string(), fmt::join(kUsualScenes, ", ")));
    }
    talk(fmt::format("{} has none of {}: measuring the project's own scenes", folder.string(),
                     fmt::join(kUsualScenes, ", ")));
    return scenes;
}

// Finds out now what would otherwise show after an hour. Throws the loader's error for a file that is missing.
void checkPresent(const std::vector<fs::path>& paths)
{
    for (const fs::path& path : paths)
    {
        std::error_code ignored;
        if (!fs::exists(path, ignored))
        {
            loadWithWarnings(std::span(&path, 1), {});
        }
    }
}

// Adds run times of passes to sums of the same names; both in order of occurrence.
void addPasses(std::vector<vk::PassTime>& sums, std::vector<vk::PassTime> passes, std::uint32_t run_count)
{
    for (vk::PassTime& pass : passes)
    {
        pass.ms /= run_count;
        sums.push_back(std::move(pass));
    }
    sums = sumByName(sums);
}

class Bench
{
public:
    Bench(const BenchOptions& options, vk::HeadlessDevice& device) : m_options(options), m_device(device) {}

    BenchRow measure(const std::string& name, const Scene& scene, const GpuScene& gpu_scene, std::uint32_t depth)
    {
        m_device.device().memory().resetPeak();
        BenchRow row;
        row.scene = name;
        row.resolution = 1U << depth;
        row.coverage = m_options.coverage;
        row.attributes = m_options.attributes;
        row.triangles = scene.triangleCount();
        const Grid grid = Grid::around(scene.bounds(), depth);
        const BuildResult built = measureBuild(gpu_scene, grid, row);
        const Bounds subject = subjectOf(scene, grid);
        const ViewCamera view = chooseCamera(m_options.camera, scene, subject, double{kWidth} / kHeight);
        const TraceCamera camera = traceCamera(view, grid, kHeight);
        measureTrace(built.octree, camera, row);
        row.voxels = built.octree.voxel_count;
        row.nodes = built.octree.node_count;
        row.geometry_bytes = built.octree.geometryBytes();
        row.attribute_bytes = built.octree.attributeBytes();
        row.peak_device_bytes = m_device.device().memory().peakBytes();
#ifdef ZVO_EMBREE
        measureEmbree(scene, built.octree, camera, row);
#endif
        return row;
    }

private:
    // Voxelize and build, after a warm-up that also finds out how much room they need.
    BuildResult measureBuild(const GpuScene& gpu_scene, const Grid& grid, BenchRow& row)
    {
        BuildOptions build = {m_options.coverage, m_options.attributes, {}};
        build.capacities = buildOctree(m_device, gpu_scene, grid, build).capacities;
        std::vector<double> voxelize_ms;
        std::vector<double> build_ms;
        for (std::uint32_t run = 1;; ++run)
        {
            BuildResult result = buildOctree(m_device, gpu_scene, grid, build);
            voxelize_ms.push_back(result.stageMs("voxelize"));
            build_ms.push_back(result.stageMs("octree"));
            addPasses(row.passes, result.passes, m_options.run_count);
            if (run == m_options.run_count)
            {
                row.voxelize_ms = Spread::of(voxelize_ms);
                row.build_ms = Spread::of(build_ms);
                return result;
            }
        }
    }

    // Primary rays, after a warm-up.
    void measureTrace(const Octree& octree, const TraceCamera& camera, BenchRow& row)
    {
        BeamGrid beam(m_device.device());
        TraceBuffers buffers(m_device.device(), kWidth, kHeight);
        const std::vector<vk::PassTime> beam_passes =
            m_device.run([&](vk::FrameGraph& graph) { buildBeam(graph, octree, beam); });
        const auto tracePicture = [&]
        {
            return m_device.run([&](vk::FrameGraph& graph)
                                { tracePrimary(graph, octree, beam, camera, TraceOptions{}, buffers); });
        };
        tracePicture();
        std::vector<double> trace_ms;
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            const std::vector<vk::PassTime> passes = tracePicture();
            trace_ms.push_back(sumMs(passes));
            addPasses(row.passes, passes, m_options.run_count);
        }
        row.beam_grid_ms = sumMs(beam_passes);
        row.trace_ms = Spread::of(trace_ms);
        row.rays = primaryRayCount(buffers);
        row.hits = countHits(buffers);
    }

    // Pixels whose ray hit something.
    std::uint64_t countHits(const TraceBuffers& buffers)
    {
        const std::vector<gpu::Hit> hits = m_device.download(buffers.hits);
        const std::vector<float> starts = m_device.download(buffers.starts);
        const std::uint32_t tiles_x = (kWidth + gpu::kTileEdge - 1) / gpu::kTileEdge;
        std::uint64_t count = 0;
        for (std::size_t pixel = 0; pixel < hits.size(); ++pixel)
        {
            const std::size_t tile = pixel / kWidth / gpu::kTileEdge * tiles_x + pixel % kWidth / gpu::kTileEdge;
            count += starts[tile] != gpu::kTileDead && hits[pixel].index != gpu::kHitMiss ? 1 : 0;
        }
        return count;
    }

#ifdef ZVO_EMBREE
    void measureEmbree(const Scene& scene, const Octree& octree, const TraceCamera& camera, BenchRow& row)
    {
        const std::vector<PrimaryRay> rays = primaryRays(camera, kWidth, kHeight);
        const EmbreeResult voxels =
            traceVoxelsByEmbree(octree.grid, voxelCodes(m_device, octree), rays, m_options.run_count);
        const EmbreeResult triangles = traceTrianglesByEmbree(octree.grid, scene, rays, m_options.run_count);
        row.embree_user_mrays_per_s = voxels.mrays_per_s;
        row.embree_user_single_mrays_per_s = voxels.single_mrays_per_s;
        row.embree_user_hits = voxels.hit_count;
        row.embree_triangle_mrays_per_s = triangles.mrays_per_s;
        row.embree_triangle_single_mrays_per_s = triangles.single_mrays_per_s;
    }
#endif

    const BenchOptions& m_options;
    vk::HeadlessDevice& m_device;
};

} // namespace

void bench(const BenchOptions& options)
{
    const std::vector<fs::path> paths = scenesOf(options);
    checkPresent(paths);
    std::optional<Output> report;
    if (!options.output.json.empty())
    {
        report.emplace(options.output.json, options.output.overwrite);
    }
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    Output table("-", true);
    const bool show_table = options.output.json != "-";
    const BenchHeader header = {device.device().report(), kWidth, kHeight, options.run_count};
    if (show_table)
    {
        table.write(tableHead(header));
    }
    Bench measurements(options, device);
    std::vector<BenchRow> rows;
    Progress progress(paths.size() * options.depths.size());
    for (const fs::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        const GpuScene gpu_scene = uploadScene(device, scene, options.attributes);
        for (const std::uint32_t depth : options.depths)
        {
            progress.step(fmt::format("{} at {}", path.stem().string(), 1U << depth));
            rows.push_back(measurements.measure(path.stem().string(), scene, gpu_scene, depth));
            if (show_table)
            {
                clearProgressBar();
                table.write(tableLine(rows.back()));
            }
        }
    }
    if (show_table && options.passes)
    {
        for (const BenchRow& row : rows)
        {
            table.write(passTable(row));
        }
    }
    checkValidation(device);
    if (report)
    {
        report->write(jsonText(benchJson(header, rows)));
        report->finish();
    }
}

} // namespace zvo::cli
