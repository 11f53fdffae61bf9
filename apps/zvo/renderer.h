// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "core/trace/tree_tracer.h"
#include "core/tree/device_tree.h"
#include "light_renderer.h"
#include "options.h"
#include "vk/headless.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace zvo::cli
{

/// The times of one picture.
struct PictureTimes
{
    std::vector<vk::PassTime> passes;
    double trace_ms = 0;           // beam and primary rays
    double shade_ms = 0;           // shadow and occlusion rays, and colour
    std::uint32_t samples = 0;     // a pixel; 0: by primary rays, otherwise all is in trace_ms
    std::optional<float> exposure; // of paths; nothing where the picture holds radiance as it is
};

/// Renders pictures of one size, of one or several octrees or DAGs. The buffers are made for the first picture, so that
/// memory that only pictures need cannot keep a tree from being made.
class Renderer
{
public:
    Renderer(vk::HeadlessDevice& device, const RenderOptions& options);

    /// Sets the tree that is shown from now on; it must outlive that. Call it again whenever the tree has changed.
    /// Returns the passes that were needed. Throws Error{Memory} for a picture that is too large.
    std::vector<vk::PassTime> show(const DeviceTree& tree);

    /// The picture as a file: a PNG, or of paths what the output's name tells.
    std::vector<std::uint8_t> render(const ViewCamera& view, Progress& progress, PictureTimes& times);

    /// Whether the user has interrupted a picture: then no other one should begin.
    [[nodiscard]] bool interrupted() const { return m_light && m_light->interrupted(); }

    /// The number of rays of all pictures that were given up.
    [[nodiscard]] std::uint64_t cappedRays() const { return m_capped_rays; }

    /// What is kept on voxels; null for other integrators.
    [[nodiscard]] const RadianceCache* kept() const { return m_light ? m_light->kept() : nullptr; }

private:
    std::optional<std::vector<std::uint8_t>> renderLight(const ViewCamera& view, Progress& progress,
                                                         PictureTimes& times);

    vk::HeadlessDevice& m_device;
    const RenderOptions& m_options;
    TraceOptions m_trace;
    TreeTracer m_tracer;
    std::optional<LightRenderer> m_light; // where pictures have samples
    const DeviceTree* m_tree = nullptr;   // the tree that is shown
    std::uint64_t m_capped_rays = 0;
};

} // namespace zvo::cli
