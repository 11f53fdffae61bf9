// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"

#include <array>
#include <cstddef>

namespace zvo::demo
{

/// Keeps a slow device usable: lowers the resolution of traced pictures, rung by rung, while frames take too long, and
/// raises it again when there is time. Its decisions depend only on the times that it is told.
class ResolutionLadder
{
public:
    /// Of the window's edges.
    static constexpr std::array<double, 7> kScales = {1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};
    static constexpr double kTooLongMs = 80;  // of device time in a frame: 10 frames a second, and some to spare
    static constexpr double kShortMs = 50;    // the expected time at the next higher scale must be below this
    static constexpr int kFramesToLower = 2;  // consecutive frames that took too long
    static constexpr int kFramesToRaise = 10; // consecutive frames that left time

    explicit ResolutionLadder(std::size_t rung) : m_rung(rung) {}

    [[nodiscard]] double scale() const { return kScales[m_rung]; }

    /// Tells how long a frame at scale() took on the device. Frames that were recorded at another scale are not told.
    void add(double gpu_ms);

private:
    std::size_t m_rung;
    int m_long_count = 0;
    int m_short_count = 0;
};

/// A window's size at a scale: at least one pixel, where the window has any.
PictureSize scaledSize(PictureSize window, double scale);

} // namespace zvo::demo
