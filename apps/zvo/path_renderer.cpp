// SPDX-License-Identifier: MIT
#include "path_renderer.h"

#include "common/output.h"
#include "core/base/read_file.h"
#include "core/path/aov.h"
#include "core/path/daylight.h"
#include "io/image/hdr_image_io.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <chrono>
#include <numbers>
#include <string>
#include <utility>

namespace zvo::cli
{

namespace
{

// Of "none", a map without light.
HdrImage readMap(const std::filesystem::path& file)
{
    if (file == "none")
    {
        return {1, 1, {glm::vec3(0.0F)}};
    }
    std::vector<std::string> warnings;
    HdrImage map = decodeHdrImage(readFile(file), file.string(), warnings);
    for (const std::string& warning : warnings)
    {
        talk("warning: " + warning);
    }
    return map;
}

// Limits a map, so that its light stays in range when it is multiplied by strength.
void limit(HdrImage& map, float strength)
{
    const float most = kRadianceMax / strength;
    std::uint64_t count = 0; // of brighter texels
    for (glm::vec3& texel : map.texels)
    {
        const glm::vec3 limited = glm::min(texel, most);
        count += limited == texel ? 0 : 1;
        texel = limited;
    }
    if (count != 0)
    {
        talk(fmt::format("warning: --environment-strength {:g} brings {} of the map above {:g}; they are taken as that",
                         strength, count == 1 ? "1 texel" : fmt::format("{} texels", count), kRadianceMax));
    }
}

DeviceEnvironment makeEnvironment(vk::HeadlessDevice& device, const RenderOptions& options)
{
    const PathRenderOptions& paths = options.paths;
    const Sun sun = options.to_sun ? daylight(*options.to_sun) : daylight();
    if (!paths.environment)
    {
        DeviceEnvironment environment(device.device());
        environment.setSun(sun);
        return environment;
    }
    HdrImage map = readMap(*paths.environment);
    limit(map, paths.environment_strength);
    DeviceEnvironment environment(device.device(), map, paths.environment_turn * std::numbers::pi / 180.0,
                                  double{paths.environment_strength});
    if (options.to_sun)
    {
        environment.setSun(sun);
    }
    return environment;
}

} // namespace

PathRenderer::PathRenderer(vk::HeadlessDevice& device, const RenderOptions& options)
    : m_device(device), m_options(options), m_tracer(device.device()), m_environment(makeEnvironment(device, options))
{
    if (options.paths.denoise)
    {
        m_denoiser.emplace(device.device());
    }
}

std::vector<std::uint8_t> PathRenderer::render(const DeviceTree& tree, const ViewCamera& view, Progress& progress,
                                               std::vector<vk::PassTime>& passes)
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const PathRenderOptions& paths = m_options.paths;
    const TraceCamera camera = traceCamera(view, tree.grid, m_options.height);
    m_camera_before = std::exchange(m_camera, camera);
    setSize();
    m_tracer.forget();
    PathOptions path = paths.path;
    path.features = paths.denoise || paths.aovs;
    path.reseeds = paths.denoise; // earlier pictures help if they have other noise
    if (!m_watch)
    {
        m_watch.emplace();
        if (paths.environment == "none" && !m_options.to_sun && !hasEmission(tree))
        {
            talk("warning: nothing gives off light: the scene has no emissive voxels, --environment is none, and there "
                 "is no --sun");
        }
    }
    std::uint32_t samples = 0;
    const auto goesOn = [&]
    {
        const std::chrono::duration<double> seconds = Clock::now() - begin;
        return samples == 0 || (samples < paths.samples && !interrupted() &&
                                (!paths.time_limit || seconds.count() < *paths.time_limit));
    };
    while (goesOn())
    {
        const std::vector<vk::PassTime> sample =
            m_device.run([&](vk::FrameGraph& graph) { m_tracer.addSample(graph, tree, m_environment, camera, path); });
        passes.insert(passes.end(), sample.begin(), sample.end());
        ++samples;
        progress.within(static_cast<double>(samples) / paths.samples,
                        fmt::format("{}/{} samples", samples, paths.samples));
    }
    if (m_tracer.sampleCount() < paths.samples)
    {
        talk(fmt::format("stopped after {} of {} samples a pixel", m_tracer.sampleCount(), paths.samples));
    }
    return encode(paths.denoise ? denoise(passes) : m_tracer.picture(), tree.grid);
}

