// SPDX-License-Identifier: MIT
#include "bench/lit_scenes.h"

#include "bench/bench_scenes.h"
#include "common/session.h"
#include "common/view.h"
#include "core/headless/pipeline.h"
#include "core/light/light_tree.h"
#include "core/path/daylight.h"
#include "core/upload/gpu_scene.h"

#include <span>

namespace zvo::cli
{

namespace
{

DeviceEnvironment environmentFor(vk::HeadlessDevice& device, bool by_day)
{
    if (!by_day)
    {
        return {device.device(), HdrImage{1, 1, {glm::vec3(0.0F)}}, 0.0, 1.0};
    }
    DeviceEnvironment light(device.device());
    light.setSun(daylight());
    return light;
}

} // namespace

std::size_t litSceneCount(const BenchOptions& options, const std::vector<std::uint32_t>& depths)
{
    return 2 * benchScenes(options).size() * options.depths.value_or(depths).size();
}

void forEachLitScene(vk::HeadlessDevice& device, const BenchOptions& options, const std::vector<std::uint32_t>& depths,
                     double aspect, const std::function<void(LitScene&)>& visit)
{
    for (const std::filesystem::path& path : benchScenes(options))
    {
        const Scene scene = loadWithWarnings(std::span(&path, 1), options.load);
        const GpuScene gpu_scene = uploadScene(device, scene, options.attributes, brightestEmission(scene));
        for (const std::uint32_t depth : options.depths.value_or(depths))
        {
            const Grid grid = Grid::around(scene.bounds(), depth);
            const DeviceTree tree =
                buildOctree(device, gpu_scene, grid, {options.coverage, options.attributes, {}}).octree;
            const ViewCamera view = chooseCamera(options.camera, scene, subjectOf(scene.bounds(), grid), aspect);
            for (const bool by_day : {true, false})
            {
                if (by_day || hasEmission(tree))
                {
                    DeviceEnvironment light = environmentFor(device, by_day);
                    LitScene lit = {path.stem().string(), tree, view, by_day ? "day" : "night", light};
                    visit(lit);
                }
            }
        }
    }
}

} // namespace zvo::cli
