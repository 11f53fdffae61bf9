// SPDX-License-Identifier: MIT
// Options of `zvo render` that do not go together.
#include "commands.h"
#include "common/output.h"
#include "common/tree_input.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

// "path, cache or cones".
std::string namesOf(std::initializer_list<Integrator> integrators)
{
    std::string names;
    for (const Integrator& integrator : integrators)
    {
        const char* const before = names.empty() ? "" : &integrator + 1 == integrators.end() ? " or " : ", ";
        names += fmt::format("{}{}", before, nameOf(kIntegrators, integrator));
    }
    return names;
}

} // namespace

void checkTreeOptions(const RenderOptions& options)
{
    const VoxelOptions& voxels = options.voxels;
    const VoxelOptions plain;
    if (voxels.scenes.size() > 1)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} stands alone; show one .zvo or .vox file, or scenes",
                                                  std::ranges::find_if(voxels.scenes, isTreeFile)->string()));
    }
    const std::pair<const char*, bool> given[] = {
        {"--up", voxels.load.up != plain.load.up},
        {"--scale", voxels.load.scale != plain.load.scale},
        {"--skip-material", !voxels.load.skip_materials.empty()},
        {"--keep-hulls", voxels.load.keep_hulls},
        {"--point-size", voxels.load.point_size != plain.load.point_size},
        {"--bind-pose", voxels.load.bind_pose},
        {"--scenes", voxels.scenes_folder.has_value()},
        {"--time", voxels.time.has_value() && !options.camera_path},
        {"--resolution", voxels.depth.has_value()},
        {"--margin", voxels.margin.has_value()},
        {"--coverage", voxels.coverage != plain.coverage},
        {"--fill", voxels.fill != plain.fill},
        {"--shell", voxels.shell != plain.shell},
        {"--attributes", voxels.attributes != plain.attributes},
        {"--bounds", voxels.bounds.has_value()},
        {"--grid", voxels.grid_position.has_value()},
        {"--ground", voxels.ground},
        {"--structure", options.structure.has_value()},
        {"--rebuild", options.rebuild},
    };
    for (const auto& [name, is_given] : given)
    {
        if (is_given)
        {
            throw Error(ErrorCode::Usage, fmt::format("{} does not go with {}, whose voxels are made already", name,
                                                      voxels.scenes.front().string()));
        }
    }
}

void checkIntegratorOptions(const RenderOptions& options)
{
    using Integrators = std::initializer_list<Integrator>;
    const Integrators of_paths = {Integrator::Path};
    const Integrators of_cache = {Integrator::Cache, Integrator::Cones};
    const Integrators of_faces = {Integrator::Primary, Integrator::Path, Integrator::Cache};
    const Integrators of_light = {Integrator::Path, Integrator::Cache, Integrator::Cones};
    const Integrators of_primary = {Integrator::Primary};
    const RenderOptions plain;
    const FrameOptions& frame = options.frame;
    const EnvironmentOptions& environment = options.environment;
    const std::tuple<const char*, bool, Integrators> given[] = {
        {"--bounces", frame.path.bounces != plain.frame.path.bounces, of_paths},
        {"--seed", frame.path.seed != plain.frame.path.seed, of_light},
        {"--settle", options.settle != plain.settle, of_cache},
        {"--rays", frame.radiance != plain.frame.radiance, of_cache},
        {"--shading", frame.shading != plain.frame.shading, of_faces},
        {"--aperture", frame.path.lens_radius != plain.frame.path.lens_radius, of_paths},
        {"--focus", options.focus.has_value(), of_paths},
        {"--environment", environment.map.has_value(), of_light},
        {"--environment-turn", environment.turn != plain.environment.turn, of_light},
        {"--environment-strength", environment.strength != plain.environment.strength, of_light},
        {"--background-blur", environment.background_blur != plain.environment.background_blur, of_light},
        {"--denoise", frame.denoise, of_paths},
        {"--aov", options.aovs, of_paths},
        {"--path-form", frame.path_form.has_value(), of_paths},
        {"--view", frame.trace.view != plain.frame.trace.view, of_primary},
        {"--occlusion", frame.trace.occlusion_rays != plain.frame.trace.occlusion_rays, of_primary},
        {"--detail", frame.trace.detail_pixels != plain.frame.trace.detail_pixels, of_primary},
    };
    for (const auto& [name, is_given, integrators] : given)
    {
        if (is_given && std::find(integrators.begin(), integrators.end(), frame.integrator) == integrators.end())
        {
            throw Error(ErrorCode::Usage, *integrators.begin() == Integrator::Primary
                                              ? fmt::format("{} does not go with --integrator {}", name,
                                                            nameOf(kIntegrators, frame.integrator))
                                              : fmt::format("{} needs --integrator {}", name, namesOf(integrators)));
        }
    }
    if (options.samples && frame.trace.view != plain.frame.trace.view)
    {
        throw Error(ErrorCode::Usage, fmt::format("--spp does not go with --view {}, which has no light",
                                                  nameOf(kViews, frame.trace.view)));
    }
    const bool has_map = environment.map && *environment.map != "none";
    if (environment.turn != plain.environment.turn && !has_map)
    {
        throw Error(ErrorCode::Usage, "--environment-turn needs a map: --environment FILE");
    }
    if (environment.strength != plain.environment.strength && !has_map)
    {
        throw Error(ErrorCode::Usage, "--environment-strength needs a map: --environment FILE");
    }
    if (environment.background_blur != plain.environment.background_blur && !has_map)
    {
        throw Error(ErrorCode::Usage, "--background-blur needs a map: --environment FILE");
    }
    if (options.focus && frame.path.lens_radius == plain.frame.path.lens_radius)
    {
        throw Error(ErrorCode::Usage, "--focus needs --aperture: all is sharp without a lens");
    }
    if (options.aovs && extensionOf(options.output.path) != ".exr")
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("--aov needs an output that ends in .exr, not {}", options.output.path));
    }
    const std::string extension = extensionOf(options.output.path);
    if (options.quality && extension != ".jpg" && extension != ".jpeg" && extension != ".webp")
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("--quality needs an output that ends in .jpg or .webp, not {}", options.output.path));
    }
}

} // namespace zvo::cli
