// SPDX-License-Identifier: MIT
#include "bench/canvas.h"

#include "bench/bench_runs.h"
#include "core/base/color_word.h"
#include "core/base/morton.h"
#include "core/tree/tree_data.h"
#include "runtime/static_part.h"
#include "zvo/error.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr std::uint32_t kStrokeAttemptsMax = 64;

// Whether a pass moves what edits have.
bool compacts(const std::string& pass)
{
    constexpr std::string_view kParts[] = {"edit/mark",     "edit/live_sums", "edit/voxel_bits",       "octree/scan",
                                           "edit/renumber", "edit/move_",     "update/emission_places"};
    return std::ranges::any_of(kParts, [&](std::string_view part) { return pass.find(part) != std::string::npos; });
}

// Whether a pass belongs to a dab, or shows what it has made; others copy to larger buffers.
bool dabs(const std::string& pass)
{
    return !compacts(pass) && (pass.find("edit/") != std::string::npos || pass == "update/show");
}

double sumIf(const std::vector<vk::PassTime>& passes, bool (*counts)(const std::string&))
{
    double ms = 0;
    for (const vk::PassTime& pass : passes)
    {
        ms += counts(pass.name) ? pass.ms : 0.0;
    }
    return ms;
}

} // namespace

Canvas::Canvas(vk::HeadlessDevice& device, const BenchEditOptions& options, const Scene& scene, const Grid& grid,
               const HistoryBounds& bounds)
    : m_device(device)
{
    StaticListener listener;
    listener.built = [&](const BuildResult& built) { m_codes = voxelCodes(device, built.octree); };
    DeviceTree fixed =
        makeStaticPart(device, scene, grid, {options.coverage, options.attributes, {}}, options.structure, listener)
            .tree;
    if (m_codes.empty())
    {
        throw Error(ErrorCode::Input, "there are no voxels to edit");
    }
    DynamicOptions dynamic;
    dynamic.attributes = options.attributes;
    dynamic.emission_scale = fixed.emission.count() != 0 ? fixed.emission_scale : 0;
    dynamic.edits = bounds;
    m_octree = std::make_unique<DynamicOctree>(device, std::move(fixed), dynamic);
}

double Canvas::stroke(BrushAction action, std::uint32_t radius)
{
    const std::uint64_t code = m_codes[m_random() % m_codes.size()];
    const Brush brush = {BrushShape::Sphere, action, gpu::ivec3(cellOfCode(code)), radius,
                         static_cast<std::uint32_t>(m_random() & kColorMask)};
    bool is_done = false;
    std::vector<vk::PassTime> passes;
    for (std::uint32_t attempt = 0; !is_done; ++attempt)
    {
        if (attempt == kStrokeAttemptsMax)
        {
            throw Error(ErrorCode::Other, "a stroke found no room");
        }
        passes = frame([&](vk::FrameGraph& graph) { is_done = m_octree->edit(graph, brush); });
    }
    m_octree->endStroke();
    return sumIf(passes, dabs);
}

double Canvas::undo()
{
    return sumMs(frame([&](vk::FrameGraph& graph) { m_octree->undoEdit(graph); }));
}

double Canvas::redo()
{
    return sumMs(frame([&](vk::FrameGraph& graph) { m_octree->redoEdit(graph); }));
}

std::vector<vk::PassTime> Canvas::frame(const std::function<void(vk::FrameGraph&)>& record)
{
    const std::uint64_t frame = m_octree->beginFrame();
    std::vector<vk::PassTime> passes = m_device.run(record);
    m_octree->frameDone(frame, passes);
    if (std::ranges::any_of(passes, [](const vk::PassTime& pass) { return pass.name == "edit/move_states"; }))
    {
        ++m_compaction_count;
        m_compaction_ms = sumIf(passes, compacts);
    }
    return passes;
}

} // namespace zvo::cli
