// SPDX-License-Identifier: MIT
#include "bench/bench_scenes.h"

#include "common/progress.h"
#include "common/session.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string>
#include <system_error>

namespace zvo::cli
{

namespace
{

namespace fs = std::filesystem;

constexpr std::array kUsualScenes = {"bunny_low.glb", "dragon.glb", "sponza.glb"};
constexpr std::array kOwnScenes = {"cornell_box.glb", "knot.glb", "atrium.glb"};
constexpr std::array kThesisScenes = {"buddha_dragon.scene.json", "sponza_bunny.scene.json"};

// The files of the project's own with these names, in the working directory or in the program's source tree.
std::vector<fs::path> ownScenes(std::span<const char* const> names)
{
    std::error_code ignored;
    std::vector<fs::path> folders = {"scenes"};
    for (fs::path folder = fs::read_symlink("/proc/self/exe", ignored); folder.has_relative_path();)
    {
        folder = folder.parent_path();
        folders.push_back(folder / "scenes");
    }
    for (const fs::path& folder : folders)
    {
        std::vector<fs::path> scenes;
        for (const char* name : names)
        {
            if (fs::exists(folder / name, ignored))
            {
                scenes.push_back(folder / name);
            }
        }
        if (!scenes.empty())
        {
            return scenes;
        }
    }
    return {};
}

std::vector<fs::path> scenesOf(const BenchOptions& options)
{
    if (!options.scenes.empty())
    {
        return options.scenes;
    }
    std::error_code missing;
    if (options.scene_folder && !fs::is_directory(*options.scene_folder, missing))
    {
        throw Error(ErrorCode::Input, fmt::format("--scenes {} is not a folder", options.scene_folder->string()));
    }
    const fs::path folder = options.scene_folder.value_or("scenes");
    std::vector<fs::path> scenes;
    std::vector<std::string> absent;
    for (const char* name : kUsualScenes)
    {
        std::error_code ignored;
        const fs::path path = folder / name;
        if (fs::exists(path, ignored))
        {
            scenes.push_back(path);
        }
        else
        {
            absent.emplace_back(name);
        }
    }
    if (!scenes.empty())
    {
        if (!absent.empty())
        {
            talk(fmt::format("warning: {} has no {}", folder.string(), fmt::join(absent, ", ")));
        }
        return scenes;
    }
    scenes = ownScenes(kOwnScenes);
    if (scenes.empty())
    {
        throw Error(ErrorCode::Input, fmt::format("{} has none of {}; name scenes to measure, or their folder by "
                                                  "--scenes",
                                                  folder.string(), fmt::join(kUsualScenes, ", ")));
    }
    talk(fmt::format("{} has none of {}: measuring the project's own scenes", folder.string(),
                     fmt::join(kUsualScenes, ", ")));
    return scenes;
}

// Throws the loader's error if a file is missing, which would otherwise show only after an hour.
void checkPresent(const std::vector<fs::path>& paths, bool allows_scene_files)
{
    for (const fs::path& path : paths)
    {
        if (isSceneFile(path) && !allows_scene_files)
        {
            throw Error(ErrorCode::Usage,
                        fmt::format("{} is a scene file, which the commands dynamic, cache and baselines measure",
                                    path.string()));
        }
        std::error_code ignored;
        if (!isSceneFile(path) && !fs::exists(path, ignored))
        {
            loadWithWarnings(std::span(&path, 1), {});
        }
    }
}

} // namespace

std::vector<fs::path> benchScenes(const BenchOptions& options, bool allows_scene_files)
{
    std::vector<fs::path> paths = scenesOf(options);
    checkPresent(paths, allows_scene_files);
    return paths;
}

AnimatedScene loadSceneFile(const BenchOptions& options, const fs::path& path)
{
    VoxelOptions voxels;
    voxels.scenes = {path};
    voxels.load = options.load;
    voxels.scenes_folder = options.scene_folder;
    return loadAnimatedSceneWithWarnings(voxels, true);
}

Grid gridOf(const AnimatedScene& animated, const Bounds& bounds_over_time, std::uint32_t depth)
{
    return animated.grid_bounds ? Grid::withCorner(*animated.grid_bounds, depth)
                                : Grid::around(bounds_over_time, depth);
}

std::vector<fs::path> thesisScenes()
{
    return ownScenes(kThesisScenes);
}

} // namespace zvo::cli
