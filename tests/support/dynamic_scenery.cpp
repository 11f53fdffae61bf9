// SPDX-License-Identifier: MIT
#include "support/dynamic_scenery.h"

#include "runtime/trees.h"
#include "support/deforming_scenes.h"
#include "support/materials_scene.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

namespace zvo::test
{

namespace
{

constexpr float kExtent = 16.0F;
constexpr std::size_t kRebuildsKept = 64;
constexpr std::array kKindNames = {"inside", "outside", "point", "flat", "mirrored", "turned", "nan", "huge"};

// Rigs the first primitives of scene, each of one instance; their vertices get normals where parts say so.
Scene rigged(Scene scene, std::uint32_t seed, const std::vector<DeformingParts>& parts)
{
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        Primitive& primitive = scene.primitives.at(i);
        Primitive rig = deformingPrimitive(random, primitive.positions.size(), parts[i]);
        primitive.normals = std::move(rig.normals);
        primitive.joints = std::move(rig.joints);
        primitive.weights = std::move(rig.weights);
        primitive.morph_targets = std::move(rig.morph_targets);
        if (parts[i].joint_count != 0)
        {
            scene.instances.at(i).skin = static_cast<std::uint32_t>(scene.skins.size());
            scene.skins.push_back({std::vector<std::uint32_t>(parts[i].joint_count, 0),
                                   std::vector<glm::mat4>(parts[i].joint_count, glm::mat4(1.0F))});
            scene.nodes.resize(1);
        }
    }
    return scene;
}

} // namespace

glm::mat4 Placement::transform() const
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

std::ostream& operator<<(std::ostream& out, const Placement& place)
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
    options.history = {entries_max, UINT64_MAX};
    options.emission_scale = emission_scale;
    options.attributes = attributes;
    options.minimal_capacities = minimal_capacities;
    return options;
}

std::ostream& operator<<(std::ostream& out, const DynamicSetting& s)
{
    return out << "depth " << s.depth << ", coverage " << static_cast<int>(s.coverage) << ", merge "
               << static_cast<int>(s.merge) << ", attributes " << s.attributes << ", emits " << s.emits << ", static "
               << s.has_static << ", compressed " << s.compressed << ", filled " << s.filled << ", minimal "
               << s.minimal_capacities << ", frames " << s.frames_in_flight << ", entries " << s.entries_max << ", "
               << s.shot;
}

DynamicScenery::DynamicScenery(vk::HeadlessDevice& device, bool emits)
    : m_device(device), m_static(materialsScene(kExtent, 8, 17)),
      m_meshes({materialsScene(kExtent / 2.6F, 5, 31), materialsScene(kExtent / 6, 4, 47),
                rigged(materialsScene(kExtent / 4, 4, 53), 1, {{true, 5, 0}, {true, 3, 0}, {false, 9, 0}}),
                rigged(materialsScene(kExtent / 3, 4, 59), 2, {{true, 0, 3}, {false, 0, 2}}),
                rigged(materialsScene(kExtent / 4, 3, 61), 3, {{true, 4, 3}, {false, 0, 4}, {true, 7, 0}})})
{
    const auto prepare = [&](Scene& scene)
    {
        for (Material& material : scene.materials)
        {
            material.emission *= emits ? 1.0F : 0.0F;
        }
        m_scale = std::max(m_scale, brightestEmission(scene));
    };
    prepare(m_static);
    std::ranges::for_each(m_meshes, prepare);
}

GpuScene DynamicScenery::upload(const Scene& scene, bool attributes) const
{
    return uploadScene(m_device, scene, attributes, m_scale);
}

DeviceTree DynamicScenery::buildStatic(const DynamicSetting& setting) const
{
    BuildOptions build;
    build.coverage = setting.coverage;
    build.attributes = setting.attributes;
    build.keep_sums = setting.attributes && setting.merge == MergeRule::Average;
    build.fill = setting.filled ? Fill::Solid : Fill::None;
    const GpuScene uploaded = upload(setting.has_static ? m_static : Scene{}, setting.attributes);
    BuildResult built = buildOctree(m_device, uploaded, setting.grid(), build);
    return setting.compressed ? compress(m_device, std::move(built.octree)).dag : std::move(built.octree);
}

std::shared_ptr<const DynamicMesh> DynamicScenery::object(std::uint32_t mesh, bool attributes)
{
    std::shared_ptr<const DynamicMesh>& object = m_uploaded[{mesh, attributes}];
    if (object == nullptr)
    {
        object = uploadDynamicMesh(m_device, m_meshes.at(mesh), attributes, m_scale);
    }
    return object;
}

Pose DynamicScenery::poseOf(const Item& item) const
{
    const Scene& scene = m_meshes.at(item.mesh);
    const glm::mat4 place = item.placement.transform();
    Pose pose;
    for (const Instance& instance : scene.instances)
    {
        const bool is_skinned = instance.skin != kNone;
        pose.transforms.push_back(is_skinned ? glm::mat4(1.0F) : place * instance.transform);
        pose.joint_matrices.emplace_back(is_skinned ? scene.skins[instance.skin].joints.size() : 0);
        pose.morph_weights.emplace_back(scene.primitives[instance.primitive].morph_targets.size());
    }
    const std::vector<glm::mat4> transforms = pose.transforms;
    std::mt19937 random(item.bend);
    changePose(random, pose);
    pose.transforms = transforms;
    for (std::vector<glm::mat4>& joints : pose.joint_matrices)
    {
        for (glm::mat4& joint : joints)
        {
            joint = place * joint;
        }
    }
    return pose;
}

std::shared_ptr<const Rebuilt> DynamicScenery::rebuilt(const DynamicSetting& setting, bool with_static,
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
        scene.append(posedScene(m_meshes.at(item.mesh), poseOf(item)));
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
