// SPDX-License-Identifier: MIT
#include "runtime/object_moves.h"

namespace zvo
{

void ObjectMoves::add(const ObjectMove& move, std::uint64_t stroke)
{
    dropRedo();
    m_moves.push_back({move, stroke, ++m_move_count});
    ++m_current;
}

std::optional<ObjectMove> ObjectMoves::undo(std::uint64_t stroke)
{
    if (m_current == 0 || m_moves[m_current - 1].stroke < stroke)
    {
        return std::nullopt;
    }
    return m_moves[--m_current].move;
}

std::optional<ObjectMove> ObjectMoves::redo(std::uint64_t next_stroke)
{
    if (m_current == m_moves.size() || m_moves[m_current].stroke >= next_stroke)
    {
        return std::nullopt;
    }
    return m_moves[m_current++].move;
}

} // namespace zvo
