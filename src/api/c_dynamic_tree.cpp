// SPDX-License-Identifier: MIT
// The C interface: dynamic trees.
#include "api/c_convert.h"
#include "api/c_handles.h"

#include <algorithm>
#include <iterator>

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

void addObject(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoModel* model, const float* to_world,
               const DynamicObjectInfo& info, ZvoDynamicObjectId* id)
{
    ZvoDynamicObjectId& result = at(id, "id");
    Recorder& object = objectOf(recorder, "recorder");
    result = objectOf(tree, "tree").addObject(object, objectOf(model, "model"), matrixOf(to_world), info);
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
                       const DynamicTreeInfo description = read(info, "info");
                       Recorder& object = objectOf(recorder, "recorder");
                       Tree& source = objectOf(fixed, "fixed");
                       give(tree, "tree", [&] { return DynamicTree(object, std::move(source), description); });
                       delete fixed;
                   });
}

ZvoResult zvoDynamicTreeAddObject(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoModel* model,
                                  const float to_world[16], ZvoDynamicObjectId* id)
{
    return guarded(__func__, [&] { addObject(tree, recorder, model, to_world, {}, id); });
}

ZvoResult zvoDynamicTreeAddObjectWith(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoModel* model,
                                      const float to_world[16], const ZvoDynamicObjectInfo* info,
                                      ZvoDynamicObjectId* id)
{
    return guarded(__func__, [&] { addObject(tree, recorder, model, to_world, read(info, "info"), id); });
}

ZvoResult zvoDynamicTreeSetTransform(ZvoDynamicTree* tree, ZvoDynamicObjectId id, const float to_world[16])
{
    return guarded(__func__, [&] { objectOf(tree, "tree").setTransform(id, matrixOf(to_world)); });
}

ZvoResult zvoDynamicTreeRemoveObject(ZvoDynamicTree* tree, ZvoDynamicObjectId id)
{
    return guarded(__func__, [&] { objectOf(tree, "tree").removeObject(id); });
}

ZvoResult zvoDynamicTreeUpdate(ZvoDynamicTree* tree, ZvoRecorder* recorder, double budget_ms, VkBool32* is_complete)
{
    return answered(__func__, is_complete, "is_complete",
                    [&] { return objectOf(tree, "tree").update(objectOf(recorder, "recorder"), budget_ms); });
}

ZvoResult zvoDynamicTreeNeedsUpdate(ZvoDynamicTree* tree, VkBool32* needs_update)
{
    return answered(__func__, needs_update, "needs_update", [&] { return objectOf(tree, "tree").needsUpdate(); });
}

ZvoResult zvoDynamicTreeUndo(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_undone)
{
    return answered(__func__, is_undone, "is_undone",
                    [&] { return objectOf(tree, "tree").undo(objectOf(recorder, "recorder")); });
}

ZvoResult zvoDynamicTreeRedo(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_redone)
{
    return answered(__func__, is_redone, "is_redone",
                    [&] { return objectOf(tree, "tree").redo(objectOf(recorder, "recorder")); });
}

ZvoResult zvoDynamicTreeEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoBrushInfo* brush,
                             VkBool32* is_recorded)
{
    return answered(__func__, is_recorded, "is_recorded",
                    [&] { return objectOf(tree, "tree").edit(objectOf(recorder, "recorder"), read(brush, "brush")); });
}

ZvoResult zvoDynamicTreeStamp(ZvoDynamicTree* tree, ZvoRecorder* recorder, const ZvoTree* octree,
                              const int32_t offset[3], ZvoBrushAction action, VkBool32* is_recorded)
{
    return answered(__func__, is_recorded, "is_recorded",
                    [&]
                    {
                        const int32_t* const by = &at(offset, "offset");
                        return objectOf(tree, "tree")
                            .stamp(objectOf(recorder, "recorder"), objectOf(octree, "octree"), {by[0], by[1], by[2]},
                                   static_cast<BrushAction>(action));
                    });
}

ZvoResult zvoDynamicTreeEndStroke(ZvoDynamicTree* tree)
{
    return guarded(__func__, [&] { objectOf(tree, "tree").endStroke(); });
}

ZvoResult zvoDynamicTreeUndoEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_undone)
{
    return answered(__func__, is_undone, "is_undone",
                    [&] { return objectOf(tree, "tree").undoEdit(objectOf(recorder, "recorder")); });
}

ZvoResult zvoDynamicTreeRedoEdit(ZvoDynamicTree* tree, ZvoRecorder* recorder, VkBool32* is_redone)
{
    return answered(__func__, is_redone, "is_redone",
                    [&] { return objectOf(tree, "tree").redoEdit(objectOf(recorder, "recorder")); });
}

ZvoResult zvoDynamicTreeTakeUpdate(ZvoDynamicTree* tree, ZvoUpdateStats* stats, VkBool32* is_taken)
{
    return answered(__func__, is_taken, "is_taken",
                    [&]
                    {
                        auto& [object, updates] = at(tree, "tree");
                        sizeOf(stats, "stats");
                        std::ranges::move(object.takeUpdates(), std::back_inserter(updates));
                        if (updates.empty())
                        {
                            return false;
                        }
                        write(stats, "stats", updates.front());
                        updates.pop_front();
                        return true;
                    });
}

ZvoResult zvoDynamicTreeInfo(const ZvoDynamicTree* tree, ZvoTreeInfo* info)
{
    return guarded(__func__, [&] { write(info, "info", objectOf(tree, "tree").info()); });
}

ZvoResult zvoDynamicTreeAddress(const ZvoDynamicTree* tree, uint64_t* address)
{
    return guarded(__func__, [&] { at(address, "address") = objectOf(tree, "tree").address(); });
}