void PathRenderer::setSize()
{
    const std::optional<PathForm>& form = m_options.paths.form;
    try
    {
        m_tracer.resize(m_options.width, m_options.height, form);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        const bool in_stages = form.value_or(pathFormOn(m_device.device())) == PathForm::Stages;
        throw Error(ErrorCode::Memory,
                    fmt::format("a picture of {} x {} pixels (--size) is too large for path tracing: {}, or make a "
                                "smaller picture{}",
                                m_options.width, m_options.height, error.what(),
                                in_stages ? ", or choose --path-form kernel, which needs less" : ""));
    }
}

SampledPicture PathRenderer::denoise(std::vector<vk::PassTime>& passes)
{
    constexpr std::uint32_t kHistory = 8; // earlier pictures that count
    m_denoiser->resize(m_options.width, m_options.height);
    const std::vector<vk::PassTime> denoising =
        m_device.run([&](vk::FrameGraph& graph)
                     { m_denoiser->denoise(graph, m_tracer.guided(), kHistory * m_tracer.sampleCount()); });
    passes.insert(passes.end(), denoising.begin(), denoising.end());
    return m_denoiser->picture();
}

std::vector<std::uint8_t> PathRenderer::encode(const SampledPicture& picture, const Grid& grid)
{
    const std::string extension = extensionOf(m_options.output.path);
    if (extension == ".exr" || extension == ".hdr")
    {
        const HdrImage image =
            pictureOf(m_device.download(picture.sums), picture.width, picture.height, picture.sample_count);
        return extension == ".hdr"    ? encodeHdr(image)
               : m_options.paths.aovs ? encodeWithAovs(image, grid)
                                      : encodeExr(image);
    }
    const Exposure exposure = {!m_options.exposure.has_value(), m_options.exposure.value_or(1.0F)};
    vk::BufferOf<gpu::uint> image(m_device.device(), "picture", std::uint64_t{m_options.width} * m_options.height);
    Developer developer(m_device.device());
    m_device.run([&](vk::FrameGraph& graph)
                 { developer.develop(graph, picture, TexelFormat::Rgba8, exposure, image); });
    m_exposure = m_device.download(developer.exposure()).front();
    const std::vector<gpu::uint> texels = m_device.download(image);
    return encodePng(m_options.width, m_options.height,
                     {reinterpret_cast<const std::uint8_t*>(texels.data()), texels.size() * sizeof(gpu::uint)});
}

std::vector<std::uint8_t> PathRenderer::encodeWithAovs(const HdrImage& image, const Grid& grid)
{
    const GuidedPicture guided = m_tracer.guided();
    const AovImages aovs =
        aovsOf(m_device.download(guided.features), image.width, image.height, guided.picture.sample_count, grid,
               guided.camera, m_camera_before.value_or(guided.camera));
    std::vector<ExrChannel> channels = {{"depth.Z", aovs.depth.data()}};
    const auto add = [&](const std::string& layer, const char* names, const float* values, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            channels.push_back({layer + '.' + names[i], values + i, count});
        }
    };
    add("albedo", "RGB", &aovs.albedo.front().x, 3);
    add("normal", "XYZ", &aovs.normal.front().x, 3);
    add("motion", "XY", &aovs.motion.front().x, 2);
    return encodeExr(image, channels);
}

std::uint64_t PathRenderer::cappedRays()
{
    return m_device.download(m_tracer.status()).front().capped_rays;
}

} // namespace zvo::cli
