// SPDX-License-Identifier: MIT
// Compares two trees that should look alike, by pictures and by rays.
#pragma once

#include "core/trace/trace.h"
#include "support/pictures.h"
#include "support/trace_octrees.h"
#include "vk/headless.h"

#include <cstdint>
#include <vector>

namespace zvo::test
{

/// Attributes of a tree, which identify voxels whose indices differ in two trees.
struct HitAttributes
{
    HitAttributes(vk::HeadlessDevice& device, const DeviceTree& tree);

    [[nodiscard]] std::uint64_t of(const gpu::Hit& hit) const;

    std::vector<gpu::Attribute> voxels;
    std::vector<gpu::Attribute> nodes;
    std::uint32_t levels;
};

/// Traces both trees in the same way and expects the same results, bit for bit. Hits must have the same attributes,
/// wherever these are stored. Both trees have attributes in 8 bytes, or none. They must outlive this object.
class TreeComparison
{
public:
    TreeComparison(vk::HeadlessDevice& device, const DeviceTree& expected, const DeviceTree& tree);

    /// Compares pictures in every view and with many levels of detail, from many cameras and from close.
    void pictures(const ViewCamera& close);

    /// Compares rays of many kinds; many of them aim at the voxels of codes.
    void rays(const Codes& codes) const;

private:
    // A tree with its tracer's buffers.
    struct Subject
    {
        Subject(vk::HeadlessDevice& device, const DeviceTree& view);

        const DeviceTree& tree;
        HitAttributes attributes;
        NodePaths paths;
    };

    [[nodiscard]] Picture take(const Subject& subject, const TraceCamera& camera, const TraceOptions& options);
    void picture(const ViewCamera& view, const TraceOptions& options);

    vk::HeadlessDevice& m_device;
    Subject m_expected;
    Subject m_subject;
    TraceBuffers m_buffers;
};

} // namespace zvo::test
