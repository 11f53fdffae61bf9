// SPDX-License-Identifier: MIT
#include "renderer.h"

#include "common/environment_input.h"
#include "common/output.h"
#include "common/report.h"
#include "core/path/aov.h"
#include "io/image/hdr_image_io.h"
#include "io/image/image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace zvo::cli
{

namespace
{

// Time of the passes up to the last primary rays. Later passes compute light and colour.
double primaryMs(const std::vector<vk::PassTime>& passes)
{
    double ms = 0;
    double ms_until_primary = 0;
    for (const vk::PassTime& pass : passes)
    {
        ms += pass.ms;
        if (pass.name == "trace/primary" || pass.name == "trace/primary_ranks" || pass.name == "trace/ranks")
        {
            ms_until_primary = ms;
        }
    }
    return ms_until_primary;
}

void append(std::vector<vk::PassTime>& passes, const std::vector<vk::PassTime>& more)
{
    passes.insert(passes.end(), more.begin(), more.end());
}

// What the options say in other places than FrameOptions.
FrameOptions frameOptions(const RenderOptions& options)
{
    constexpr std::uint32_t kHistory = 8; // earlier pictures that count
    FrameOptions frame = options.frame;
    frame.antialias = options.sampleCount() > 1 || holdsRadiance(options.output.path);
    frame.trace.to_sun = options.to_sun.value_or(frame.trace.to_sun);
    frame.path.features = options.aovs;
    frame.history_max = kHistory * options.sampleCount();
    frame.radiance.seed = frame.path.seed;
    return frame;
}

} // namespace

Renderer::Renderer(vk::HeadlessDevice& device, const RenderOptions& options)
    : m_device(device), m_options(options), m_frame(frameOptions(options)), m_renderer(device.device())
{
    if (options.frame.integrator != Integrator::Primary)
    {
        m_environment = readEnvironment(device.device(), options.environment, options.to_sun);
    }
}

std::vector<vk::PassTime> Renderer::show(const DeviceTree& tree)
{
    m_tree = &tree;
    if (m_frame.integrator != Integrator::Primary)
    {
        return {};
    }
    setSize();
    return m_device.run([&](vk::FrameGraph& graph) { m_renderer.prepare(graph, tree); });
}

void Renderer::setSize()
{
    try
    {
        m_renderer.resize(m_options.width, m_options.height);
        m_renderer.reserve(*m_tree, m_frame);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        const bool in_stages = m_frame.integrator == Integrator::Path &&
                               m_frame.path_form.value_or(pathFormOn(m_device.device())) == PathForm::Stages;
        throw Error(ErrorCode::Memory,
                    fmt::format("a picture of {} x {} pixels (--size) is too large: {}, or make a smaller picture{}",
                                m_options.width, m_options.height, error.what(),
                                in_stages ? ", or choose --path-form kernel, which needs less" : ""));
    }
}

std::vector<std::uint8_t> Renderer::render(const ViewCamera& view, Progress& progress, PictureTimes& times)
{
    m_camera_before = std::exchange(m_camera, traceCamera(view, m_tree->grid, m_options.height));
    if (m_frame.hasSamples())
    {
        if (std::optional<std::vector<std::uint8_t>> picture = renderSamplesOrWarn(progress, times))
        {
            return std::move(*picture);
        }
        m_frame.integrator = Integrator::Primary;
        m_frame.antialias = false;
        m_renderer.dropSamples();
        show(*m_tree);
    }
    return renderAtOnce(times);
}

FrameSubject Renderer::subject()
{
    return {*m_tree, *m_camera, m_environment ? &*m_environment : nullptr};
}

std::vector<std::uint8_t> Renderer::renderAtOnce(PictureTimes& times)
{
    times.passes = m_device.run([&](vk::FrameGraph& graph) { m_renderer.render(graph, subject(), m_frame); });
    times.trace_ms = primaryMs(times.passes);
    times.shade_ms = sumMs(times.passes) - times.trace_ms;
    m_capped_rays += m_device.download(m_renderer.buffers().status).front().capped_rays;
    return encodePicture();
}

// The picture whose light is computed by samples; nothing, with a warning, if there is no room for a radiance
// cache.
std::optional<std::vector<std::uint8_t>> Renderer::renderSamplesOrWarn(Progress& progress, PictureTimes& times)
{
    try
    {
        return renderSamples(progress, times);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory || !usesCache(m_frame.integrator) ||
            extensionOf(m_options.output.path) != ".png")
        {
            throw;
        }
        talk(fmt::format("warning: no radiance cache, and pictures are by --integrator primary: {}", error.what()));
        times = {};
        return std::nullopt;
    }
}

