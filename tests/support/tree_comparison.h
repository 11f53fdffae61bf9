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

/// Traces both trees in the same way and expects the same results, bit for bit. Hits must have the same attributes,
/// wherever these are stored. Both trees have attributes in 8 bytes, or none. They must outlive this object.
class TreeComparison
{
public:
    /// size: of pictures. rank_table: rays in a DAG begin at node paths with ranks; otherwise at those without.
    TreeComparison(vk::HeadlessDevice& device, const DeviceTree& expected, const DeviceTree& tree,
                   const glm::uvec2& size = {53, 41}, bool rank_table = true);

    /// Compares pictures in every view and with many levels of detail, from many cameras and from close.
    void pictures(const ViewCamera& close);

    /// Compares a picture, and returns how many of its pixels show a hit.
    std::uint32_t picture(const ViewCamera& view, const TraceOptions& options = {});

    /// Compares pictures in every view with occlusion. Expects hits if must_hit.
    void views(const ViewCamera& view, bool must_hit = false);

    /// Compares pictures of every n-th of manyCameras(), with and without beam.
    void cameras(std::size_t n, TraceOptions options = {});

    /// Compares pictures with levels of detail. Expects hits if must_hit.
    void detail(const ViewCamera& view, bool must_hit = false);

    /// Compares rays of many kinds, also with levels of detail; many of them aim at the voxels of codes.
    void rays(const Codes& codes, TraceOptions options = {}, std::uint32_t count = 1001) const;

private:
    // A tree with what its comparison takes.
    struct Subject
    {
        Subject(vk::HeadlessDevice& device, const DeviceTree& view, bool rank_table);

        [[nodiscard]] std::uint64_t attributeOf(const gpu::Hit& hit) const;

        const DeviceTree& tree;
        std::vector<gpu::Attribute> voxels; // they identify voxels whose indices differ
        std::vector<gpu::Attribute> nodes;
        NodePaths paths;
    };

    [[nodiscard]] Picture take(const Subject& subject, const TraceCamera& camera, const TraceOptions& options);
    void expectSameHits(const std::vector<gpu::Hit>& expected, const std::vector<gpu::Hit>& hits,
                        bool with_attributes) const;

    vk::HeadlessDevice& m_device;
    Subject m_expected;
    Subject m_subject;
    TraceBuffers m_buffers;
};

} // namespace zvo::test
