// SPDX-License-Identifier: MIT
// Two trees that have to look alike, by pictures and by rays.
#pragma once

#include "core/trace/trace.h"
#include "support/pictures.h"
#include "support/trace_octrees.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo::test
{

/// The attributes of a tree, by which indices in two trees are compared.
struct HitAttributes
{
    HitAttributes(vk::HeadlessDevice& device, const DeviceTree& tree);

    [[nodiscard]] std::uint64_t of(const gpu::Hit& hit) const;

    std::vector<gpu::Attribute> voxels;
    std::vector<gpu::Attribute> nodes;
    std::uint32_t levels;
};

/// Traces both trees in the same way and expects the same results, bit for bit; of hits, the same attributes, wherever
/// they are stored. Both trees have attributes in 8 bytes or none. What is given must outlive this.
class TreeComparison
{
public:
    TreeComparison(vk::HeadlessDevice& device, const DeviceTree& expected, const DeviceTree& tree);

    /// Pictures by every view and many levels of detail, from everywhere and from close.
    void pictures(const ViewCamera& close);

    /// Rays of many kinds, many of them to the voxels of codes.
    void rays(const Codes& codes) const;

private:
    // A tree, and what pictures of it take.
    struct Subject
    {
        Subject(vk::HeadlessDevice& device, const DeviceTree& view);

        const DeviceTree& tree;
        HitAttributes attributes;
        BeamGrid beam;
    };

    [[nodiscard]] Picture take(const Subject& subject, const TraceCamera& camera, const TraceOptions& options);
    void picture(const ViewCamera& view, const TraceOptions& options);

    vk::HeadlessDevice& m_device;
    Subject m_expected;
    Subject m_subject;
    TraceBuffers m_buffers;
};

} // namespace zvo::test
