// SPDX-License-Identifier: MIT
// App: recording and submitting frames, and reading their results.
#include "demo/app/app.h"

#include "common/progress.h"
#include "common/report.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace zvo::demo
{

namespace
{

using Milliseconds = std::chrono::duration<double, std::milli>;

} // namespace

// Whether the frame is the last one, of which the command line wants a screenshot.
bool App::isLastPicture() const
{
    return m_options.frame_count && m_frame + 1 == *m_options.frame_count && m_screenshot_output != nullptr;
}

bool App::wantsScreenshot() const
{
    return m_wanted_screenshot || isLastPicture();
}

std::unique_ptr<Screenshot> App::takeScreenshot(PictureSize size)
{
    if (isLastPicture())
    {
        return std::make_unique<Screenshot>(m_device.device(), size, std::move(m_screenshot_output), true);
    }
    const std::optional<bool> wanted = std::exchange(m_wanted_screenshot, std::nullopt);
    return wanted ? std::make_unique<Screenshot>(m_device.device(), size, nullptr, *wanted) : nullptr;
}

void App::draw()
{
    const PictureSize size = m_window.framebufferSize();
    if (size.width == 0 || size.height == 0)
    {
        return;
    }
    if (m_is_first_world)
    {
        return drawKept();
    }
    if (m_options.fixed_step)
    {
        // Waits, so that this frame does not depend on which frames the device has completed.
        finishAll();
        m_world->scene.settle(worldSeconds());
        return drawLive();
    }
    m_refinement.show(pictureState(), moves(), m_frame_seconds);
    if (!m_refinement.isStill() || !m_has_traced)
    {
        drawLive();
    }
    else if (!m_makes_world)
    {
        drawStill();
    }
    else if (m_is_refined)
    {
        drawKept();
    }
    else
    {
        drawLive();
    }
}

Picture App::pictureIn(PictureSize traced)
{
    Picture picture;
    picture.camera = m_camera.camera();
    picture.options = m_view.frame;
    picture.has_sun = hasSun();
    if (!m_options.fixed_step)
    {
        // So that denoising can begin and end without other samples.
        picture.options.path.features = true;
        picture.options.path.reseeds = true;
    }
    picture.size = traced;
    picture.window = m_window.framebufferSize();
    return picture;
}

// What reads the results of a picture for which reserve() was called.
App::FrameInFlight App::tracingFrame()
{
    FrameInFlight frame;
    frame.looks = takeLooks();
    if (const std::uint64_t elements = m_renderer.rayListElements(); elements != 0)
    {
        frame.ray_lists = std::make_unique<vk::BufferOf<gpu::DispatchArgs>>(m_device.device(), "ray lists", elements,
                                                                            vk::MemoryKind::Readback);
    }
    frame.primary_ray_count = m_renderer.rayCount();
    frame.integrator = m_renderer.integrator();
    return frame;
}

// A frame that traces the picture.
void App::drawLive()
{
    Picture picture = pictureIn(scaledSize(m_window.framebufferSize(), internalScale()));
    if (!prepare(picture))
    {
        return;
    }
    FrameInFlight frame = tracingFrame();
    picture.probe = frame.looks.probe.get();
    picture.ray_lists = frame.ray_lists.get();
    frame.internal_scale = internalScale();
    m_is_refined = false;
    m_has_traced = true;
    m_renderer.showTraced();
    measure(false);
    const auto trace = [&](vk::FrameGraph& graph)
    {
        m_world->scene.update(graph, worldSeconds());
        picture.edited = m_world->scene.isEdited();
        m_renderer.recordPicture(graph, m_world->scene.tree(), picture);
    };
    frame.world_frame = m_world->scene.beginFrame();
    try
    {
        present(std::move(frame), trace);
    }
    catch (...)
    {
        m_world->scene.frameLost();
        m_renderer.forget();
        throw;
    }
}

// A frame that shows the last picture that was kept.
void App::drawKept()
{
    m_renderer.beginFrame(m_drawn_count, composition());
    present({}, [](vk::FrameGraph&) {});
}

// What the window shows around a picture, but for what only present() knows.
Composition App::composition()
{
    Composition composition;
    composition.window = m_window.framebufferSize();
    composition.encodes_srgb = vk::encodesSrgb(m_swapchain.format());
    if (m_panels.shows_panels || m_has_overlay)
    {
        composition.panels = [this](VkCommandBuffer commands) { m_ui.draw(commands); };
    }
    return composition;
}

// Submits a frame: what `trace` records, and the window's contents. A failure ends the program: the window's image
// cannot be presented any more.
void App::present(FrameInFlight frame, const std::function<void(vk::FrameGraph&)>& trace)
{
    Composition composition = this->composition();
    frame.is_last_picture = m_screenshot_output != nullptr;
    frame.screenshot = takeScreenshot(composition.window);
    frame.is_last_picture = frame.is_last_picture && m_screenshot_output == nullptr;
    if (frame.screenshot != nullptr)
    {
        composition.screenshot = &frame.screenshot->pixels();
        composition.screenshot_has_panels = frame.screenshot->hasPanels() && m_panels.shows_panels;
    }
    frame.number = m_drawn_count;
    // Nothing that may fail stands between acquiring an image and the submission that waits for it.
    const std::optional<vk::SwapchainImage> target =
        m_swapchain.acquire({composition.window.width, composition.window.height}, m_drawn_count);
    composition.target = target ? &*target : nullptr;
    vk::SubmitSync sync;
    if (target)
    {
        sync = {target->available, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, target->presentable};
    }
    const bool is_read = frame.screenshot != nullptr || frame.looks.probe != nullptr || frame.ray_lists != nullptr;
    frame.submission = m_device.submit(
        [&](vk::FrameGraph& graph)
        {
            trace(graph);
            m_renderer.recordFrame(graph, composition);
            if (is_read)
            {
                graph.releaseToHost();
            }
        },
        sync);
    m_frames_in_flight.push_back(std::move(frame));
    if (target)
    {
        m_swapchain.present(*target);
    }
    ++m_drawn_count;
}

// Makes buffers for the picture. Without memory for them the picture is left out; for the first one that is an error.
bool App::prepare(const Picture& picture)
{
    try
    {
        m_renderer.beginFrame(m_drawn_count, composition());
        m_renderer.reserve(m_world->scene.tree(), picture);
        m_lacks_memory = false;
        return true;
    }
    catch (const Error& error)
    {
        if (error.code() == ErrorCode::Memory && usesCache(picture.options.shownIntegrator()))
        {
            m_view.frame.integrator = Integrator::Primary; // from the next frame on
            cli::talk(fmt::format("warning: no radiance cache: {}", error.what()));
            return false;
        }
        if (error.code() != ErrorCode::Memory || !m_has_traced)
        {
            throw;
        }
        if (!std::exchange(m_lacks_memory, true))
        {
            cli::talkError(error);
        }
        return false;
    }
}

void App::finishOldest()
{
    FrameInFlight frame = std::move(m_frames_in_flight.front());
    m_frames_in_flight.pop_front();
    const std::vector<vk::PassTime> passes = frame.submission.wait();
    if (frame.world_frame)
    {
        m_world->scene.frameDone(*frame.world_frame, passes);
        m_stats.addPasses(passes, frame.rays());
        if (m_ladder && frame.internal_scale == m_ladder->scale())
        {
            m_ladder->add(scalingMs(passes));
        }
    }
    m_renderer.frameDone(frame.number);
    m_swapchain.frameDone(frame.number);
    if (!m_first_frame_ms)
    {
        m_first_frame_ms = Milliseconds(Clock::now() - m_start).count();
    }
    answer(frame.looks);
    if (frame.screenshot != nullptr)
    {
        keep(frame);
    }
}

// Writes a screenshot. That one fails which a key asked for is no reason to end.
void App::keep(const FrameInFlight& frame)
{
    try
    {
        const std::string name = frame.screenshot->write();
        if (!name.empty())
        {
            note("screenshot " + name);
        }
    }
    catch (const Error& error)
    {
        if (frame.is_last_picture)
        {
            throw;
        }
        cli::talkError(error);
    }
}

void App::finishAll()
{
    while (!m_frames_in_flight.empty())
    {
        finishOldest();
    }
}

MemoryUse App::memoryUse()
{
    const vk::MemoryAllocator& memory = m_device.device().memory();
    const StaticInfo& fixed = m_world->scene.info().fixed;
    return {fixed.geometry_bytes, fixed.attribute_bytes, m_renderer.pictureBytes(), memory.usedBytes(),
            memory.heldBytes()};
}

void App::writeStats()
{
    if (m_stats_output == nullptr)
    {
        return;
    }
    cli::Json json = cli::headJson("zvo.demo/1", m_device.device().report());
    json["frames"] = m_frame;
    json["frames_drawn"] = m_drawn_count;
    json["first_frame_ms"] = m_first_frame_ms ? cli::Json(*m_first_frame_ms) : cli::Json(nullptr);
    const auto timesOf = [](const History& history) {
        return cli::Json{{"mean_ms", history.mean()}, {"p95_ms", history.p95()}};
    };
    json["frame"] = timesOf(m_stats.frameMs());
    json["gpu"] = timesOf(m_stats.gpuMs());
    json["mrays_per_second"] = m_stats.megaraysPerSecond();
    json["internal_scale"] = m_is_refined ? m_view.internal_scale.value_or(1.0) : internalScale();
    json["swapchains"] = m_swapchain.generation();
    json["passes"] = cli::Json::array();
    for (const std::string& name : m_stats.names())
    {
        cli::Json pass = {{"name", name}};
        pass.update(timesOf(m_stats.pass(name)));
        json["passes"].push_back(std::move(pass));
    }
    const DeviceTree& tree = m_world->scene.tree();
    const StaticInfo& fixed = m_world->scene.info().fixed;
    json["scene"] = {{"name", m_world->name},
                     {"seconds", worldSeconds()},
                     {"structure", structureName(tree.structure)},
                     {"resolution", tree.grid.resolution()},
                     {"voxels", fixed.voxel_count},
                     {"nodes", fixed.node_count},
                     {"movers", m_world->scene.animated().objects.size()}};
    const MemoryUse memory = memoryUse();
    json["bytes"] = {{"geometry", memory.geometry},
                     {"attributes", memory.attributes},
                     {"pictures", memory.pictures},
                     {"used", memory.used},
                     {"peak", m_device.device().memory().peakBytes()},
                     {"held", memory.held}};
    cli::writeReport(*m_stats_output, json);
}

} // namespace zvo::demo
