// SPDX-License-Identifier: MIT
#include "runtime/live_scene.h"

#include "core/upload/gpu_scene.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kAttemptsMax = 64; // everything doubles in two attempts at most

// A pose that is moved by an offset in world space.
Pose moved(Pose pose, const glm::dvec3& by)
{
    const glm::dmat4 translation = glm::translate(glm::dmat4(1.0), by);
    const auto move_matrix = [&](glm::mat4& matrix) { matrix = glm::mat4(translation * glm::dmat4(matrix)); };
    std::ranges::for_each(pose.transforms, move_matrix);
    for (std::vector<glm::mat4>& joints : pose.joint_matrices)
    {
        std::ranges::for_each(joints, move_matrix);
    }
    return pose;
}

} // namespace

float brightestEmission(const AnimatedScene& animated)
{
    float brightest = brightestEmission(animated.fixed);
    for (const DynamicObject& object : animated.objects)
    {
        brightest = std::max(brightest, brightestEmission(*object.scene));
    }
    return brightest;
}

LiveScene::LiveScene(vk::HeadlessDevice& device, const TreeData& tree, const LiveOptions& options)
    : m_device(device), m_warn(options.warn), m_fixed(uploadTree(device, tree))
{
    m_info.fixed.voxel_count = tree.occupiedCount();
    m_info.fixed.node_count = tree.nodes.size();
    m_info.fixed.geometry_bytes = tree.geometryBytes();
    m_info.fixed.attribute_bytes = tree.attributeBytes();
    if (isPacked(m_fixed.attributeFormat()) || (m_fixed.filled && m_fixed.isDag()))
    {
        return;
    }
    DynamicOptions dynamic;
    dynamic.merge = MergeRule::DynamicWins; // a file has no sums
    dynamic.frames_in_flight = options.frames_in_flight;
    dynamic.attributes = m_fixed.hasAttributes();
    dynamic.emission_scale = m_fixed.emission.count() != 0 ? m_fixed.emission_scale
                             : options.brushes_emit        ? 1.0F
                                                           : 0.0F;
    m_dynamic = std::make_unique<DynamicOctree>(device, std::move(m_fixed), dynamic);
}

LiveScene::LiveScene(vk::HeadlessDevice& device, AnimatedScene animated, const Grid& grid, const LiveOptions& options,
                     const StaticListener& listener)
    : m_device(device), m_animated(std::move(animated)), m_warn(options.warn), m_offsets(m_animated.objects.size())
{
    DynamicOptions dynamic;
    dynamic.coverage = options.coverage;
    dynamic.merge = m_animated.objects.empty() ? MergeRule::DynamicWins : m_animated.merge; // which needs no sums
    dynamic.frames_in_flight = options.frames_in_flight;
    dynamic.attributes = options.attributes;
    dynamic.emission_scale = brightestEmission(m_animated);
    const bool keep_sums = options.attributes && dynamic.merge == MergeRule::Average;
    Scene fixed = std::exchange(m_animated.fixed, {});
    m_animated.fixed.cameras = fixed.cameras;
    StaticPart part = makeStaticPart(device, std::move(fixed), grid,
                                     {.coverage = options.coverage,
                                      .attributes = options.attributes,
                                      .keep_sums = keep_sums,
                                      .fill = options.fill,
                                      .shell = options.shell},
                                     options.structure, listener, dynamic.emission_scale);
    m_info.fixed = std::move(part.info);
    if (part.tree.filled && part.tree.isDag() && m_animated.objects.empty())
    {
        m_fixed = std::move(part.tree);
        return;
    }
    const float emission_scale = dynamic.emission_scale;
    dynamic.emission_scale = emission_scale == 0.0F && options.brushes_emit ? 1.0F : emission_scale;
    m_dynamic = std::make_unique<DynamicOctree>(device, std::move(part.tree), dynamic);
    listener.operation("copying what moves");
    std::map<const Scene*, std::shared_ptr<const DynamicMesh>> meshes;
    for (const DynamicObject& object : m_animated.objects)
    {
        m_info.moving_triangle_count += object.scene->triangleCount();
        std::shared_ptr<const DynamicMesh>& mesh = meshes[object.scene.get()];
        if (mesh == nullptr)
        {
            mesh = uploadDynamicMesh(device, *object.scene, options.attributes, emission_scale);
            std::ranges::for_each(mesh->uploaded.warnings, listener.warn);
        }
        m_objects.push_back(m_dynamic->add(mesh, poseAt(object, 0.0), {object.carves, object.fill}));
    }
}

// Records an update that shows the dynamic objects at a time of the animated scene.
void LiveScene::updateObjects(vk::FrameGraph& graph, double seconds)
{
    if (m_shown_seconds != seconds)
    {
        for (std::size_t i = 0; i < m_objects.size(); ++i)
        {
            m_dynamic->setPose(m_objects[i], poseOf(i, seconds));
        }
    }
    else if (!m_dynamic->needsUpdate() && !m_dynamic->isUpdating())
    {
        return;
    }
    m_shown_seconds = seconds;
    m_dynamic->update(graph);
    m_trouble.clear();
}

