// SPDX-License-Identifier: MIT
#include "zvo/query.h"

#include "api/checked.h"
#include "api/convert.h"
#include "api/query_impl.h"
#include "api/shown_tree.h"

#include <fmt/format.h>

#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint64_t kQueriesMax = 1U << 24;

KeptQueries kept(const QueryList& queries)
{
    return std::visit([](const auto& list) { return KeptQueries(std::vector(list.begin(), list.end())); }, queries);
}

QueryList listOf(const KeptQueries& queries)
{
    return std::visit([](const auto& list) { return QueryList(std::span(list)); }, queries);
}

template <typename AnyTree>
std::unique_ptr<QueryBatch::Impl> ask(Recorder& recorder, AnyTree& any_tree, const QueryList& queries)
{
    requireAtMost(sizeOf(queries), kQueriesMax, "queries");
    const DeviceTree& tree = shownIn(recorder.impl(), any_tree).tree;
    return recording(recorder,
                     [&](Recorder::Impl& impl) { return std::make_unique<QueryBatch::Impl>(impl, tree, queries); });
}

} // namespace

QueryBatch::Impl::Impl(Recorder::Impl& recorder, const DeviceTree& asked, const QueryList& list)
    : context(recorder.context), tree(asked), queries(kept(list)), made_in(recorder.frame)
{
    if (sizeOf(list) == 0)
    {
        return;
    }
    buffers.emplace(context.uploads, list, asked.grid);
    readback = vk::Readback(context.device, buffers->hits.bytes() + buffers->looks.bytes() + sizeof(std::uint64_t));
    try
    {
        context.uploads.flush();
        answerQueries(recorder.graph, asked, *buffers);
        hits_at = readback.copy(recorder.graph, buffers->hits, 0, buffers->count);
        looks_at = readback.copy(recorder.graph, buffers->looks, 0, buffers->count);
        recorder.graph.releaseToHost();
    }
    catch (...)
    {
        keepBuffers(); // what was recorded may be submitted
        throw;
    }
}

QueryBatch::Impl::~Impl()
{
    keepBuffers();
}

void QueryBatch::Impl::keepBuffers()
{
    context.deleteLater(std::move(buffers));
    context.deleteLater(std::move(readback));
}

void QueryBatch::Impl::answers(std::size_t first, std::span<QueryAnswer> answers) const
{
    const QueryList list = listOf(queries);
    if (first > sizeOf(list) || answers.size() > sizeOf(list) - first)
    {
        throw Error(ErrorCode::Usage, fmt::format("there are {} queries: no answers {} to {}", sizeOf(list), first,
                                                  first + answers.size()));
    }
    if (!made_in->is_done)
    {
        throw Error(ErrorCode::Usage, "queries have no answers before Context::frameDone() of their frame");
    }
    if (!answers.empty())
    {
        readAnswers(tree, list, first, readback.at<gpu::Hit>(hits_at, buffers->count).subspan(first, answers.size()),
                    readback.at<gpu::QueryLook>(looks_at, buffers->count).subspan(first, answers.size()), answers);
    }
}

LatticePosition latticePosition(const GridInfo& grid, const DVec3& world)
{
    return latticePosition(checkedGrid(grid), toGlm(world));
}

QueryBatch::QueryBatch(Recorder& recorder, const Tree& tree, const QueryList& queries)
    : m_impl(ask(recorder, tree, queries))
{
}

QueryBatch::QueryBatch(Recorder& recorder, DynamicTree& tree, const QueryList& queries)
    : m_impl(ask(recorder, tree, queries))
{
}

QueryBatch::~QueryBatch() = default;
QueryBatch::QueryBatch(QueryBatch&&) noexcept = default;
QueryBatch& QueryBatch::operator=(QueryBatch&&) noexcept = default;

std::size_t QueryBatch::size() const
{
    return sizeOf(listOf(usable(*this).queries));
}

bool QueryBatch::isDone() const
{
    return usable(*this).made_in->is_done;
}

void QueryBatch::answers(std::size_t first, std::span<QueryAnswer> answers) const
{
    usable(*this).answers(first, answers);
}

} // namespace zvo
