// SPDX-License-Identifier: MIT
#include "demo/world/stroke.h"

namespace zvo::demo
{

void Stroke::press()
{
    m_answered = m_is_stroke ? m_answered : m_probe; // a press before the last one was answered goes on with it
    ++m_probe;
    m_is_down = true;
    m_is_stroke = true;
}

void Stroke::move()
{
    m_probe += m_is_down ? 1 : 0;
}

bool Stroke::found(std::uint64_t probe, bool has_voxel)
{
    const bool counts = m_is_stroke && probe > m_answered;
    m_answered = counts ? probe : m_answered;
    return counts && has_voxel;
}

bool Stroke::takeEnd()
{
    const bool ends = m_is_stroke && !m_is_down && m_answered == m_probe;
    m_is_stroke = m_is_stroke && !ends;
    return ends;
}

} // namespace zvo::demo
