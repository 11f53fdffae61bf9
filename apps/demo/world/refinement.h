// SPDX-License-Identifier: MIT
#pragma once

#include "core/frame/frame_options.h"
#include "core/present/present.h"
#include "core/scene/camera.h"

#include <cstdint>
#include <optional>

namespace zvo::demo
{

/// All that a picture depends on.
struct PictureState
{
    ViewCamera camera;
    FrameOptions options; // without those of its development
    PictureSize window;
    PictureSize size; // in which it is traced while it stands still
    std::uint64_t tree_version = 0;
    double seconds = 0; // of the scene
    std::uint64_t sky_version = 0;
    bool has_sun = true; // of paths and cached light

    bool operator==(const PictureState&) const = default;
};

/// Decides when the picture stands still, so that it is made in the window's full size and with many samples, and when
/// these are enough. Its decisions depend only on what it is told.
class Refinement
{
public:
    static constexpr double kStillSeconds = 0.3; // without input and change
    static constexpr std::uint32_t kPrimarySamples = 16;
    static constexpr std::uint32_t kCacheFrames = 128;
    static constexpr std::uint32_t kPathSamples = 4096;

    /// Tells what a frame shows, whether anything moves, and the seconds since the last frame. Another picture than
    /// before, or a motion, ends the still one.
    void show(const PictureState& state, bool moves, double seconds);

    /// Tells that the user has done something. changes: what is shown must follow at once.
    void noteInput(bool changes);

    /// Whether the picture stands still.
    [[nodiscard]] bool isStill() const { return m_quiet_seconds >= kStillSeconds && !m_is_refused; }

    /// Whether show() of that state would end the still picture.
    [[nodiscard]] bool differs(const PictureState& state) const { return m_state != state; }

    /// Tells that there is no memory for the still picture. The same one is not wanted again.
    void refuse() { m_is_refused = true; }

    /// Samples after which a still picture is done.
    static std::uint32_t samplesOf(const FrameOptions& options);

    /// Samples after which a picture of the full size is no noisier than one with `samples` paths a pixel whose edges
    /// are `scale` as long.
    static std::uint32_t samplesLike(std::uint32_t samples, double scale);

private:
    std::optional<PictureState> m_state;
    double m_quiet_seconds = 0;
    bool m_is_refused = false;
};

} // namespace zvo::demo
