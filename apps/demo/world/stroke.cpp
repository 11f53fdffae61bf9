// SPDX-License-Identifier: MIT
#include "demo/world/stroke.h"

#include <algorithm>
#include <cmath>

namespace zvo::demo
{

void Stroke::press(const glm::dvec2& at, bool line)
{
    m_points.push_back({at, line ? Joint::Line : Joint::Nothing});
    m_pointer = at;
    m_is_down = true;
    m_is_stroke = true;
}

void Stroke::move(const glm::dvec2& at)
{
    if (!m_is_down)
    {
        return;
    }
    const glm::dvec2 from = m_pointer;
    const double step_count = std::ceil(glm::distance(from, at) / kLookStep);
    for (double step = 1; step <= step_count; ++step)
    {
        m_points.push_back({glm::mix(from, at, step / step_count), Joint::Before});
    }
    m_pointer = at;
}

std::vector<glm::dvec2> Stroke::takePoints()
{
    std::vector<glm::dvec2> taken;
    for (; !m_points.empty() && taken.size() < kLooksMax; m_points.pop_front())
    {
        taken.push_back(m_points.front().at);
        m_awaited.push_back(m_points.front().joint);
    }
    return taken;
}

std::vector<glm::ivec3> Stroke::found(std::span<const std::optional<glm::ivec3>> voxels, const DabSpacing& spacing)
{
    std::vector<glm::ivec3> dabs;
    for (const std::optional<glm::ivec3>& voxel : voxels)
    {
        DabSpacing wanted = spacing;
        if (m_awaited.front() == Joint::Line)
        {
            m_last_dab = m_line_from;
            wanted.reach = INFINITY;
        }
        else if (m_awaited.front() == Joint::Nothing || !voxel)
        {
            m_last_dab.reset();
        }
        m_awaited.pop_front();
        if (voxel)
        {
            join(*voxel, wanted, dabs);
        }
    }
    return dabs;
}

// Adds the dabs between the last one and a voxel.
void Stroke::join(const glm::ivec3& voxel, const DabSpacing& spacing, std::vector<glm::ivec3>& dabs)
{
    const glm::dvec3 to(voxel);
    const glm::dvec3 from(m_last_dab.value_or(voxel));
    const double distance = glm::distance(from, to);
    if (m_last_dab && distance < spacing.step)
    {
        return;
    }
    // A voxel farther away is of something behind, or in front: nothing joins the two.
    const double count = distance > spacing.reach ? 1.0 : std::max(std::ceil(distance / spacing.step), 1.0);
    for (double i = 1; i <= count; ++i)
    {
        dabs.emplace_back(glm::round(glm::mix(from, to, i / count)));
    }
    m_last_dab = voxel;
    m_line_from = voxel;
}

bool Stroke::takeEnd()
{
    const bool ends = m_is_stroke && !m_is_down && m_points.empty() && m_awaited.empty();
    m_is_stroke = m_is_stroke && !ends;
    return ends;
}

} // namespace zvo::demo
