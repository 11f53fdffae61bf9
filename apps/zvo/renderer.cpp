// SPDX-License-Identifier: MIT
#include "renderer.h"

#include "common/environment_input.h"
#include "common/focus.h"
#include "common/output.h"
#include "common/picture_file.h"
#include "common/report.h"
#include "core/base/color_word.h"
#include "core/path/aov.h"
#include "io/image/hdr_image_io.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kPage = kOpaque | 48U * 0x10101U; // what a sheet shows where it has no view

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

void PictureTimes::add(PictureTimes&& part)
{
    append(passes, part.passes);
    trace_ms += part.trace_ms;
    shade_ms += part.shade_ms;
    samples = samples == 0 ? part.samples : std::min(samples, part.samples);
    exposure = exposure ? exposure : part.exposure;
    focus = focus ? focus : part.focus;
}

Renderer::Renderer(vk::HeadlessDevice& device, const RenderOptions& options)
    : m_device(device), m_options(options), m_layout(layoutOf(options)), m_frame(frameOptions(options)),
      m_renderer(device.device())
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
        m_renderer.resize(m_layout.width, m_layout.height);
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

Picture Renderer::render(std::span<const ViewCamera> views, Progress& progress, PictureTimes& times)
{
    if (views.size() == 1)
    {
        return renderView(views.front(), progress, times);
    }
    Picture sheet = {m_options.width, m_options.height, {}, {}};
    sheet.texels.assign(std::size_t{sheet.width} * sheet.height, kPage);
    for (std::uint32_t i = 0; i < views.size(); ++i)
    {
        PictureTimes view_times;
        placeView(m_layout, i, renderView(views[i], progress, view_times), sheet);
        times.add(std::move(view_times));
        m_renderer.forgetSamples(); // another view has none that help to denoise
    }
    return sheet;
}

Picture Renderer::renderView(const ViewCamera& view, Progress& progress, PictureTimes& times)
{
    m_camera_before = std::exchange(m_camera, traceCamera(view, m_tree->grid, m_layout.height));
    if (m_frame.hasSamples())
    {
        if (std::optional<Picture> picture = renderSamplesOrWarn(progress, times))
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

Picture Renderer::renderAtOnce(PictureTimes& times)
{
    times.passes = m_device.run([&](vk::FrameGraph& graph) { m_renderer.render(graph, subject(), m_frame); });
    times.trace_ms = primaryMs(times.passes);
    times.shade_ms = sumMs(times.passes) - times.trace_ms;
    m_capped_rays += m_device.download(m_renderer.buffers().status).front().capped_rays;
    return downloadPicture();
}

// The picture whose light is computed by samples; nothing, with a warning, if there is no room for a radiance
// cache.
std::optional<Picture> Renderer::renderSamplesOrWarn(Progress& progress, PictureTimes& times)
{
    try
    {
        return renderSamples(progress, times);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory || !usesCache(m_frame.integrator) || holdsRadiance(m_options.output.path))
        {
            throw;
        }
        talk(fmt::format("warning: no radiance cache, and pictures are by --integrator primary: {}", error.what()));
        times = {};
        return std::nullopt;
    }
}

Picture Renderer::renderSamples(Progress& progress, PictureTimes& times)
{
    const Clock::time_point begin = Clock::now();
    setSize();
    if (!m_watch)
    {
        m_watch.emplace();
        warnOfDarkness();
    }
    if (m_settled_views < m_layout.view_count)
    {
        settle(progress, times);
        ++m_settled_views;
    }
    focus(times);
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
    return downloadSamples(times);
}

void Renderer::warnOfDarkness()
{
    if (m_environment && m_options.environment.map == "none" && !m_options.to_sun && !hasEmission(*m_tree))
    {
        talk("warning: nothing gives off light: the scene has no emissive voxels, --environment is none, and there "
             "is no --sun");
    }
}

// Where the camera has a lens and nobody said what is sharp, it is what is at the middle of the picture.
void Renderer::focus(PictureTimes& times)
{
    if (m_frame.integrator != Integrator::Path || m_frame.path.lens_radius == 0.0F)
    {
        return;
    }
    times.focus = m_options.focus ? m_options.focus : distanceAtMiddle(m_device, *m_tree, *m_camera);
    if (!times.focus)
    {
        times.focus = m_tree->grid.voxel_size * static_cast<float>(m_tree->grid.resolution());
        talk(fmt::format("warning: nothing is at the picture's middle; sharp is what is {:g} away, as --focus can say",
                         *times.focus));
    }
    m_frame.path.focus_distance = *times.focus;
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
        tellRun(fmt::format("stopped after {} of {} samples a pixel", times.samples, asked));
    }
}

Picture Renderer::downloadPicture()
{
    const TraceBuffers& buffers = m_renderer.buffers();
    return {buffers.width, buffers.height, m_device.download(buffers.image), {}};
}

Picture Renderer::downloadSamples(PictureTimes& times)
{
    if (holdsRadiance(m_options.output.path))
    {
        const SampledPicture picture = m_renderer.samples(m_frame);
        const HdrImage image =
            pictureOf(m_device.download(picture.sums), picture.width, picture.height, picture.sample_count);
        return {image.width,
                image.height,
                {},
                m_options.aovs ? encodeWithAovs(image) : encodeRadiance(m_options.output.path, image)};
    }
    m_device.run([&](vk::FrameGraph& graph) { m_renderer.develop(graph, m_frame); });
    times.exposure = m_device.download(m_renderer.exposure()).front();
    m_frame.exposure = {.automatic = false, .factor = *times.exposure}; // of a sequence, which would flicker otherwise
    return downloadPicture();
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
