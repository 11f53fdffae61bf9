// SPDX-License-Identifier: MIT
// The C interface: models, trees, and the jobs that make them.
#include "api/c_convert.h"
#include "api/c_handles.h"

#include <filesystem>

using namespace zvo;

ZvoResult zvoModelCreate(ZvoRecorder* recorder, const ZvoModelInfo* info, ZvoModel** model)
{
    return guarded(__func__,
                   [&]
                   {
                       const ModelOfC description(readStruct(info, "info"));
                       give(model, "model", [&] { return Model(objectOf(recorder, "recorder"), description.info()); });
                   });
}

ZvoResult zvoModelStats(const ZvoModel* model, ZvoModelStats* stats)
{
    return guarded(__func__, [&] { write(stats, "stats", objectOf(model, "model")); });
}

ZvoResult zvoModelGridAround(const ZvoModel* model, uint32_t depth, ZvoGrid* grid)
{
    return guarded(__func__, [&] { at(grid, "grid") = toC<ZvoGrid>(objectOf(model, "model").gridAround(depth)); });
}

ZvoResult zvoTreeFromFile(ZvoRecorder* recorder, const char* path, ZvoTree** tree)
{
    return guarded(__func__,
                   [&]
                   {
                       const std::filesystem::path file(&at(path, "path"));
                       give(tree, "tree", [&] { return Tree(objectOf(recorder, "recorder"), file); });
                   });
}

ZvoResult zvoTreeFromMemory(ZvoRecorder* recorder, const void* file, size_t file_bytes, ZvoTree** tree)
{
    return guarded(__func__,
                   [&]
                   {
                       const auto* const bytes = &at(static_cast<const std::byte*>(file), "file");
                       give(tree, "tree",
                            [&] { return Tree(objectOf(recorder, "recorder"), std::span(bytes, file_bytes)); });
                   });
}

ZvoResult zvoTreeInfo(const ZvoTree* tree, ZvoTreeInfo* info)
{
    return guarded(__func__, [&] { write(info, "info", objectOf(tree, "tree").info()); });
}

ZvoResult zvoTreeAddress(const ZvoTree* tree, uint64_t* address)
{
    return guarded(__func__, [&] { at(address, "address") = objectOf(tree, "tree").address(); });
}

ZvoResult zvoTreeBuildCreate(ZvoContext* context, const ZvoModel* model, const ZvoTreeBuildInfo* info,
                             ZvoTreeJob** build)
{
    return guarded(__func__,
                   [&]
                   {
                       const TreeBuildInfo description = read(info, "info");
                       const Model& source = objectOf(model, "model");
                       give(build, "build",
                            [&] { return TreeBuild(objectOf(context, "context"), source, description); });
                   });
}

ZvoResult zvoTreeAlgebraCreate(ZvoRecorder* recorder, const ZvoTree* tree, const ZvoTree* other,
                               const ZvoTreeAlgebraInfo* info, ZvoTreeJob** algebra)
{
    return guarded(__func__,
                   [&]
                   {
                       const TreeAlgebraInfo description = read(info, "info");
                       const Tree& source = objectOf(tree, "tree");
                       const Tree* const second = other != nullptr ? &objectOf(other, "other") : nullptr;
                       give(algebra, "algebra",
                            [&] { return TreeAlgebra(objectOf(recorder, "recorder"), source, second, description); });
                   });
}

ZvoResult zvoTreeCompressionCreate(ZvoContext* context, ZvoTree* octree, ZvoTreeJob** compression)
{
    return guarded(__func__,
                   [&]
                   {
                       Context& object = objectOf(context, "context");
                       Tree& source = objectOf(octree, "octree");
                       give(compression, "compression", [&] { return TreeCompression(object, std::move(source)); });
                       delete octree;
                   });
}

ZvoResult zvoTreeJobRecord(ZvoTreeJob* job, ZvoRecorder* recorder, VkBool32* has_more)
{
    return answered(__func__, has_more, "has_more",
                    [&] { return objectOf(job, "job").record(objectOf(recorder, "recorder")); });
}

ZvoResult zvoTreeJobIsDone(ZvoTreeJob* job, VkBool32* is_done)
{
    return answered(__func__, is_done, "is_done", [&] { return objectOf(job, "job").isDone(); });
}

ZvoResult zvoTreeJobIsBroken(const ZvoTreeJob* job, VkBool32* is_broken)
{
    return answered(__func__, is_broken, "is_broken", [&] { return objectOf(job, "job").isBroken(); });
}

ZvoResult zvoTreeJobTake(ZvoTreeJob* job, ZvoTree** tree)
{
    return guarded(__func__, [&] { give(tree, "tree", [&] { return objectOf(job, "job").take(); }); });
}

ZvoResult zvoTreeJobDropped(const ZvoTreeJob* job, ZvoDroppedTriangles* dropped)
{
    return guarded(__func__, [&] { write(dropped, "dropped", objectOf(job, "job").dropped()); });
}
