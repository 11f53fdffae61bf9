// SPDX-License-Identifier: MIT
#include "demo/input/camera_flight.h"

#include <utility>

namespace zvo::demo
{

namespace
{

constexpr double kKeySeconds = 0.25; // between recorded keys

} // namespace

void CameraFlight::fly(CameraPath path, bool stays)
{
    m_path = std::move(path);
    m_time.reset();
    m_flies = true;
    m_stays = stays;
}

bool CameraFlight::toggle()
{
    m_flies = m_path && !m_flies;
    m_stays = false;
    m_time.reset();
    return m_path.has_value();
}

std::optional<CameraPath> CameraFlight::toggleRecording()
{
    m_records = !m_records;
    if (m_records)
    {
        m_recorded.clear();
        m_record_time.reset();
        return std::nullopt;
    }
    if (m_recorded.empty())
    {
        return std::nullopt;
    }
    m_path.emplace(std::exchange(m_recorded, {}));
    return m_path;
}

void CameraFlight::advance(double seconds, bool is_first, CameraControl& camera)
{
    if (m_flies)
    {
        if (!is_first)
        {
            m_time.add(seconds);
        }
        camera.show(m_path->at(m_time.seconds()));
        m_flies = m_stays || m_time.seconds() < m_path->seconds();
    }
    if (m_records)
    {
        recordKey(camera);
        m_record_time.add(seconds);
    }
}

void CameraFlight::recordKey(const CameraControl& control)
{
    const ViewCamera& camera = control.camera();
    const double now = m_record_time.seconds();
    const bool is_due = m_recorded.empty() || now - m_recorded.back().seconds >= kKeySeconds;
    if (is_due && !camera.orthographic) // keys cannot represent orthographic cameras
    {
        m_recorded.push_back({now, camera.position, control.pivot(), glm::degrees(camera.vertical_fov)});
    }
}

} // namespace zvo::demo
