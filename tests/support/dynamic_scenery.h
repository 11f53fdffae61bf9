// SPDX-License-Identifier: MIT
// A small scene with things to move in it, and what voxelizing all of it at once gives.
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

/// Where a dynamic object is.
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

/// A mesh in its place.
struct Item
{
    std::uint32_t mesh = 0; // less than DynamicScenery::kMeshCount
    Placement placement;
    std::uint32_t bend = 0; // number of a shape that joints and morph weights pull it into; 0 for a rigid mesh

    auto operator<=>(const Item&) const = default;
};

/// What octrees of the scenery are like, and the dynamic objects in them.
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
    bool minimal_capacities = false;
    std::uint32_t frames_in_flight = 2;
    std::uint32_t entries_max = 16;
    Shot shot = {};

    /// The scene's extent takes 64 voxels at most; a deeper grid has it in its farthest corner, where all bits of codes
    /// count.
    [[nodiscard]] Grid grid() const;

    [[nodiscard]] TraceCamera camera() const;
    [[nodiscard]] DynamicOptions options(float emission_scale) const;
};

std::ostream& operator<<(std::ostream& out, const DynamicSetting& setting);

/// An octree that was made anew.
struct Rebuilt
{
    DeviceTree octree;
    std::vector<Cell> cells; // of it
};

/// Meshes of a few dozen triangles with textures, alpha and, if they are to, emission: two that are rigid, one with
/// skins, one with morph targets, and one with both, on one primitive, too. Some instances of these are rigid. Must not
/// outlive the device.
class DynamicScenery
{
public:
    static constexpr std::uint32_t kRigidCount = 2;
    static constexpr std::uint32_t kMeshCount = 5; // the first ones are rigid

    DynamicScenery(vk::HeadlessDevice& device, bool emits);

    [[nodiscard]] float emissionScale() const { return m_scale; }

    /// The static part, or without one the tree of nothing.
    [[nodiscard]] DeviceTree buildStatic(const DynamicSetting& setting) const;

    [[nodiscard]] std::shared_ptr<const DynamicMesh> object(std::uint32_t mesh, bool attributes);
    [[nodiscard]] const Scene& mesh(std::uint32_t number) const { return m_meshes.at(number); }
    [[nodiscard]] Pose poseOf(const Item& item) const;

    /// The octree that is made of items, deformed on the CPU, and, if that is asked for, the static part. The last few
    /// are kept.
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
