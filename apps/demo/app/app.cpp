// SPDX-License-Identifier: MIT
#include "demo/app/app.h"

#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/signals.h"
#include "common/view.h"
#include "core/base/kernels.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace zvo::demo
{

namespace
{

constexpr double kIdleSeconds = 0.1;      // between looks at a window that shows nothing
constexpr double kFrameSecondsMax = 0.25; // a program that was stopped does not jump
constexpr std::size_t kCpuRung = 2;       // half the window's edges: what software devices begin with

using Milliseconds = std::chrono::duration<double, std::milli>;

std::unique_ptr<cli::Output> outputTo(const std::string& target, bool overwrite)
{
    return target.empty() ? nullptr : std::make_unique<cli::Output>(target, overwrite);
}

vk::HeadlessOptions deviceOptions(const DemoOptions& options, const Window& window)
{
    vk::HeadlessOptions device = cli::headlessOptions(options.device);
    device.window = window.support();
    device.submissions_in_flight = options.frames_in_flight;
    return device;
}

Settings settingsFor(const DemoOptions& options)
{
    const std::optional<std::filesystem::path> file = options.usesSettings() ? settingsFile() : std::nullopt;
    return file ? readSettings(*file) : Settings{};
}

// The view of the settings, with the changes that options make.
ViewState viewOf(const DemoOptions& options, const Settings& settings)
{
    ViewState view = settings.view;
    for (const ViewChange& change : options.view_changes)
    {
        change(view);
    }
    return view;
}

} // namespace

App::App(const DemoOptions& options, Clock::time_point start)
    : m_options(options), m_settings(settingsFor(options)), m_view(viewOf(options, m_settings)), m_start(start),
      m_screenshot_output(outputTo(options.screenshot, options.overwrite)),
      m_stats_output(outputTo(options.json, options.overwrite)),
      m_record_output(options.record_input ? outputTo(options.record_input->string(), options.overwrite) : nullptr),
      m_world_options{options.voxels, options.structure, options.frames_in_flight},
      m_loading(options.voxels.scenes.empty() ? nullptr : std::make_unique<Loading>(m_world_options)),
      m_window(options.size.value_or(m_settings.window), !options.size, "zvo"),
      m_device(deviceOptions(options, m_window), zvoKernels()),
      m_swapchain(m_device, [this](VkInstance instance) { return m_window.makeSurface(instance); },
                  {m_view.present_mode, options.frames_in_flight}),
      m_compose_pass(m_device.device()), m_ui(m_device, m_compose_pass, m_window, options.frames_in_flight),
      m_world(World::make(m_device, WorldOptions{}, {})), m_renderer(m_device, m_compose_pass),
      m_timeline(options.fixed_step), m_camera(ViewCamera::framing(m_world->subject, aspect()), m_world->subject),
      m_flight(options.fixed_step), m_shaders(options.shaders ? *options.shaders : shadersOf(thisProgram())),
      m_frame_start(Clock::now())
{
    if (options.input_script)
    {
        m_replay.emplace(readInputScript(*options.input_script));
    }
    if (options.camera_path)
    {
        m_flight.fly(readCameraPath(*options.camera_path), true);
    }
    m_editor.state = m_settings.brush;
    if (options.usesSettings() && m_settings.is_first && m_device.device().report().type != "cpu")
    {
        m_view.frame.integrator = Integrator::Cache; // which takes a software device long to settle
        applyViewOptions();
    }
    if (options.environment.map)
    {
        setEnvironment(options.environment);
    }
    m_panels = {m_settings.shows_panels && !options.hide_ui, m_settings.shows_keys};
    m_timeline.start(options.voxels.time.value_or(0.0));
    if (m_device.device().report().type == "cpu" && !options.fixed_step)
    {
        m_ladder.emplace(kCpuRung);
    }
    cli::listenToTalk(
        [this](std::string_view text)
        {
            const std::lock_guard lock(m_told_mutex);
            m_told.emplace_back(text);
        });
    beginFirstWorld();
}

App::~App()
{
    m_loading.reset(); // its thread may write notices
    cli::listenToTalk(nullptr);
}

void App::run()
{
    m_watch.emplace(cli::Noticed::All); // what is kept from run to run is kept then, too
    while (!m_quits)
    {
        continueLoading(); // draws frames, too
        if (!m_quits)
        {
            tick();
        }
    }
    m_loading.reset();
    finishAll();
    if (m_screenshot_output != nullptr)
    {
        throw Error(ErrorCode::Other, "the last frame was not drawn: the window had no extent, or was closed before");
    }
    if (m_record_output != nullptr)
    {
        m_record_output->write(inputScriptText(m_recorded));
        m_record_output->finish();
    }
    writeStats();
    keepSettings();
    cli::checkValidation(m_device);
}

void App::tick()
{
    frame();
    countFrame();
}

void App::countFrame()
{
    ++m_frame;
    m_quits = m_quits || (m_options.frame_count && m_frame >= *m_options.frame_count);
}

void App::frame()
{
    beginFrame(restSeconds());
    if (m_frame != 0 && !m_is_refined)
    {
        m_stats.addFrame(Milliseconds(m_passed).count());
    }
    while (m_frames_in_flight.size() >= framesInFlight())
    {
        finishOldest();
    }
    for (const std::function<void()>& action : std::exchange(m_when_free, {}))
    {
        action();
    }
    carryOutOrders();
    advanceTime();
    buildPanels();
    draw();
}

// rest_seconds: how long nothing happens without input.
void App::beginFrame(double rest_seconds)
{
    takeInput(rest_seconds);
    m_quits = m_quits || (m_watch && m_watch->interrupted());
    const Clock::time_point now = Clock::now();
    m_passed = now - m_frame_start;
    m_frame_start = now;
    m_frame_seconds =
        m_options.fixed_step ? m_options.fixed_step->seconds() : std::min(m_passed.count(), kFrameSecondsMax);
    m_since_redraw += m_frame_seconds;
}

// Frames that may be under way. A software device gains nothing from several, and each is another one between the
// user's input and its effect.
std::size_t App::framesInFlight() const
{
    return m_ladder ? 1 : m_options.frames_in_flight;
}

void App::takeInput(double rest_seconds)
{
    const PictureSize size = m_window.framebufferSize();
    const bool idles = !m_replay && (size.width == 0 || size.height == 0);
    const std::vector<InputEvent> users = m_window.takeEvents(idles ? kIdleSeconds : rest_seconds);
    if (m_window.takeDamage())
    {
        noteRedraw();
    }
    // While a script is played, only the user's request to close the window counts.
    for (const InputEvent& event : users)
    {
        if (!m_replay || std::holds_alternative<CloseEvent>(event))
        {
            apply(event);
        }
    }
    if (!m_replay)
    {
        return;
    }
    for (const InputEvent& event : m_replay->take(m_frame))
    {
        if (const auto* const resize = std::get_if<ResizeEvent>(&event))
        {
            m_window.resize({resize->width, resize->height});
        }
        else if (const auto* const minimize = std::get_if<MinimizeEvent>(&event))
        {
            m_window.minimize(minimize->minimized);
        }
        apply(event);
    }
}

void App::apply(const InputEvent& event)
{
    if (m_record_output != nullptr)
    {
        m_recorded.push_back({m_frame, event});
    }
    noteRedraw();
    const auto* const move = std::get_if<MouseMoveEvent>(&event);
    m_mouse = move != nullptr ? *move : m_mouse;
    m_refinement.noteInput(move != nullptr && m_editor.hasButton()); // a tool follows the pointer
    const auto* const key = std::get_if<KeyEvent>(&event);
    const KeyBinding* const binding = key != nullptr ? bindingOf(*key) : nullptr;
    const bool is_of_loading = std::holds_alternative<CloseEvent>(event) || std::holds_alternative<DropEvent>(event) ||
                               (binding != nullptr && binding->action == Action::Quit);
    if (m_is_first_world && !is_of_loading) // there is nothing else yet
    {
        return;
    }
    const bool is_the_panels = m_ui.handle(event); // the panels see events even while they are hidden
    const bool is_the_dialogs = hasDialog() && (is_the_panels || (key != nullptr && key->pressed));
    if ((m_panels.shows_panels && is_the_panels) || is_the_dialogs)
    {
        return;
    }
    if (const auto* const drop = std::get_if<DropEvent>(&event))
    {
        loadFiles(drop->files);
        return;
    }
    if (std::holds_alternative<CloseEvent>(event))
    {
        quit();
        return;
    }
    m_sun.handle(event, m_view.frame.trace.to_sun);
    const auto* const button = std::get_if<MouseButtonEvent>(&event);
    if (m_sun.isHeld() && button != nullptr && button->pressed)
    {
        return; // who drags the sun moves neither camera nor tool
    }
    const PictureSize size = m_window.size();
    m_camera.handle(event, m_editor.hasButton(), static_cast<double>(size.height));
    m_editor.handle(event, m_camera.camera(), {size.width, size.height}, *m_world);
    if (key != nullptr)
    {
        onKey(*key);
    }
    if (m_camera.isDragging())
    {
        m_flight.stop();
    }
}

void App::advanceTime()
{
    const bool is_first = m_frame == 0;
    takeTold();
    showTitle();
    if (!m_notices.all().empty() || m_loading != nullptr)
    {
        m_redraws = std::max(m_redraws, 1);
    }
    m_notices.advance(m_frame_seconds);
    m_camera.advance(m_frame_seconds);
    if (!m_is_first_world)
    {
        m_flight.advance(m_frame_seconds, is_first, m_camera);
    }
    if (!is_first)
    {
        m_timeline.advance(m_frame_seconds);
    }
}

void App::keepSettings()
{
    const std::optional<std::filesystem::path> file = m_options.usesSettings() ? settingsFile() : std::nullopt;
    if (!file)
    {
        return;
    }
    Settings settings;
    const PictureSize size = m_window.unscaledSize();
    settings.window = size.width != 0 && size.height != 0 ? size : m_settings.window;
    settings.shows_panels = m_options.hide_ui ? m_settings.shows_panels : m_panels.shows_panels;
    settings.shows_keys = m_panels.shows_keys;
    settings.view = m_view;
    settings.brush = m_editor.state;
    settings.brush.tool = Tool::Camera;
    rememberScene();
    settings.scenes = m_settings.scenes;
    writeSettings(*file, settings);
}

void App::showTitle()
{
    const std::string& name = m_world->name;
    const std::string title = (hasUnsaved() ? "*" : "") + (name.empty() ? "zvo" : name + " - zvo");
    if (m_title != title)
    {
        m_title = title;
        m_window.setTitle(title);
    }
}

double App::aspect() const
{
    const PictureSize size = m_window.size();
    return size.width != 0 && size.height != 0 ? static_cast<double>(size.width) / size.height : 1.0;
}

double App::internalScale() const
{
    return m_view.internal_scale ? *m_view.internal_scale : m_ladder ? m_ladder->scale() : 1.0;
}

double App::worldSeconds() const
{
    return m_timeline.secondsIn(m_world->scene.animated());
}

void App::note(const std::string& text)
{
    m_notices.add(text);
}

} // namespace zvo::demo
