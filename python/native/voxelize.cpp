// SPDX-License-Identifier: MIT
#include "voxelize.h"

#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/tree_input.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

namespace zvo::python
{

namespace
{

template <typename T> std::vector<T> copyOf(std::span<const T> elements)
{
    return {elements.begin(), elements.end()};
}

std::vector<glm::vec3> unitNormals(std::span<const glm::vec3> normals)
{
    std::vector<glm::vec3> units;
    units.reserve(normals.size());
    for (const glm::vec3& normal : normals)
    {
        const float length = glm::length(normal);
        units.push_back(length > 0.0F && length < INFINITY ? normal / length : glm::vec3(0.0F));
    }
    return units;
}

std::vector<glm::uvec3> pointsOf(std::size_t count)
{
    std::vector<glm::uvec3> points;
    points.reserve(count);
    for (glm::uint vertex = 0; vertex < count; ++vertex)
    {
        points.emplace_back(vertex);
    }
    return points;
}

std::unique_ptr<Tree> voxelize(const std::shared_ptr<Session>& session, AnimatedScene animated,
                               const cli::VoxelOptions& options)
{
    const Grid grid = cli::placeGrid(options, animated, boundsOverTime(animated));
    const double seconds = loopedTime(animated, options.time.value_or(0.0));
    const Scene scene = sceneAt(std::move(animated), seconds);
    const auto counts = cli::SceneCounts::of(scene, grid, options.coverage);
    BuildResult built = session->use(
        [&](vk::HeadlessDevice& device)
        {
            cli::Progress progress(1);
            const GpuScene uploaded = cli::uploadWithWarnings(device, scene, options, grid, progress);
            return buildOctree(device, uploaded, grid, options.build());
        });
    cli::warnOfDropped(built.octree.occupiedCount(), built.dropped, counts, false);
    cli::warnOfOpenSurfaces(built.open, false);
    return std::make_unique<Tree>(session, std::move(built.octree));
}

// Of a file that holds voxels already.
void checkTreeOptions(const cli::VoxelOptions& options)
{
    const std::string path = options.scenes.front().string();
    if (options.scenes.size() > 1)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} holds voxels; it is loaded alone", path));
    }
    if (options.depth || options.bounds || options.time || options.fill != Fill::None)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} holds voxels; resolution, bounds, time and fill are not chosen for it", path));
    }
}

} // namespace

Scene sceneOf(const Mesh& mesh)
{
    Primitive primitive;
    primitive.positions = copyOf(mesh.positions);
    primitive.is_points = mesh.is_points;
    primitive.triangles = mesh.is_points ? pointsOf(mesh.positions.size()) : copyOf(mesh.triangles);
    primitive.normals = unitNormals(mesh.normals);
    primitive.colors = copyOf(mesh.colors);
    primitive.uvs = copyOf(mesh.uvs);
    Material material;
    Scene scene;
    if (!mesh.texture.rgba.empty())
    {
        scene.images.push_back({"texture", mesh.texture.width, mesh.texture.height, copyOf(mesh.texture.rgba)});
        scene.textures.push_back({});
        material.base_color_texture = 0;
    }
    scene.materials.push_back(std::move(material));
    scene.primitives.push_back(std::move(primitive));
    scene.instances.push_back({});
    return scene;
}

std::unique_ptr<Tree> voxelize(const std::string& device, Scene scene, const cli::VoxelOptions& options)
{
    AnimatedScene animated;
    animated.fixed = std::move(scene);
    return voxelize(Session::of(device), std::move(animated), options);
}

std::unique_ptr<Tree> load(const std::string& device, const cli::VoxelOptions& options)
{
    const std::shared_ptr<Session> session = Session::of(device);
    if (std::ranges::none_of(options.scenes, cli::isTreeFile))
    {
        AnimatedScene animated =
            cli::loadAnimatedSceneWithWarnings(options, options.time.has_value(), ImageDecoding::WhenUploaded);
        cli::warnOfMergeRule(animated);
        return voxelize(session, std::move(animated), options);
    }
    checkTreeOptions(options);
    DeviceTree tree = session->use(
        [&](vk::HeadlessDevice& opened)
        {
            const auto same = [&]() -> vk::HeadlessDevice& { return opened; };
            return uploadTree(opened, cli::loadTree(options.scenes.front(), same, false));
        });
    return std::make_unique<Tree>(session, std::move(tree));
}

} // namespace zvo::python
