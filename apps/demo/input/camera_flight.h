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

/// Camera paths: flown along, and recorded.
class CameraFlight
{
public:
    explicit CameraFlight(const std::optional<FixedStep>& step) : m_time(step), m_record_time(step) {}

    /// Flies along path from its beginning. stays: after its end, too, where the camera stands still.
    void fly(CameraPath path, bool stays);

    /// Begins the flight along the path that there is, or ends it; false where there is none.
    bool toggle();
    void stop() { m_flies = false; }
    [[nodiscard]] bool flies() const { return m_flies; }

    /// Begins recording, or ends it: then the path is what was recorded, if that is anything, and returned.
    std::optional<CameraPath> toggleRecording();
    [[nodiscard]] bool records() const { return m_records; }

    /// A frame more, which took so long by the clock; the first frame shows the beginning. Moves the camera, or watches
    /// it.
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
