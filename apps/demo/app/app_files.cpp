// SPDX-License-Identifier: MIT
// App: files that are opened and saved, and strokes that are not in a file.
#include "demo/app/app.h"

#include "common/environment_input.h"
#include "common/output.h"
#include "common/picture_file.h"
#include "common/progress.h"
#include "common/tree_export.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <span>
#include <utility>

namespace zvo::demo
{

namespace
{

constexpr int kSavedMost = 1000; // largest number in a file's name

const std::vector<std::string> kReadExtensions = {".zvo", ".vox", ".glb", ".gltf", ".obj", ".ply",
                                                  ".stl", ".xyz", ".pts", ".json", ".hdr", ".exr"};
const std::vector<std::string> kWrittenExtensions = {".zvo", ".vox",  ".ply", ".glb", ".nvdb",
                                                     ".png", ".webp", ".jpg", ".exr", ".hdr"};

// A name in the working folder that no file has yet.
std::string freeName(const std::string& stem)
{
    for (int i = 1; i < kSavedMost; ++i)
    {
        const std::string name = i == 1 ? stem + ".zvo" : fmt::format("{}-{}.zvo", stem, i);
        std::error_code ignored;
        if (!std::filesystem::exists(name, ignored))
        {
            return name;
        }
    }
    throw Error(ErrorCode::Output, fmt::format("there are {} files like {}.zvo already", kSavedMost, stem));
}

} // namespace

std::string App::editedName() const
{
    const std::string stem = std::filesystem::path(m_world->name).stem().string();
    return (stem.empty() ? "zvo" : stem) + "-edited";
}

bool App::hasUnsaved() const
{
    return m_editor.isBusy() || m_world->scene.editPoint() != m_saved_point;
}

// Saves to the file that was chosen before, or to a new one in the working folder.
bool App::save()
{
    try
    {
        return m_saved_file.empty() ? write(freeName(editedName()), false) : write(m_saved_file, true);
    }
    catch (const Error& error) // there is no free name
    {
        cli::talkError(error);
        return false;
    }
}

// Writes the shown tree to a file, whose name says of what kind it is. Returns whether it is written.
bool App::write(const std::filesystem::path& file, bool overwrites)
{
    if (isMakingAWorld())
    {
        return false;
    }
    finishAll();
    bool is_written = false;
    try
    {
        m_world->scene.settle(worldSeconds());
        cli::Output output(file.string(), overwrites);
        const std::string format = cli::treeFormatOf(file.string());
        cli::writeTree(m_world->copyTree(m_device), format, output);
        output.finish();
        is_written = true;
        note("saved " + file.string());
        const bool can_be_opened = format == "zvo" || format == "vox";
        if (can_be_opened && !m_editor.isBusy())
        {
            m_saved_point = m_world->scene.editPoint();
        }
    }
    catch (const std::exception& error)
    {
        cli::talkError(error);
    }
    m_frame_start = Clock::now();
    return is_written;
}

// Writes the picture without panels as it was traced last: while it stands still, in full size, with all samples so
// far.
void App::savePicture(const std::filesystem::path& file)
{
    try
    {
        finishAll();
        cli::Output output(file.string(), true);
        const std::vector<std::uint8_t> bytes =
            cli::holdsRadiance(file.string())
                ? cli::encodeRadiance(file.string(), m_renderer.radiance())
                : cli::encodePicture(file.string(), m_renderer.pictureSize().width, m_renderer.pictureSize().height,
                                     m_renderer.pixels());
        output.write(std::as_bytes(std::span(bytes)));
        output.finish();
        note("saved " + file.string());
    }
    catch (const std::exception& error)
    {
        cli::talkError(error);
    }
    m_frame_start = Clock::now();
}

void App::saveAs(const std::filesystem::path& file)
{
    if (std::ranges::find(cli::kPictureExtensions, cli::extensionOf(file.string())) != cli::kPictureExtensions.end())
    {
        return savePicture(file);
    }
    if (write(file, true) && cli::treeFormatOf(file.string()) == "zvo")
    {
        m_saved_file = file; // by Ctrl+S from now on
    }
}

void App::openDialog()
{
    const Files& files = m_world_options.voxels.scenes;
    m_file_dialog.openToRead(files.empty() ? "." : files.front().parent_path(), kReadExtensions);
}

void App::saveDialog()
{
    if (!isMakingAWorld())
    {
        m_file_dialog.openToWrite(m_saved_file.parent_path(),
                                  m_saved_file.empty() ? editedName() + ".zvo" : m_saved_file.filename().string(),
                                  kWrittenExtensions);
    }
}

// The question whether strokes may be lost, before the file dialog: of two popups Dear ImGui shows neither. Returns
// whether a dialog is open.
bool App::drawDialogs()
{
    if (m_after_loss)
    {
        drawLossQuestion();
    }
    else if (const std::optional<std::filesystem::path> file = m_file_dialog.show())
    {
        if (!m_file_dialog.writes())
        {
            loadFiles({*file});
        }
        else
        {
            whenFree([this, file = *file] { saveAs(file); });
        }
    }
    return hasDialog();
}

void App::drawLossQuestion()
{
    const std::optional<LossAnswer> answer = lossQuestion();
    if (!answer)
    {
        return;
    }
    const std::function<void()> action = std::exchange(m_after_loss, nullptr);
    if (answer == LossAnswer::Discard)
    {
        action();
    }
    else if (answer == LossAnswer::Save)
    {
        whenFree(
            [this, action]
            {
                if (save())
                {
                    action();
                }
            });
    }
}

bool App::hasDialog() const
{
    return m_file_dialog.isOpen() || m_after_loss;
}

// Does something by which strokes are lost; asks before, where there are such and somebody who can answer.
void App::loseStrokes(std::function<void()> action)
{
    const bool has_user = !m_replay && !m_options.frame_count;
    if (has_user && hasUnsaved())
    {
        m_after_loss = std::move(action);
    }
    else
    {
        action();
    }
}

void App::quit()
{
    loseStrokes([this] { m_quits = true; });
}

void App::filesPanel()
{
    std::vector<Files> recent;
    for (const SceneMemory& memory : m_settings.scenes)
    {
        recent.push_back(memory.files);
    }
    const FilesAnswer answer = demo::filesPanel(recent);
    if (answer.opens)
    {
        openDialog();
    }
    if (answer.saves_as)
    {
        saveDialog();
    }
    if (answer.recent)
    {
        loadFiles(*answer.recent);
    }
}

// Keeps how the scene is looked at, for when its files are opened again.
void App::rememberScene()
{
    if (!m_is_first_world && !m_world_options.voxels.scenes.empty())
    {
        const Exposure& exposure = m_view.frame.exposure;
        remember(m_settings.scenes,
                 {absoluteFiles(m_world_options.voxels.scenes), m_camera.camera(), m_bookmarks,
                  m_view.frame.trace.to_sun, exposure.automatic ? exposure.factor : Exposure().factor});
    }
}

// Returns whether the scene was looked at before: then it is shown as it was.
bool App::recallScene()
{
    const SceneMemory* const memory = recall(m_settings.scenes, absoluteFiles(m_world_options.voxels.scenes));
    if (memory != nullptr)
    {
        m_camera.show(memory->camera);
        m_camera.setSubject(m_world->subject);
        m_bookmarks = memory->bookmarks;
        m_view.frame.trace.to_sun = memory->to_sun;
        m_view.frame.exposure = {.factor = memory->exposure};
    }
    return memory != nullptr;
}

} // namespace zvo::demo
