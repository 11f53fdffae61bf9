// SPDX-License-Identifier: MIT
// App: the actions of keys.
#include "demo/app/app.h"

#include "common/names.h"
#include "common/progress.h"
#include "common/words.h"
#include "io/file/atomic_file.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace zvo::demo
{

namespace
{

constexpr const char* kPathFile = "zvo-path.json"; // in the working folder

} // namespace

void App::onKey(const KeyEvent& event)
{
    if (const KeyBinding* const binding = bindingOf(event))
    {
        perform(*binding, event.key);
    }
}

void App::perform(const KeyBinding& binding, Key key)
{
    // Position in a range of keys.
    const auto number = static_cast<std::size_t>(key) - static_cast<std::size_t>(binding.key);
    switch (binding.action)
    {
    case Action::ShowKeys:
        m_panels.shows_keys = !m_panels.shows_keys;
        return;
    case Action::ShowPanels:
        m_panels.shows_panels = !m_panels.shows_panels;
        return;
    case Action::NextView:
        return changeView(1);
    case Action::PreviousView:
        return changeView(-1);
    case Action::FrameScene:
        return frameScene();
    case Action::Copy:
        return m_editor.state.tool == Tool::Select ? editSelection(Action::Copy) : copyCamera();
    case Action::Paste:
        return m_editor.state.tool == Tool::Select ? m_editor.perform(Action::Paste) : pasteCamera();
    case Action::Cut:
    case Action::Delete:
        return editSelection(binding.action);
    case Action::StoreBookmark:
        return storeBookmark(number);
    case Action::RecallBookmark:
        return recallBookmark(number);
    case Action::RecordPath:
        return toggleRecording();
    case Action::PlayPath:
        return togglePath();
    case Action::PlayScene:
        return m_timeline.play(!m_timeline.plays());
    case Action::NextFrame:
        return m_timeline.nextFrame(m_world->scene.animated());
    case Action::ReloadShaders:
        return whenFree([this] { reloadChangedShaders(); });
    case Action::Screenshot:
        m_wanted_screenshot = true;
        return;
    case Action::ScreenshotOfPicture:
        m_wanted_screenshot = false;
        return;
    case Action::UseBrush:
    case Action::UseHand:
    case Action::UseCamera:
    case Action::NextBrush:
    case Action::SmallerBrush:
    case Action::LargerBrush:
    case Action::TakeColor:
    case Action::UseSelection:
    case Action::NextForm:
    case Action::NextMirror:
    case Action::PlaceMirror:
        return m_editor.perform(binding.action);
    case Action::Undo:
        return request(UndoStroke{});
    case Action::Redo:
        return request(RedoStroke{});
    case Action::Save:
        return whenFree([this] { save(); });
    case Action::SaveAs:
        return saveDialog();
    case Action::Open:
        return openDialog();
    case Action::Focus:
        m_wants_focus = true;
        return;
    case Action::Quit:
        return quit();
    case Action::None:
        return;
    }
}

void App::storeBookmark(std::size_t number)
{
    m_bookmarks[number] = m_camera.camera();
    note(fmt::format("bookmark {}", number + 1));
}

void App::recallBookmark(std::size_t number)
{
    if (m_bookmarks[number])
    {
        m_camera.show(*m_bookmarks[number]);
        m_flight.stop();
    }
}

void App::frameScene()
{
    m_flight.stop();
    m_camera.show(ViewCamera::framing(m_world->subject, aspect()));
    m_camera.setSubject(m_world->subject);
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
    m_flight.stop();
    m_camera.show(*camera);
}

void App::changeView(int by)
{
    View& view = m_view.frame.trace.view;
    const auto current = std::ranges::find(cli::kViews, view, &cli::Named<View>::value) - cli::kViews.begin();
    const auto count = static_cast<std::ptrdiff_t>(cli::kViews.size());
    view = cli::kViews[static_cast<std::size_t>((current + by + count) % count)].value;
}

void App::toggleRecording()
{
    const std::optional<CameraPath> path = m_flight.toggleRecording();
    if (m_flight.records())
    {
        note("recording a camera path; R ends it");
        return;
    }
    if (!path)
    {
        return;
    }
    const std::string text = cameraPathText(*path);
    try
    {
        writeFileAtomically(kPathFile, std::as_bytes(std::span(text)), Overwrite::Allow);
        note(fmt::format("camera path {}, {:.1f} s; P plays it", kPathFile, path->seconds()));
    }
    catch (const Error& error)
    {
        cli::talkError(error);
    }
}

void App::togglePath()
{
    if (!m_flight.toggle())
    {
        note("there is no camera path; R records one, --camera-path names one");
    }
}

void App::reloadChangedShaders()
{
    if (isMakingAWorld())
    {
        return;
    }
    if (!m_shaders.exist())
    {
        note(fmt::format("the shaders' sources are not here: {} is not a folder", m_shaders.root().string()));
        return;
    }
    finishAll();
    const ReloadedShaders result = reloadShaders(m_device.device().kernels(), m_shaders);
    m_renderer.forget();
    m_is_refined = false; // a still picture is made anew
    m_shader_message = result.message;
    if (!result.message.empty())
    {
        cli::talk(fmt::format("error: shaders: {}", result.message));
    }
    note(result.count != 0        ? cli::counted(result.count, "shader") + " compiled"
         : result.message.empty() ? "no shader has changed"
                                  : "the old shaders go on");
    m_frame_start = Clock::now();
}

} // namespace zvo::demo
