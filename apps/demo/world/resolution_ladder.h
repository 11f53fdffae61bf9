// SPDX-License-Identifier: MIT
#pragma once

#include "core/present/present.h"
#include "vk/timer.h"

#include <array>
#include <cstddef>
#include <span>

namespace zvo::demo
{

/// Keeps a slow device usable: lowers the resolution of traced pictures, rung by rung, while frames take too long, and
/// raises it again when there is time. Its decisions depend only on the times that it is told.
class ResolutionLadder
{
public:
    /// Of the window's edges.
    static constexpr std::array<double, 7> kScales = {1.0, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125};
    static constexpr double kTooLongMs = 80;  // of passes that scale: 10 frames a second, and some to spare
    static constexpr double kShortMs = 50;    // the expected time at the next higher scale must be below this
    static constexpr int kFramesToLower = 2;  // consecutive frames that took too long
    static constexpr int kFramesToRaise = 10; // consecutive frames that left time

    explicit ResolutionLadder(std::size_t rung) : m_rung(rung) {}

    [[nodiscard]] double scale() const { return kScales[m_rung]; }

    /// Tells scalingMs() of a frame at scale(). Frames that were recorded at another scale are not told.
    void add(double scaling_ms);

private:
    std::size_t m_rung;
    int m_long_count = 0;
    int m_short_count = 0;
};

/// Time of those passes of a frame whose work follows the size of the traced picture, in milliseconds. What the others
/// take, such as updates of the tree or of kept light, no lower resolution makes shorter.
double scalingMs(std::span<const vk::PassTime> passes);

/// A window's size at a scale: at least one pixel, where the window has any.
PictureSize scaledSize(PictureSize window, double scale);

} // namespace zvo::demo
