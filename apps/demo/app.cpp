// SPDX-License-Identifier: MIT
#include "demo/app.h"

#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/view.h"
#include "core/kernels.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace zvo::demo
{

namespace
{

constexpr double kIdleSeconds = 0.1;      // between looks at a window that shows nothing
constexpr double kLongestStep = 0.25;     // seconds: a program that was stopped does not jump
constexpr double kPathKeySeconds = 0.25;  // between keys of a path that is recorded
constexpr std::size_t kCpuLadderStep = 2; // half the window's edges: what software devices begin with
constexpr const char* kTitle = "zvo";
constexpr const char* kPathFile = "zvo-path.json";

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

// What options say, and settings where they do not.
ViewState viewOf(const DemoOptions& options, const Settings& settings)
{
    ViewState view = settings.view;
    view.view = options.view.value_or(view.view);
    view.occlusion_rays = options.occlusion_rays.value_or(view.occlusion_rays);
    view.to_sun = options.to_sun.value_or(view.to_sun);
    view.exposure = options.exposure.value_or(view.exposure);
    view.detail_pixels = options.detail_pixels.value_or(view.detail_pixels);
    view.internal_scale = options.internal_scale ? options.internal_scale : view.internal_scale;
    view.present_mode = options.present_mode.value_or(view.present_mode);
    return view;
}

WorldOptions worldOptions(const DemoOptions& options)
{
    return {options.voxels, options.structure, options.frames_in_flight};
}

// A window of panels in the upper left or right corner. ImGui::End() ends it, whether or not it is open.
bool beginPanels(const char* title, bool is_right)
{
    constexpr float kMargin = 10;
    const float width = ImGui::GetMainViewport()->WorkSize.x;
    ImGui::SetNextWindowPos({is_right ? width - kMargin : kMargin, kMargin}, ImGuiCond_Always,
                            {is_right ? 1.0F : 0.0F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.85F);
    return ImGui::Begin(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
}

CameraKey keyOf(const ViewCamera& camera, double seconds, const glm::dvec3& target)
{
    return {seconds, camera.position, target, glm::degrees(camera.vertical_fov)};
}

} // namespace

App::App(const DemoOptions& options, Clock::time_point start)
    : m_options(options), m_settings(settingsFor(options)), m_start(start),
      m_screenshot_output(outputTo(options.screenshot, options.overwrite)),
      m_stats_output(outputTo(options.json, options.overwrite)),
      m_record_output(options.record_input ? outputTo(options.record_input->string(), options.overwrite) : nullptr),
      m_window(options.size.value_or(m_settings.window), kTitle),
      m_device(deviceOptions(options, m_window), zvoKernels()),
      m_swapchain(m_device, [this](VkInstance instance) { return m_window.makeSurface(instance); },
                  {options.present_mode.value_or(m_settings.view.present_mode), options.frames_in_flight}),
      m_compose_pass(m_device.device()), m_ui(m_device, m_compose_pass, m_window, options.frames_in_flight),
      m_world_options(worldOptions(options)), m_world(World::load(m_device, m_world_options)),
      m_renderer(m_device, m_compose_pass), m_view(viewOf(options, m_settings)), m_timeline(options.fixed_step),
      m_camera(cli::chooseCamera(options.camera, m_world->stage(), m_world->subject(), aspect()), m_world->subject()),
      m_path_time(options.fixed_step), m_shaders(options.shaders.value_or(ZVO_SHADERS_DIR)), m_frame_start(Clock::now())
{
    if (options.input_script)
    {
        m_replay.emplace(readInputScript(*options.input_script));
    }
    if (options.camera_path)
    {
        m_path = readCameraPath(*options.camera_path);
        m_path_plays = true;
    }
    m_panels = {m_settings.shows_panels && !options.hide_ui, m_settings.shows_keys};
    m_timeline.start(options.voxels.time.value_or(0.0));
    if (m_device.device().report().type == "cpu" && !options.fixed_step)
    {
        m_ladder.emplace(kCpuLadderStep);
    }
    cli::listenToTalk(
        [this](std::string_view text)
        {
            const std::lock_guard lock(m_told_mutex);
            m_told.emplace_back(text);
        });
    m_window.setTitle(m_world->info().name.empty() ? kTitle : fmt::format("{} - {}", m_world->info().name, kTitle));
}

App::~App()
{
    m_loading.reset(); // its thread tells things
    cli::listenToTalk(nullptr);
}

void App::run()
{
    while (!m_quits)
    {
        continueLoading();
        tick();
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
    ++m_frame;
    m_quits = m_quits || (m_options.frame_count && m_frame >= *m_options.frame_count);
}

void App::frame()
{
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> passed = now - m_frame_start;
    m_frame_start = now;
    m_step = m_options.fixed_step ? m_options.fixed_step->seconds() : std::min(passed.count(), kLongestStep);
    if (m_frame != 0)
    {
        m_stats.addFrame(Milliseconds(passed).count());
    }
    takeInput();
    while (m_flights.size() >= m_options.frames_in_flight)
    {
        finishOldest();
    }
    advanceTime();
    buildPanels();
    draw();
}

void App::takeInput()
{
    const PictureSize size = m_window.framebufferSize();
    const bool idles = !m_replay && (size.width == 0 || size.height == 0);
    const std::vector<InputEvent> users = m_window.takeEvents(idles ? kIdleSeconds : 0.0);
    // What the window system does to the window counts even while a script is played.
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
        else if (const auto* const minimise = std::get_if<MinimiseEvent>(&event))
        {
            m_window.minimise(minimise->minimised);
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
    if (const auto* const move = std::get_if<MouseMoveEvent>(&event))
    {
        m_mouse = *move;
    }
    const bool is_the_panels = m_ui.handle(event); // which also see what happens while they are hidden
    if (m_panels.shows_panels && is_the_panels)
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
        m_quits = true;
        return;
    }
    const PictureSize size = m_window.size();
    m_camera.handle(event, m_editor.hasButton(), static_cast<double>(size.height));
    m_editor.handle(event, m_camera.camera(), {size.width, size.height}, *m_world);
    if (const auto* const key = std::get_if<KeyEvent>(&event))
    {
        onKey(*key);
    }
    m_path_plays = m_path_plays && !m_camera.isDragging();
}

void App::onKey(const KeyEvent& event)
{
    if (const KeyBinding* const binding = bindingOf(event))
    {
        perform(*binding, event.key);
    }
}

void App::perform(const KeyBinding& binding, Key key)
{
    const auto number = static_cast<std::size_t>(key) - static_cast<std::size_t>(binding.key); // in a range
    switch (binding.action)
    {
    case Action::ShowKeys:
        m_panels.shows_keys = !m_panels.shows_keys;
        break;
    case Action::ShowPanels:
        m_panels.shows_panels = !m_panels.shows_panels;
        break;
    case Action::NextView:
        changeView(1);
        break;
    case Action::PreviousView:
        changeView(-1);
        break;
    case Action::FrameScene:
        frameScene();
        break;
    case Action::CopyCamera:
        copyCamera();
        break;
    case Action::PasteCamera:
        pasteCamera();
        break;
    case Action::StoreBookmark:
        m_bookmarks[number] = m_camera.camera();
        note(fmt::format("bookmark {}", number + 1));
        break;
    case Action::RecallBookmark:
        if (m_bookmarks[number])
        {
            m_camera.show(*m_bookmarks[number]);
            m_path_plays = false;
        }
        break;
    case Action::RecordPath:
        toggleRecording();
        break;
    case Action::PlayPath:
        togglePath();
        break;
    case Action::PlayScene:
        m_timeline.play(!m_timeline.plays());
        break;
    case Action::StepScene:
        m_timeline.step(m_world->stage());
        break;
    case Action::ReloadShaders:
        reloadShaders();
        break;
    case Action::Screenshot:
        m_wanted_screenshot = true;
        break;
    case Action::ScreenshotOfPicture:
        m_wanted_screenshot = false;
        break;
    case Action::UseBrush:
    case Action::UseHand:
    case Action::UseCamera:
    case Action::NextBrush:
    case Action::SmallerBrush:
    case Action::LargerBrush:
        m_editor.perform(binding.action);
        break;
    case Action::TakeColor:
        if (m_inspected)
        {
            m_editor.takeColor(m_inspected->report);
        }
        break;
    case Action::Undo:
        request(UndoStroke{});
        break;
    case Action::Redo:
        request(RedoStroke{});
        break;
    case Action::Save:
        save();
        break;
    case Action::Quit:
        m_quits = true;
        break;
    case Action::None:
        break;
    }
}

void App::advanceTime()
{
    takeTold();
    m_notices.advance(m_step);
    m_camera.advance(m_step);
    if (m_frame != 0) // the first frame shows the beginning
    {
        m_timeline.advance(m_step);
        if (m_path_plays)
        {
            m_path_time.add(m_step);
        }
        m_record_seconds += m_step;
    }
    if (m_path && m_path_plays)
    {
        m_camera.show(m_path->at(m_path_time.seconds()));
        m_path_plays = m_options.camera_path || m_path_time.seconds() < m_path->seconds();
    }
    if (m_path_records &&
        (m_path_recorded.empty() || m_record_seconds - m_path_recorded.back().seconds >= kPathKeySeconds))
    {
        addPathKey();
    }
}

void App::buildPanels()
{
    const PictureSize size = m_window.size();
    if (size.width == 0 || size.height == 0)
    {
        return;
    }
    m_ui.build(size, m_window.framebufferSize(), m_step,
               [this]
               {
                   if (!m_panels.shows_panels)
                   {
                       return;
                   }
                   if (beginPanels("zvo", false))
                   {
                       scenePanel(*m_world, m_timeline);
                       buildPanel();
                       toolsPanel();
                       viewPanel(m_view, {internalScale(), m_swapchain.mode(), m_camera.speed()});
                       ImGui::TextUnformatted("F1: keys");
                   }
                   ImGui::End();
                   if (beginPanels("measurements", true))
                   {
                       performancePanel(m_stats, memoryUse());
                       inspectorPanel(m_inspected, m_world->info());
                   }
                   ImGui::End();
                   shadersPanel(m_shader_message);
                   keysPanel(m_panels.shows_keys);
                   noticesPanel(m_notices);
               });
    m_swapchain.setMode(m_view.present_mode);
}

std::unique_ptr<Screenshot> App::takeScreenshot(PictureSize size)
{
    const bool is_last = m_options.frame_count && m_frame + 1 == *m_options.frame_count;
    if (is_last && m_screenshot_output != nullptr)
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
    if (m_options.fixed_step)
    {
        // What this frame shows does not depend on which frames the device is done with.
        finishAll();
        m_world->settle(worldSeconds());
    }
    Picture picture;
    picture.camera = m_camera.camera();
    picture.view = m_view;
    picture.window = size;
    picture.internal = scaledSize(size, internalScale());
    if (!prepare(picture))
    {
        return;
    }
    if (m_panels.shows_panels)
    {
        picture.panels = [this](VkCommandBuffer commands) { m_ui.draw(commands); };
    }
    Flight flight;
    flight.screenshot = takeScreenshot(size);
    if (flight.screenshot != nullptr)
    {
        picture.screenshot = &flight.screenshot->pixels();
        picture.screenshot_has_panels = flight.screenshot->hasPanels();
    }
    flight.look = m_editor.look();
    flight.inspected = m_panels.shows_panels || m_editor.wantsPixel() ? pixelUnderMouse() : std::nullopt;
    if (flight.inspected)
    {
        flight.report = std::make_unique<vk::BufferOf<gpu::PixelReport>>(m_device.device(), "inspected pixel", 1,
                                                                         vk::MemoryKind::Readback);
        picture.inspected = flight.inspected;
        picture.report = flight.report.get();
    }
    // Nothing that may fail comes between an image and the submission that waits for it.
    const std::optional<vk::SwapchainImage> target = m_swapchain.acquire({size.width, size.height}, m_drawn_count);
    picture.target = target ? &*target : nullptr;
    submit(picture, flight);
    if (target)
    {
        m_swapchain.present(*target);
    }
    ++m_drawn_count;
}

// Makes buffers for the picture. Without them it is not drawn; that there is no memory for the first one is an error.
bool App::prepare(const Picture& picture)
{
    try
    {
        m_renderer.begin(m_drawn_count, picture, vk::encodesSrgb(m_swapchain.format()));
        m_lacks_memory = false;
        return true;
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory || m_drawn_count == 0)
        {
            throw;
        }
        if (!std::exchange(m_lacks_memory, true))
        {
            cli::talk(fmt::format("error: {}", error.what()));
        }
        return false;
    }
}

void App::submit(Picture& picture, Flight& flight)
{
    flight.frame = m_drawn_count;
    flight.internal_scale = internalScale();
    flight.ray_count = m_renderer.rayCount();
    flight.world_frame = m_world->beginFrame();
    vk::SubmitSync sync;
    if (picture.target != nullptr)
    {
        sync = {picture.target->available, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, picture.target->presentable};
    }
    try
    {
        flight.submission = m_device.submit(
            [&](vk::FrameGraph& graph)
            {
                m_world->update(graph, worldSeconds());
                m_renderer.record(graph, *m_world, picture);
            },
            sync);
    }
    catch (...)
    {
        m_world->frameLost();
        throw;
    }
    m_flights.push_back(std::move(flight));
}

void App::finishOldest()
{
    Flight flight = std::move(m_flights.front());
    m_flights.pop_front();
    const std::vector<vk::PassTime> passes = flight.submission.wait();
    m_world->frameDone(flight.world_frame, passes);
    m_renderer.frameDone(flight.frame);
    m_swapchain.frameDone(flight.frame);
    m_stats.addPasses(passes, flight.ray_count);
    if (!m_first_frame_ms)
    {
        m_first_frame_ms = Milliseconds(Clock::now() - m_start).count();
    }
    if (flight.inspected)
    {
        m_inspected = {*flight.inspected, *flight.report->mappedData()};
        m_editor.found(flight.look, m_inspected->report, *m_world);
    }
    if (m_ladder && flight.internal_scale == m_ladder->scale())
    {
        m_ladder->add(m_stats.gpuMs().last());
    }
    if (flight.screenshot != nullptr)
    {
        const std::string name = flight.screenshot->write();
        if (!name.empty())
        {
            note("screenshot " + name);
        }
    }
}

void App::finishAll()
{
    while (!m_flights.empty())
    {
        finishOldest();
    }
}

void App::frameScene()
{
    m_path_plays = false;
    m_camera.show(ViewCamera::framing(m_world->subject(), aspect()));
    m_camera.setSubject(m_world->subject());
}

void App::copyCamera()
{
    const double distance = glm::length(m_camera.pivot() - m_camera.camera().position);
    const std::optional<std::string> text = cameraText(m_camera.camera(), distance);
    if (text)
    {
        m_window.setClipboard(*text);
    }
    note(text ? "camera " + *text : "this camera cannot be written as eye, target and field of view");
}

void App::pasteCamera()
{
    const std::optional<ViewCamera> camera = cameraOfText(m_window.clipboard());
    if (!camera)
    {
        note("the clipboard holds no camera: ex,ey,ez,tx,ty,tz or ex,ey,ez,tx,ty,tz,fov");
        return;
    }
    m_path_plays = false;
    m_camera.show(*camera);
}

void App::changeView(int by)
{
    const auto views = cli::allViews();
    const auto current = std::ranges::find(views, m_view.view, &cli::NamedView::view) - views.begin();
    const auto count = static_cast<std::ptrdiff_t>(views.size());
    m_view.view = views[static_cast<std::size_t>((current + by + count) % count)].view;
}

void App::addPathKey()
{
    if (!m_camera.camera().orthographic)
    {
        m_path_recorded.push_back(keyOf(m_camera.camera(), m_record_seconds, m_camera.pivot()));
    }
}

void App::toggleRecording()
{
    m_path_records = !m_path_records;
    if (m_path_records)
    {
        m_path_recorded.clear();
        m_record_seconds = 0;
        note("recording a camera path; R ends it");
        return;
    }
    if (m_path_recorded.empty())
    {
        return;
    }
    m_path.emplace(std::exchange(m_path_recorded, {}));
    const std::string text = cameraPathText(*m_path);
    try
    {
        writeFileAtomically(kPathFile, std::as_bytes(std::span(text)), Overwrite::Allow);
        note(fmt::format("camera path {}, {:.1f} s; P plays it", kPathFile, m_path->seconds()));
    }
    catch (const Error& error)
    {
        cli::talk(fmt::format("error: {}", error.what()));
    }
}

void App::togglePath()
{
    if (!m_path)
    {
        note("there is no camera path; R records one, --camera-path names one");
        return;
    }
    m_path_plays = !m_path_plays;
    m_path_time.reset();
}

void App::reloadShaders()
{
    vk::KernelCache& kernels = m_device.device().kernels();
    if (!m_shaders.exist())
    {
        note(fmt::format("the shaders' sources are not here: {} is not a folder", m_shaders.root().string()));
        return;
    }
    finishAll(); // old pipelines go
    m_shader_message.clear();
    std::size_t count = 0;
    try
    {
        for (CompiledShader& shader : m_shaders.compile(m_shaders.takeChanged(kernels.names())))
        {
            if (shader.words.empty())
            {
                m_shader_message += shader.message;
                continue;
            }
            kernels.replace(shader.name, std::move(shader.words));
            ++count;
        }
    }
    catch (const Error& error)
    {
        m_shader_message += error.what();
    }
    kernels.releaseReplaced();
    m_world->refresh();
    if (!m_shader_message.empty())
    {
        cli::talk(fmt::format("error: shaders: {}", m_shader_message));
    }
    note(count != 0                 ? fmt::format("{} {} compiled", count, count == 1 ? "shader" : "shaders")
         : m_shader_message.empty() ? "no shader has changed"
                                    : "the old shaders go on");
    m_frame_start = Clock::now();
}

void App::keepSettings()
{
    const std::optional<std::filesystem::path> file = m_options.usesSettings() ? settingsFile() : std::nullopt;
    if (!file)
    {
        return;
    }
    Settings settings;
    const PictureSize size = m_window.size();
    settings.window = size.width != 0 && size.height != 0 ? size : m_settings.window;
    settings.shows_panels = m_options.hide_ui ? m_settings.shows_panels : m_panels.shows_panels;
    settings.shows_keys = m_panels.shows_keys;
    settings.view = m_view;
    writeSettings(*file, settings);
}

std::optional<glm::uvec2> App::pixelUnderMouse() const
{
    const PictureSize size = m_window.size();
    const PictureSize pixels = m_window.framebufferSize();
    if (!m_mouse || !(m_mouse->x >= 0 && m_mouse->x < size.width && m_mouse->y >= 0 && m_mouse->y < size.height))
    {
        return std::nullopt;
    }
    const glm::uvec2 pixel(m_mouse->x * pixels.width / size.width, m_mouse->y * pixels.height / size.height);
    return glm::min(pixel, glm::uvec2(pixels.width - 1, pixels.height - 1));
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
    return m_timeline.secondsIn(m_world->stage());
}

MemoryUse App::memoryUse()
{
    const vk::MemoryAllocator& memory = m_device.device().memory();
    const WorldInfo& info = m_world->info();
    return {info.geometry_bytes, info.attribute_bytes, m_renderer.pictureBytes(), memory.usedBytes(),
            memory.heldBytes()};
}

void App::note(const std::string& text)
{
    m_notices.add(text);
}

void App::writeStats()
{
    if (m_stats_output == nullptr)
    {
        return;
    }
    cli::Json json;
    json["schema"] = "zvo.demo/1";
    json["zvo"] = ZVO_VERSION;
    json["device"] = cli::deviceJson(m_device.device().report());
    json["frames"] = m_frame;
    json["frames_drawn"] = m_drawn_count;
    json["first_frame_ms"] = m_first_frame_ms ? cli::Json(*m_first_frame_ms) : cli::Json(nullptr);
    const auto timesOf = [](const History& history) {
        return cli::Json{{"mean_ms", history.mean()}, {"p95_ms", history.p95()}};
    };
    json["frame"] = timesOf(m_stats.frameMs());
    json["gpu"] = timesOf(m_stats.gpuMs());
    json["mrays_per_second"] = m_stats.megaraysPerSecond();
    json["internal_scale"] = internalScale();
    json["swapchains"] = m_swapchain.generation();
    json["passes"] = cli::Json::array();
    for (const std::string& name : m_stats.names())
    {
        cli::Json pass = {{"name", name}};
        pass.update(timesOf(m_stats.pass(name)));
        json["passes"].push_back(std::move(pass));
    }
    const WorldInfo& info = m_world->info();
    json["scene"] = {{"name", info.name},
                     {"seconds", worldSeconds()},
                     {"structure", structureName(info.structure)},
                     {"resolution", info.grid.resolution()},
                     {"voxels", info.static_voxel_count},
                     {"nodes", info.static_node_count},
                     {"movers", info.mover_count}};
    const MemoryUse memory = memoryUse();
    json["bytes"] = {{"geometry", memory.geometry},
                     {"attributes", memory.attributes},
                     {"pictures", memory.pictures},
                     {"used", memory.used},
                     {"peak", m_device.device().memory().peakBytes()},
                     {"held", memory.held}};
    m_stats_output->write(cli::jsonText(json));
    m_stats_output->finish();
}

} // namespace zvo::demo
