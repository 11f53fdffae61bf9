// SPDX-License-Identifier: MIT
// The C interface: questions to trees. Its structs are those of C++.
#include "api/c_convert.h"
#include "api/c_handles.h"
#include "api/checked.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

namespace zvo
{

namespace
{

static_assert(sizeof(ZvoPointQuery) == sizeof(PointQuery) && sizeof(ZvoRayQuery) == sizeof(RayQuery) &&
              sizeof(ZvoBoxQuery) == sizeof(BoxQuery) && sizeof(ZvoNearestQuery) == sizeof(NearestQuery) &&
              sizeof(ZvoSweepQuery) == sizeof(SweepQuery) && sizeof(ZvoQueryAnswer) == sizeof(QueryAnswer));
static_assert(offsetof(ZvoRayQuery, direction) == offsetof(RayQuery, direction) &&
              offsetof(ZvoNearestQuery, reach) == offsetof(NearestQuery, reach) &&
              offsetof(ZvoSweepQuery, motion) == offsetof(SweepQuery, motion) &&
              offsetof(ZvoQueryAnswer, face) == offsetof(QueryAnswer, face) &&
              offsetof(ZvoQueryAnswer, numerator) == offsetof(QueryAnswer, numerator) &&
              offsetof(ZvoQueryAnswer, color) == offsetof(QueryAnswer, color) &&
              offsetof(ZvoQueryAnswer, emission) == offsetof(QueryAnswer, emission) &&
              offsetof(ZvoQueryAnswer, index) == offsetof(QueryAnswer, index));

template <typename Query> QueryList listOf(const void* queries, std::size_t count)
{
    return std::span(static_cast<const Query*>(queries), count);
}

QueryList listOf(ZvoQueryKind kind, const void* queries, std::size_t count)
{
    if (count != 0 && queries == nullptr)
    {
        throw Error(ErrorCode::Usage, "queries is null");
    }
    switch (checkedEnum(static_cast<QueryKind>(kind), QueryKind::Sweep, "kind"))
    {
    case QueryKind::Point:
        return listOf<PointQuery>(queries, count);
    case QueryKind::Ray:
        return listOf<RayQuery>(queries, count);
    case QueryKind::Box:
        return listOf<BoxQuery>(queries, count);
    case QueryKind::Nearest:
        return listOf<NearestQuery>(queries, count);
    case QueryKind::Sweep:
        break;
    }
    return listOf<SweepQuery>(queries, count);
}

template <typename TreeHandle>
ZvoResult create(const char* function, ZvoRecorder* recorder, TreeHandle* tree, ZvoQueryKind kind, const void* queries,
                 size_t count, ZvoQueryBatch** batch)
{
    return guarded(function,
                   [&]
                   {
                       Recorder& recording = objectOf(recorder, "recorder");
                       auto& asked = objectOf(tree, "tree");
                       const QueryList list = listOf(kind, queries, count);
                       give(batch, "batch", [&] { return QueryBatch(recording, asked, list); });
                   });
}

} // namespace

} // namespace zvo

using namespace zvo;

ZvoResult zvoLatticePosition(const ZvoGrid* grid, const double world[3], int32_t position[3])
{
    return guarded(
        __func__,
        [&]
        {
            const double* const from = &at(world, "world");
            int32_t* const to = &at(position, "position");
            const LatticePosition result = latticePosition(ofC(at(grid, "grid")), {from[0], from[1], from[2]});
            std::copy(result.begin(), result.end(), to);
        });
}

ZvoResult zvoQueryBatchCreate(ZvoRecorder* recorder, const ZvoTree* tree, ZvoQueryKind kind, const void* queries,
                              size_t count, ZvoQueryBatch** batch)
{
    return create(__func__, recorder, tree, kind, queries, count, batch);
}

ZvoResult zvoQueryBatchCreateDynamic(ZvoRecorder* recorder, ZvoDynamicTree* tree, ZvoQueryKind kind,
                                     const void* queries, size_t count, ZvoQueryBatch** batch)
{
    return create(__func__, recorder, tree, kind, queries, count, batch);
}

ZvoResult zvoQueryBatchIsDone(const ZvoQueryBatch* batch, VkBool32* done)
{
    return answered(__func__, done, "done", [&] { return objectOf(batch, "batch").isDone(); });
}

ZvoResult zvoQueryBatchAnswers(const ZvoQueryBatch* batch, size_t first, size_t count, ZvoQueryAnswer* answers)
{
    return guarded(__func__,
                   [&]
                   {
                       const QueryBatch& asked = objectOf(batch, "batch");
                       auto* const out = reinterpret_cast<QueryAnswer*>(&at(answers, "answers"));
                       asked.answers(first, std::span(out, count));
                   });
}
