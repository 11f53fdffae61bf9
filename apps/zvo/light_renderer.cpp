// SPDX-License-Identifier: MIT
#include "light_renderer.h"

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

LightRenderer::LightRenderer(vk::HeadlessDevice& device, const RenderOptions& options)
    : m_device(device), m_options(options), m_tracer(device.device()), m_environment(makeEnvironment(device, options))
{
    if (keepsLight(options.integrator))
    {
        m_kept.emplace(device.device());
    }
    if (options.paths.denoise)
    {
        m_denoiser.emplace(device.device());
    }
}

RadianceOptions LightRenderer::keptOptions() const
{
    RadianceOptions kept = m_options.kept.radiance;
    kept.seed = m_options.paths.path.seed;
    return kept;
}

// Records a sample of the picture.
void LightRenderer::addSample(vk::FrameGraph& graph, const DeviceTree& tree)
{
    if (m_kept)
    {
        const bool is_cones = m_options.integrator == Integrator::Cones;
        m_kept->addFrame(graph, tree, m_environment, *m_camera, keptOptions(),
                         is_cones ? KeptView::Cones : KeptView::Faces);
        return;
    }
    PathOptions path = m_options.paths.path;
    path.features = m_options.paths.denoise || m_options.paths.aovs;
    path.reseeds = m_options.paths.denoise; // earlier pictures help if they have other noise
    m_tracer.addSample(graph, tree, m_environment, *m_camera, path);
}

// Brings the light that is kept on voxels up to date before the first picture.
void LightRenderer::settle(const DeviceTree& tree, Progress& progress, std::vector<vk::PassTime>& passes)
{
    const std::uint32_t count = m_options.kept.settle;
    for (std::uint32_t frame = 0; frame < count && !interrupted(); ++frame)
    {
        const std::vector<vk::PassTime> times = m_device.run(
            [&](vk::FrameGraph& graph) { m_kept->settle(graph, tree, m_environment, *m_camera, keptOptions()); });
        passes.insert(passes.end(), times.begin(), times.end());
        progress.within(static_cast<double>(frame + 1) / (count + m_options.sampleCount()),
                        fmt::format("light settles, {}/{} frames", frame + 1, count));
    }
}

std::vector<std::uint8_t> LightRenderer::render(const DeviceTree& tree, const ViewCamera& view, Progress& progress,
                                                std::vector<vk::PassTime>& passes)
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const PathRenderOptions& paths = m_options.paths;
    const std::uint32_t asked = m_options.sampleCount();
    m_camera_before = std::exchange(m_camera, traceCamera(view, tree.grid, m_options.height));
    setSize();
    m_tracer.forget();
    const bool is_first = !m_watch;
    if (is_first)
    {
        m_watch.emplace();
        if (paths.environment == "none" && !m_options.to_sun && !hasEmission(tree))
        {
            talk("warning: nothing gives off light: the scene has no emissive voxels, --environment is none, and there "
                 "is no --sun");
        }
    }
    if (m_kept)
    {
        if (is_first)
        {
            settle(tree, progress, passes);
        }
        m_kept->beginPicture();
    }
    std::uint32_t samples = 0;
    const auto goesOn = [&]
    {
        const std::chrono::duration<double> seconds = Clock::now() - begin;
        return samples == 0 ||
               (samples < asked && !interrupted() && (!paths.time_limit || seconds.count() < *paths.time_limit));
    };
    while (goesOn())
    {
        const std::vector<vk::PassTime> sample = m_device.run([&](vk::FrameGraph& graph) { addSample(graph, tree); });
        passes.insert(passes.end(), sample.begin(), sample.end());
        ++samples;
        progress.within(static_cast<double>(samples) / asked, fmt::format("{}/{} samples", samples, asked));
    }
    if (sampleCount() < asked)
    {
        talk(fmt::format("stopped after {} of {} samples a pixel", sampleCount(), asked));
    }
    return encode(paths.denoise ? denoise(passes) : picture(), tree.grid);
}

void LightRenderer::setSize()
{
    const std::optional<PathForm>& form = m_options.paths.form;
    try
    {
        if (m_kept)
        {
            m_kept->resize(m_options.width, m_options.height);
            return;
        }
        m_tracer.resize(m_options.width, m_options.height, form);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        if (m_kept)
        {
            throw Error(ErrorCode::Memory, fmt::format("a picture of {} x {} pixels (--size) is too large: {}, or make "
                                                       "a smaller picture",
                                                       m_options.width, m_options.height, error.what()));
        }
        const bool in_stages = form.value_or(pathFormOn(m_device.device())) == PathForm::Stages;
        throw Error(ErrorCode::Memory,
                    fmt::format("a picture of {} x {} pixels (--size) is too large for path tracing: {}, or make a "
                                "smaller picture{}",
                                m_options.width, m_options.height, error.what(),
                                in_stages ? ", or choose --path-form kernel, which needs less" : ""));
    }
}

SampledPicture LightRenderer::denoise(std::vector<vk::PassTime>& passes)
{
    constexpr std::uint32_t kHistory = 8; // earlier pictures that count
    m_denoiser->resize(m_options.width, m_options.height);
    const std::vector<vk::PassTime> denoising =
        m_device.run([&](vk::FrameGraph& graph)
                     { m_denoiser->denoise(graph, m_tracer.guided(), kHistory * m_tracer.sampleCount()); });
    passes.insert(passes.end(), denoising.begin(), denoising.end());
    return m_denoiser->picture();
}

std::vector<std::uint8_t> LightRenderer::encode(const SampledPicture& picture, const Grid& grid)
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

std::vector<std::uint8_t> LightRenderer::encodeWithAovs(const HdrImage& image, const Grid& grid)
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

std::uint64_t LightRenderer::cappedRays()
{
    return m_device.download(m_kept ? m_kept->cache().status() : m_tracer.status()).front().capped_rays;
}

} // namespace zvo::cli
