// SPDX-License-Identifier: MIT
#include "demo/world/world.h"

#include "common/ground.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/tree_input.h"
#include "common/view.h"
#include "core/file/zvo_file.h"
#include "runtime/flatten.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo::demo
{

namespace
{

bool isTreeFile(const std::filesystem::path& file)
{
    return isZvoFile(file) || cli::isVoxFile(file);
}

// A box around a dynamic object in a pose. A skinned vertex lies between the positions that each of its joints would
// give it.
Bounds boundsOf(const Scene& scene, const Pose& pose)
{
    Bounds bounds;
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        Bounds primitive;
        for (const glm::vec3& position : scene.primitives[scene.instances[i].primitive].positions)
        {
            primitive.extend(position);
        }
        const bool has_joints = i < pose.joint_matrices.size() && !pose.joint_matrices[i].empty();
        for (const glm::mat4& matrix : has_joints ? pose.joint_matrices[i] : std::vector{pose.transforms[i]})
        {
            for (int corner = 0; corner < 8; ++corner)
            {
                const glm::bvec3 is_max((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
                bounds.extend(glm::vec3(matrix * glm::vec4(glm::mix(primitive.min, primitive.max, is_max), 1.0F)));
            }
        }
    }
    return bounds;
}

LiveOptions liveOptions(const WorldOptions& options)
{
    return {options.voxels.coverage,
            options.voxels.hasAttributes(),
            options.structure.value_or(TreeStructure::Svo),
            options.frames_in_flight,
            true,
            cli::talk,
            options.voxels.fill};
}

} // namespace

WorldInput World::read(const WorldOptions& options)
{
    const std::vector<std::filesystem::path>& files = options.voxels.scenes;
    const auto tree_file = std::ranges::find_if(files, isTreeFile);
    if (tree_file == files.end())
    {
        return files.empty() ? WorldInput{} : WorldInput{cli::loadAnimatedSceneWithWarnings(options.voxels, true), {}};
    }
    if (files.size() > 1)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} stands alone; show one file of voxels, or scenes", tree_file->string()));
    }
    return cli::isVoxFile(*tree_file) ? WorldInput{} : WorldInput{{}, readZvo(*tree_file).tree};
}

std::unique_ptr<World> World::make(vk::HeadlessDevice& device, const WorldOptions& options, WorldInput input,
                                   const StaticListener& listener)
{
    const std::vector<std::filesystem::path>& files = options.voxels.scenes;
    const std::string name = files.empty() ? "" : files.front().filename().string();
    std::unique_ptr<World> world;
    if (input.animated)
    {
        const Bounds bounds = boundsOverTime(*input.animated);
        const Grid grid = cli::placeGrid(options.voxels, *input.animated, bounds);
        const Bounds subject = cli::subjectOf(*input.animated, bounds, grid);
        if (options.voxels.ground)
        {
            cli::addGround(*input.animated, bounds, grid);
        }
        const cli::SceneCounts counts = cli::SceneCounts::of(input.animated->fixed, grid, options.voxels.coverage);
        world.reset(new World{name, subject,
                              LiveScene(device, std::move(*input.animated), grid, liveOptions(options), listener)});
        if (!world->scene.moves())
        {
            const StaticInfo& fixed = world->scene.info().fixed;
            cli::warnOfDropped(fixed.voxel_count, fixed.dropped, counts, options.voxels.load.strict);
        }
        cli::warnOfOpenSurfaces(world->scene.info().fixed.open, options.voxels.load.strict);
    }
    else if (!files.empty())
    {
        const TreeData tree =
            input.tree ? std::move(*input.tree) : cli::loadVox(files.front(), device, options.voxels.load.strict);
        if (tree.voxel_count == 0)
        {
            cli::talk("warning: the file has no voxels");
        }
        listener.operation("copying to the device");
        world.reset(new World{name, cli::subjectOf(cli::boundsOf(tree), tree.grid),
                              LiveScene(device, tree, liveOptions(options))});
    }
    else
    {
        world.reset(new World{name, {glm::vec3(0.0F), glm::vec3(1.0F)}, LiveScene(device)});
    }
    world->scene.settle(0);
    return world;
}

std::optional<std::size_t> World::objectAt(const glm::dvec3& point) const
{
    const double slack = 2.0 * scene.tree().grid.voxel_size;
    std::optional<std::size_t> best;
    double best_size = 0;
    for (std::size_t i = 0; i < scene.animated().objects.size(); ++i)
    {
        const Bounds bounds = boundsOf(*scene.animated().objects[i].scene, scene.shownPose(i));
        const bool is_inside = glm::all(glm::greaterThanEqual(point, glm::dvec3(bounds.min) - slack)) &&
                               glm::all(glm::lessThanEqual(point, glm::dvec3(bounds.max) + slack));
        const double size = glm::length(glm::dvec3(bounds.max) - glm::dvec3(bounds.min));
        if (is_inside && (!best || size < best_size))
        {
            best = i;
            best_size = size;
        }
    }
    return best;
}

TreeData World::copyTree(vk::HeadlessDevice& device) const
{
    if (!scene.canEdit())
    {
        return downloadTree(device, scene.tree());
    }
    TreeData flat = flattenTree(device, scene.tree());
    return scene.tree().isDag() && !flat.nodes.empty() ? compressTree(device, std::move(flat)) : std::move(flat);
}

} // namespace zvo::demo
