// SPDX-License-Identifier: MIT
// The C interface: dynamic trees.
#include "api/c_convert.h"
#include "api/c_handles.h"
#include "api/c_struct.h"

#include <algorithm>

namespace zvo
{

namespace
{

Mat4 matrixOf(const float* values)
{
    Mat4 result{};
    std::copy_n(&at(values, "to_world"), result.size(), result.begin());
    return result;
}

// Checks all pointers, then calls work and stores its answer.
template <typename Work>
ZvoResult answered(const char* function, ZvoDynamicTree* tree, VkBool32* answer, const Work& work)
{
    return guarded(function,
                   [&]
                   {
                       VkBool32& result = at(answer, "the last pointer");
                       result = work(at(tree, "tree").object) ? VK_TRUE : VK_FALSE;
                   });
}

} // namespace

} // namespace zvo

using namespace zvo;

ZvoResult zvoDynamicTreeCreate(ZvoRecorder* recorder, ZvoTree* fixed, const ZvoDynamicTreeInfo* info,
                               ZvoDynamicTree** tree)
{
    return guarded(__func__,
                   [&]
                   {
                       const DynamicTreeInfo description = ofC(readStruct(info, "info"));
                       Recorder& object = at(recorder, "recorder").object;
                       Tree& source = at(fixed, "fixed").object;
                       give(tree, "tree", [&] { return DynamicTree(object, std::move(source), description); });
                       delete fixed;
                   });
}

void zvoDynamicTreeDestroy(ZvoDynamicTree* tree)
{
    delete tree;
}

ZvoResult zvoDynamicTreeAddObject(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoModel* model,
                                  const float to_world[16], ZvoDynamicObjectId* id)
{
    return guarded(__func__,
                   [&]
                   {
                       ZvoDynamicObjectId& result = at(id, "id");
                       Recorder& object = at(recorder, "recorder").object;
                       result =
                           at(tree, "tree").object.addObject(object, at(model, "model").object, matrixOf(to_world));
                   });
}

ZvoResult zvoDynamicTreeSetTransform(ZvoDynamicTree* tree, ZvoDynamicObjectId id, const float to_world[16])
{
    return guarded(__func__, [&] { at(tree, "tree").object.setTransform(id, matrixOf(to_world)); });
}

ZvoResult zvoDynamicTreeRemoveObject(ZvoDynamicTree* tree, ZvoDynamicObjectId id)
{
    return guarded(__func__, [&] { at(tree, "tree").object.removeObject(id); });
}

ZvoResult zvoDynamicTreeUpdate(ZvoDynamicTree* tree, ZvoRecorder* recorder, double budget_ms, VkBool32* is_complete)
{
    return answered(__func__, tree, is_complete,
                    [&](DynamicTree& object) { return object.update(at(recorder, "recorder").object, budget_ms); });
}

ZvoResult zvoDynamicTreeNeedsUpdate(ZvoDynamicTree* tree, VkBool32* needs_update)
{
    return answered(__func__, tree, needs_update, [](DynamicTree& object) { return object.needsUpdate(); });
}

ZvoResult zvoDynamicTreeUndo(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_undone)
{
    return answered(__func__, tree, is_undone,
                    [&](DynamicTree& object) { return object.undo(at(recorder, "recorder").object); });
}

ZvoResult zvoDynamicTreeRedo(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_redone)
{
    return answered(__func__, tree, is_redone,
                    [&](DynamicTree& object) { return object.redo(at(recorder, "recorder").object); });
}

ZvoResult zvoDynamicTreeEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoBrushInfo* brush,
                             VkBool32* is_recorded)
{
    return answered(__func__, tree, is_recorded,
                    [&](DynamicTree& object)
                    {
                        const BrushInfo info = ofC(readStruct(brush, "brush"));
                        return object.edit(at(recorder, "recorder").object, info);
                    });
}

ZvoResult zvoDynamicTreeEndStroke(ZvoDynamicTree* tree)
{
    return guarded(__func__, [&] { at(tree, "tree").object.endStroke(); });
}

ZvoResult zvoDynamicTreeUndoEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_undone)
{
    return answered(__func__, tree, is_undone,
                    [&](DynamicTree& object) { return object.undoEdit(at(recorder, "recorder").object); });
}

ZvoResult zvoDynamicTreeRedoEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_redone)
{
    return answered(__func__, tree, is_redone,
                    [&](DynamicTree& object) { return object.redoEdit(at(recorder, "recorder").object); });
}

ZvoResult zvoDynamicTreeTakeUpdate(ZvoDynamicTree* tree, ZvoUpdateStats* stats, VkBool32* is_taken)
{
    return guarded(__func__,
                   [&]
                   {
                       auto& [object, updates] = at(tree, "tree");
                       VkBool32& result = at(is_taken, "is_taken");
                       sizeOf(stats, "stats");
                       for (UpdateStats& update : object.takeUpdates())
                       {
                           updates.push_back(std::move(update));
                       }
                       result = updates.empty() ? VK_FALSE : VK_TRUE;
                       if (!updates.empty())
                       {
                           writeStruct(stats, "stats", toC(updates.front()));
                           updates.pop_front();
                       }
                   });
}

ZvoResult zvoDynamicTreeInfo(const ZvoDynamicTree* tree, ZvoTreeInfo* info)
{
    return guarded(__func__, [&] { writeStruct(info, "info", toC(at(tree, "tree").object.info())); });
}

ZvoResult zvoDynamicTreeAddress(const ZvoDynamicTree* tree, uint64_t* address)
{
    return guarded(__func__, [&] { at(address, "address") = at(tree, "tree").object.address(); });
}
