// SPDX-License-Identifier: MIT
#include "bench/bench_cache.h"

#include "bench/bench_runs.h"
#include "bench/bench_scenes.h"
#include "bench/cache_motion.h"
#include "bench/lit_scenes.h"
#include "bench/picture_quality.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "core/frame/frame_renderer.h"
#include "core/path/path_tracer.h"
#include "core/trace/tree_tracer.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kCacheDepth = 8;
constexpr std::uint32_t kPictureFrames = 16; // of a picture by the radiance cache

/// A picture beside the reference.
struct CacheRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::string light;
    std::string integrator;
    std::uint32_t count = 0; // paths a pixel, or frames before the picture
    std::optional<PictureQuality> quality;
    std::optional<double> noise;          // error of the reference
    double frame_ms = 0;                  // median of a sample or frame
    double total_ms = 0;                  // of all before the picture
    std::optional<double> paths_of_error; // a pixel that path tracing needs for the same error
    std::optional<double> of_their_time;  // total_ms beside that of these paths
    std::optional<double> bytes_of_voxel; // that are kept
};

const Columns<CacheRow>& cacheColumns()
{
    using Row = CacheRow;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.resolution); }},
        {"light", 5, [](const Row& row) { return row.light; }},
        {"integrator", 10, [](const Row& row) { return row.integrator; }},
        {"samples", 7, [](const Row& row) { return fmt::format("{}", row.count); }},
        {"error %", 7,
         [](const Row& row) { return row.quality ? fmt::format("{:.2f}", 100.0 * row.quality->relative) : "-"; }},
        {"noise %", 7, [](const Row& row) { return row.noise ? fmt::format("{:.2f}", 100.0 * *row.noise) : "-"; }},
        {"PSNR dB", 7, [](const Row& row) { return row.quality ? fmt::format("{:.2f}", row.quality->psnr_db) : "-"; }},
        {"SSIM", 6, [](const Row& row) { return row.quality ? fmt::format("{:.4f}", row.quality->ssim) : "-"; }},
        {"FLIP", 6, [](const Row& row) { return row.quality ? fmt::format("{:.4f}", row.quality->flip) : "-"; }},
        {"frame ms", 8, [](const Row& row) { return fmt::format("{:.1f}", row.frame_ms); }},
        {"total ms", 8, [](const Row& row) { return fmt::format("{:.0f}", row.total_ms); }},
        {"as paths", 8, [](const Row& row) { return cellText(row.paths_of_error, 0); }},
        {"of their time", 13, [](const Row& row) { return cellText(row.of_their_time, 3); }},
        {"bytes a voxel", 13, [](const Row& row) { return cellText(row.bytes_of_voxel, 1); }},
    };
    return all;
}

double medianOf(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.empty() ? 0.0 : *middle;
}

