// SPDX-License-Identifier: MIT
// App: the light that the user gives to the scene.
#include "demo/app/app.h"

#include "common/environment_input.h"
#include "common/progress.h"
#include "demo/world/hit_face.h"

#include <fmt/format.h>

#include <exception>
#include <optional>

namespace zvo::demo
{

// Options of the command line come before what is kept of earlier runs.
void App::applyViewOptions()
{
    for (const ViewChange& change : m_options.view_changes)
    {
        change(m_view);
    }
}

// Lights the picture by a map. Throws Error.
void App::setEnvironment(const cli::EnvironmentOptions& options)
{
    finishAll();
    m_renderer.setSky(cli::readEnvironment(m_device.device(), options, std::nullopt));
    m_has_map = true;
    if (m_view.frame.integrator == Integrator::Primary) // which has no light of maps
    {
        m_view.frame.integrator = Integrator::Path;
    }
}

void App::loadEnvironment(const std::filesystem::path& file)
{
    try
    {
        cli::EnvironmentOptions options = m_options.environment;
        options.map = file;
        setEnvironment(options);
        note("light of " + file.filename().string());
    }
    catch (const std::exception& error)
    {
        cli::talkError(error);
    }
    m_frame_start = Clock::now();
}

// Brings what is under the pointer into focus.
void App::focusOn(const gpu::PixelReport& report)
{
    if (report.hit == 0)
    {
        return;
    }
    const glm::dvec3 middle = nodeCenter(m_world->scene.tree().grid, glm::ivec3(report.cell), report.level);
    const ViewCamera& camera = m_camera.camera();
    const double distance = glm::dot(middle - camera.position, camera.forward);
    if (distance > 0)
    {
        m_view.frame.path.focus_distance = static_cast<float>(distance);
        note(fmt::format("in focus: {:.3g} units away", distance));
    }
}

} // namespace zvo::demo
