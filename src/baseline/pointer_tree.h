// SPDX-License-Identifier: MIT
// The octree that the thesis builds, and that Crassin and Green build.
#pragma once

#include "baseline/pointer_octree.h"
#include "core/base/grid.h"
#include "core/scene/camera.h"
#include "shared/octree.h"
#include "shared/trace.h"
#include "vk/frame_graph.h"
#include "vk/headless.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace zvo::baseline
{

/// An octree by pointers in device memory: nodes of 12 bytes, whose eight children are always allocated
/// (shaders/baseline/pointer_octree.h). Voxels are nodes of the lowest level.
struct PointerOctree
{
    Grid grid;
    vk::BufferOf<gpu::PointerNode> nodes; // with room behind those in use
    std::uint32_t node_count = 0;         // in use, voxels among them
    std::uint32_t root = 0;               // where rays begin

    std::uint32_t static_count = 0; // nodes before those of a dynamic update

    /// Bytes of the nodes in use.
    [[nodiscard]] std::uint64_t bytes() const { return std::uint64_t{node_count} * sizeof(gpu::PointerNode); }
};

/// A voxel of a PointerOctree.
struct PointerVoxel
{
    std::uint64_t code = 0; // Morton code
    gpu::Attribute look;    // the alpha of its colour is 255
};

/// The voxels below the root, by ascending code. Waits. Cost: nodes, on the host.
std::vector<PointerVoxel> listVoxels(vk::HeadlessDevice& device, const PointerOctree& octree);

/// The Morton codes of the same voxels.
std::vector<std::uint64_t> listCodes(vk::HeadlessDevice& device, const PointerOctree& octree);

/// Throws Error{Usage} if grid is deeper than depth_max, which what can do.
void requireDepth(const Grid& grid, std::uint32_t depth_max, std::string_view what);

/// What the rays of a picture hit, pixel by pixel from the top left.
struct PointerPicture
{
    PointerPicture(vk::Device& device, std::uint32_t picture_width, std::uint32_t picture_height);

    std::uint32_t width;
    std::uint32_t height;
    vk::BufferOf<gpu::Hit> hits;           // [width * height]
    vk::BufferOf<gpu::TraceStatus> status; // [1]
};

/// Records the pass that traces the ray of each pixel (baseline/thesis_trace): depth first with children in their order
/// along the ray, on an explicit stack, as the thesis does. Time, cell, level and face of the hits are those of
/// zvo::tracePrimary(), bit for bit; Hit::index is the number of the voxel's node. The depth must be at most
/// gpu::kPointerDepthMax. Rays that use up their iterations hit nothing and are counted in status. Cost: pixels times
/// the nodes that their rays visit; without zvo's beam pass.
void tracePicture(vk::FrameGraph& graph, const PointerOctree& octree, const TraceCamera& camera,
                  PointerPicture& picture);

} // namespace zvo::baseline
