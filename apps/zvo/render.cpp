// SPDX-License-Identifier: MIT
#include "render.h"

#include "core/gpu_scene.h"
#include "core/image_io.h"
#include "core/kernels.h"
#include "core/pipeline.h"
#include "core/trace.h"
#include "output.h"
#include "progress.h"
#include "report.h"
#include "session.h"
#include "view.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <numbers>
#include <optional>

namespace zvo::cli
{

namespace
{

/// The pictures' files: one, or one for each frame.
class Pictures
{
public:
    /// Finds out now whether all of them can be written.
    explicit Pictures(const RenderOptions& options) : m_options(options)
    {
        const std::string& path = options.output.path;
        if (path != "-" && extensionOf(path) != ".png")
        {
            throw Error(ErrorCode::Usage, fmt::format("-o {}: pictures are PNG files; name it .png", path));
        }
        if (!options.frames)
        {
            m_first.emplace(path, options.output.overwrite);
            return;
        }
        m_marker = path.find('#');
        m_digits = m_marker == std::string::npos ? 0 : path.find_first_not_of('#', m_marker) - m_marker;
        if (m_digits == 0)
        {
            throw Error(ErrorCode::Usage, fmt::format("-o {}: with --frames, the name needs a place for the frame's "
                                                      "number, such as frame_####.png",
                                                      path));
        }
        for (std::uint32_t i = 0; i < count(); ++i)
        {
            const Output look(pathOf(i), options.output.overwrite);
        }
    }

    [[nodiscard]] std::uint32_t count() const
    {
        return m_options.frames ? m_options.frames->second - m_options.frames->first + 1 : 1;
    }

    void write(std::uint32_t index, std::span<const std::uint8_t> png)
    {
        if (!m_first)
        {
            m_first.emplace(pathOf(index), m_options.output.overwrite);
        }
        m_first->write(std::as_bytes(png));
        m_first->finish();
        m_first.reset();
    }

private:
    [[nodiscard]] std::string pathOf(std::uint32_t index) const
    {
        const std::string& path = m_options.output.path;
        return fmt::format("{}{:0{}}{}", path.substr(0, m_marker), m_options.frames->first + index, m_digits,
                           path.substr(m_marker + m_digits));
    }

    const RenderOptions& m_options;
    std::size_t m_marker = 0; // where the frame's number goes
    std::size_t m_digits = 0;
    std::optional<Output> m_first; // opened already
};

// Times of one picture.
struct PictureTimes
{
    std::vector<vk::PassTime> passes;
    double trace_ms = 0; // beam and primary rays
    double shade_ms = 0; // shadow and occlusion rays, and colour
};

// The time of the passes up to the last primary rays: what comes after them is light and colour.
double primaryMs(const std::vector<vk::PassTime>& passes)
{
    double ms = 0;
    double ms_until_primary = 0;
    for (const vk::PassTime& pass : passes)
    {
        ms += pass.ms;
        if (pass.name == "trace/primary")
        {
            ms_until_primary = ms;
        }
    }
    return ms_until_primary;
}

TraceBuffers makeBuffers(vk::HeadlessDevice& device, const RenderOptions& options)
{
    try
    {
        return {device.device(), options.width, options.height};
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::Memory)
        {
            throw;
        }
        throw Error(ErrorCode::Memory, fmt::format("a picture of {} x {} pixels (--size) is too large: {}, or a "
                                                   "smaller picture",
                                                   options.width, options.height, error.what()));
    }
}

class Renderer
{
public:
    Renderer(vk::HeadlessDevice& device, const Octree& octree, const RenderOptions& options)
        : m_device(device), m_octree(octree), m_beam(device.device()), m_buffers(makeBuffers(device, options))
    {
        m_options.view = options.view;
        m_options.detail_pixels = options.detail_pixels;
        m_options.occlusion_rays = options.occlusion_rays;
        m_options.exposure = options.exposure;
        m_options.to_sun = options.to_sun.value_or(m_options.to_sun);
        m_beam_passes = device.run([&](vk::FrameGraph& graph) { buildBeam(graph, octree, m_beam); });
    }

    [[nodiscard]] const std::vector<vk::PassTime>& beamPasses() const { return m_beam_passes; }
    [[nodiscard]] std::uint64_t cappedRays() const { return m_capped_rays; }

