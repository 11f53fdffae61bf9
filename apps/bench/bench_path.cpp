// SPDX-License-Identifier: MIT
#include "bench/bench_path.h"

#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/bench_table.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/view.h"
#include "core/base/kernels.h"
#include "core/base/read_file.h"
#include "core/path/daylight.h"
#include "core/path/path_tracer.h"
#include "core/upload/gpu_scene.h"
#include "io/image/hdr_image_io.h"
#include "runtime/trees.h"
#include "zvo/error.h"
#include "zvo/version.h"

#ifdef ZVO_EMBREE
#include "bench/bench_embree.h"
#endif

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr std::uint32_t kPathDepth = 9;
constexpr std::uint32_t kVarianceWidth = 160;
constexpr std::uint32_t kVarianceHeight = 90;
constexpr std::uint32_t kVarianceSamples = 256;

/// Rays and their time.
struct Rays
{
    std::uint64_t count = 0;
    double ms = 0;

    [[nodiscard]] double nsEach() const { return count == 0 ? 0.0 : 1e6 * ms / static_cast<double>(count); }
    [[nodiscard]] double mraysPerSecond() const { return ms == 0.0 ? 0.0 : static_cast<double>(count) / ms / 1e3; }

    void add(const Rays& other)
    {
        count += other.count;
        ms += other.ms;
    }
};

/// What a sample costs on the device in both forms, and its rays in stages, and by Embree, one by one.
struct SpeedRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::uint64_t voxels = 0;
    Spread sample_ms;     // in stages
    Spread one_kernel_ms; // of a sample, too
    Rays all;             // in the time of whole samples, in stages
    Rays primary;
    Rays bounces;
    Rays shadows;
    double embree_bounces = 0; // Mrays/s; 0: not measured
};

/// The relative variance of a sample's luminance, mean over the pixels, by the way in which light is found.
struct VarianceRow
{
    std::string scene;
    std::string light;
    double chance = 0;
    double plain = 0;  // lights by their power, or directions evenly
    double chosen = 0; // as zvo does
};

const Columns<SpeedRow>& speedColumns()
{
    using Row = SpeedRow;
    const auto ratio = [](const Rays& rays, const Rays& primary)
    { return fmt::format("{:.0f} ({:.2f})", rays.nsEach(), rays.nsEach() / primary.nsEach()); };
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.resolution); }},
        {"voxels", 9, [](const Row& row) { return fmt::format("{}", row.voxels); }},
        {"sample ms", 21, [](const Row& row) { return spreadText(row.sample_ms); }},
        {"in one kernel", 21, [](const Row& row) { return spreadText(row.one_kernel_ms); }},
        {"Mrays/s in all", 14, [](const Row& row) { return fmt::format("{:.2f}", row.all.mraysPerSecond()); }},
        {"primary ns", 10, [](const Row& row) { return fmt::format("{:.0f}", row.primary.nsEach()); }},
        {"bounce ns", 12, [ratio](const Row& row) { return ratio(row.bounces, row.primary); }},
        {"shadow ns", 12, [ratio](const Row& row) { return ratio(row.shadows, row.primary); }},
        {"bounces, Mrays/s", 16, [](const Row& row) { return fmt::format("{:.2f}", row.bounces.mraysPerSecond()); }},
        {"Embree", 6,
         [](const Row& row) { return row.embree_bounces == 0 ? "-" : fmt::format("{:.2f}", row.embree_bounces); }},
    };
    return all;
}

const Columns<VarianceRow>& varianceColumns()
{
    using Row = VarianceRow;
    const auto times = [](double other, double own) { return fmt::format("{:.3g} ({:.1f}x)", other, other / own); };
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.scene; }},
        {"light", 24, [](const Row& row) { return row.light; }},
        {"as zvo does", 11, [](const Row& row) { return fmt::format("{:.3g}", row.chosen); }},
        {"by power, or evenly", 19, [times](const Row& row) { return times(row.plain, row.chosen); }},
        {"by chance", 18, [times](const Row& row) { return times(row.chance, row.chosen); }},
    };
    return all;
}

