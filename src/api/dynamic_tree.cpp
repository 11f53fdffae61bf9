// SPDX-License-Identifier: MIT
#include "zvo/dynamic_tree.h"

#include "api/convert.h"
#include "api/dynamic_tree_impl.h"
#include "api/model_impl.h"
#include "core/animation.h"
#include "core/tree_table.h"

#include <span>

namespace zvo
{

namespace
{

DynamicOptions optionsOf(const DynamicTreeInfo& info)
{
    DynamicOptions options;
    options.coverage = info.coverage;
    options.merge = info.merge;
    options.frames_in_flight = info.frames_in_flight;
    options.history = {info.history_steps, info.history_bytes};
    options.edits = {info.strokes, info.edit_bytes};
    options.emission_scale = info.emission_scale;
    return options;
}

Pose poseOf(const MoverMesh& mesh, const Mat4& to_world)
{
    return poseAt(mesh.scene, 0.0, glm::dmat4(toGlm(to_world)));
}

UpdateFacts factsOf(const UpdateReport& report)
{
    return {report.failed != 0, report.node_count, report.voxel_count, report.dynamic_count, report.dropped};
}

} // namespace

DynamicTree::Impl::Impl(Recorder::Impl& recorder, Tree&& fixed, const DynamicTreeInfo& info)
    : context(recorder.context), facts(usable(fixed).facts), table(context.device, "tree table", 1)
{
    requireSame(context, usable(fixed).context);
    try
    {
        octree = std::make_unique<DynamicOctree>(context.uploads, std::move(fixed.impl()->fixed), optionsOf(info));
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Usage) // else nothing was taken
        {
            fixed.release();
        }
        throw;
    }
    fixed.release();
    made_in = recorder.frame;
    publish(recorder.graph);
}

DynamicTree::Impl::~Impl()
{
    context.retire(std::move(octree));
    context.retire(std::move(table));
}

void DynamicTree::Impl::learn()
{
    if (made_in)
    {
        requireUsable(*made_in, "dynamic tree");
        made_in = made_in->is_done ? nullptr : made_in;
    }
    while (!frames.empty() && frames.front().host->is_done)
    {
        const Frame frame = std::move(frames.front());
        frames.pop_front();
        for (const UpdateReport& report : octree->frameDone(frame.number, frame.host->times))
        {
            updates.push_back(factsOf(report));
        }
    }
    if (!frames.empty() && frames.back().host->is_lost)
    {
        octree->frameLost();
        frames.pop_back();
        version = context.next_version++;
    }
    for (const NewMover& made : new_movers)
    {
        if (made.made_in->is_lost)
        {
            octree->remove(made.mover); // what its vertices are was not uploaded
        }
    }
    std::erase_if(new_movers, [](const NewMover& made) { return made.made_in->is_lost || made.made_in->is_done; });
}

void DynamicTree::Impl::enter(Recorder::Impl& recorder)
{
    requireSame(context, recorder.context);
    learn();
    if (frames.empty() || frames.back().host != recorder.frame)
    {
        frames.push_back({recorder.frame, octree->beginFrame()});
    }
}

void DynamicTree::Impl::publish(vk::FrameGraph& graph)
{
    version = context.next_version++;
    const gpu::TreeTable values = treeTable(octree->tree());
    graph.update(table, 0, std::span(&values, 1));
}

DynamicTree::DynamicTree(Recorder& recorder, Tree&& fixed, const DynamicTreeInfo& info)
    : m_impl(recording(recorder,
                       [&](Recorder::Impl& impl) { return std::make_unique<Impl>(impl, std::move(fixed), info); }))
{
}

DynamicTree::~DynamicTree() = default;
DynamicTree::DynamicTree(DynamicTree&&) noexcept = default;
DynamicTree& DynamicTree::operator=(DynamicTree&&) noexcept = default;

MoverId DynamicTree::addMover(Recorder& recorder, const Model& model, const Mat4& to_world)
{
    requireUsable(*model.impl()->made_in, "model");
    requireSame(m_impl->context, model.impl()->context);
    m_impl->enter(recorder.impl());
    const auto& mesh = model.impl()->mesh;
    const MoverId mover =
        recording(recorder, [&](Recorder::Impl&) { return m_impl->octree->add(mesh, poseOf(*mesh, to_world)); });
    m_impl->new_movers.push_back({recorder.impl().frame, mover});
    return mover;
}

void DynamicTree::placeMover(MoverId mover, const Mat4& to_world)
{
    m_impl->learn();
    m_impl->octree->place(mover, poseOf(m_impl->octree->mesh(mover), to_world));
}

void DynamicTree::removeMover(MoverId mover)
{
    m_impl->learn();
    m_impl->octree->remove(mover);
    std::erase_if(m_impl->new_movers, [&](const Impl::NewMover& made) { return made.mover == mover; });
}

bool DynamicTree::update(Recorder& recorder, double budget_ms)
{
    return m_impl->change(recorder, [&](DynamicOctree& octree, vk::FrameGraph& graph)
                          { return octree.update(graph, budget_ms); });
}

bool DynamicTree::needsUpdate()
{
    m_impl->learn();
    return m_impl->octree->needsUpdate();
}

bool DynamicTree::undo(Recorder& recorder)
{
    return m_impl->change(recorder, [](DynamicOctree& octree, vk::FrameGraph& graph) { return octree.undo(graph); });
}

bool DynamicTree::redo(Recorder& recorder)
{
    return m_impl->change(recorder, [](DynamicOctree& octree, vk::FrameGraph& graph) { return octree.redo(graph); });
}

bool DynamicTree::edit(Recorder& recorder, const BrushInfo& info)
{
    Brush brush;
    brush.shape = info.shape;
    brush.action = info.action;
    brush.center = {info.center[0], info.center[1], info.center[2]};
    brush.radius = info.radius;
    brush.color = info.color;
    return m_impl->change(recorder,
                          [&](DynamicOctree& octree, vk::FrameGraph& graph) { return octree.edit(graph, brush); });
}

void DynamicTree::endStroke()
{
    m_impl->octree->endStroke();
}

bool DynamicTree::undoEdit(Recorder& recorder)
{
    return m_impl->change(recorder,
                          [](DynamicOctree& octree, vk::FrameGraph& graph) { return octree.undoEdit(graph); });
}

bool DynamicTree::redoEdit(Recorder& recorder)
{
    return m_impl->change(recorder,
                          [](DynamicOctree& octree, vk::FrameGraph& graph) { return octree.redoEdit(graph); });
}

std::vector<UpdateFacts> DynamicTree::takeUpdates()
{
    m_impl->learn();
    return std::exchange(m_impl->updates, {});
}

const TreeFacts& DynamicTree::facts() const
{
    return m_impl->facts;
}

std::uint64_t DynamicTree::address() const
{
    return m_impl->table.address();
}

} // namespace zvo
