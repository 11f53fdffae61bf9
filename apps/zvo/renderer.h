// SPDX-License-Identifier: MIT
#pragma once

#include "commands.h"
#include "common/progress.h"
#include "common/signals.h"
#include "core/frame/frame_renderer.h"
#include "picture.h"
#include "sheet.h"
#include "vk/headless.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace zvo::cli
{

/// The times of one picture.
struct PictureTimes
{
    std::vector<vk::PassTime> passes;
    double trace_ms = 0;           // beam and primary rays
    double shade_ms = 0;           // shadow and occlusion rays, and colour
    std::uint32_t samples = 0;     // a pixel; 0: the picture has none, otherwise all is in trace_ms
    std::optional<float> exposure; // of samples; nothing where the picture holds radiance as it is
    std::optional<float> focus;    // where the camera has a lens: the distance that is sharp

    /// Adds those of a part of the picture.
    void add(PictureTimes&& part);
};

/// Renders pictures of one size, of one or several octrees or DAGs, and waits for each. The buffers are made for the
/// first picture, so that memory that only pictures need cannot keep a tree from being made.
class Renderer
{
public:
    /// Reads the environment map, if one was asked for. Throws Error{Input}, Error{Memory}.
    Renderer(vk::HeadlessDevice& device, const RenderOptions& options);

    /// Sets the tree that is shown from now on; it must outlive that. Call it again whenever the tree has changed.
    /// Returns the passes that were needed. Throws Error{Memory} for a picture that is too large.
    std::vector<vk::PassTime> show(const DeviceTree& tree);

    /// The picture of a view, or the sheet of several: pixels, or of samples what the output's name tells. Of samples,
    /// stops early at the time limit, or when the user interrupts; then the picture shows those so far.
    Picture render(std::span<const ViewCamera> views, Progress& progress, PictureTimes& times);

    /// Whether the user has interrupted a picture: then no other one should begin.
    [[nodiscard]] bool interrupted() const { return m_watch && m_watch->interrupted(); }

    /// The number of rays of all pictures that were given up.
    [[nodiscard]] std::uint64_t cappedRays() const { return m_capped_rays; }

    /// The radiance cache; null for other integrators.
    [[nodiscard]] const DeviceRadianceCache* cache()
    {
        return usesCache(m_frame.integrator) ? &m_renderer.cache() : nullptr;
    }

private:
    using Clock = std::chrono::steady_clock;

    void setSize();
    [[nodiscard]] FrameSubject subject();
    Picture renderView(const ViewCamera& view, Progress& progress, PictureTimes& times);
    Picture renderAtOnce(PictureTimes& times);
    std::optional<Picture> renderSamplesOrWarn(Progress& progress, PictureTimes& times);
    Picture renderSamples(Progress& progress, PictureTimes& times);
    void warnOfDarkness();
    void focus(PictureTimes& times);
    void settle(Progress& progress, PictureTimes& times);
    void addSamples(Clock::time_point begin, Progress& progress, PictureTimes& times);
    Picture downloadPicture();
    Picture downloadSamples(PictureTimes& times);
    [[nodiscard]] std::vector<std::uint8_t> encodeWithAovs(const HdrImage& image);

    vk::HeadlessDevice& m_device;
    const RenderOptions& m_options;
    SheetLayout m_layout;
    FrameOptions m_frame;
    FrameRenderer m_renderer;
    std::optional<DeviceEnvironment> m_environment; // nothing for Integrator::Primary
    std::optional<InterruptWatch> m_watch;          // from the first picture with samples on
    const DeviceTree* m_tree = nullptr;             // the tree that is shown
    std::optional<TraceCamera> m_camera;            // of the last picture
    std::optional<TraceCamera> m_camera_before;     // of the one before
    std::uint32_t m_settled_views = 0;
    std::uint64_t m_capped_rays = 0;
};

} // namespace zvo::cli