std::vector<std::uint8_t> Renderer::renderSamples(Progress& progress, PictureTimes& times)
{
    const Clock::time_point begin = Clock::now();
    setSize();
    if (!m_watch)
    {
        m_watch.emplace();
        if (m_environment && m_options.environment.map == "none" && !m_options.to_sun && !hasEmission(*m_tree))
        {
            talk("warning: nothing gives off light: the scene has no emissive voxels, --environment is none, and there "
                 "is no --sun");
        }
        settle(progress, times);
    }
    addSamples(begin, progress, times);
    if (m_frame.denoise)
    {
        append(times.passes, m_device.run([&](vk::FrameGraph& graph) { m_renderer.denoise(graph, m_frame); }));
    }
    times.trace_ms = sumMs(times.passes);
    if (m_frame.integrator != Integrator::Primary)
    {
        const auto& status = usesCache(m_frame.integrator) ? m_renderer.cache().status() : m_renderer.pathStatus();
        m_capped_rays = m_device.download(status).front().capped_rays; // of all pictures so far
    }
    return encodeSamples(times);
}

// Brings the radiance cache up to date before the first picture.
void Renderer::settle(Progress& progress, PictureTimes& times)
{
    const std::uint32_t count = usesCache(m_frame.integrator) ? m_options.settle : 0;
    for (std::uint32_t frame = 0; frame < count && !interrupted(); ++frame)
    {
        append(times.passes,
               m_device.run([&](vk::FrameGraph& graph) { m_renderer.settle(graph, subject(), m_frame); }));
        progress.within(static_cast<double>(frame + 1) / (count + m_options.sampleCount()),
                        fmt::format("light settles, {}/{} frames", frame + 1, count));
    }
}

// begin: of the picture, from which the time limit counts.
void Renderer::addSamples(Clock::time_point begin, Progress& progress, PictureTimes& times)
{
    const std::uint32_t asked = m_options.sampleCount();
    const auto goesOn = [&]
    {
        const std::chrono::duration<double> seconds = Clock::now() - begin;
        const bool has_time = !m_options.time_limit || seconds.count() < *m_options.time_limit;
        return times.samples == 0 || (times.samples < asked && !interrupted() && has_time);
    };
    m_renderer.beginPicture(m_frame);
    while (goesOn())
    {
        append(times.passes,
               m_device.run([&](vk::FrameGraph& graph) { m_renderer.addSample(graph, subject(), m_frame); }));
        if (m_frame.integrator == Integrator::Primary)
        {
            m_capped_rays += m_device.download(m_renderer.buffers().status).front().capped_rays;
        }
        ++times.samples;
        progress.within(static_cast<double>(times.samples) / asked, fmt::format("{}/{} samples", times.samples, asked));
    }
    if (times.samples < asked)
    {
        talk(fmt::format("stopped after {} of {} samples a pixel", times.samples, asked));
    }
}

std::vector<std::uint8_t> Renderer::encodePicture()
{
    const TraceBuffers& buffers = m_renderer.buffers();
    const std::vector<gpu::uint> texels = m_device.download(buffers.image);
    return encodePng(buffers.width, buffers.height,
                     {reinterpret_cast<const std::uint8_t*>(texels.data()), texels.size() * sizeof(gpu::uint)});
}

std::vector<std::uint8_t> Renderer::encodeSamples(PictureTimes& times)
{
    if (holdsRadiance(m_options.output.path))
    {
        const SampledPicture picture = m_renderer.samples(m_frame);
        const HdrImage image =
            pictureOf(m_device.download(picture.sums), picture.width, picture.height, picture.sample_count);
        return extensionOf(m_options.output.path) == ".hdr" ? encodeHdr(image)
               : m_options.aovs                             ? encodeWithAovs(image)
                                                            : encodeExr(image);
    }
    m_device.run([&](vk::FrameGraph& graph) { m_renderer.develop(graph, m_frame); });
    times.exposure = m_device.download(m_renderer.exposure()).front();
    m_frame.exposure = {.automatic = false, .factor = *times.exposure}; // of a sequence, which would flicker otherwise
    return encodePicture();
}

std::vector<std::uint8_t> Renderer::encodeWithAovs(const HdrImage& image)
{
    const GuidedPicture guided = m_renderer.guided();
    const AovImages aovs =
        aovsOf(m_device.download(guided.features), image.width, image.height, guided.picture.sample_count, m_tree->grid,
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

} // namespace zvo::cli
