// SPDX-License-Identifier: MIT
#include "demo/world/world.h"

#include "common/progress.h"
#include "common/report.h"
#include "common/session.h"
#include "common/tree_input.h"
#include "common/view.h"
#include "core/file/zvo_file.h"
#include "core/headless/compress.h"
#include "core/headless/flatten.h"
#include "core/headless/pipeline.h"
#include "core/headless/tree_download.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "runtime/stage_octree.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <utility>

namespace zvo::demo
{

namespace
{

// Parts of the time that making a world takes, more or less, when its steps begin.
constexpr double kCopyingAt = 0.3; // after reading
constexpr double kVoxelizingAt = 0.45;
constexpr double kCompressingAt = 0.8;
constexpr double kMoversAt = 0.9;
constexpr int kSettleFrames = 64; // everything doubles in two of them at most

bool isTreeFile(const std::filesystem::path& file)
{
    return isZvoFile(file) || cli::isVoxFile(file);
}

// A pose moved by so much.
Pose moved(Pose pose, const glm::dvec3& by)
{
    const glm::dmat4 move = glm::translate(glm::dmat4(1.0), by);
    const auto place = [&](glm::mat4& matrix) { matrix = glm::mat4(move * glm::dmat4(matrix)); };
    std::ranges::for_each(pose.transforms, place);
    for (std::vector<glm::mat4>& joints : pose.joint_matrices)
    {
        std::ranges::for_each(joints, place);
    }
    return pose;
}

// A box around a primitive in the places that matrices put it into.
void include(Bounds& bounds, const Bounds& primitive, const std::vector<glm::mat4>& matrices)
{
    for (const glm::mat4& matrix : matrices)
    {
        for (int corner = 0; corner < 8; ++corner)
        {
            const glm::vec3 at((corner & 1) != 0 ? primitive.max.x : primitive.min.x,
                               (corner & 2) != 0 ? primitive.max.y : primitive.min.y,
                               (corner & 4) != 0 ? primitive.max.z : primitive.min.z);
            bounds.extend(glm::vec3(matrix * glm::vec4(at, 1.0F)));
        }
    }
}

// A box around a mover in a pose: what joints pull is between where each of them alone would put it.
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
        include(bounds, primitive, has_joints ? pose.joint_matrices[i] : std::vector{pose.transforms[i]});
    }
    return bounds;
}

std::string nameOf(const std::vector<std::filesystem::path>& files)
{
    return files.empty() ? "" : files.front().filename().string();
}

} // namespace

World::World(vk::HeadlessDevice& device, Stage stage, const Bounds& subject)
    : m_device(device), m_stage(std::move(stage)), m_subject(subject)
{
}

std::unique_ptr<World> World::load(vk::HeadlessDevice& device, const WorldOptions& options)
{
    return make(device, options, read(options), [](std::string_view, double) {});
}

WorldInput World::read(const WorldOptions& options)
{
    const std::vector<std::filesystem::path>& files = options.voxels.scenes;
    const auto tree_file = std::ranges::find_if(files, isTreeFile);
    if (tree_file == files.end())
    {
        return files.empty() ? WorldInput{} : WorldInput{cli::loadStageWithWarnings(options.voxels, true), {}};
    }
    if (files.size() > 1)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} stands alone; show one file of voxels, or scenes", tree_file->string()));
    }
    return cli::isVoxFile(*tree_file) ? WorldInput{} : WorldInput{{}, readZvo(*tree_file).tree};
}

std::unique_ptr<World> World::make(vk::HeadlessDevice& device, const WorldOptions& options, WorldInput input,
                                   const StepListener& listener)
{
    const std::vector<std::filesystem::path>& files = options.voxels.scenes;
    std::unique_ptr<World> world;
    if (input.stage)
    {
        world = ofStage(device, options, std::move(*input.stage), listener);
    }
    else if (!files.empty())
    {
        TreeData tree = input.tree ? std::move(*input.tree) : cli::loadVox(files.front(), device);
        world = ofTree(device, options, std::move(tree), listener);
    }
    else
    {
        world.reset(new World(device, {}, {glm::vec3(0.0F), glm::vec3(1.0F)}));
    }
    world->m_info.name = nameOf(files);
    world->m_info.grid = world->tree().grid;
    world->m_info.structure = world->tree().isDag() ? TreeStructure::Svdag : TreeStructure::Svo;
    world->settle(0);
    return world;
}

