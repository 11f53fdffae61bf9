// SPDX-License-Identifier: MIT
#include "demo/world/stroke.h"

namespace zvo::demo
{

void Stroke::press()
{
    m_answered = m_is_stroke ? m_answered : m_look; // a press continues a stroke that still waits for an answer
    ++m_look;
    m_is_down = true;
    m_is_stroke = true;
}

void Stroke::move()
{
    m_look += m_is_down ? 1 : 0;
}

bool Stroke::found(std::uint64_t look, bool has_voxel)
{
    const bool counts = m_is_stroke && look > m_answered;
    m_answered = counts ? look : m_answered;
    return counts && has_voxel;
}

bool Stroke::takeEnd()
{
    const bool ends = m_is_stroke && !m_is_down && m_answered == m_look;
    m_is_stroke = m_is_stroke && !ends;
    return ends;
}

} // namespace zvo::demo