double totalOf(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Makes pictures of one scene by one light.
class CacheBench
{
public:
    CacheBench(vk::HeadlessDevice& device, const LitScene& scene, const BenchCacheOptions& options)
        : m_device(device), m_scene(scene), m_width(options.width), m_height(options.height),
          m_cache_options({.faces = options.faces}), m_camera(traceCamera(scene.view, scene.tree.grid, m_height))
    {
    }

    template <typename Told> HdrImage reference(std::uint32_t samples, const Told& told)
    {
        PathTracer tracer(m_device.device());
        tracer.resize(m_width, m_height);
        const std::uint32_t half_samples = samples / 2;
        HdrImage half;
        for (std::uint32_t i = 0; i < samples; ++i)
        {
            addPath(tracer, {.bounces = kReferenceBounces, .seed = 1});
            if (i + 1 == half_samples)
            {
                half = imageOf(tracer.picture());
            }
            told(i + 1);
        }
        HdrImage reference = imageOf(tracer.picture());
        if (half_samples != 0)
        {
            // The two halves of an even number of samples are twice as far apart as the whole is from either, and that
            // as far as it is from what it would become.
            m_noise = meanOf(relativeErrors(reference, half)) *
                      std::sqrt(static_cast<double>(half_samples) / (samples - half_samples));
        }
        return reference;
    }

    /// Primary rays with a ray to the sun.
    CacheRow primary()
    {
        TreeTracer tracer(m_device.device());
        tracer.resize(m_width, m_height);
        std::vector<double> ms;
        const auto trace = [&] {
            return m_device.run([&](vk::FrameGraph& graph)
                                { tracer.trace(graph, m_scene.tree, m_camera, TraceOptions()); });
        };
        warmUp(m_device, trace); // and makes the node paths
        for (std::uint32_t run = 0; run < 7; ++run)
        {
            ms.push_back(sumMs(trace()));
        }
        CacheRow row = rowOf("primary", 1);
        row.frame_ms = medianOf(ms);
        row.total_ms = row.frame_ms;
        return row;
    }

    std::vector<CacheRow> paths(const HdrImage& reference, std::span<const std::uint32_t> counts)
    {
        PathTracer tracer(m_device.device());
        tracer.resize(m_width, m_height);
        std::vector<CacheRow> rows;
        std::vector<double> ms;
        for (const std::uint32_t count : counts)
        {
            while (ms.size() < count)
            {
                ms.push_back(addPath(tracer, {.bounces = kReferenceBounces}));
            }
            CacheRow row = rowOf("path", count);
            row.quality = compareTo(reference, imageOf(tracer.picture()));
            row.noise = m_noise;
            row.frame_ms = medianOf(ms);
            row.total_ms = totalOf(ms);
            rows.push_back(row);
        }
        return rows;
    }

    /// The radiance cache after so many frames, on the faces that are seen and through cones: both pictures are of
    /// the same frames.
    std::vector<CacheRow> cached(const HdrImage& reference, std::span<const std::uint32_t> counts, const CacheRow& path)
    {
        const FrameOptions options = {
            .integrator = Integrator::Cache, .radiance = m_cache_options, .shading = Shading::Faces}; // as paths
        FrameRenderer tracer(m_device.device());
        tracer.resize(m_width, m_height);
        RadianceView cones(m_device.device(), m_width, m_height);
        std::vector<CacheRow> rows;
        std::vector<double> ms;
        const auto addFrame = [&]
        {
            return m_device.run(
                [&](vk::FrameGraph& graph) {
                    tracer.addSample(graph, {m_scene.tree, m_camera, &m_scene.light}, options);
                });
        };
        for (const std::uint32_t count : counts)
        {
            while (ms.size() < count)
            {
                ms.push_back(sumMs(addFrame()));
            }
            std::vector<double> cone_ms;
            const double settled_ms = totalOf(ms);
            tracer.beginPicture(options);
            cones.begin();
            for (std::uint32_t frame = 0; frame < kPictureFrames; ++frame)
            {
                const std::vector<vk::PassTime> passes = addFrame();
                ms.push_back(sumMs(passes));
                cone_ms.push_back(sumMs(passes) - sumOfViews(passes) + addCones(tracer, cones));
            }
            CacheRow row = rowOf("cache", count);
            row.frame_ms = medianOf(ms);
            row.total_ms = totalOf(ms);
            compareCached(row, reference, tracer.samples(options), path, tracer.cache());
            rows.push_back(row);
            row = rowOf("cones", count);
            row.frame_ms = medianOf(cone_ms);
            row.total_ms = settled_ms + totalOf(cone_ms);
            compareCached(row, reference, cones.picture(), path, tracer.cache());
            rows.push_back(row);
        }
        return rows;
    }

private:
    static constexpr std::uint32_t kReferenceBounces = 32;

    [[nodiscard]] CacheRow rowOf(std::string_view integrator, std::uint32_t count) const
    {
        CacheRow row;
        row.scene = m_scene.name;
        row.resolution = m_scene.tree.grid.resolution();
        row.light = m_scene.light_name;
        row.integrator = integrator;
        row.count = count;
        return row;
    }

    // Compares a row, of which the times are known.
    void compareCached(CacheRow& row, const HdrImage& reference, const SampledPicture& picture, const CacheRow& path,
                       const DeviceRadianceCache& cache)
    {
        row.quality = compareTo(reference, imageOf(picture));
        row.noise = m_noise;
        // An estimate: the error of paths falls with the square root of their number, and those of a picture and of
        // the reference are independent, so that their squares add up.
        const double square = std::pow(row.quality->relative, 2.0) - std::pow(m_noise.value_or(0.0), 2.0);
        const double path_square = std::pow(path.quality->relative, 2.0) - std::pow(m_noise.value_or(0.0), 2.0);
        if (square > 0.0 && path_square > 0.0)
        {
            row.paths_of_error = path.count * path_square / square;
            row.of_their_time = row.total_ms / (*row.paths_of_error * path.frame_ms);
        }
        row.bytes_of_voxel = static_cast<double>(cache.bytes()) / static_cast<double>(m_scene.tree.voxel_count);
    }

    // Adds what cones see in the tracer's last frame. Returns the milliseconds.
    double addCones(FrameRenderer& tracer, RadianceView& cones)
    {
        const TraceCamera through = shifted(m_camera, pointOfPixel(cones.frameCount()));
        return sumMs(m_device.run(
            [&](vk::FrameGraph& graph) {
                cones.add(graph, tracer.cache(), m_scene.tree, m_scene.light, through, tracer.buffers(),
                          CacheView::Cones);
            }));
    }

    // Of the passes that add what is seen to a picture.
    static double sumOfViews(const std::vector<vk::PassTime>& passes)
    {
        double sum = 0.0;
        for (const vk::PassTime& pass : passes)
        {
            sum += pass.name == "radiance/view" || pass.name == "radiance/direct" ? pass.ms : 0.0;
        }
        return sum;
    }

    double addPath(PathTracer& tracer, const PathOptions& options)
    {
        return sumMs(m_device.run([&](vk::FrameGraph& graph)
                                  { tracer.addSample(graph, m_scene.tree, m_scene.light, m_camera, options); }));
    }

    HdrImage imageOf(const SampledPicture& picture)
    {
        return pictureOf(m_device.download(picture.sums), picture.width, picture.height, picture.sample_count);
    }

    vk::HeadlessDevice& m_device;
    const LitScene& m_scene;
    std::uint32_t m_width;
    std::uint32_t m_height;
    std::optional<double> m_noise; // of the reference
    RadianceOptions m_cache_options;
    TraceCamera m_camera;
};

Json cacheReportJson(const vk::DeviceReport& device, const BenchCacheOptions& options,
                     const std::vector<CacheRow>& rows, std::span<const MotionResult> motion)
{
    Json json = headJson("zvo.bench_cache/1", device);
    json["width"] = options.width;
    json["height"] = options.height;
    json["reference_samples"] = options.reference_samples;
    json["faces_of_frame"] = options.faces;
    json["picture_frames"] = kPictureFrames;
    json["rows"] = Json::array();
    for (const CacheRow& row : rows)
    {
        Json entry = {{"scene", row.scene},           {"resolution", row.resolution}, {"light", row.light},
                      {"integrator", row.integrator}, {"samples", row.count},         {"frame_ms", row.frame_ms},
                      {"total_ms", row.total_ms}};
        if (row.quality)
        {
            entry["relative_error"] = row.quality->relative;
            entry["reference_error"] = row.noise ? Json(*row.noise) : Json(nullptr);
            entry["psnr_db"] = row.quality->psnr_db;
            entry["ssim"] = row.quality->ssim;
            entry["flip"] = row.quality->flip;
        }
        if (row.paths_of_error)
        {
            entry["paths_of_error"] = *row.paths_of_error;
        }
        if (row.of_their_time)
        {
            entry["of_their_time"] = *row.of_their_time;
        }
        if (row.bytes_of_voxel)
        {
            entry["bytes_of_voxel"] = *row.bytes_of_voxel;
        }
        json["rows"].push_back(std::move(entry));
    }
    json["motion"] = motionJson(motion);
    return json;
}

std::string cacheTable(const vk::DeviceReport& device, const BenchCacheOptions& options,
                       const std::vector<CacheRow>& rows, std::span<const MotionResult> motion)
{
    std::string text =
        fmt::format("zvo {} on {} ({}, {}). Pictures of {} x {} pixels beside one of {} paths a pixel with another "
                    "seed. The radiance cache samples {} faces a frame.\n\n",
                    ZVO_VERSION_TEXT, device.name, device.type, device.driver, options.width, options.height,
                    options.reference_samples, options.faces);
    if (!rows.empty())
    {
        text += fmt::format("A picture of it is {} frames behind those that are named; through cones, of the same "
                            "frames. GPU milliseconds.\n\n{}",
                            kPictureFrames, columnNames(cacheColumns()));
        for (const CacheRow& row : rows)
        {
            text += columnValues(cacheColumns(), row);
        }
    }
    if (!motion.empty())
    {
        text += fmt::format("{}{}", rows.empty() ? "" : "\n", motionText(motion));
    }
    return text;
}

} // namespace