std::unique_ptr<World> World::ofTree(vk::HeadlessDevice& device, const WorldOptions& options, TreeData tree,
                                     const StepListener& listener)
{
    if (tree.voxel_count == 0)
    {
        cli::talk("warning: the file has no voxels");
    }
    listener("copying to the device", kCopyingAt);
    const Bounds subject = cli::subjectOf(cli::boundsOf(tree), tree.grid);
    std::unique_ptr<World> world(new World(device, {}, subject));
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
    if (isPacked(tree.attributeForm()))
    {
        m_fixed = std::move(tree);
        return;
    }
    DynamicOptions dynamic;
    dynamic.merge = MergeRule::DynamicWins; // a file has no sums
    dynamic.frames_in_flight = options.frames_in_flight;
    dynamic.attributes = tree.hasAttributes();
    dynamic.emission_scale = tree.emission.count() != 0 ? tree.emission_scale : 0.0F;
    m_dynamic = std::make_unique<DynamicOctree>(m_device, std::move(tree), dynamic);
}

std::unique_ptr<World> World::ofStage(vk::HeadlessDevice& device, const WorldOptions& options, Stage stage,
                                      const StepListener& listener)
{
    const Bounds bounds = stageBounds(stage);
    const Grid grid = cli::placeGrid(options.voxels, stage, bounds);
    std::unique_ptr<World> world(new World(device, std::move(stage), cli::subjectOf(bounds, grid)));
    world->build(options, grid, listener);
    return world;
}

// Voxelizes what stands still, and makes it ready for what moves.
void World::build(const WorldOptions& options, const Grid& grid, const StepListener& listener)
{
    const bool has_attributes = options.voxels.hasAttributes();
    const float emission_scale = brightestEmission(m_stage);
    BuildOptions build;
    build.coverage = options.voxels.coverage;
    build.attributes = has_attributes;
    build.keep_sums = has_attributes && m_stage.merge == MergeRule::Average && !m_stage.movers.empty();
    listener("copying to the device", kCopyingAt);
    const GpuScene fixed_scene = uploadScene(m_device, m_stage.fixed, has_attributes, emission_scale);
    listener("voxelizing", kVoxelizingAt);
    BuildResult built = buildOctree(m_device, fixed_scene, grid, build);
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
    if (options.structure == TreeStructure::Svdag)
    {
        listener("compressing", kCompressingAt);
        CompressResult compressed = compress(m_device, std::move(built.octree));
        m_info.static_node_count = compressed.dag.node_count;
        m_info.geometry_bytes = compressed.dag.geometryBytes();
        m_info.attribute_bytes = compressed.dag.attributeBytes();
        m_info.build_ms += compressed.ms();
        built.octree = std::move(compressed.dag);
    }
    DynamicOptions dynamic;
    dynamic.coverage = options.voxels.coverage;
    dynamic.merge = m_stage.movers.empty() ? MergeRule::DynamicWins : m_stage.merge; // which needs no sums
    dynamic.frames_in_flight = options.frames_in_flight;
    dynamic.attributes = has_attributes;
    dynamic.emission_scale = emission_scale;
    m_dynamic = std::make_unique<DynamicOctree>(m_device, std::move(built.octree), dynamic);
    listener("copying what moves", kMoversAt);
    for (const Mover& mover : m_stage.movers)
    {
        m_info.moving_triangle_count += mover.scene.triangleCount();
        m_movers.push_back(
            m_dynamic->add(uploadMover(m_device, mover.scene, has_attributes, emission_scale), moverPose(mover, 0.0)));
    }
    m_offsets.resize(m_movers.size());
    m_info.mover_count = m_movers.size();
}

std::uint64_t World::beginFrame()
{
    return canEdit() ? m_dynamic->beginFrame() : m_frame++;
}

