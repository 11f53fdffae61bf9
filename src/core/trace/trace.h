// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "core/scene/sky.h"
#include "core/tree/device_tree.h"
#include "shared/sky.h"
#include "trace/light.h"
#include "trace/trace.h"
#include "vk/frame_graph.h"
#include "zvo/tracer.h"
#include "zvo/types.h"

#include <cstdint>

namespace zvo
{

/// How a picture stores its pixels; alpha is always 1. All formats but Half hold sRGB codes, tone-mapped in lit
/// pictures.
enum class TexelFormat : std::uint32_t
{
    Rgba8 = gpu::kTexelRgba8, ///< one word: red | green << 8 | blue << 16 | alpha << 24
    Bgra8 = gpu::kTexelBgra8, ///< one word: blue | green << 8 | red << 16 | alpha << 24
    Rgb10 = gpu::kTexelRgb10, ///< one word: red | green << 10 | blue << 20 | alpha << 30
    /// Two words of half floats, red first. View::Color: linear radiance times exposure, at most 65504, neither
    /// tone-mapped nor dithered. Other views: the linear values of the sRGB codes that the other formats would hold.
    Half = gpu::kTexelHalf,
};

constexpr std::uint32_t texelWords(TexelFormat format)
{
    return format == TexelFormat::Half ? 2 : 1;
}

/// The most rays that TraceOptions::occlusion_rays asks for.
inline constexpr std::uint32_t kOcclusionRaysMax = 64;

/// Options of a trace. Those that a host can choose have the names and defaults of TraceInfo (zvo/tracer.h).
struct TraceOptions
{
    View view = TraceInfo().view;
    Shading shading = TraceInfo().shading; // View::Color
    bool beam = true; // begin at what a tile's rays may hit, and below the root; the picture is the same
    bool shadows = TraceInfo().shadows;
    glm::dvec3 to_sun = {TraceInfo().to_sun[0], TraceInfo().to_sun[1], TraceInfo().to_sun[2]};
    glm::dvec3 up = kUp; // length 1
    float sun = TraceInfo().sun;
    float exposure = TraceInfo().exposure;
    std::uint32_t occlusion_rays = TraceInfo().occlusion_rays;
    float occlusion_reach = TraceInfo().occlusion_reach;
    float occlusion_turn = 0; // radians about the normal by which the pattern of these rays is turned
    float detail_pixels = TraceInfo().detail_pixels;
    std::uint32_t detail_level = UINT32_MAX; // stop at this level of nodes
    /// Of an invocation. Fewer only for tests: of later rounds, and of beams that end sooner.
    std::uint32_t iterations_max = gpu::kTraceIterationsMax;

    bool operator==(const TraceOptions&) const = default;

    [[nodiscard]] bool hasDetail() const { return detail_pixels > 0.0F || detail_level != UINT32_MAX; }
};

/// The nodes around each of 64^3 cells, where rays may begin (shaders/trace/node_paths.h).
struct NodePaths
{
    /// for_dag: makes room for a table that makes the ranks of hits in a DAG cheaper. The hits are the same.
    explicit NodePaths(vk::Device& device, bool for_dag = false);

