// SPDX-License-Identifier: MIT
#include "session.h"

#include "core/load_scene.h"
#include "progress.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace zvo::cli
{

namespace
{

std::filesystem::path environmentPath(const char* variable)
{
    const char* value = std::getenv(variable);
    const std::filesystem::path path = value != nullptr ? value : "";
    return path.is_absolute() ? path : std::filesystem::path();
}

// Empty where there is no place for it.
std::filesystem::path cacheFolder()
{
    std::filesystem::path base = environmentPath("XDG_CACHE_HOME");
    if (base.empty())
    {
        base = environmentPath("HOME");
        base = base.empty() ? base : base / ".cache";
    }
    return base.empty() ? base : base / "zvo";
}

} // namespace

vk::HeadlessOptions headlessOptions(const DeviceOptions& options)
{
    vk::HeadlessOptions headless;
    headless.device = options.device;
    headless.validation = options.validation || options.gpu_validation;
    headless.gpu_assisted_validation = options.gpu_validation;
    headless.memory_budget_bytes = options.memory_limit;
    headless.slices.submission_ms = options.dispatch_ms;
    const std::filesystem::path folder = cacheFolder();
    headless.pipeline_cache_path = folder.empty() ? "" : (folder / "pipelines.bin").string();
    return headless;
}

Scene loadWithWarnings(std::span<const std::filesystem::path> paths, const LoadOptions& options)
{
    Scene scene = loadScene(paths, options);
    for (const std::vector<std::string>* warnings : {&scene.warnings, &scene.rest_warnings})
    {
        for (const std::string& warning : *warnings)
        {
            talk(fmt::format("warning: {}", warning));
        }
    }
    if (scene.triangleCount() == 0)
    {
        talk("warning: the scene has no triangles");
    }
    return scene;
}

Grid placeGrid(const VoxelOptions& options, const Bounds& bounds)
{
    if (options.grid_place)
    {
        return {options.grid_place->origin, options.grid_place->voxel_size, options.depth};
    }
    return options.bounds ? Grid::withCorner(*options.bounds, options.depth) : Grid::around(bounds, options.depth);
}

void warnOfDropped(const BuildResult& result)
{
    if (result.octree.voxel_count == 0)
    {
        talk("warning: there are no voxels; the grid misses the scene, or its triangles have no area at this "
             "resolution");
    }
    for (const char* reason : {"nonfinite", "out_of_range"})
    {
        const auto dropped = result.dropped.find(reason);
        if (dropped != result.dropped.end())
        {
            talk(fmt::format("warning: {} triangles left out ({})", dropped->second, reason));
        }
    }
}

void checkValidation(const vk::HeadlessDevice& device)
{
    const std::uint32_t count = device.validationMessageCount();
    if (count != 0)
    {
        throw Error(ErrorCode::Other, fmt::format("the validation layers reported {} {}, see above", count,
                                                  count == 1 ? "problem" : "problems"));
    }
}

} // namespace zvo::cli
