// SPDX-License-Identifier: MIT
#pragma once

#include "api/context_impl.h"
#include "core/query/query_list.h"
#include "vk/readback.h"
#include "zvo/query.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace zvo
{

/// A QueryList that owns its questions.
using KeptQueries = std::variant<std::vector<PointQuery>, std::vector<RayQuery>, std::vector<BoxQuery>,
                                 std::vector<NearestQuery>, std::vector<SweepQuery>>;

struct ZVO_LOCAL QueryBatch::Impl
{
    static constexpr const char* kName = "query batch"; // in messages

    Impl(Recorder::Impl& recorder, const DeviceTree& asked, const QueryList& list);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void answers(std::size_t first, std::span<QueryAnswer> answers) const;

    Context::Impl& context;
    QueriedTree tree;
    KeptQueries queries;
    std::shared_ptr<FrameState> made_in;
    std::optional<QueryBuffers> buffers = std::nullopt; // none without questions
    vk::Readback readback = {};                         // hits, then looks
    std::uint64_t hits_at = 0;
    std::uint64_t looks_at = 0;

private:
    void keepBuffers();
};

} // namespace zvo