    // The picture as a PNG file.
    std::vector<std::uint8_t> render(const ViewCamera& view, PictureTimes& times)
    {
        const TraceCamera camera = traceCamera(view, m_octree.grid, m_buffers.height);
        times.passes =
            m_device.run([&](vk::FrameGraph& graph) { trace(graph, m_octree, m_beam, camera, m_options, m_buffers); });
        times.trace_ms = primaryMs(times.passes);
        times.shade_ms = sumMs(times.passes) - times.trace_ms;
        m_capped_rays += m_device.download(m_buffers.status).front().capped_rays;
        const std::vector<gpu::uint> image = m_device.download(m_buffers.image);
        const auto* const bytes = reinterpret_cast<const std::uint8_t*>(image.data());
        return encodePng(m_buffers.width, m_buffers.height, {bytes, image.size() * sizeof(gpu::uint)});
    }

private:
    vk::HeadlessDevice& m_device;
    const Octree& m_octree;
    TraceOptions m_options;
    BeamGrid m_beam;
    TraceBuffers m_buffers;
    std::vector<vk::PassTime> m_beam_passes;
    std::uint64_t m_capped_rays = 0;
};

// Adds what tracing has to report: the first picture's passes, and mean times of all pictures.
void addTrace(Json& json, const RenderOptions& options, const Renderer& renderer,
              const std::vector<PictureTimes>& times)
{
    double trace_ms = 0;
    double shade_ms = 0;
    for (const PictureTimes& picture : times)
    {
        trace_ms += picture.trace_ms / static_cast<double>(times.size());
        shade_ms += picture.shade_ms / static_cast<double>(times.size());
    }
    for (const std::vector<vk::PassTime>* passes : {&renderer.beamPasses(), &times.front().passes})
    {
        const Json more = passesJson(*passes);
        json["passes"].insert(json["passes"].end(), more.begin(), more.end());
    }
    json["trace_ms"] = trace_ms;
    json["shade_ms"] = shade_ms;
    json["beam_grid_ms"] = sumMs(renderer.beamPasses());
    json["capped_rays"] = renderer.cappedRays();
    json["picture"] = {{"width", options.width}, {"height", options.height}, {"count", times.size()}};
}

// Beside the octree the picture has buffers of its own, which a lower resolution does not make smaller.
} // namespace

void render(const RenderOptions& options)
{
    checkPlaces(options.output, options.voxels.scenes);
    Pictures pictures(options);
    std::optional<Output> report;
    if (!options.output.json.empty())
    {
        report.emplace(options.output.json, options.output.overwrite);
    }

    Progress progress(3 + pictures.count());
    progress.step("loading");
    Scene scene = loadWithWarnings(options.voxels.scenes, options.voxels.load);
    const std::uint64_t triangle_count = scene.triangleCount();
    const Grid grid = placeGrid(options.voxels, scene.bounds());
    const Bounds subject = subjectOf(scene, grid);
    const ViewCamera camera =
        chooseCamera(options.camera, scene, subject, static_cast<double>(options.width) / options.height);

    progress.step("copying to the device");
    vk::HeadlessDevice device(headlessOptions(options.device), zvoKernels());
    std::optional<GpuScene> gpu_scene = uploadScene(device, scene, options.voxels.attributes);
    scene = {};

    progress.step("voxelizing");
    const BuildResult result =
        buildOctree(device, *gpu_scene, grid, {options.voxels.coverage, options.voxels.attributes, {}});
    warnOfDropped(result);
    gpu_scene.reset();

    Renderer renderer(device, result.octree, options);
    const glm::dvec3 centre = 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max));
    std::vector<PictureTimes> times(pictures.count());
    for (std::uint32_t i = 0; i < pictures.count(); ++i)
    {
        progress.step("tracing");
        const std::uint32_t number = options.frames ? options.frames->first + i : 0;
        const double turn = 2.0 * std::numbers::pi * number / pictures.count();
        const std::vector<std::uint8_t> png = renderer.render(camera.turnedAround(centre, turn), times[i]);
        checkValidation(device);
        pictures.write(i, png);
    }
    if (report)
    {
        Json json = octreeJson("zvo.render/1", device.device().report(), options.voxels, triangle_count, result,
                               octreeSha256(device, result.octree), device.device().memory().peakBytes());
        addTrace(json, options, renderer, times);
        report->write(jsonText(json));
        report->finish();
    }
    if (renderer.cappedRays() != 0)
    {
        talk(fmt::format("warning: {} rays took too many steps and were given up", renderer.cappedRays()));
    }
    talk(fmt::format("{} voxels of {}^3 from {} triangles; voxelize {:.1f} ms, build {:.1f} ms, trace {:.1f} ms, light "
                     "and shade {:.1f} ms on {}",
                     result.octree.voxel_count, grid.resolution(), triangle_count, result.stageMs("voxelize"),
                     result.stageMs("octree"), times.front().trace_ms, times.front().shade_ms,
                     device.device().report().name));
}

} // namespace zvo::cli
