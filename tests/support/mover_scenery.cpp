// SPDX-License-Identifier: MIT
#include "support/mover_scenery.h"

#include "core/pipeline.h"
#include "support/materials_scene.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace zvo::test
{

namespace
{

constexpr float kExtent = 16.0F;
constexpr std::size_t kRebuildsKept = 64;
constexpr std::array kKindNames = {"inside", "outside", "point", "flat", "mirrored", "turned", "nan", "huge"};

} // namespace

glm::mat4 Place::transform() const
{
    const glm::mat4 one(1.0F);
    const glm::vec3 shift = glm::vec3(at[0], at[1], at[2]) * 3.7F;
    const glm::mat4 moved = glm::translate(one, shift);
    switch (kind)
    {
    case Kind::Inside:
        break;
    case Kind::Outside:
        return glm::translate(one, shift + 10 * kExtent);
    case Kind::Point:
        return glm::scale(moved, glm::vec3(0.0F));
    case Kind::Flat:
        return glm::scale(moved, glm::vec3(1.0F, 0.0F, 2.0F));
    case Kind::Mirrored:
        return glm::scale(glm::translate(moved, glm::vec3(5.0F, 0.0F, 0.0F)), glm::vec3(-1.0F, 1.0F, 1.5F));
    case Kind::Turned:
        return glm::rotate(moved, 0.7F, glm::vec3(0.3F, 0.8F, -0.5F));
    case Kind::Nan:
        return glm::translate(one, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    case Kind::Huge:
        return glm::scale(moved, glm::vec3(std::numeric_limits<float>::max()));
    }
    return moved;
}

std::ostream& operator<<(std::ostream& out, const Place& place)
{
    return out << kKindNames.at(static_cast<std::size_t>(place.kind)) << " at " << place.at[0] << " " << place.at[1]
               << " " << place.at[2];
}

Grid DynamicSetting::grid() const
{
    Grid grid;
    grid.depth = depth;
    grid.voxel_size = kExtent / static_cast<float>(1U << std::min(depth, 6U));
    grid.origin = glm::vec3(kExtent - grid.voxel_size * static_cast<float>(1U << depth));
    return grid;
}

TraceCamera DynamicSetting::camera() const
{
    return shot.camera(grid(), kExtent);
}

DynamicOptions DynamicSetting::options(float emission_scale) const
{
    DynamicOptions options;
    options.coverage = coverage;
    options.merge = merge;
    options.frames_in_flight = frames_in_flight;
    options.history = {steps_max, UINT64_MAX};
    options.emission_scale = emission_scale;
    options.attributes = attributes;
    options.minimal_capacities = minimal_capacities;
    return options;
}

std::ostream& operator<<(std::ostream& out, const DynamicSetting& s)
{
    return out << "depth " << s.depth << ", coverage " << static_cast<int>(s.coverage) << ", merge "
               << static_cast<int>(s.merge) << ", attributes " << s.attributes << ", emits " << s.emits << ", static "
               << s.has_static << ", minimal " << s.minimal_capacities << ", frames " << s.frames_in_flight
               << ", steps " << s.steps_max << ", " << s.shot;
}

MoverScenery::MoverScenery(vk::HeadlessDevice& device, bool emits)
    : m_device(device), m_static(materialsScene(kExtent, 8, 17)),
      m_meshes({materialsScene(kExtent / 2.6F, 5, 31), materialsScene(kExtent / 6, 4, 47)})
{
    for (Scene* scene : {&m_static, &m_meshes[0], &m_meshes[1]})
    {
        for (Material& material : scene->materials)
        {
            material.emission *= emits ? 1.0F : 0.0F;
        }
        m_scale = std::max(m_scale, brightestEmission(*scene));
    }
}

GpuScene MoverScenery::upload(const Scene& scene, bool attributes) const
{
    return uploadScene(m_device, scene, attributes, m_scale);
}

BuildResult MoverScenery::buildStatic(const DynamicSetting& setting) const
{
    BuildOptions build;
    build.coverage = setting.coverage;
    build.attributes = setting.attributes;
    build.keep_sums = setting.attributes && setting.merge == MergeRule::Average;
    const GpuScene uploaded = upload(setting.has_static ? m_static : Scene{}, setting.attributes);
    return buildOctree(m_device, uploaded, setting.grid(), build);
}

std::shared_ptr<const MoverMesh> MoverScenery::mover(std::uint32_t mesh, bool attributes)
{
    std::shared_ptr<const MoverMesh>& mover = m_uploaded[{mesh, attributes}];
    if (mover == nullptr)
    {
        mover = uploadMover(m_device, m_meshes.at(mesh), attributes, m_scale);
    }
    return mover;
}

Pose MoverScenery::poseOf(const Item& item) const
{
    Pose pose;
    for (const Instance& instance : m_meshes.at(item.mesh).instances)
    {
        pose.transforms.push_back(item.place.transform() * instance.transform);
    }
    return pose;
}

std::shared_ptr<const Rebuilt> MoverScenery::rebuilt(const DynamicSetting& setting, bool with_static,
                                                     const std::multiset<Item>& items)
{
    const bool has_static = with_static && setting.has_static;
    const Key key(setting.depth, setting.coverage, setting.attributes, has_static, items);
    if (const auto found = m_rebuilt.find(key); found != m_rebuilt.end())
    {
        return found->second;
    }
    Scene scene = has_static ? m_static : Scene{};
    for (const Item& item : items)
    {
        Scene mesh = m_meshes.at(item.mesh);
        const Pose pose = poseOf(item);
        for (std::size_t i = 0; i < mesh.instances.size(); ++i)
        {
            mesh.instances[i].transform = pose.transforms[i];
        }
        scene.append(std::move(mesh));
    }
    BuildOptions build;
    build.coverage = setting.coverage;
    build.attributes = setting.attributes;
    auto rebuilt = std::make_shared<Rebuilt>();
    rebuilt->octree = buildOctree(m_device, upload(scene, setting.attributes), setting.grid(), build).octree;
    rebuilt->cells = cellsOf(m_device, rebuilt->octree);
    if (m_rebuilt.size() == kRebuildsKept)
    {
        m_rebuilt.clear();
    }
    return m_rebuilt[key] = std::move(rebuilt);
}

} // namespace zvo::test
