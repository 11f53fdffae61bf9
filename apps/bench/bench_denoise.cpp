// SPDX-License-Identifier: MIT
#include "bench/bench_denoise.h"

#include "bench/lit_scenes.h"
#include "bench/picture_quality.h"
#include "bench/table.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "core/base/kernels.h"
#include "core/denoise/denoiser.h"
#include "core/path/path_tracer.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kDenoiseDepth = 7;
constexpr std::uint32_t kDenoiseWidth = 320;
constexpr std::uint32_t kDenoiseHeight = 180;

/// A picture beside the reference.
struct DenoiseRow
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::string light;
    std::uint32_t samples = 0; // a pixel
    bool is_denoised = false;
    PictureQuality quality;
    double ms = 0; // of all samples
    double denoise_ms = 0;
};

const Columns<DenoiseRow>& denoiseColumns()
{
    using Row = DenoiseRow;
    static const Columns<Row> all = {
        {"scene", 12, [](const Row& row) { return row.scene; }},
        {"resolution", 10, [](const Row& row) { return fmt::format("{}", row.resolution); }},
        {"light", 5, [](const Row& row) { return row.light; }},
        {"samples", 7, [](const Row& row) { return fmt::format("{}", row.samples); }},
        {"denoised", 8, [](const Row& row) { return row.is_denoised ? "yes" : "no"; }},
        {"PSNR dB", 7, [](const Row& row) { return fmt::format("{:.2f}", row.quality.psnr_db); }},
        {"SSIM", 6, [](const Row& row) { return fmt::format("{:.4f}", row.quality.ssim); }},
        {"samples ms", 10, [](const Row& row) { return fmt::format("{:.0f}", row.ms); }},
        {"denoise ms", 10,
         [](const Row& row) { return row.is_denoised ? fmt::format("{:.0f}", row.denoise_ms) : "-"; }},
    };
    return all;
}

/// Traces pictures of one tree from one place, by one light.
class DenoiseBench
{
public:
    DenoiseBench(vk::HeadlessDevice& device, const LitScene& scene)
        : m_device(device), m_tree(scene.tree), m_camera(traceCamera(scene.view, scene.tree.grid, kDenoiseHeight)),
          m_light(scene.light), m_tracer(device.device()), m_denoiser(device.device())
    {
        m_tracer.resize(kDenoiseWidth, kDenoiseHeight);
        m_denoiser.resize(kDenoiseWidth, kDenoiseHeight);
    }

    /// told: called with the number of samples so far.
    template <typename Told> HdrImage traceReference(std::uint32_t samples, const Told& told)
    {
        for (std::uint32_t i = 0; i < samples; ++i)
        {
            addSample({.seed = 1});
            told(i + 1);
        }
        return imageOf(m_tracer.picture());
    }

    /// The qualities of pictures after each of the numbers of samples, with and without denoising.
    std::vector<DenoiseRow> measure(const HdrImage& reference, std::span<const std::uint32_t> counts)
    {
        m_tracer.forget();
        std::vector<DenoiseRow> rows;
        DenoiseRow row;
        for (std::uint32_t count : counts)
        {
            while (row.samples < count)
            {
                row.ms += addSample({.features = true});
                ++row.samples;
            }
            row.is_denoised = false;
            row.quality = compareTo(reference, imageOf(m_tracer.picture()));
            rows.push_back(row);
            m_denoiser.forget();
            row.is_denoised = true;
            row.denoise_ms =
                sumMs(m_device.run([&](vk::FrameGraph& graph) { m_denoiser.denoise(graph, m_tracer.guided(), 0); }));
            row.quality = compareTo(reference, imageOf(m_denoiser.picture()));
            rows.push_back(row);
        }
        return rows;
    }

private:
    double addSample(const PathOptions& options)
    {
        return sumMs(m_device.run([&](vk::FrameGraph& graph)
                                  { m_tracer.addSample(graph, m_tree, m_light, m_camera, options); }));
    }

    HdrImage imageOf(const SampledPicture& picture)
    {
        return pictureOf(m_device.download(picture.sums), picture.width, picture.height, picture.sample_count);
    }

    vk::HeadlessDevice& m_device;
    const DeviceTree& m_tree;
    TraceCamera m_camera;
    DeviceEnvironment& m_light;
    PathTracer m_tracer;
    Denoiser m_denoiser;
};

Json denoiseReportJson(const vk::DeviceReport& device, const BenchDenoiseOptions& options,
                       const std::vector<DenoiseRow>& rows)
{
    Json json = headJson("zvo.bench_denoise/1", device);
    json["width"] = kDenoiseWidth;
    json["height"] = kDenoiseHeight;
    json["reference_samples"] = options.reference_samples;
    json["rows"] = Json::array();
    for (const DenoiseRow& row : rows)
    {
        json["rows"].push_back({{"scene", row.scene},
                                {"resolution", row.resolution},
                                {"light", row.light},
                                {"samples", row.samples},
                                {"denoised", row.is_denoised},
                                {"psnr_db", row.quality.psnr_db},
                                {"ssim", row.quality.ssim},
                                {"samples_ms", row.ms},
                                {"denoise_ms", row.denoise_ms}});
    }
    return json;
}

std::string denoiseTable(const vk::DeviceReport& device, const BenchDenoiseOptions& options,
                         const std::vector<DenoiseRow>& rows)
{
    std::string text = fmt::format("zvo {} on {} ({}, {}). Pictures of {} x {} pixels beside one of {} samples with "
                                   "another seed, both tone-mapped "
                                   "with the exposure of that one. GPU milliseconds.\n\n{}",
                                   ZVO_VERSION_TEXT, device.name, device.type, device.driver, kDenoiseWidth,
                                   kDenoiseHeight, options.reference_samples, columnNames(denoiseColumns()));
    for (const DenoiseRow& row : rows)
    {
        text += columnValues(denoiseColumns(), row);
    }
    return text;
}

} // namespace

void benchDenoise(const BenchDenoiseOptions& options)
{
    constexpr std::array<std::uint32_t, 4> kCounts = {1, 4, 16, 64};
    const std::vector<std::uint32_t> depths = {kDenoiseDepth};
    std::optional<Output> report = openReport(options.output);
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::vector<DenoiseRow> rows;
    Progress progress(litSceneCount(options, depths));
    forEachLitScene(device, options, depths, double{kDenoiseWidth} / kDenoiseHeight,
                    [&](LitScene& scene)
                    {
                        progress.begin(fmt::format("{} by {}", scene.name, scene.light_name));
                        DenoiseBench bench(device, scene);
                        const HdrImage reference = bench.traceReference(
                            options.reference_samples, [&](std::uint32_t samples)
                            { progress.within(static_cast<double>(samples) / options.reference_samples); });
                        for (DenoiseRow& row : bench.measure(reference, kCounts))
                        {
                            row.scene = scene.name;
                            row.resolution = scene.tree.grid.resolution();
                            row.light = scene.light_name;
                            rows.push_back(std::move(row));
                        }
                    });
    clearProgressBar();
    if (options.output.json != "-")
    {
        Output("-", true).write(denoiseTable(device.device().report(), options, rows));
    }
    checkValidation(device);
    if (report)
    {
        writeReport(*report, denoiseReportJson(device.device().report(), options, rows));
    }
}

} // namespace zvo::cli
