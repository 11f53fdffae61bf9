// SPDX-License-Identifier: MIT
// The C interface: models, trees, and the jobs that make them.
#include "api/c_convert.h"
#include "api/c_handles.h"
#include "api/c_struct.h"

#include <filesystem>

namespace zvo
{

namespace
{

VkBool32 boolean(bool value)
{
    return value ? VK_TRUE : VK_FALSE;
}

// TreeBuild and TreeCompression share these functions.

template <typename Job> ZvoResult record(const char* function, Job* job, ZvoRecorder* recorder, VkBool32* has_more)
{
    return guarded(function,
                   [&]
                   {
                       VkBool32& result = at(has_more, "has_more");
                       result = boolean(at(job, "job").object.record(at(recorder, "recorder").object));
                   });
}

template <typename Job> ZvoResult isDone(const char* function, Job* job, VkBool32* is_done)
{
    return guarded(function, [&] { at(is_done, "is_done") = boolean(at(job, "job").object.isDone()); });
}

template <typename Job> ZvoResult isBroken(const char* function, const Job* job, VkBool32* is_broken)
{
    return guarded(function, [&] { at(is_broken, "is_broken") = boolean(at(job, "job").object.isBroken()); });
}

template <typename Job> ZvoResult take(const char* function, Job* job, ZvoTree** tree)
{
    return guarded(function, [&] { give(tree, "tree", [&] { return at(job, "job").object.take(); }); });
}

} // namespace

} // namespace zvo

using namespace zvo;

ZvoResult zvoModelCreate(ZvoRecorder* recorder, const ZvoModelInfo* info, ZvoModel** model)
{
    return guarded(__func__,
                   [&]
                   {
                       const ModelOfC description(readStruct(info, "info"));
                       give(model, "model", [&] { return Model(at(recorder, "recorder").object, description.info()); });
                   });
}

void zvoModelDestroy(ZvoModel* model)
{
    delete model;
}

ZvoResult zvoModelStats(const ZvoModel* model, ZvoModelStats* stats)
{
    return guarded(__func__,
                   [&]
                   {
                       const Model& object = at(model, "model").object;
                       auto result = initial<ZvoModelStats>();
                       result.triangle_count = object.triangleCount();
                       result.emission_scale = object.emissionScale();
                       writeStruct(stats, "stats", result);
                   });
}

ZvoResult zvoModelGridAround(const ZvoModel* model, uint32_t depth, ZvoGrid* grid)
{
    return guarded(__func__, [&] { at(grid, "grid") = toC(at(model, "model").object.gridAround(depth)); });
}

ZvoResult zvoTreeFromFile(ZvoRecorder* recorder, const char* path, ZvoTree** tree)
{
    return guarded(__func__,
                   [&]
                   {
                       const std::filesystem::path file(&at(path, "path"));
                       give(tree, "tree", [&] { return Tree(at(recorder, "recorder").object, file); });
                   });
}

ZvoResult zvoTreeFromMemory(ZvoRecorder* recorder, const void* file, size_t file_bytes, ZvoTree** tree)
{
    return guarded(__func__,
                   [&]
                   {
                       const auto* const bytes = &at(static_cast<const std::byte*>(file), "file");
                       give(tree, "tree",
                            [&] { return Tree(at(recorder, "recorder").object, std::span(bytes, file_bytes)); });
                   });
}

void zvoTreeDestroy(ZvoTree* tree)
{
    delete tree;
}

ZvoResult zvoTreeInfo(const ZvoTree* tree, ZvoTreeInfo* info)
{
    return guarded(__func__, [&] { writeStruct(info, "info", toC(at(tree, "tree").object.info())); });
}

ZvoResult zvoTreeAddress(const ZvoTree* tree, uint64_t* address)
{
    return guarded(__func__, [&] { at(address, "address") = at(tree, "tree").object.address(); });
}

ZvoResult zvoTreeBuildCreate(ZvoContext* context, const ZvoModel* model, const ZvoTreeBuildInfo* info,
                             ZvoTreeBuild** build)
{
    return guarded(__func__,
                   [&]
                   {
                       const TreeBuildInfo description = ofC(readStruct(info, "info"));
                       const Model& object = at(model, "model").object;
                       give(build, "build",
                            [&] { return TreeBuild(at(context, "context").object, object, description); });
                   });
}

void zvoTreeBuildDestroy(ZvoTreeBuild* build)
{
    delete build;
}

ZvoResult zvoTreeBuildRecord(ZvoTreeBuild* build, ZvoRecorder* recorder, VkBool32* has_more)
{
    return record(__func__, build, recorder, has_more);
}

ZvoResult zvoTreeBuildIsDone(ZvoTreeBuild* build, VkBool32* is_done)
{
    return isDone(__func__, build, is_done);
}

ZvoResult zvoTreeBuildIsBroken(const ZvoTreeBuild* build, VkBool32* is_broken)
{
    return isBroken(__func__, build, is_broken);
}

ZvoResult zvoTreeBuildTake(ZvoTreeBuild* build, ZvoTree** tree)
{
    return take(__func__, build, tree);
}

ZvoResult zvoTreeBuildDropped(const ZvoTreeBuild* build, ZvoDroppedTriangles* dropped)
{
    return guarded(__func__, [&] { writeStruct(dropped, "dropped", toC(at(build, "build").object.dropped())); });
}

ZvoResult zvoTreeCompressionCreate(ZvoContext* context, ZvoTree* octree, ZvoTreeCompression** compression)
{
    return guarded(__func__,
                   [&]
                   {
                       Context& object = at(context, "context").object;
                       Tree& source = at(octree, "octree").object;
                       give(compression, "compression", [&] { return TreeCompression(object, std::move(source)); });
                       delete octree;
                   });
}

void zvoTreeCompressionDestroy(ZvoTreeCompression* compression)
{
    delete compression;
}

ZvoResult zvoTreeCompressionRecord(ZvoTreeCompression* compression, ZvoRecorder* recorder, VkBool32* has_more)
{
    return record(__func__, compression, recorder, has_more);
}

ZvoResult zvoTreeCompressionIsDone(ZvoTreeCompression* compression, VkBool32* is_done)
{
    return isDone(__func__, compression, is_done);
}

ZvoResult zvoTreeCompressionIsBroken(const ZvoTreeCompression* compression, VkBool32* is_broken)
{
    return isBroken(__func__, compression, is_broken);
}

ZvoResult zvoTreeCompressionTake(ZvoTreeCompression* compression, ZvoTree** tree)
{
    return take(__func__, compression, tree);
}
