// SPDX-License-Identifier: MIT
// A small scene with dynamic objects, and the reference: all of it voxelized at once.
#pragma once

#include "core/dynamic/dynamic_octree.h"
#include "support/octree_contents.h"
#include "support/shots.h"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <tuple>
#include <vector>

namespace zvo::test
{

/// The transform of a dynamic object.
struct Placement
{
    enum class Kind
    {
        Inside, // or across the grid's border
        Outside,
        Point,
        Flat,
        Mirrored,
        Turned,
        Nan,
        Huge // overflows single precision
    };

    Kind kind = Kind::Inside;
    std::array<int, 3> at{}; // 0 to 3 inside

    auto operator<=>(const Placement&) const = default;

    [[nodiscard]] glm::mat4 transform() const;
};

std::ostream& operator<<(std::ostream& out, const Placement& place);

/// A dynamic object: mesh, placement and shape.
struct Item
{
    std::uint32_t mesh = 0; // less than DynamicScenery::kMeshCount
    Placement placement;
    std::uint32_t bend = 0; // number of the shape that joints and morph weights give it; 0 for a rigid mesh

    auto operator<=>(const Item&) const = default;
};

/// Properties of an octree of the scenery, and how it is updated and looked at.
struct DynamicSetting
{
    static constexpr std::uint32_t kWideDepth = 13; // keys of its leaves do not fit 32 bits

    std::uint32_t depth = 5;
    Coverage coverage = Coverage::Thin;
    MergeRule merge = MergeRule::Average;
    bool attributes = true;
    bool emits = true;
    bool has_static = true;
    bool compressed = false; // the static part is a DAG
    bool filled = false;     // it is filled; not with compressed
    bool minimal_capacities = false;
    std::uint32_t frames_in_flight = 2;
    std::uint32_t entries_max = 16;
    Shot shot = {};

    /// The scene's extent takes 64 voxels at most. In a deeper grid it lies in the farthest corner, so that codes use
    /// all bits.
    [[nodiscard]] Grid grid() const;

    [[nodiscard]] TraceCamera camera() const;
    [[nodiscard]] DynamicOptions options(float emission_scale) const;
};

std::ostream& operator<<(std::ostream& out, const DynamicSetting& setting);

/// An octree that was made anew, with its cells.
struct Rebuilt
{
    DeviceTree octree;
    std::vector<Cell> cells;
};

/// Meshes of a few dozen triangles with textures, alpha and optional emission. Two are rigid, one has skins, one has
/// morph targets, and one has both, also on a single primitive. Some instances of the deforming ones are rigid. The
/// device must outlive the scenery.
class DynamicScenery
{
public:
    static constexpr std::uint32_t kRigidCount = 2;
    static constexpr std::uint32_t kMeshCount = 5; // rigid meshes come first

    DynamicScenery(vk::HeadlessDevice& device, bool emits);

    [[nodiscard]] float emissionScale() const { return m_scale; }

    /// The static part; an empty tree if the setting has none.
    [[nodiscard]] DeviceTree buildStatic(const DynamicSetting& setting) const;

    [[nodiscard]] std::shared_ptr<const DynamicMesh> object(std::uint32_t mesh, bool attributes);
    [[nodiscard]] const Scene& mesh(std::uint32_t number) const { return m_meshes.at(number); }
    [[nodiscard]] Pose poseOf(const Item& item) const;

    /// The octree of items, deformed on the CPU, and of the static part if with_static. The last few results are
    /// cached.
    std::shared_ptr<const Rebuilt> rebuilt(const DynamicSetting& setting, bool with_static,
                                           const std::multiset<Item>& items);

private:
    using Key = std::tuple<std::uint32_t, Coverage, bool, bool, std::multiset<Item>>;

    [[nodiscard]] GpuScene upload(const Scene& scene, bool attributes) const;

    vk::HeadlessDevice& m_device;
    Scene m_static;
    std::array<Scene, kMeshCount> m_meshes;
    float m_scale = 0;
    std::map<std::pair<std::uint32_t, bool>, std::shared_ptr<const DynamicMesh>> m_uploaded;
    std::map<Key, std::shared_ptr<const Rebuilt>> m_rebuilt;
};

} // namespace zvo::test