// Records a dab. Returns false if it has to be tried again in a later frame.
bool LiveScene::recordDab(vk::FrameGraph& graph, const Brush& brush)
{
    const std::uint64_t before = edits()->stroke();
    const bool is_done = m_dynamic->edit(graph, brush);
    if (edits()->stroke() != before)
    {
        m_moves.dropRedo();
    }
    return is_done;
}

void LiveScene::undo(vk::FrameGraph& graph)
{
    m_dynamic->endStroke();
    if (const std::optional<ObjectMove> move = m_moves.undo(edits()->undoCount() != 0 ? edits()->stroke() : 0))
    {
        return setOffset(move->object, move->from);
    }
    m_dynamic->undoEdit(graph);
}

void LiveScene::redo(vk::FrameGraph& graph)
{
    m_dynamic->endStroke();
    if (const std::optional<ObjectMove> move = m_moves.redo(edits()->nextStroke()))
    {
        return setOffset(move->object, move->to);
    }
    m_dynamic->redoEdit(graph);
}

// Records a request. Returns false if it has to be tried again in a later frame.
bool LiveScene::record(vk::FrameGraph& graph, const EditRequest& request)
{
    if (const auto* const brush = std::get_if<Brush>(&request))
    {
        return recordDab(graph, *brush);
    }
    if (const auto* const move = std::get_if<ObjectMove>(&request))
    {
        m_dynamic->endStroke();
        m_dynamic->dropRedoneStrokes();
        m_moves.add(*move, edits()->stroke());
    }
    else if (std::holds_alternative<EndStroke>(request))
    {
        m_dynamic->endStroke();
    }
    else if (std::holds_alternative<UndoStroke>(request))
    {
        undo(graph);
    }
    else
    {
        redo(graph);
    }
    return true;
}

// Records as many requests as a frame takes. A dab for which memory does not suffice is left out.
void LiveScene::recordRequests(vk::FrameGraph& graph)
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
            m_warn(error.what());
        }
        m_requests.pop_front();
    }
}

void LiveScene::update(vk::FrameGraph& graph, double seconds)
{
    m_recorded.clear();
    m_moves_before = m_moves;
    recordRequests(graph);
    if (moves() || (canEdit() && m_dynamic->needsUpdate()))
    {
        try
        {
            updateObjects(graph, seconds);
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

LiveUpdate LiveScene::settle(double seconds)
{
    LiveUpdate result;
    if (!moves() && isSettled())
    {
        return result;
    }
    for (; result.retry_count < kAttemptsMax; ++result.retry_count)
    {
        const std::uint64_t frame = beginFrame();
        try
        {
            result.passes = m_device.run([&](vk::FrameGraph& graph) { update(graph, seconds); });
        }
        catch (...)
        {
            frameLost();
            throw;
        }
        frameDone(frame, result.passes);
        if (isSettled())
        {
            result.report = m_info.update;
            return result;
        }
    }
    throw Error(
        ErrorCode::Memory,
        fmt::format("dynamic objects and strokes found no room in {} attempts; lower the resolution", kAttemptsMax));
}

LiveUpdate LiveScene::updateAndWait(double seconds)
{
    m_shown_seconds.reset();
    LiveUpdate result = settle(seconds);
    if (!m_trouble.empty())
    {
        throw Error(ErrorCode::Memory, m_trouble);
    }
    return result;
}

bool LiveScene::isSettled() const
{
    const bool is_shown = !canEdit() || !m_trouble.empty() || !m_dynamic->needsUpdate();
    return is_shown && m_requests.empty();
}

void LiveScene::frameDone(std::uint64_t frame, std::span<const vk::PassTime> passes)
{
    const auto reports = m_dynamic ? m_dynamic->frameDone(frame, passes) : std::vector<UpdateReport>();
    if (!reports.empty())
    {
        m_info.update = reports.back();
    }
}

void LiveScene::frameLost()
{
    if (canEdit())
    {
        m_dynamic->frameLost();
        m_moves = m_moves_before;
    }
    m_requests.insert(m_requests.begin(), m_recorded.begin(), m_recorded.end());
    m_recorded.clear();
}

void LiveScene::setOffset(std::size_t object, const glm::dvec3& offset)
{
    m_offsets[object] = offset;
    m_shown_seconds.reset();
}

Pose LiveScene::poseOf(std::size_t object, double seconds) const
{
    Pose pose = poseAt(m_animated.objects[object], seconds);
    return m_offsets[object] == glm::dvec3(0.0) ? pose : moved(std::move(pose), m_offsets[object]);
}

} // namespace zvo
