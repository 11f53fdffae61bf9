// SPDX-License-Identifier: MIT
#pragma once

#include "common/progress.h"
#include "common/signals.h"
#include "core/denoise/denoiser.h"
#include "core/path/path_tracer.h"
#include "core/radiance/radiance_tracer.h"
#include "options.h"
#include "vk/headless.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace zvo::cli
{

/// Makes pictures of one size whose light comes from an environment and from voxels: by path tracing, or from what is
/// kept on the voxels.
class LightRenderer
{
public:
    /// Reads the environment map, if one was asked for. Throws Error{Input}, Error{Memory}.
    LightRenderer(vk::HeadlessDevice& device, const RenderOptions& options);

    /// The picture of a tree as a file of the kind that the output's name tells. passes receives those of all samples.
    /// Stops early at the time limit, or when the user interrupts; then the picture shows the samples so far.
    std::vector<std::uint8_t> render(const DeviceTree& tree, const ViewCamera& view, Progress& progress,
                                     std::vector<vk::PassTime>& passes);

    /// Whether the user has interrupted a picture: then no other one should begin.
    [[nodiscard]] bool interrupted() const { return m_watch && m_watch->interrupted(); }

    /// The number of rays of the last picture, or of all whose light is kept, that were given up.
    [[nodiscard]] std::uint64_t cappedRays();

    /// Samples a pixel of the last picture, or its frames.
    [[nodiscard]] std::uint32_t sampleCount() const { return picture().sample_count; }

    /// The exposure of the last picture; nothing where it holds radiance as it is.
    [[nodiscard]] std::optional<float> exposure() const { return m_exposure; }

    /// What is kept on voxels; null for paths.
    [[nodiscard]] const RadianceCache* kept() const { return m_kept ? &m_kept->cache() : nullptr; }

private:
    void setSize();
    [[nodiscard]] SampledPicture picture() const { return m_kept ? m_kept->picture() : m_tracer.picture(); }
    [[nodiscard]] RadianceOptions keptOptions() const;
    void addSample(vk::FrameGraph& graph, const DeviceTree& tree);
    void settle(const DeviceTree& tree, Progress& progress, std::vector<vk::PassTime>& passes);
    SampledPicture denoise(std::vector<vk::PassTime>& passes);
    std::vector<std::uint8_t> encode(const SampledPicture& picture, const Grid& grid);
    [[nodiscard]] std::vector<std::uint8_t> encodeWithAovs(const HdrImage& image, const Grid& grid);

    vk::HeadlessDevice& m_device;
    const RenderOptions& m_options;
    PathTracer m_tracer;
    std::optional<RadianceTracer> m_kept; // where light is kept on voxels; then m_tracer is not used
    std::optional<Denoiser> m_denoiser;   // where pictures are denoised
    DeviceEnvironment m_environment;
    std::optional<InterruptWatch> m_watch;      // from the first picture on
    std::optional<float> m_exposure;            // of the last picture
    std::optional<TraceCamera> m_camera;        // of the last picture
    std::optional<TraceCamera> m_camera_before; // of the one before
};

} // namespace zvo::cli
