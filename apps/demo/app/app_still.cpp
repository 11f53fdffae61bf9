// SPDX-License-Identifier: MIT
// App: a picture that stands still. It is traced in full size, sample by sample, and then the window rests. A sample
// may take seconds: it is made in short submissions, between which frames show the last picture under live panels.
#include "demo/app/app.h"

#include "common/progress.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo::demo
{

namespace
{

constexpr double kSliceMs = 30;       // of a sample, between looks at the user's input
constexpr double kRefreshSeconds = 1; // between frames while nothing happens but samples
constexpr double kRestSeconds = 1;    // between looks at a window in which nothing happens
constexpr double kFadingSeconds = 0.1;
constexpr double kLoadingSeconds = 0.04; // between frames that show nothing but progress
constexpr int kFramesAfterInput = 3;     // until panels have settled

// The user has changed the picture that is being made.
struct Abandoned
{
};

} // namespace

// In which a still picture is traced.
PictureSize App::fullSize() const
{
    return scaledSize(m_window.framebufferSize(), m_view.internal_scale.value_or(1.0));
}

PictureState App::pictureState() const
{
    PictureState state = {m_camera.camera(),
                          m_view.frame,
                          m_window.framebufferSize(),
                          fullSize(),
                          m_world->scene.tree().version,
                          m_world->scene.moves() ? worldSeconds() : 0.0,
                          m_renderer.skyVersion(),
                          hasSun()};
    state.options.exposure = {};
    state.options.denoise = false;
    return state;
}

// Whether paths and cached light have a sun.
bool App::hasSun() const
{
    return m_has_map ? m_view.map_sun : m_view.frame.trace.shadows;
}

// Whether frames must follow each other, whatever they show.
bool App::moves() const
{
    return m_editor.wantsFrames() || m_world->scene.hasRequests() || m_flight.records();
}

// Seconds to wait for input before the next frame.
double App::restSeconds() const
{
    const bool is_scripted = m_replay || m_options.frame_count;
    if (m_is_first_world)
    {
        return m_makes_world ? 0 : kLoadingSeconds;
    }
    const bool rests = m_is_refined && !m_quits && m_redraws == 0 && m_refinement.isStill() && isRefinedEnough();
    if (is_scripted || !rests)
    {
        return 0;
    }
    return m_notices.all().empty() && m_loading == nullptr ? kRestSeconds : kFadingSeconds;
}

bool App::isRefinedEnough() const
{
    return m_renderer.sampleCount() >= Refinement::samplesOf(m_refined.options) && m_refined.options == m_developed;
}

// Panels are drawn anew.
void App::noteRedraw()
{
    m_redraws = std::max(m_redraws, kFramesAfterInput);
}

void App::drawStill()
{
    if (!m_is_refined && !beginStill())
    {
        return drawLive();
    }
    if (m_renderer.sampleCount() < Refinement::samplesOf(m_refined.options) || !m_has_samples)
    {
        addSample();
    }
    else
    {
        develop();
        inspectStill();
    }
    if (m_is_refined && (m_redraws > 0 || wantsScreenshot()))
    {
        m_redraws = std::max(m_redraws - 1, 0);
        drawKept();
    }
}

// Makes the buffers of the full size, and keeps what was shown until now. Returns whether there is memory for them.
bool App::beginStill()
{
    finishAll();
    const double scale = internalScale();
    const std::uint32_t live_samples = m_renderer.sampleCount();
    m_refined = pictureIn(fullSize());
    m_refined.options.antialias = true;
    try
    {
        m_device.run([&](vk::FrameGraph& graph) { m_renderer.keepPicture(graph); });
        m_renderer.reserve(m_world->scene.tree(), m_refined);
    }
    catch (const Error& error)
    {
        refuseStill(error);
        return false;
    }
    const bool is_path = m_refined.options.shownIntegrator() == Integrator::Path;
    m_shown_from = is_path ? Refinement::samplesLike(live_samples, scale) : 1;
    m_renderer.beginPicture();
    m_has_samples = false;
    m_is_refined = true;
    measure(true);
    return true;
}

// Without memory for the full size the picture stays as it is while the camera moves. Throws other errors again.
void App::refuseStill(const Error& error)
{
    if (error.code() != ErrorCode::Memory)
    {
        throw;
    }
    cli::talkError(error);
    m_is_refined = false;
    m_refinement.refuse();
}

// Takes the options of development that the user has chosen. Without memory to denoise, that choice is taken back.
void App::takeDevelopment()
{
    m_refined.options.exposure = m_view.frame.exposure;
    if (std::exchange(m_refined.options.denoise, m_view.frame.denoise) == m_view.frame.denoise)
    {
        return;
    }
    try
    {
        m_renderer.reserve(m_world->scene.tree(), m_refined);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        cli::talk(fmt::format("warning: no denoising: {}", error.what()));
        m_view.frame.denoise = m_refined.options.denoise = false;
    }
}

void App::addSample()
{
    takeDevelopment();
    FrameInFlight frame = tracingFrame();
    Picture picture = m_refined;
    picture.probe = frame.looks.probe.get();
    picture.ray_lists = frame.ray_lists.get();
    std::vector<vk::PassTime> passes;
    const auto sample = [&](vk::FrameGraph& graph)
    {
        m_renderer.recordSample(graph, m_world->scene.tree(), picture);
        if (m_renderer.sampleCount() >= m_shown_from)
        {
            m_renderer.keepPicture(graph);
        }
        graph.releaseToHost();
    };
    try
    {
        m_is_within = true;
        m_device.withPauses([this] { frameWithin(); }, kSliceMs, [&] { passes = m_device.run(sample); });
        m_is_within = false;
    }
    catch (const Abandoned&)
    {
        // A sample that is not finished is forgotten, with those before it.
        m_is_within = false;
        m_is_refined = false;
        m_wants_focus = m_wants_focus || frame.looks.focus;
        return;
    }
    catch (const Error& error)
    {
        m_is_within = false;
        refuseStill(error);
        m_renderer.forget();
        return;
    }
    m_has_samples = true;
    m_developed = m_refined.options;
    answer(frame.looks);
    m_stats.addPasses(passes, frame.rays());
    m_redraws = std::max(m_redraws, 2); // now, and when panels know of the sample
}

// Shows the samples with other options of their development.
void App::develop()
{
    takeDevelopment();
    if (m_refined.options == m_developed)
    {
        return;
    }
    m_device.run(
        [&](vk::FrameGraph& graph)
        {
            m_renderer.recordDevelopment(graph, m_refined.options);
            m_renderer.keepPicture(graph);
        });
    m_developed = m_refined.options;
    m_redraws = std::max(m_redraws, 1);
}

// Looks at the pixels that panels and tools ask for, after input.
void App::inspectStill()
{
    if (m_redraws == 0)
    {
        return;
    }
    FrameLooks looks = takeLooks();
    if (looks.probe != nullptr)
    {
        Picture picture = m_refined;
        picture.probe = looks.probe.get();
        m_device.run(
            [&](vk::FrameGraph& graph)
            {
                m_renderer.recordProbe(graph, m_world->scene.tree(), picture);
                graph.releaseToHost();
            });
    }
    answer(looks);
}

// Calls the action now, or after the sample that is being made.
void App::whenFree(std::function<void()> action)
{
    if (m_is_within)
    {
        m_when_free.push_back(std::move(action));
    }
    else
    {
        action();
    }
}

// Of which times are shown.
void App::measure(bool still)
{
    const std::tuple measured = {m_view.frame.shownIntegrator(), m_view.frame.trace.view, still};
    if (m_measured != measured && !m_options.fixed_step)
    {
        m_stats = {};
    }
    m_measured = measured;
}

// Between two submissions of a sample.
void App::frameWithin()
{
    beginFrame(0);
    advanceTime();
    abandonIfChanged();
    if (m_redraws == 0 && m_since_redraw < kRefreshSeconds && m_notices.all().empty())
    {
        return;
    }
    m_redraws = std::max(m_redraws - 1, 0);
    m_since_redraw = 0;
    while (m_frames_in_flight.size() >= framesInFlight())
    {
        finishOldest();
    }
    buildPanels();
    abandonIfChanged();
    const PictureSize size = m_window.framebufferSize();
    if (size.width != 0 && size.height != 0)
    {
        drawKept();
    }
    countFrame();
}

// Light that is kept goes on from its last frame, so a frame of it is not left unfinished.
void App::abandonIfChanged()
{
    const bool can_abandon = !usesCache(m_refined.options.shownIntegrator());
    if (can_abandon && (m_quits || moves() || m_refinement.differs(pictureState())))
    {
        throw Abandoned();
    }
}

} // namespace zvo::demo