/// Measures pictures of one tree.
class PathBench
{
public:
    PathBench(vk::HeadlessDevice& device, const BenchPathOptions& options, const Scene& scene, std::string name,
              std::uint32_t depth)
        : m_device(device), m_options(options), m_name(std::move(name)), m_grid(Grid::around(scene.bounds(), depth))
    {
        const float emission_scale = brightestEmission(scene);
        const GpuScene gpu_scene = uploadScene(device, scene, options.attributes, emission_scale);
        m_tree = buildOctree(device, gpu_scene, m_grid, {options.coverage, options.attributes, {}}).octree;
        m_view = chooseCamera(options.camera, scene, subjectOf(scene.bounds(), m_grid),
                              static_cast<double>(options.width) / options.height);
    }

    SpeedRow measureSpeed()
    {
        SpeedRow row;
        row.scene = m_name;
        row.resolution = m_grid.resolution();
        row.voxels = m_tree.voxel_count;
        DeviceEnvironment sky(m_device.device());
        sky.setSun(daylight());
        const TraceCamera camera = traceCamera(m_view, m_grid, m_options.height);
        PathTracer tracer(m_device.device());
        PathTracer in_one_kernel(m_device.device());
        tracer.resize(m_options.width, m_options.height, PathForm::Stages);
        in_one_kernel.resize(m_options.width, m_options.height, PathForm::OneKernel);
        const PathOptions options;
        vk::BufferOf<gpu::DispatchArgs> lists(m_device.device(), "bench/lists", tracer.listElements(options));
        const auto sampleBy = [&](PathTracer& form, vk::BufferOf<gpu::DispatchArgs>* lists_of_sample)
        {
            return m_device.run([&](vk::FrameGraph& graph)
                                { form.addSample(graph, m_tree, sky, camera, options, lists_of_sample); });
        };
        std::vector<double> sample_ms;
        std::vector<double> one_kernel_ms;
        warmUp(m_device,
               [&] // the first samples make kernels, tables and lights
               {
                   sampleBy(tracer, nullptr);
                   sampleBy(in_one_kernel, nullptr);
               });
        for (std::uint32_t run = 0; run < m_options.run_count; ++run)
        {
            const std::vector<vk::PassTime> passes = sampleBy(tracer, &lists);
            const std::vector<vk::PassTime> one_kernel_passes = sampleBy(in_one_kernel, nullptr);
            sample_ms.push_back(sumMs(passes));
            one_kernel_ms.push_back(sumMs(one_kernel_passes));
            addRays(row, passes, m_device.download(lists), options.bounces);
        }
        row.sample_ms = Spread::of(sample_ms);
        row.one_kernel_ms = Spread::of(one_kernel_ms);
        row.all = row.primary;
        row.all.add(row.bounces);
        row.all.add(row.shadows);
        row.all.count /= m_options.run_count;
        row.all.ms = row.sample_ms.median;
#ifdef ZVO_EMBREE
        row.embree_bounces = measureEmbree(tracer, sky, camera);
#endif
        return row;
    }

    // Light of voxels alone: at night.
    std::optional<VarianceRow> measureVoxelLights()
    {
        if (!hasEmission(m_tree))
        {
            return std::nullopt;
        }
        DeviceEnvironment night(m_device.device(), HdrImage{1, 1, {glm::vec3(0.0F)}}, 0.0, 1.0);
        PathOptions by_power;
        by_power.lights_by_power = true;
        VarianceRow row = {m_name, fmt::format("{} emissive voxels", m_tree.emission.count())};
        const std::vector<Pixel> best = tracePixels(night, {});
        row.chosen = relativeVariance(best, best);
        row.plain = relativeVariance(tracePixels(night, by_power), best);
        row.chance = relativeVariance(tracePixels(night, {.sampling = LightSampling::Chance}), best);
        return row;
    }

