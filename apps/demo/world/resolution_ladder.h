// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"

#include <array>
#include <cstddef>

namespace zvo::demo
{

/// Keeps a slow device usable: lowers the resolution at which pictures are traced, step by step, where a frame takes
/// too long, and raises it again where there is time. What it decides depends on the times that it is told alone.
class ResolutionLadder
{
public:
    /// Of the window's edges.
    static constexpr std::array<double, 7> kScales = {1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};
    static constexpr double kTooLongMs = 80;  // of device time in a frame: 10 frames a second, and some to spare
    static constexpr double kShortMs = 50;    // that the next higher step may be expected to take
    static constexpr int kFramesToLower = 2;  // that took too long, one after the other
    static constexpr int kFramesToRaise = 10; // that left time

    explicit ResolutionLadder(std::size_t step) : m_step(step) {}

    [[nodiscard]] double scale() const { return kScales[m_step]; }

    /// A frame at scale() took so long on the device. Frames that were on their way at another scale are not told.
    void add(double gpu_ms);

private:
    std::size_t m_step;
    int m_long_count = 0;
    int m_short_count = 0;
};

/// A window's size at a scale: at least one pixel, where the window has any.
PictureSize scaledSize(PictureSize window, double scale);

} // namespace zvo::demo
