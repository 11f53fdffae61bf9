// SPDX-License-Identifier: MIT
#pragma once

#include "demo/input/elapsed.h"
#include "io/scene/animated_scene.h"

#include <optional>

namespace zvo::demo
{

/// The time of the scene, which can run, stop, or advance by single frames.
class Timeline
{
public:
    explicit Timeline(const std::optional<FixedStep>& step) : m_run(step) {}

    /// Sets the time.
    void start(double seconds)
    {
        m_start = seconds;
        m_run.reset();
    }

    /// Adds a frame, whose duration is by the clock.
    void advance(double seconds)
    {
        if (m_plays)
        {
            m_run.add(seconds);
        }
    }

    /// Stops, and goes on by a frame of the animated scene.
    void nextFrame(const AnimatedScene& animated)
    {
        m_plays = false;
        start(this->seconds() + 1.0 / animated.frames_per_second);
    }

    void play(bool plays) { m_plays = plays; }
    [[nodiscard]] bool plays() const { return m_plays; }

    /// Seconds of the scene per second; at least 0.
    [[nodiscard]] double speed() const { return m_speed; }
    void setSpeed(double speed)
    {
        start(seconds());
        m_speed = speed;
    }

    /// The time within the animated scene, which starts again at its end.
    [[nodiscard]] double secondsIn(const AnimatedScene& animated) const { return loopedTime(animated, seconds()); }

private:
    [[nodiscard]] double seconds() const { return m_start + m_speed * m_run.seconds(); }

    double m_start = 0;
    Elapsed m_run;
    double m_speed = 1;
    bool m_plays = true;
};

} // namespace zvo::demo