void benchCache(const BenchCacheOptions& options)
{
    constexpr std::array<std::uint32_t, 3> kPathCounts = {1, 4, 16};
    constexpr std::array<std::uint32_t, 3> kFrameCounts = {16, 64, 256};
    const std::vector<std::uint32_t> depths = {kCacheDepth};
    std::optional<Output> report = openReport(options.output);
    BenchCacheOptions still = options;
    still.scenes = benchScenes(options, true);
    std::vector<std::filesystem::path> scene_files;
    std::ranges::copy_if(still.scenes, std::back_inserter(scene_files), isSceneFile);
    std::erase_if(still.scenes, isSceneFile);
    const std::vector<MovingScene> moving = loadMovingScenes(options, scene_files);
    const bool has_still = !still.scenes.empty(); // else it would be the usual ones
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::vector<CacheRow> rows;
    Progress progress((has_still ? litSceneCount(still, depths) : 0) + motionCount(options, moving));
    const auto measureStill = [&](LitScene& scene)
    {
        progress.begin(fmt::format("{} by {}", scene.name, scene.light_name));
        CacheBench bench(device, scene, options);
        const HdrImage reference =
            bench.reference(options.reference_samples, [&](std::uint32_t samples)
                            { progress.within(static_cast<double>(samples) / options.reference_samples); });
        rows.push_back(bench.primary());
        const std::vector<CacheRow> paths = bench.paths(reference, kPathCounts);
        rows.insert(rows.end(), paths.begin(), paths.end());
        const std::vector<CacheRow> cached = bench.cached(reference, kFrameCounts, paths.back());
        rows.insert(rows.end(), cached.begin(), cached.end());
    };
    if (has_still)
    {
        forEachLitScene(device, still, depths, static_cast<double>(options.width) / options.height, measureStill);
    }
    const std::vector<MotionResult> motion = measureMotion(device, options, moving, kCacheDepth, progress);
    clearProgressBar();
    if (options.output.json != "-")
    {
        Output("-", true).write(cacheTable(device.device().report(), options, rows, motion));
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, cacheReportJson(device.device().report(), options, rows, motion));
    }
}

} // namespace zvo::cli
