// SPDX-License-Identifier: MIT
// What a host's kernel finds through cones by zvo/trace.glsl, against known answers and many rays.
#include "core/dynamic/dynamic_octree.h"
#include "core/radiance/kept_light_table.h"
#include "core/radiance/radiance_tracer.h"
#include "core/tree/tree_table.h"
#include "glsl/host_device.h"
#include "oracle/morton.h"
#include "support/dags.h"
#include "support/dynamic_updates.h"
#include "support/lit_voxels.h"
#include "support/octree_contents.h"
#include "support/scenes.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::deviceOfHosts;
using test::LitVoxel;

// The structs of tests/glsl/host/cones.comp.
struct Cone
{
    glm::vec3 origin;
    glm::vec3 direction;
    float aperture;
    float reach = 1e30F;
};

struct Found
{
    glm::vec4 one;
    glm::vec4 mean;
    glm::vec4 rays;
};

struct ConesPush
{
    gpu::ConstPtr<gpu::KeptLightTable> kept;
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<Cone> cones;
    gpu::Ptr<Found> results;
    gpu::uint count;
    gpu::uint rays;
};

struct CoveragePush
{
    gpu::ConstPtr<gpu::uvec2> masks;
    gpu::Ptr<gpu::vec3> results;
    gpu::uint count;
    gpu::uint padding = 0;
};

const LitVoxel kGreyWall = {{}, glm::uvec3(188), glm::vec3(0.0F)};

// Light that is kept on a tree's voxels, below a sky of one radiance.
class LightOfCones
{
public:
    LightOfCones(const DeviceTree& tree, const glm::vec3& sky, const ViewCamera& view, std::uint32_t frames)
        : m_sky(deviceOfHosts().device(), {4, 2, std::vector(8, sky)}, 0.0, 1.0), m_tracer(deviceOfHosts().device())
    {
        m_sky.setSun({});
        m_tracer.resize(64, 64);
        const TraceCamera camera = traceCamera(view, tree.grid, 64);
        for (std::uint32_t i = 0; i < frames; ++i)
        {
            deviceOfHosts().run([&](vk::FrameGraph& graph) { m_tracer.addFrame(graph, tree, m_sky, camera, {}); });
        }
    }

    std::vector<Found> through(const DeviceTree& tree, const std::vector<Cone>& cones, std::uint32_t rays)
    {
        const gpu::KeptLightTable kept = keptLightTable(m_tracer.cache(), m_sky);
        const auto kept_table = deviceOfHosts().makeBuffer<gpu::KeptLightTable>("kept light", std::vector{kept});
        const auto tree_table = deviceOfHosts().makeBuffer<gpu::TreeTable>("tree", std::vector{treeTable(tree)});
        const auto given = deviceOfHosts().makeBuffer("cones", std::span<const Cone>(cones));
        vk::BufferOf<Found> results(deviceOfHosts().device(), "results", cones.size());
        deviceOfHosts().run(
            [&](vk::FrameGraph& graph)
            {
                vk::UntypedPass pass = graph.addPass("host/cones");
                pass.read(tree.nodes);
                pass.read(tree.voxel_attributes);
                pass.read(tree.node_attributes);
                pass.read(tree.emission_words);
                pass.read(tree.emission);
                pass.read(tree.lists.before);
                pass.read(tree.lists.voxels_before_leaf);
                pass.read(tree.overlays.ranks);
                pass.read(m_tracer.cache().faces());
                (void)m_sky.read(pass);
                const ConesPush push = {
                    pass.read(kept_table), pass.read(tree_table), pass.read(given), pass.write(results),
                    static_cast<gpu::uint>(cones.size()), rays};
                pass.dispatch(cones.size(), push);
            });
        return deviceOfHosts().download(results);
    }

private:
    DeviceEnvironment m_sky;
    RadianceTracer m_tracer;
};

// The aperture whose cone is so wide at a distance.
float apertureOf(float width, float distance)
{
    return 2.0F * std::atan(0.5F * width / distance);
}

// Gives the nodes of a tree the colour that all of its voxels have.
void setNodeColors(DeviceTree& tree, const LitVoxel& voxel)
{
    std::vector<gpu::Attribute> nodes = deviceOfHosts().download(tree.node_attributes);
    for (gpu::Attribute& node : nodes)
    {
        node.color |= voxel.color.r | (voxel.color.g << 8) | (voxel.color.b << 16);
    }
    tree.node_attributes = deviceOfHosts().makeBuffer("node attributes", std::span<const gpu::Attribute>(nodes));
}

