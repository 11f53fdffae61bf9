// SPDX-License-Identifier: MIT
#include "zvo/dynamic_tree.h"

#include "api/checked.h"
#include "api/convert.h"
#include "api/dynamic_tree_impl.h"
#include "api/model_impl.h"
#include "api/shown_tree.h"
#include "core/scene/animation.h"
#include "core/tree/tree_table.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <span>

namespace zvo
{

namespace
{

constexpr std::int64_t kFarthestVoxel = 1 << 20; // farther away, no grid has voxels

DynamicOptions optionsOf(const DynamicTreeInfo& info)
{
    DynamicOptions options;
    options.coverage = checked(info).coverage;
    options.merge = info.merge;
    options.frames_in_flight = info.frames_in_flight;
    options.history = {info.history_entries, info.history_bytes};
    options.edits = {info.strokes, info.edit_bytes};
    options.emission_scale = info.emission_scale;
    return options;
}

Pose poseOf(const DynamicMesh& mesh, const Mat4& to_world)
{
    return poseAt(mesh.scene, 0.0, glm::dmat4(toGlm(checkedTransform(to_world, "a dynamic object"))));
}

UpdateStats statsOf(const UpdateReport& report)
{
    return {report.failed != 0, report.node_count, report.voxel_count, report.dynamic_count, report.dropped};
}

} // namespace

DynamicTree::Impl::Impl(Recorder::Impl& recorder, Tree&& fixed, const DynamicTreeInfo& info)
    : context(recorder.context), tree_info(usable(fixed).tree_info), table(context.device, "tree table", 1)
{
    requireSame(context, usable(fixed).context);
    try
    {
        octree = std::make_unique<DynamicOctree>(context.uploads, std::move(fixed.impl()->fixed), optionsOf(info));
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Usage) // with Usage, the tree was not taken
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
    context.deleteLater(std::move(octree));
    context.deleteLater(std::move(table));
}

void DynamicTree::Impl::learn()
{
    made_in = made_in && made_in->is_done ? nullptr : made_in;
    while (!frames.empty() && frames.front().host->is_done)
    {
        const Frame frame = std::move(frames.front());
        frames.pop_front();
        for (const UpdateReport& report : octree->frameDone(frame.number, frame.host->times))
        {
            updates.push_back(statsOf(report));
        }
    }
    if (!frames.empty() && frames.back().host->is_lost)
    {
        octree->frameLost();
        frames.pop_back();
    }
    for (const NewObject& made : new_objects)
    {
        if (made.made_in->is_lost)
        {
            octree->remove(made.object); // the upload of its vertices was lost
        }
    }
    std::erase_if(new_objects, [](const NewObject& made) { return made.made_in->is_lost || made.made_in->is_done; });
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

DynamicObjectId DynamicTree::addObject(Recorder& recorder, const Model& model, const Mat4& to_world,
                                       const DynamicObjectInfo& info)
{
    Impl& impl = usable(*this);
    const Model::Impl& model_impl = usable(model);
    requireSame(impl.context, model_impl.context);
    checked(info);
    const auto& mesh = model_impl.mesh;
    Pose pose = poseOf(*mesh, to_world); // checks to_world before anything is recorded
    impl.enter(recorder.impl());
    const DynamicObjectId object =
        recording(recorder, [&](Recorder::Impl&) { return impl.octree->add(mesh, std::move(pose), info); });
    impl.new_objects.push_back({recorder.impl().frame, object});
    return object;
}

void DynamicTree::setTransform(DynamicObjectId object, const Mat4& to_world)
{
    Impl& impl = usable(*this);
    impl.learn();
    impl.octree->setPose(object, poseOf(impl.octree->mesh(object), to_world));
}

void DynamicTree::removeObject(DynamicObjectId object)
{
    Impl& impl = usable(*this);
    impl.learn();
    impl.octree->remove(object);
    std::erase_if(impl.new_objects, [&](const Impl::NewObject& made) { return made.object == object; });
}

bool DynamicTree::update(Recorder& recorder, double budget_ms)
{
    checkedAmount(budget_ms, "budget_ms");
    return usable(*this).change(recorder, [&](DynamicOctree& octree, vk::FrameGraph& graph)
                                { return octree.update(graph, budget_ms); });
}

bool DynamicTree::needsUpdate()
{
    Impl& impl = usable(*this);
    impl.learn();
    return impl.octree->needsUpdate();
}

bool DynamicTree::undo(Recorder& recorder)
{
    return usable(*this).change(recorder, &DynamicOctree::undo);
}

bool DynamicTree::redo(Recorder& recorder)
{
    return usable(*this).change(recorder, &DynamicOctree::redo);
}

bool DynamicTree::edit(Recorder& recorder, const BrushInfo& info)
{
    Brush brush;
    brush.shape = checked(info).shape;
    brush.action = info.action;
    brush.center = {info.center[0], info.center[1], info.center[2]};
    brush.radius = info.radius;
    brush.color = info.color;
    brush.emission = {info.emission[0], info.emission[1], info.emission[2]};
    if (brush.emission != gpu::vec3(0.0F) && usable(*this).octree->tree().emission_words.count() == 0)
    {
        throw Error(ErrorCode::Usage,
                    "BrushInfo::emission needs DynamicTreeInfo::emission_scale above 0, and a tree with attributes");
    }
    return usable(*this).changeEdits(recorder, [&](DynamicOctree& octree, vk::FrameGraph& graph)
                                     { return octree.edit(graph, brush); });
}

bool DynamicTree::stamp(Recorder& recorder, const Tree& octree, const std::array<std::int32_t, 3>& offset,
                        BrushAction action)
{
    const DeviceTree& source = shownIn(recorder.impl(), octree).tree;
    usable(*this).enter(recorder.impl());
    const DeviceTree& edited = usable(*this).octree->tree();
    if (action != BrushAction::Carve && action != BrushAction::Fill)
    {
        throw Error(ErrorCode::Usage, "a stamp carves or fills");
    }
    requireAtMost(source.grid.depth, std::bit_width(gpu::kDabEdgeMax) - 1, "the depth of a stamp's grid");
    if (source.isDag() || isPacked(source.attributeFormat()))
    {
        throw Error(ErrorCode::Usage, "a stamp is an octree, with attributes of 8 bytes or none");
    }
    if (source.emission.count() != 0 && edited.emission_words.count() != 0 &&
        source.emission_scale != edited.emission_scale)
    {
        throw Error(ErrorCode::Usage, "a stamp has another emission scale than the tree");
    }
    const auto isFarAway = [](std::int32_t voxels) { return std::abs(std::int64_t{voxels}) > kFarthestVoxel; };
    if (source.node_count == 0 || std::ranges::any_of(offset, isFarAway))
    {
        return true;
    }
    Brush brush;
    brush.action = action;
    brush.tree_stamp = {&source, {offset[0], offset[1], offset[2]}};
    return usable(*this).changeEdits(recorder, [&](DynamicOctree& dynamic, vk::FrameGraph& graph)
                                     { return dynamic.edit(graph, brush); });
}

void DynamicTree::endStroke()
{
    usable(*this).octree->endStroke();
}

bool DynamicTree::undoEdit(Recorder& recorder)
{
    return usable(*this).changeEdits(recorder, &DynamicOctree::undoEdit);
}

bool DynamicTree::redoEdit(Recorder& recorder)
{
    return usable(*this).changeEdits(recorder, &DynamicOctree::redoEdit);
}

std::vector<UpdateStats> DynamicTree::takeUpdates()
{
    Impl& impl = usable(*this);
    impl.learn();
    return std::exchange(impl.updates, {});
}

const TreeInfo& DynamicTree::info() const
{
    return usable(*this).tree_info;
}

std::uint64_t DynamicTree::address() const
{
    return usable(*this).table.address();
}

} // namespace zvo