    vk::BufferOf<uint64_t> cells; // [kPathCells^3], or [kRankTableOverlays + 1]
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
    vk::BufferOf<float> starts; // [tiles] where the rays of a tile start; kTileDead: the tile is dead, nothing is hit
    vk::BufferOf<gpu::uvec2> live;          // [tiles] the live tiles in any order, then kNoTile
    vk::BufferOf<gpu::DispatchArgs> args;   // [1] one workgroup for each live tile
    vk::BufferOf<gpu::DispatchArgs> rounds; // [kTraceRoundsMax] likewise, for later rounds
    vk::BufferOf<gpu::TraceStatus> status;  // [1]
    vk::BufferOf<gpu::Sky> sky;             // [1]
    vk::BufferOf<gpu::Hit> hits;            // [width * height]; undefined in dead tiles
    vk::BufferOf<gpu::uint> light; // [width * height]; undefined in dead tiles. for View::Iterations, their counts
    vk::BufferOf<gpu::uint> image; // [width * height * texelWords(texels)]
};

/// Records the passes that fill paths for tree. Needed once for each DeviceTree::version. Cost: constant.
void buildNodePaths(vk::FrameGraph& graph, const DeviceTree& tree, NodePaths& paths);

/// Records the passes that find what the ray of each pixel hits first: they fill buffers.starts, live, args, status and
/// hits, and for View::Iterations also light. paths: made by buildNodePaths() for this version of tree; anything if
/// TraceOptions::beam is false. In a DAG, Hit::index is undefined where options show no attributes or the tree has
/// none. Cost: pixels of the tiles that are near something.
void tracePrimary(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
                  const TraceOptions& options, TraceBuffers& buffers);

/// Records the passes that find how much light of sun and sky, as options ask for it, arrives at hits: they fill
/// buffers.light.
void traceLight(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
                const TraceOptions& options, TraceBuffers& buffers);

/// Where a picture goes, [width * height * texelWords(format)].
struct TexelTarget
{
    vk::BufferOf<gpu::uint>& texels;
    TexelFormat format;
};

/// Records what makes a picture of hits, of the sky and, where options ask for it, light.
void shade(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera, const TraceOptions& options,
           TraceBuffers& buffers, const TexelTarget& target);

/// Records the pass that reports what the rays of single pixels meet. To be recorded after trace() of the same tree
/// with the same camera, options and buffers. pixels: [count], at least one, row by row. reports: [count]. Where the
/// tree has no attributes or options show none, PixelReport::look is 0 and, in a DAG, PixelReport::index is undefined.
/// Cost: a ray a pixel.
void inspectPixels(vk::FrameGraph& graph, const DeviceTree& tree, const TraceCamera& camera,
                   const TraceOptions& options, const TraceBuffers& buffers, const vk::BufferOf<gpu::uint>& pixels,
                   vk::BufferOf<gpu::PixelReport>& reports);

/// Records all passes from a camera to buffers.image: tracePrimary(), traceLight() where needed, shade().
void trace(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
           const TraceOptions& options, TraceBuffers& buffers);

/// Records the same passes, but for a picture that goes elsewhere.
void traceTo(vk::FrameGraph& graph, const DeviceTree& tree, const NodePaths& paths, const TraceCamera& camera,
             const TraceOptions& options, TraceBuffers& buffers, const TexelTarget& target);

/// How many elements of a list of rays count, where only the device knows: a word, and the workgroups for it.
struct RayListLength
{
    const vk::BufferOf<gpu::DispatchArgs>& buffer;
    std::uint64_t args = 0; // element with the workgroups, of kRaysGroup threads each
    std::uint64_t word = 0; // of the buffer, with the number of rays
};

/// Records the passes that trace a list of rays in the unit space of tree: hits[i] is what rays[i] hits first. hits
/// must have as many elements as rays, rounds kTraceRoundsMax. A ray with a component that is NaN or infinite, or with
/// an inverse direction too small to be a normal number, hits nothing. In a DAG without attributes, Hit::index only
/// tells hits from misses. Rays without an answer are added to status[0].capped_rays. length: null if all elements of
/// rays count.
void traceRays(vk::FrameGraph& graph, const DeviceTree& tree, const vk::BufferOf<gpu::Ray>& rays,
               vk::BufferOf<gpu::Hit>& hits, vk::BufferOf<gpu::DispatchArgs>& rounds,
               vk::BufferOf<gpu::TraceStatus>& status, const TraceOptions& options,
               const RayListLength* length = nullptr);

/// The number of rays that tracePrimary() has to answer; Mrays/s are counted by it.
inline std::uint64_t primaryRayCount(const TraceBuffers& buffers)
{
    return std::uint64_t{buffers.width} * buffers.height;
}

} // namespace zvo