// What moves, where it is at a time of the stage.
void World::updateMovers(vk::FrameGraph& graph, double seconds)
{
    DynamicOctree& octree = *m_dynamic;
    if (m_shown_seconds != seconds)
    {
        for (std::size_t i = 0; i < m_movers.size(); ++i)
        {
            octree.place(m_movers[i], poseOf(i, seconds));
        }
    }
    else if (!octree.needsUpdate() && !octree.isUpdating())
    {
        return;
    }
    m_shown_seconds = seconds;
    octree.update(graph);
    m_trouble.clear();
}

// Whether the octree took it.
bool World::record(vk::FrameGraph& graph, const EditRequest& request)
{
    DynamicOctree& octree = *m_dynamic;
    if (const auto* const brush = std::get_if<Brush>(&request))
    {
        return octree.edit(graph, *brush);
    }
    if (std::holds_alternative<EndStroke>(request))
    {
        octree.endStroke();
    }
    else if (std::holds_alternative<UndoStroke>(request))
    {
        octree.undoEdit(graph);
    }
    else
    {
        octree.redoEdit(graph);
    }
    return true;
}

// What brushes are to do, as far as it goes into a frame. A dab without memory is left out.
void World::recordRequests(vk::FrameGraph& graph)
{
    for (std::uint32_t i = 0; i < kDabsPerFrameMax && !m_requests.empty(); ++i)
    {
        try
        {
            if (!record(graph, m_requests.front()))
            {
                return; // in a later frame
            }
            m_recorded.push_back(m_requests.front());
        }
        catch (const Error& error)
        {
            if (error.code() != ErrorCode::Memory)
            {
                throw;
            }
            cli::talk(error.what());
        }
        m_requests.pop_front();
    }
}

void World::update(vk::FrameGraph& graph, double seconds)
{
    m_recorded.clear();
    if (!m_requests.empty())
    {
        recordRequests(graph);
    }
    if (moves() || (canEdit() && m_dynamic->needsUpdate()))
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
}

void World::settle(double seconds)
{
    if (!moves() && isSettled())
    {
        return;
    }
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
        if (isSettled())
        {
            return;
        }
    }
    throw Error(ErrorCode::Memory,
                fmt::format("movers and strokes found no room in {} attempts; lower the resolution", kSettleFrames));
}

bool World::isSettled() const
{
    const bool is_shown = !canEdit() || !m_trouble.empty() || !m_dynamic->needsUpdate();
    return is_shown && m_requests.empty();
}

void World::frameLost()
{
    if (canEdit())
    {
        m_dynamic->frameLost();
    }
    m_requests.insert(m_requests.begin(), m_recorded.begin(), m_recorded.end());
    m_recorded.clear();
}

Pose World::poseOf(std::size_t mover, double seconds) const
{
    Pose pose = moverPose(m_stage.movers[mover], seconds);
    return m_offsets[mover] == glm::dvec3(0.0) ? pose : moved(std::move(pose), m_offsets[mover]);
}

std::optional<std::size_t> World::moverAt(const glm::dvec3& point) const
{
    const double slack = 2.0 * m_info.grid.voxel_size;
    std::optional<std::size_t> best;
    double best_size = 0;
    for (std::size_t i = 0; i < m_movers.size(); ++i)
    {
        const Bounds bounds = boundsOf(m_stage.movers[i].scene, poseOf(i, m_shown_seconds.value_or(0.0)));
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

void World::setOffset(std::size_t mover, const glm::dvec3& offset)
{
    m_offsets[mover] = offset;
    m_shown_seconds.reset();
}

TreeData World::copyTree(TreeStructure structure)
{
    if (!canEdit())
    {
        return downloadTree(m_device, m_fixed);
    }
    TreeData flat = flattenTree(m_device, tree());
    if (structure == TreeStructure::Svo || flat.nodes.empty())
    {
        return flat;
    }
    return compressTree(m_device, std::move(flat));
}

void World::frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes)
{
    if (!canEdit())
    {
        return;
    }
    const std::vector<UpdateReport> reports = m_dynamic->frameDone(frame, passes);
    if (!reports.empty())
    {
        m_info.update = reports.back();
    }
}

} // namespace zvo::demo
