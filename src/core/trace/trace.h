// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "core/tree/device_tree.h"
#include "trace/trace.h"
#include "vk/frame_graph.h"
#include "zvo/tracer.h"
#include "zvo/types.h"

#include <cstdint>

namespace zvo
{

/// Where a ray keeps the nodes above the current one. The hits are the same. Private is for CPUs: rays on devices of
/// other types keep their nodes in registers in its place.
enum class TraceStack : std::uint32_t
{
    Registers = gpu::kStackRegisters,
    Private = gpu::kStackPrivate,
    Shared = gpu::kStackShared,
};

/// How a picture stores its pixels, alpha 1 always. All but Half hold sRGB codes, tone-mapped where the picture is lit.
enum class TexelFormat : std::uint32_t
{
    Rgba8 = gpu::kTexelRgba8, ///< one word: red | green << 8 | blue << 16 | alpha << 24
    Bgra8 = gpu::kTexelBgra8, ///< one word: blue | green << 8 | red << 16 | alpha << 24
    Rgb10 = gpu::kTexelRgb10, ///< one word: red | green << 10 | blue << 20 | alpha << 30
    /// Two words of half floats, red first. View::Color: exposure times radiance, linear, neither tone-mapped nor
    /// dithered, at most 65504. Other views: the linear values of the codes that they show.
    Half = gpu::kTexelHalf,
};

constexpr std::uint32_t texelWords(TexelFormat format)
{
    return format == TexelFormat::Half ? 2 : 1;
}

/// The most rays that TraceOptions::occlusion_rays asks for.
inline constexpr std::uint32_t kOcclusionRaysMax = 64;

/// What a host can choose is what TraceInfo says (zvo/tracer.h), with the same defaults.
struct TraceOptions
{
    View view = TraceInfo().view;
    TraceStack stack = TraceStack::Registers;
    bool beam = true; // skip what the beam grid shows to be empty; the picture is the same
    bool shadows = TraceInfo().shadows;
    glm::dvec3 to_sun = {TraceInfo().to_sun[0], TraceInfo().to_sun[1], TraceInfo().to_sun[2]};
    float sun = TraceInfo().sun;
    float exposure = TraceInfo().exposure;
    std::uint32_t occlusion_rays = TraceInfo().occlusion_rays;
    float occlusion_reach = TraceInfo().occlusion_reach;
    float detail_pixels = TraceInfo().detail_pixels;
    std::uint32_t detail_level = UINT32_MAX; // stop at this level of nodes
    std::uint32_t iterations_max =
        gpu::kTraceIterationsMax; // iterations of an invocation: fewer only to test what comes then

    [[nodiscard]] bool hasDetail() const { return detail_pixels > 0.0F || detail_level != UINT32_MAX; }
};

/// A coarse octree over a dilated octree (trace/trace.h), by which the beam pass finds out what rays can skip.
struct BeamGrid
{
    /// for_dag: with the table that makes the ranks of hits in a DAG cheaper. Without, they are the same.
    explicit BeamGrid(vk::Device& device, bool for_dag = false);

    vk::BufferOf<uint64_t> occupied; // [kBeamRows]
    vk::BufferOf<uint64_t> rows;     // [kBeamRows]
    vk::BufferOf<uint64_t> masks;    // [kBeamMasks]
    vk::BufferOf<gpu::Node> nodes;   // [kBeamNodes]
    vk::BufferOf<uint64_t> paths;    // [kPathCells^3], or [kRankTableOverlays + 1]
};

/// What the passes for a picture of width x height pixels write. Pixels are stored row by row from the top left.
struct TraceBuffers
{
    TraceBuffers(vk::Device& device, std::uint32_t width, std::uint32_t height,
                 TexelFormat texels = TexelFormat::Rgba8);

    /// Of all buffers together.
    [[nodiscard]] std::uint64_t bytes() const;

    std::uint32_t width;
    std::uint32_t height;
    TexelFormat texels;
    vk::BufferOf<float> starts;             // [tiles] of kTileEdge^2 pixels, row by row: kTileDead where nothing is hit
    vk::BufferOf<gpu::uvec2> live;          // [tiles] the others, in any order, then kNoTile
    vk::BufferOf<gpu::DispatchArgs> args;   // [1] one workgroup for each of them
    vk::BufferOf<gpu::DispatchArgs> rounds; // [kTraceRoundsMax] the same for later rounds
    vk::BufferOf<gpu::TraceStatus> status;  // [1]
    vk::BufferOf<gpu::Hit> hits;            // [width * height]; undefined in dead tiles
    vk::BufferOf<gpu::uint> light;          // [width * height]; undefined in dead tiles. View::Iterations: those
    vk::BufferOf<gpu::uint> image;          // [width * height * texelWords(texels)]
};

/// Records the passes that make the beam grid of tree: once for each tree, and again whenever a DynamicOctree shows
/// another one. Cost: constant, and the cells that the tree touches in the beam grid.
void buildBeam(vk::FrameGraph& graph, const DeviceTree& tree, BeamGrid& beam);

/// Records the passes that find what each pixel's ray hits first: fills buffers.starts, live, args, status, hits (and
/// light with iteration counts for View::Iterations). Of a DAG, Hit::index is undefined where options show no
/// attributes or there are none. beam: buildBeam()'s of this tree, or anything without TraceOptions::beam. Cost: pixels
/// of tiles that are near something.
void tracePrimary(vk::FrameGraph& graph, const DeviceTree& tree, const BeamGrid& beam, const TraceCamera& camera,
                  const TraceOptions& options, TraceBuffers& buffers);

/// Records the passes that options ask for to find how much light of sun and sky arrives at hits: fills buffers.light.
void traceLight(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
                TraceBuffers& buffers);

/// Records the passes that make buffers.image from hits and, as far as options ask for it, light.
void shade(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
           TraceBuffers& buffers);

/// Records the pass that tells what the ray of a pixel met, after trace() of the same tree with the same camera,
/// options and buffers. Without attributes, and where options show none, report.look is 0; of a DAG report.index is
/// undefined then. report has one element. Cost: one ray.
void inspectPixel(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
                  const TraceBuffers& buffers, glm::uvec2 pixel, vk::BufferOf<gpu::PixelReport>& report);

/// Records all passes from a camera to a picture.
void trace(vk::FrameGraph& graph, const DeviceTree& tree, const BeamGrid& beam, const TraceCamera& camera,
           const TraceOptions& options, TraceBuffers& buffers);

/// Records the pass that traces a list of rays in tree's unit space: hits[i] is what rays[i] hits first. hits has
/// room for as many. Of a DAG without attributes, Hit::index only tells hits from misses. Rays with components that are
/// NaN, infinite or (inverse directions) too small to be normal hit nothing. rounds has kTraceRoundsMax elements, for
/// rays that need more than one round. Adds to status[0].capped_rays.
void traceRays(vk::FrameGraph& graph, const DeviceTree& tree, const vk::BufferOf<gpu::Ray>& rays,
               vk::BufferOf<gpu::Hit>& hits, vk::BufferOf<gpu::DispatchArgs>& rounds,
               vk::BufferOf<gpu::TraceStatus>& status, const TraceOptions& options);

/// Rays of a picture that tracePrimary has to answer: what Mrays/s counts.
inline std::uint64_t primaryRayCount(const TraceBuffers& buffers)
{
    return std::uint64_t{buffers.width} * buffers.height;
}

} // namespace zvo
