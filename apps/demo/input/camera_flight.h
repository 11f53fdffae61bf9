// SPDX-License-Identifier: MIT
#pragma once

#include "demo/input/camera_control.h"
#include "demo/input/elapsed.h"
#include "io/scene/camera_path.h"

#include <optional>
#include <string>
#include <vector>

namespace zvo::demo
{

/// Flies the camera along paths, and records paths.
class CameraFlight
{
public:
    explicit CameraFlight(const std::optional<FixedStep>& step) : m_time(step), m_record_time(step) {}

    /// Flies along path from its beginning. stays: the camera stays at the path's end instead of being released.
    void fly(CameraPath path, bool stays);

    /// Begins a flight along the current path, or ends it. Returns false if there is no path.
    bool toggle();
    void stop() { m_flies = false; }
    [[nodiscard]] bool flies() const { return m_flies; }

    /// Begins recording, or ends it. At the end, the recorded path, if it is one, becomes the current one and is
    /// returned.
    std::optional<CameraPath> toggleRecording();
    [[nodiscard]] bool records() const { return m_records; }

    /// Advances by a frame, whose duration is by the clock; the first frame shows the path's beginning. Moves the
    /// camera, or records it.
    void advance(double seconds, bool is_first, CameraControl& camera);

private:
    void recordKey(const CameraControl& camera);

    std::optional<CameraPath> m_path;
    bool m_flies = false;
    bool m_stays = false;
    Elapsed m_time;
    bool m_records = false;
    Elapsed m_record_time;
    std::vector<CameraKey> m_recorded;
};

} // namespace zvo::demo
