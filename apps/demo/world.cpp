// SPDX-License-Identifier: MIT
#include "demo/world.h"

#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/tree_input.h"
#include "common/view.h"
#include "core/gpu_scene.h"
#include "core/pipeline.h"
#include "core/stage_octree.h"
#include "core/svdag.h"
#include "core/zvo_file.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace zvo::demo
{

namespace
{

constexpr int kSettleFrames = 64; // everything doubles in two of them at most

bool isTreeFile(const std::filesystem::path& file)
{
    return isZvoFile(file) || cli::isVoxFile(file);
}

std::string nameOf(const std::vector<std::filesystem::path>& files)
{
    return files.empty() ? "" : files.front().filename().string();
}

} // namespace

World::World(vk::HeadlessDevice& device, Stage stage, const Bounds& subject, bool has_lists)
    : m_device(device), m_stage(std::move(stage)), m_subject(subject), m_beam(device.device(), has_lists)
{
}

std::unique_ptr<World> World::load(vk::HeadlessDevice& device, const WorldOptions& options)
{
    const std::vector<std::filesystem::path>& files = options.voxels.scenes;
    std::unique_ptr<World> world;
    if (files.empty())
    {
        world.reset(new World(device, {}, {glm::vec3(0.0F), glm::vec3(1.0F)}, false));
        world->m_tree = DeviceTree(Octree{});
    }
    else if (std::ranges::any_of(files, isTreeFile))
    {
        if (files.size() > 1)
        {
            throw Error(ErrorCode::Usage, fmt::format("{} stands alone; show one file of voxels, or scenes",
                                                      std::ranges::find_if(files, isTreeFile)->string()));
        }
        world = ofTree(device, options);
    }
    else
    {
        world = ofStage(device, options);
    }
    world->m_info.name = nameOf(files);
    world->m_info.grid = world->tree().octree().grid;
    world->m_info.structure = world->tree().hasLists() ? TreeStructure::Svdag : TreeStructure::Svo;
    world->settle(0);
    return world;
}

std::unique_ptr<World> World::ofTree(vk::HeadlessDevice& device, const WorldOptions& options)
{
    const std::filesystem::path& file = options.voxels.scenes.front();
    const TreeData tree = cli::isVoxFile(file) ? cli::loadVox(file, device) : readZvo(file).tree;
    if (tree.voxel_count == 0)
    {
        cli::talk("warning: the file has no voxels");
    }
    const Bounds subject = cli::subjectOf(cli::boundsOf(tree), tree.grid);
    std::unique_ptr<World> world(new World(device, {}, subject, tree.structure == TreeStructure::Svdag));
    world->m_info.static_voxel_count = tree.voxel_count;
    world->m_info.static_node_count = tree.nodes.size();
    world->m_info.geometry_bytes = tree.geometryBytes();
    world->m_info.attribute_bytes = tree.attributeBytes();
    world->keep(uploadTree(device, tree), options);
    return world;
}

// Packed attributes cannot be merged with anything.
void World::keep(DeviceTree&& tree, const WorldOptions& options)
{
    const Octree& octree = std::visit([](const auto& made) -> const Octree& { return TreeView(made).octree(); }, tree);
    if (isPacked(octree.attributeForm()))
    {
        m_tree = std::move(tree);
        return;
    }
    DynamicOptions dynamic;
    dynamic.merge = MergeRule::DynamicWins; // a file has no sums
    dynamic.frames_in_flight = options.frames_in_flight;
    dynamic.attributes = octree.hasAttributes();
    dynamic.emission_scale = octree.emission.count() != 0 ? octree.emission_scale : 0.0F;
    if (auto* const dag = std::get_if<Svdag>(&tree))
    {
        m_tree = std::make_unique<DynamicOctree>(m_device, StaticTree(std::move(*dag), {}), dynamic);
        return;
    }
    BuildResult built;
    built.octree = std::move(std::get<Octree>(tree));
    m_tree = std::make_unique<DynamicOctree>(m_device, std::move(built), dynamic);
}

std::unique_ptr<World> World::ofStage(vk::HeadlessDevice& device, const WorldOptions& options)
{
    Stage stage = cli::loadStageWithWarnings(options.voxels, true);
    const Bounds bounds = stageBounds(stage);
    const Grid grid = cli::placeGrid(options.voxels, stage, bounds);
    std::unique_ptr<World> world(
        new World(device, std::move(stage), cli::subjectOf(bounds, grid), options.structure == TreeStructure::Svdag));
    world->build(options, grid);
    return world;
}

// Voxelizes what stands still, and makes it ready for what moves.
void World::build(const WorldOptions& options, const Grid& grid)
{
    const bool has_attributes = options.voxels.hasAttributes();
    const float emission_scale = brightestEmission(m_stage);
    BuildOptions build;
    build.coverage = options.voxels.coverage;
    build.attributes = has_attributes;
    build.keep_sums = has_attributes && m_stage.merge == MergeRule::Average && !m_stage.movers.empty();
    BuildResult built =
        buildOctree(m_device, uploadScene(m_device, m_stage.fixed, has_attributes, emission_scale), grid, build);
    m_info.static_triangle_count = m_stage.fixed.triangleCount();
    m_stage.fixed.primitives.clear(); // the cameras stay
    m_stage.fixed.instances.clear();
    m_stage.fixed.images.clear();
    m_info.static_voxel_count = built.octree.voxel_count;
    m_info.static_node_count = built.octree.node_count;
    m_info.geometry_bytes = built.octree.geometryBytes();
    m_info.attribute_bytes = built.octree.attributeBytes();
    m_info.build_ms = cli::sumMs(built.passes);
    if (m_stage.movers.empty())
    {
        cli::warnOfDropped(built.octree.voxel_count, built.dropped);
    }
    FragmentSums sums = std::move(built.sums);
    std::optional<Svdag> dag;
    if (options.structure == TreeStructure::Svdag)
    {
        CompressResult compressed = compress(m_device, std::move(built.octree));
        m_info.static_node_count = compressed.dag.tree.node_count;
        m_info.geometry_bytes = compressed.dag.geometryBytes();
        m_info.attribute_bytes = compressed.dag.tree.attributeBytes();
        m_info.build_ms += compressed.ms();
        dag = std::move(compressed.dag);
    }
    DynamicOptions dynamic;
    dynamic.coverage = options.voxels.coverage;
    dynamic.merge = m_stage.movers.empty() ? MergeRule::DynamicWins : m_stage.merge; // which needs no sums
    dynamic.frames_in_flight = options.frames_in_flight;
    dynamic.attributes = has_attributes;
    dynamic.emission_scale = emission_scale;
    built.sums = std::move(sums);
    StaticTree fixed = dag ? StaticTree(*std::move(dag), std::move(built.sums)) : StaticTree(std::move(built));
    auto octree = std::make_unique<DynamicOctree>(m_device, std::move(fixed), dynamic);
    for (const Mover& mover : m_stage.movers)
    {
        m_info.moving_triangle_count += mover.scene.triangleCount();
        m_movers.push_back(
            octree->add(uploadMover(m_device, mover.scene, has_attributes, emission_scale), moverPose(mover, 0.0)));
    }
    m_info.mover_count = m_movers.size();
    m_tree = std::move(octree);
}

TreeView World::tree() const
{
    if (const auto* const dynamic = std::get_if<std::unique_ptr<DynamicOctree>>(&m_tree))
    {
        return (*dynamic)->tree();
    }
    return std::visit([](const auto& fixed) { return TreeView(fixed); }, std::get<DeviceTree>(m_tree));
}

std::uint64_t World::beginFrame()
{
    const auto* const dynamic = std::get_if<std::unique_ptr<DynamicOctree>>(&m_tree);
    return dynamic != nullptr ? (*dynamic)->beginFrame() : m_frame++;
}

// What moves, where it is at a time of the stage.
void World::updateMovers(vk::FrameGraph& graph, double seconds)
{
    DynamicOctree& octree = *std::get<std::unique_ptr<DynamicOctree>>(m_tree);
    if (m_shown_seconds != seconds)
    {
        for (std::size_t i = 0; i < m_movers.size(); ++i)
        {
            octree.place(m_movers[i], moverPose(m_stage.movers[i], seconds));
        }
    }
    else if (!octree.needsUpdate() && !octree.isUpdating())
    {
        return;
    }
    m_shown_seconds = seconds;
    m_beam_is_stale = true;
    octree.update(graph);
    m_trouble.clear();
}

void World::update(vk::FrameGraph& graph, double seconds)
{
    if (moves())
    {
        try
        {
            updateMovers(graph, seconds);
        }
        catch (const Error& error)
        {
            if (error.code() != ErrorCode::Memory)
            {
                throw;
            }
            m_trouble = error.what();
        }
    }
    if (m_beam_is_stale)
    {
        buildBeam(graph, tree(), m_beam);
        m_beam_is_stale = false;
    }
}

void World::settle(double seconds)
{
    for (int i = 0; i < kSettleFrames; ++i)
    {
        const std::uint64_t frame = beginFrame();
        try
        {
            const std::vector<vk::PassTime> passes =
                m_device.run([&](vk::FrameGraph& graph) { update(graph, seconds); });
            frameDone(frame, passes);
        }
        catch (...)
        {
            frameLost();
            throw;
        }
        if (!moves() || !m_trouble.empty() || !std::get<std::unique_ptr<DynamicOctree>>(m_tree)->needsUpdate())
        {
            return;
        }
    }
    throw Error(ErrorCode::Memory,
                fmt::format("movers found no room in {} attempts; lower the resolution", kSettleFrames));
}

void World::frameLost()
{
    if (auto* const dynamic = std::get_if<std::unique_ptr<DynamicOctree>>(&m_tree))
    {
        (*dynamic)->frameLost();
    }
    m_beam_is_stale = true;
}

void World::frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes)
{
    const auto* const dynamic = std::get_if<std::unique_ptr<DynamicOctree>>(&m_tree);
    if (dynamic == nullptr)
    {
        return;
    }
    const std::vector<UpdateReport> reports = (*dynamic)->frameDone(frame, passes);
    if (!reports.empty())
    {
        m_info.update = reports.back();
    }
}

} // namespace zvo::demo
