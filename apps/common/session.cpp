// SPDX-License-Identifier: MIT
#include "common/session.h"

#include "common/ground.h"
#include "common/names.h"
#include "common/progress.h"
#include "common/report.h"
#include "common/words.h"
#include "core/base/kernels.h"
#include "io/scene/load_scene.h"
#include "io/scene/scene_part.h"
#include "vk/log_file.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace zvo::cli
{

namespace
{

struct KeptDevice
{
    DeviceOptions options;
    std::shared_ptr<vk::HeadlessDevice> device;
};
std::optional<std::vector<KeptDevice>> g_kept_devices;

void warnOfNothing(bool has_triangles)
{
    if (!has_triangles)
    {
        talk("warning: the scene has no triangles and no points");
    }
}

// The dropped triangles whose numbers are invalid, without those that lie outside.
std::map<std::string, std::uint64_t> senselessAmong(std::map<std::string, std::uint64_t> dropped)
{
    std::erase_if(dropped,
                  [](const auto& entry) { return entry.first != "nonfinite" && entry.first != "out_of_range"; });
    return dropped;
}

// Counts the triangles of a scene by the reason for which none has a voxel.
std::string whyNoVoxels(const std::map<std::string, std::uint64_t>& dropped, const SceneCounts& counts)
{
    if (counts.triangles == 0)
    {
        return "the scene has no triangles and no points";
    }
    std::uint64_t rest = counts.triangles;
    std::vector<std::string> reasons;
    const auto add = [&](std::uint64_t count, std::string_view reason)
    {
        count = std::min(count, rest);
        rest -= count;
        if (count != 0)
        {
            reasons.push_back(fmt::format("{} {}", count, reason));
        }
    };
    const auto countOf = [&](const char* reason) { return dropped.contains(reason) ? dropped.at(reason) : 0; };
    const std::uint64_t thin = countOf("zero_area");
    add(countOf("outside") + countOf("out_of_range"), "lie outside of the grid");
    add(countOf("nonfinite"), "have coordinates that are not finite");
    rest -= std::min(thin, rest); // are added last
    for (const auto& [material, count] : counts.transparent)
    {
        add(count, fmt::format("are transparent (material \"{}\")", material));
    }
    rest += thin;
    add(rest, "are too small or thin to reach the middle of a voxel (--coverage conservative keeps them)");
    return fmt::format("of {}, {}", counts.told(), fmt::join(reasons, ", "));
}

// Refuses options that have no effect with a scene file.
void checkSceneFileOptions(const VoxelOptions& options)
{
    if (options.scenes.size() > 1)
    {
        throw Error(ErrorCode::Usage, "a scene file (.scene.json) stands alone; name further files in it");
    }
    if (options.load.up != UpAxis::Y || options.load.scale != 1.0F || options.load.bind_pose)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("--up, --scale and --bind-pose do not go with {}; write up and place into it",
                                options.scenes.front().string()));
    }
    std::error_code missing;
    if (options.scenes_folder && !std::filesystem::is_directory(*options.scenes_folder, missing))
    {
        throw Error(ErrorCode::Input, fmt::format("--scenes {} is not a folder", options.scenes_folder->string()));
    }
}

} // namespace

std::filesystem::path userFolder(const char* variable, const char* in_home)
{
    const auto absolutePath = [](const char* name)
    {
        const char* const value = std::getenv(name);
        const std::filesystem::path path = value != nullptr ? value : "";
        return path.is_absolute() ? path : std::filesystem::path();
    };
    const std::filesystem::path named = absolutePath(variable);
    const std::filesystem::path home = absolutePath("HOME");
    return !named.empty() ? named / "zvo" : home.empty() ? home : home / in_home / "zvo";
}

vk::HeadlessOptions headlessOptions(const DeviceOptions& options)
{
    vk::HeadlessOptions headless;
    headless.device = options.device;
    headless.validation = options.validation || options.gpu_validation;
    headless.gpu_assisted_validation = options.gpu_validation;
    headless.memory_budget_bytes = options.memory_limit;
    headless.memory_budget_name = "--memory-limit";
    headless.slices.submission_ms = options.dispatch_ms;
    headless.tuning = options.tuning;
    headless.log = vk::logToFile(std::getenv("ZVO_LOG"));
    const std::filesystem::path folder = userFolder("XDG_CACHE_HOME", ".cache");
    headless.pipeline_cache_path = folder.empty() ? "" : (folder / "pipelines.bin").string();
    return headless;
}

std::shared_ptr<vk::HeadlessDevice> openDevice(const DeviceOptions& options)
{
    const auto make = [&] { return std::make_shared<vk::HeadlessDevice>(headlessOptions(options), zvoKernels()); };
    if (!g_kept_devices)
    {
        return make();
    }
    const auto kept = std::ranges::find(*g_kept_devices, options, &KeptDevice::options);
    if (kept == g_kept_devices->end())
    {
        g_kept_devices->push_back({options, make()});
        return g_kept_devices->back().device;
    }
    kept->device->device().memory().resetPeak();
    return kept->device;
}

KeptDevices::KeptDevices()
{
    g_kept_devices.emplace();
}

KeptDevices::~KeptDevices()
{
    g_kept_devices.reset();
}

Scene loadWithWarnings(std::span<const std::filesystem::path> paths, const LoadOptions& options)
{
    Scene scene = atRest(loadScene(paths, options));
    warnOrRefuse(scene.warnings, false);
    warnOfNothing(scene.triangleCount() != 0);
    return scene;
}

