// SPDX-License-Identifier: MIT
#include "bench/lit_scenes.h"

#include "bench/bench_scenes.h"
#include "common/session.h"
#include "common/view.h"
#include "core/light/light_tree.h"
#include "core/path/daylight.h"
#include "core/upload/gpu_scene.h"
#include "runtime/trees.h"

#include <algorithm>
#include <array>
#include <span>

namespace zvo::cli
{

namespace
{

/// What shows a scene that would be dark with a camera and a sun that suit others.
struct SceneView
{
    std::string_view scene;
    const char* camera;
    glm::dvec3 to_sun;
};
constexpr std::array kViews = {SceneView{"sponza", "-10,1.5,-0.4,5,2.5,-0.4,75", {0.25, 1.0, 0.12}}};

const SceneView* viewFor(std::string_view scene)
{
    const auto* const view = std::ranges::find(kViews, scene, &SceneView::scene);
    return view == kViews.end() ? nullptr : view;
}

} // namespace

DeviceEnvironment lightFor(vk::HeadlessDevice& device, std::string_view scene, bool by_day)
{
    if (!by_day)
    {
        return {device.device(), HdrImage{1, 1, {glm::vec3(0.0F)}}, 0.0, 1.0};
    }
    DeviceEnvironment light(device.device());
    const SceneView* const view = viewFor(scene);
    light.setSun(view != nullptr ? daylight(view->to_sun) : daylight());
    return light;
}

std::size_t litSceneCount(const LitBenchOptions& options, const std::vector<std::uint32_t>& depths)
{
    return 2 * benchScenes(options).size() * options.depths.value_or(depths).size();
}

void forEachLitScene(vk::HeadlessDevice& device, const LitBenchOptions& options,
                     const std::vector<std::uint32_t>& depths, double aspect,
                     const std::function<void(LitScene&)>& visit)
{
    for (const std::filesystem::path& path : benchScenes(options))
    {
        const std::string name = path.stem().string();
        const SceneView* const usual = viewFor(name);
        const std::string camera = options.camera.empty() && usual != nullptr ? usual->camera : options.camera;
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        const GpuScene gpu_scene = uploadScene(device, scene, options.attributes, brightestEmission(scene));
        for (const std::uint32_t depth : options.depths.value_or(depths))
        {
            const Grid grid = Grid::around(scene.bounds(), depth);
            const DeviceTree tree =
                buildOctree(device, gpu_scene, grid, {options.coverage, options.attributes, {}}).octree;
            const ViewCamera view = chooseCamera(camera, scene, subjectOf(scene.bounds(), grid), aspect);
            for (const bool by_day : {true, false})
            {
                if (by_day || hasEmission(tree))
                {
                    DeviceEnvironment light = lightFor(device, name, by_day);
                    LitScene lit = {name, tree, view, by_day ? "day" : "night", light};
                    visit(lit);
                }
            }
        }
    }
}

} // namespace zvo::cli