    VarianceRow measureMap(const fs::path& file)
    {
        std::vector<std::string> warnings;
        const HdrImage map = decodeHdrImage(readFile(file), file.string(), warnings);
        DeviceEnvironment by_light(m_device.device(), map, 0.0, 1.0);
        DeviceEnvironment evenly(m_device.device(), map, 0.0, 1.0);
        evenly.chooseEvenly();
        VarianceRow row = {m_name, file.stem().string()};
        const std::vector<Pixel> best = tracePixels(by_light, {});
        row.chosen = relativeVariance(best, best);
        row.plain = relativeVariance(tracePixels(evenly, {}), best);
        row.chance = relativeVariance(tracePixels(by_light, {.sampling = LightSampling::Chance}), best);
        return row;
    }

private:
    // Adds the rays of a sample, whose passes of trace/rays stand in the order of batches, then of bounces: rays, then
    // shadow rays.
    static void addRays(SpeedRow& row, const std::vector<vk::PassTime>& passes,
                        const std::vector<gpu::DispatchArgs>& lists, std::uint32_t bounces)
    {
        const std::uint32_t passes_of_batch = 2 * bounces + 1;
        const std::uint64_t elements_of_batch = std::uint64_t{bounces + 2} * gpu::kListElements;
        const auto lengthOf = [&](std::uint32_t batch, std::uint32_t bounce, std::uint32_t list) -> std::uint64_t
        {
            const auto* words = reinterpret_cast<const gpu::uint*>(
                &lists.at(batch * elements_of_batch + std::uint64_t{bounce} * gpu::kListElements + gpu::kListLengths));
            return words[list];
        };
        std::uint32_t number = 0;
        for (const vk::PassTime& pass : passes)
        {
            if (pass.name != "trace/rays")
            {
                continue;
            }
            const std::uint32_t batch = number / passes_of_batch;
            const std::uint32_t bounce = number % passes_of_batch / 2;
            const bool is_shadow = number % passes_of_batch % 2 == 1;
            ++number;
            Rays& rays = is_shadow ? row.shadows : bounce == 0 ? row.primary : row.bounces;
            rays.add({lengthOf(batch, bounce, is_shadow ? gpu::kListShadows : gpu::kListPaths), pass.ms});
        }
        if (number * elements_of_batch != passes_of_batch * lists.size())
        {
            throw Error(ErrorCode::Other, "a grid has more levels than are counted");
        }
    }

    /// A pixel's mean luminance, and the variance of a sample.
    struct Pixel
    {
        double mean = 0;
        double variance = 0;
    };

    std::vector<Pixel> tracePixels(DeviceEnvironment& light, const PathOptions& options)
    {
        PathTracer tracer(m_device.device());
        tracer.resize(kVarianceWidth, kVarianceHeight);
        const TraceCamera camera = traceCamera(m_view, m_grid, kVarianceHeight);
        for (std::uint32_t i = 0; i < kVarianceSamples; ++i)
        {
            m_device.run([&](vk::FrameGraph& graph) { tracer.addSample(graph, m_tree, light, camera, options); });
        }
        std::vector<Pixel> pixels;
        for (const gpu::PixelSum& sum : m_device.download(tracer.picture().sums))
        {
            const double mean =
                glm::dot(glm::dvec3(sum.radiance), glm::dvec3(0.2126, 0.7152, 0.0722)) / kVarianceSamples;
            pixels.push_back({mean, std::max(double{sum.luminance_squared} / kVarianceSamples - mean * mean, 0.0)});
        }
        return pixels;
    }

    // The mean over all pixels of the variance over the square of the pixel's luminance in the best picture, to which a
    // hundredth of the picture's is added.
    static double relativeVariance(const std::vector<Pixel>& pixels, const std::vector<Pixel>& best)
    {
        double mean = 0;
        for (const Pixel& pixel : best)
        {
            mean += pixel.mean / static_cast<double>(best.size());
        }
        double sum = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i)
        {
            sum += pixels[i].variance / (best[i].mean * best[i].mean + 0.01 * mean * mean);
        }
        return sum / static_cast<double>(pixels.size());
    }

#ifdef ZVO_EMBREE
    // Traces the rays of all bounces by Embree, one by one, and returns their rate.
    double measureEmbree(PathTracer& tracer, DeviceEnvironment& sky, const TraceCamera& camera)
    {
        std::vector<PrimaryRay> rays;
        const float t_min = 1e-3F / static_cast<float>(m_grid.rootResolution()); // behind the face where it starts
        for (std::uint32_t bounce = 1; bounce <= PathOptions().bounces; ++bounce)
        {
            m_device.run([&](vk::FrameGraph& graph)
                         { tracer.addSample(graph, m_tree, sky, camera, {.bounces = bounce}); });
            const std::vector<gpu::Ray> traced = m_device.download(tracer.rays(bounce));
            const std::vector<gpu::DispatchArgs> lists = m_device.download(tracer.lists());
            const auto* words = reinterpret_cast<const gpu::uint*>(
                &lists[std::size_t{bounce} * gpu::kListElements + gpu::kListLengths]);
            for (std::uint32_t i = 0; i < words[gpu::kListPaths]; ++i)
            {
                rays.push_back({traced[i].origin, 1.0F / traced[i].inverse_direction, t_min});
            }
        }
        const EmbreeScene voxels = EmbreeScene::ofVoxels(m_grid, voxelCodes(m_device, m_tree));
        voxels.trace(rays, 1);
        return static_cast<double>(rays.size()) / voxels.trace(rays, 1).seconds / 1e6;
    }