AnimatedScene loadAnimatedSceneWithWarnings(const VoxelOptions& options, bool in_motion, ImageDecoding decoding)
{
    LoadOptions load = options.load;
    load.images = decoding;
    const bool is_scene_file = std::any_of(options.scenes.begin(), options.scenes.end(), isSceneFile);
    if (!is_scene_file && options.scenes_folder)
    {
        throw Error(ErrorCode::Usage, "--scenes goes with a scene file (.scene.json)");
    }
    AnimatedScene animated;
    if (is_scene_file)
    {
        checkSceneFileOptions(options);
        animated = loadAnimatedScene(options.scenes.front(), {options.scenes_folder, "--scenes", load});
    }
    else if (in_motion)
    {
        animated = animatedSceneOf(loadScene(options.scenes, load), options.scenes.front().stem().string());
        animated.files = options.scenes;
    }
    else
    {
        animated.fixed = atRest(loadScene(options.scenes, load));
        animated.files = options.scenes;
        warnOrRefuse(animated.fixed.warnings, false);
    }
    warnOrRefuse(animated.warnings, false);
    const bool has_triangles =
        animated.fixed.triangleCount() != 0 ||
        std::any_of(animated.objects.begin(), animated.objects.end(),
                    [](const DynamicObject& object) { return object.scene->triangleCount() != 0; });
    warnOfNothing(has_triangles);
    if (options.time && animated.objects.empty())
    {
        talk("warning: nothing moves in this scene, it is the same at every --time");
    }
    return animated;
}

GpuScene uploadWithWarnings(vk::HeadlessDevice& device, const Scene& scene, const VoxelOptions& options,
                            const std::optional<Grid>& grid, Progress& progress)
{
    GpuScene uploaded = uploadScene(device, scene, options.hasAttributes(), std::nullopt,
                                    {grid, options.coverage, [&](double done) { progress.within(done); }});
    warnOrRefuse(uploaded.warnings, false);
    return uploaded;
}

Grid placeGrid(const VoxelOptions& options, const AnimatedScene& animated, const Bounds& bounds)
{
    constexpr std::uint32_t kDefaultDepth = 9;
    const std::uint32_t depth = options.depth.value_or(animated.grid_depth.value_or(kDefaultDepth));
    if (options.grid_position)
    {
        return {options.grid_position->origin, options.grid_position->voxel_size, depth};
    }
    const std::optional<Bounds>& wanted = options.bounds ? options.bounds : animated.grid_bounds;
    if (wanted && !options.margin)
    {
        return Grid::withCorner(*wanted, depth);
    }
    const std::uint32_t margin = options.margin.value_or(options.default_margin);
    if (2 * margin >= 1U << depth)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("--margin {}: leaves nothing of a grid of {} voxels an edge", margin, 1U << depth));
    }
    const Grid grid = Grid::around(wanted.value_or(bounds), depth, margin);
    return options.ground && !wanted ? gridWithGround(grid, bounds) : grid;
}

bool warnOfDropped(std::uint64_t voxel_count, const std::map<std::string, std::uint64_t>& dropped,
                   const SceneCounts& counts, bool strict)
{
    std::vector<std::string> lines;
    if (voxel_count == 0)
    {
        lines.push_back("there are no voxels: " + whyNoVoxels(dropped, counts));
    }
    else if (counts.parts && counts.parts->lost != 0)
    {
        lines.push_back(fmt::format("{} of {} parts {} no voxel at this resolution; --coverage conservative keeps them",
                                    counts.parts->lost, counts.parts->parts, counts.parts->lost == 1 ? "has" : "have"));
    }
    for (const auto& [reason, count] : senselessAmong(dropped))
    {
        lines.push_back(fmt::format("{} of {} left out ({})", count, counts.told(), reason));
    }
    warnOrRefuse(lines, strict);
    return !lines.empty();
}

bool warnOfOpenSurfaces(const OpenSurfaces& open, bool strict)
{
    if (open.lines == 0 && open.undecided.value_or(0) == 0)
    {
        return false;
    }
    const bool one = open.lines == 1;
    const std::string effect =
        open.undecided
            ? fmt::format("{} of voxels {} inside behind all of them; what most rays and neighbours say is filled, "
                          "and {} that cannot be decided left out",
                          counted(open.lines, "line"), one ? "is" : "are", counted(*open.undecided, "voxel"))
            : fmt::format("{} of voxels {} inside below all of them, so that what is filled there may be wrong",
                          counted(open.lines, "vertical line"), one ? "is" : "are");
    warnOrRefuse({"the surfaces are open, or reach out of the grid: " + effect}, strict);
    return true;
}

bool warnOfDroppedTriangles(double seconds, const std::map<std::string, std::uint64_t>& dropped)
{
    std::vector<std::string> counts;
    for (const auto& [reason, count] : senselessAmong(dropped))
    {
        counts.push_back(fmt::format("{} ({})", count, reason));
    }
    if (!counts.empty())
    {
        talk(fmt::format("warning: at {:g} s, left out of what moves: {}", seconds, fmt::join(counts, ", ")));
    }
    return !counts.empty();
}

void warnOfMergeRule(const AnimatedScene& animated)
{
    if (!animated.objects.empty() && animated.merge != MergeRule::Average)
    {
        talk(fmt::format("warning: everything is voxelized together, which averages where objects overlap; the scene "
                         "file's merge, {}, has no effect",
                         nameOf(kMergeRules, animated.merge)));
    }
    if (std::ranges::any_of(animated.objects, &DynamicObject::carves))
    {
        talk("warning: everything is voxelized together: objects that carve are left out");
    }
}

void checkValidation(const vk::HeadlessDevice& device)
{
    const std::uint32_t count = device.validationMessageCount();
    if (count != 0)
    {
        throw Error(ErrorCode::Other,
                    fmt::format("the validation layers reported {}, see above", counted(count, "problem")));
    }
}

} // namespace zvo::cli
