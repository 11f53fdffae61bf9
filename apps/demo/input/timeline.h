// SPDX-License-Identifier: MIT
#pragma once

#include "demo/input/elapsed.h"
#include "io/scene/animated_scene.h"

#include <optional>

namespace zvo::demo
{

/// The time of the scene: runs, stands still, goes on by one frame.
class Timeline
{
public:
    explicit Timeline(const std::optional<FixedStep>& step) : m_run(step) {}

    /// From here on.
    void start(double seconds)
    {
        m_start = seconds;
        m_run.reset();
    }

    /// A frame more, which took this long by the clock.
    void advance(double seconds)
    {
        if (m_plays)
        {
            m_run.add(seconds);
        }
    }

    /// Stops, and goes on by a frame of the animated scene.
    void step(const AnimatedScene& animated)
    {
        m_plays = false;
        start(this->seconds() + 1.0 / animated.frames_per_second);
    }

    void play(bool plays) { m_plays = plays; }
    [[nodiscard]] bool plays() const { return m_plays; }

    /// Seconds of the scene in a second; from 0 on.
    [[nodiscard]] double speed() const { return m_speed; }
    void setSpeed(double speed)
    {
        start(seconds());
        m_speed = speed;
    }

    /// From 0 to the animated scene's end, where everything begins anew.
    [[nodiscard]] double secondsIn(const AnimatedScene& animated) const { return loopedTime(animated, seconds()); }

private:
    [[nodiscard]] double seconds() const { return m_start + m_speed * m_run.seconds(); }

    double m_start = 0;
    Elapsed m_run;
    double m_speed = 1;
    bool m_plays = true;
};

} // namespace zvo::demo
