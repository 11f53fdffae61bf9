// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"
#include "core/dynamic/dynamic_octree.h"
#include "vk/headless.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <random>
#include <vector>

namespace zvo::cli
{

/// A tree under a brush. Its functions wait for the device and return GPU milliseconds.
class Canvas
{
public:
    /// Builds the tree. Throws Error{Input} if it has no voxels.
    Canvas(vk::HeadlessDevice& device, const BenchEditOptions& options, const Scene& scene, const Grid& grid,
           const HistoryBounds& bounds);

    /// A stroke of one dab at a random voxel of the scene.
    double stroke(BrushAction action, std::uint32_t radius);
    double undo();
    double redo();

    [[nodiscard]] const Edits& edits() const { return m_octree->edits(); }
    [[nodiscard]] std::uint64_t voxelCount() const { return m_codes.size(); }
    [[nodiscard]] std::uint32_t compactionCount() const { return m_compaction_count; }
    [[nodiscard]] double compactionMs() const { return m_compaction_ms; } // of the last one

private:
    std::vector<vk::PassTime> frame(const std::function<void(vk::FrameGraph&)>& record);

    vk::HeadlessDevice& m_device;
    std::vector<std::uint64_t> m_codes;
    std::unique_ptr<DynamicOctree> m_octree;
    std::mt19937 m_random{1};
    std::uint32_t m_compaction_count = 0;
    double m_compaction_ms = 0;
};

} // namespace zvo::cli
