// SPDX-License-Identifier: MIT
#pragma once

#include "core/stage.h"

namespace zvo::demo
{

/// The time of the scene: runs, stands still, goes on by one frame.
class Timeline
{
public:
    void start(double seconds) { m_seconds = seconds; }

    void advance(double seconds) { m_seconds += m_plays ? speed * seconds : 0.0; }

    /// Stops, and goes on by a frame of the stage.
    void step(const Stage& stage)
    {
        m_plays = false;
        m_seconds += 1.0 / stage.frames_per_second;
    }

    void play(bool plays) { m_plays = plays; }
    [[nodiscard]] bool plays() const { return m_plays; }

    /// From 0 to the stage's end, where everything begins anew.
    [[nodiscard]] double secondsIn(const Stage& stage) const { return loopedTime(stage, m_seconds); }

    double speed = 1; // seconds of the scene in a second; from 0 on

private:
    double m_seconds = 0;
    bool m_plays = true;
};

} // namespace zvo::demo