TEST(HostCones, CountTheColumnsOfMasks)
{
    std::mt19937 random(3);
    std::vector<gpu::uvec2> masks = {{0U, 0U}, {~0U, ~0U}};
    for (std::uint32_t i = 0; i < 64; ++i)
    {
        masks.emplace_back(i < 32 ? 1U << i : 0U, i < 32 ? 0U : 1U << (i - 32));
    }
    for (std::uint32_t i = 0; i < 2000; ++i)
    {
        gpu::uvec2 mask(random(), random());
        for (std::uint32_t sparser = 0; sparser < i % 5; ++sparser)
        {
            mask &= gpu::uvec2(random(), random());
        }
        masks.push_back(mask);
    }
    const auto given = deviceOfHosts().makeBuffer("masks", std::span<const gpu::uvec2>(masks));
    vk::BufferOf<gpu::vec3> results(deviceOfHosts().device(), "results", masks.size());
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("host/coverage");
            pass.dispatch(masks.size(),
                          CoveragePush{pass.read(given), pass.write(results), static_cast<gpu::uint>(masks.size())});
        });
    const std::vector<gpu::vec3> found = deviceOfHosts().download(results);
    for (std::size_t i = 0; i < masks.size(); ++i)
    {
        std::array<std::set<std::pair<std::uint32_t, std::uint32_t>>, 3> columns;
        for (std::uint32_t cell = 0; cell < 64; ++cell)
        {
            if (((masks[i][cell / 32] >> (cell % 32)) & 1U) != 0)
            {
                const glm::uvec3 at = oracle::mortonDecode(cell);
                columns[0].emplace(at.y, at.z);
                columns[1].emplace(at.x, at.z);
                columns[2].emplace(at.x, at.y);
            }
        }
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_EQ(found[i][axis], static_cast<float>(columns[axis].size()) / 16.0F) << i << ", axis " << axis;
        }
    }
}

TEST(HostCones, Experiment)
{
    using Pattern = std::function<bool(const glm::uvec3&)>;
    const std::vector<std::pair<std::string, Pattern>> patterns = {
        {"bars1of4", [](const glm::uvec3& c) { return c.y % 4 == 1; }},
        {"bars2of4", [](const glm::uvec3& c) { return c.y % 4 < 2; }},
        {"bars3of4", [](const glm::uvec3& c) { return c.y % 4 != 2; }},
        {"checker1", [](const glm::uvec3& c) { return (c.y + c.z) % 2 == 1; }},
        {"checker2", [](const glm::uvec3& c) { return (c.y / 2 + c.z / 2) % 2 == 1; }},
        {"checker8", [](const glm::uvec3& c) { return (c.y / 8 + c.z / 8) % 2 == 1; }},
        {"dots", [](const glm::uvec3& c) { return c.y % 4 == 2 && c.z % 4 == 1; }},
        {"full", [](const glm::uvec3&) { return true; }}};
    for (const auto& [name, pattern] : patterns)
    {
        for (const std::uint32_t thick : {1U, 4U})
        {
        std::vector<LitVoxel> voxels;
        for (std::uint32_t i = 0; i < 128 * 128 * thick; ++i)
        {
            const glm::uvec3 cell(80 + i / (128 * 128), i % 128, i / 128 % 128);
            if (pattern(cell))
            {
                voxels.push_back({cell, kGreyWall.color, kGreyWall.emission});
            }
        }
        DeviceTree tree = test::litTree(deviceOfHosts(), voxels, 7);
        setNodeColors(tree, kGreyWall);
        LightOfCones light(tree, glm::vec3(1.0F), ViewCamera::lookAt({-30.0, 64.0, 64.0}, {80.0, 64.0, 64.0}, 0.9), 2);
        for (const float width : {3.0F, 6.0F, 13.0F, 20.0F, 40.0F})
        {
            for (const glm::vec3& slope : {glm::vec3(1, 0, 0), glm::vec3(1, 0.2F, 0.1F), glm::vec3(1, 0.4F, -0.3F), glm::vec3(1, 0.8F,0), glm::vec3(1,0.7F,0.7F)})
            {
                const glm::vec3 direction = glm::normalize(slope);
                std::vector<Cone> cones;
                const float distance = std::max(20.0F, width);
                for (int k = 0; k < 64; ++k)
                {
                    const glm::vec3 target(80.5F, 60.0F + 16 * std::fmod(float(k) * 0.7548F, 1.0F), 60.0F + 16 * std::fmod(float(k) * 0.5698F, 1.0F));
                    cones.push_back({target - distance * direction, direction, apertureOf(width, distance)});
                }
                double w = 0, wmin = 9, wmax = 0, rays = 0;
                for (const Found& f : light.through(tree, cones, 256))
                {
                    w += f.one.w / 64; rays += f.rays.w / 64;
                    wmin = std::min<double>(wmin, f.one.w); wmax = std::max<double>(wmax, f.one.w);
                }
                std::printf("%-9s thick %u width %4.0f slope %.1f,%.1f: w %.3f (%.3f..%.3f) rays %.3f\n", name.c_str(), thick, width,
                            slope.y, slope.z, w, wmin, wmax, rays);
            }
        }
        }
    }
}

} // namespace
} // namespace zvo
