// SPDX-License-Identifier: MIT
// App: the world that is shown, and the one that is being loaded.
#include "demo/app/app.h"

#include "common/environment_input.h"
#include "common/progress.h"
#include "common/view.h"
#include "core/base/color_word.h"
#include "zvo/error.h"

#include <exception>
#include <filesystem>
#include <memory>
#include <utility>

namespace zvo::demo
{

namespace
{

constexpr double kLoadingPieceMs = 30; // work on a world between two frames of another one
constexpr gpu::uint kLoadingColor = kOpaque | 32U << 16U | 28U << 8U | 26U; // of the window

} // namespace

void App::loadFiles(const std::vector<std::filesystem::path>& files)
{
    if (files.empty())
    {
        return;
    }
    if (files.size() == 1 && cli::isEnvironmentFile(files.front()))
    {
        whenFree([this, file = files.front()] { loadEnvironment(file); });
        return;
    }
    WorldOptions options = m_world_options;
    options.voxels.scenes = files;
    options.voxels.time.reset(); // belongs to the files of the command line, as does the grid's position
    options.voxels.bounds.reset();
    options.voxels.grid_position.reset();
    loseStrokes([this, options] { beginLoading(options); });
}

// Shows the files of the command line. A run that is the same for everyone has them from its first frame on; otherwise
// frames show how far they are.
void App::beginFirstWorld()
{
    constexpr double kSubmissionMs = 400;
    m_is_first_world = m_loading != nullptr;
    const bool at_once = m_options.fixed_step || m_options.frame_count || m_replay;
    if (m_loading == nullptr)
    {
        showFirst(nullptr);
    }
    else if (at_once)
    {
        showFirst(m_loading->finish(m_device, kSubmissionMs, [] {}));
        m_loading.reset();
    }
    else
    {
        m_device.run([this](vk::FrameGraph& graph) { m_renderer.keepColor(graph, kLoadingColor); });
        buildPanels(); // which show from the second time on
    }
}

// world: null if there is none, as none was asked for or loading was cancelled.
void App::showFirst(std::unique_ptr<World> world)
{
    if (world != nullptr)
    {
        m_world = std::move(world);
        m_camera.setSubject(m_world->subject);
        showTitle();
        if (m_options.camera.empty() && !m_options.camera_path && recallScene())
        {
            applyViewOptions();
        }
        else
        {
            m_camera.show(cli::chooseCamera(m_options.camera, m_world->scene.animated(), m_world->subject, aspect()));
        }
        m_timeline.start(m_options.voxels.time.value_or(0.0));
    }
    else
    {
        m_world_options.voxels.scenes.clear();
    }
    m_editor.release();
    m_is_first_world = false;
    m_frame_start = Clock::now();
}

// Begins loading in the background. With fixed steps it loads at once, so that every run shows the same frames.
void App::beginLoading(WorldOptions options)
{
    if (m_options.fixed_step)
    {
        loadAtOnce(options);
    }
    else if (m_loading != nullptr)
    {
        m_loading->cancel();
        m_loads_next = std::move(options);
    }
    else
    {
        m_loading = std::make_unique<Loading>(std::move(options));
    }
}

void App::loadAtOnce(const WorldOptions& options)
{
    finishAll(); // loading uses the device, too
    try
    {
        show(World::make(m_device, options, World::read(options)), options);
    }
    catch (const std::exception& error)
    {
        cli::talkError(error);
    }
    m_frame_start = Clock::now();
}

void App::continueLoading()
{
    if (m_loading == nullptr || !m_loading->isRead())
    {
        return;
    }
    std::exception_ptr failure; // a frame's failure, not that of loading
    const auto frame = [&]
    {
        try
        {
            tick();
        }
        catch (...)
        {
            failure = std::current_exception();
        }
        if (m_quits || failure)
        {
            m_loads_next.reset();
            m_loading->cancel();
        }
    };
    m_makes_world = true;
    try
    {
        std::unique_ptr<World> world = m_loading->finish(m_device, kLoadingPieceMs, frame);
        m_makes_world = false;
        if (m_is_first_world)
        {
            finishAll();
            showFirst(std::move(world));
        }
        else if (world != nullptr)
        {
            finishAll();
            show(std::move(world), m_loading->options());
        }
    }
    catch (const std::exception& error)
    {
        if (m_is_first_world)
        {
            throw;
        }
        cli::talkError(error);
    }
    m_makes_world = false;
    m_loading.reset();
    noteRedraw();
    if (failure)
    {
        std::rethrow_exception(failure);
    }
    if (m_loads_next)
    {
        m_loading = std::make_unique<Loading>(*std::exchange(m_loads_next, std::nullopt));
    }
}

// Shows a world. The camera stays if only the voxels have changed.
void App::show(std::unique_ptr<World> world, const WorldOptions& options)
{
    const bool is_same = options.voxels.scenes == m_world_options.voxels.scenes;
    if (!is_same)
    {
        rememberScene();
    }
    m_world = std::move(world);
    m_world_options = options;
    m_editor.release();
    m_clip = {};
    m_inspected.reset();
    m_saved_point = {};
    m_saved_file.clear();
    m_camera.setSubject(m_world->subject);
    if (is_same)
    {
        return;
    }
    m_bookmarks = {};
    m_flight.stop();
    m_timeline.start(0);
    if (!recallScene())
    {
        m_camera.show(cli::chooseCamera("", m_world->scene.animated(), m_world->subject, aspect()));
    }
}

void App::request(const EditRequest& request)
{
    if (m_world->scene.canEdit())
    {
        m_editor.request(request, *m_world);
    }
}

// Whether the device is making a world; meanwhile only frames may be drawn.
bool App::isMakingAWorld()
{
    if (m_loading != nullptr)
    {
        note("not before the new scene is there");
    }
    return m_loading != nullptr;
}

void App::takeTold()
{
    const std::lock_guard lock(m_told_mutex);
    for (const std::string& text : std::exchange(m_told, {}))
    {
        m_notices.add(text);
    }
}

} // namespace zvo::demo