#endif

    vk::HeadlessDevice& m_device;
    const BenchPathOptions& m_options;
    std::string m_name;
    Grid m_grid;
    DeviceTree m_tree;
    ViewCamera m_view;
};

std::string pathTableHead(const vk::DeviceReport& device, const BenchPathOptions& options)
{
    return fmt::format(
        "zvo {} on {} ({}, {}). A sample is a path of {} bounces for each of {} x {} pixels; GPU milliseconds, medians "
        "of {} runs, in stages and in one kernel. A ray's time is that of trace/rays alone, without beam; beside it, "
        "the ratio to primary rays. Embree traces the same rays of bounces through the same voxels, one by one, on all "
        "processors.\n",
        ZVO_VERSION_TEXT, device.name, device.type, device.driver, PathOptions().bounces, options.width, options.height,
        options.run_count);
}

Json raysJson(const Rays& rays)
{
    return {{"count", rays.count}, {"ns_each", rays.nsEach()}, {"mrays_per_s", rays.mraysPerSecond()}};
}

Json pathReportJson(const vk::DeviceReport& device, const BenchPathOptions& options, const std::vector<SpeedRow>& speed,
                    const std::vector<VarianceRow>& variances)
{
    Json json = headJson("zvo.bench_path/1", device);
    json["coverage"] = coverageName(options.coverage);
    json["runs"] = options.run_count;
    json["width"] = options.width;
    json["height"] = options.height;
    json["rows"] = Json::array();
    for (const SpeedRow& row : speed)
    {
        json["rows"].push_back({{"scene", row.scene},
                                {"resolution", row.resolution},
                                {"voxels", row.voxels},
                                {"sample_ms", spreadJson(row.sample_ms)},
                                {"one_kernel_ms", spreadJson(row.one_kernel_ms)},
                                {"all", raysJson(row.all)},
                                {"primary", raysJson(row.primary)},
                                {"bounces", raysJson(row.bounces)},
                                {"shadows", raysJson(row.shadows)},
                                {"embree_bounces_mrays_per_s", row.embree_bounces}});
    }
    json["variances"] = Json::array();
    for (const VarianceRow& row : variances)
    {
        json["variances"].push_back({{"scene", row.scene},
                                     {"light", row.light},
                                     {"chosen", row.chosen},
                                     {"plain", row.plain},
                                     {"chance", row.chance}});
    }
    return json;
}

} // namespace

void benchPath(const BenchPathOptions& options)
{
    const std::vector<fs::path> paths = benchScenes(options);
    const std::vector<std::uint32_t> depths = options.depths.value_or(std::vector{kPathDepth});
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::vector<SpeedRow> speed;
    std::vector<VarianceRow> variances;
    Progress progress(paths.size() * depths.size() * (2 + options.environments.size()));
    for (const fs::path& path : paths)
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        for (const std::uint32_t depth : depths)
        {
            PathBench bench(device, options, scene, path.stem().string(), depth);
            progress.begin(fmt::format("{}: speed", path.stem().string()));
            speed.push_back(bench.measureSpeed());
            progress.begin(fmt::format("{}: variance", path.stem().string()));
            if (const std::optional<VarianceRow> row = bench.measureVoxelLights())
            {
                variances.push_back(*row);
            }
            for (const fs::path& map : options.environments)
            {
                progress.begin(fmt::format("{}: {}", path.stem().string(), map.stem().string()));
                variances.push_back(bench.measureMap(map));
            }
        }
    }
    clearProgressBar();
    if (options.output.json != "-")
    {
        std::string text = pathTableHead(device.device().report(), options) + "\n" + columnNames(speedColumns());
        for (const SpeedRow& row : speed)
        {
            text += columnValues(speedColumns(), row);
        }
        text += fmt::format("\nVariance of a sample's luminance over the square of its mean, mean over {} x {} pixels "
                            "of {} samples.\n\n{}",
                            kVarianceWidth, kVarianceHeight, kVarianceSamples, columnNames(varianceColumns()));
        for (const VarianceRow& row : variances)
        {
            text += columnValues(varianceColumns(), row);
        }
        Output("-", true).write(text);
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, pathReportJson(device.device().report(), options, speed, variances));
    }
}

} // namespace zvo::cli
