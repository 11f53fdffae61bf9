// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace zvo
{

/// A dynamic object's change from an offset to another one.
struct ObjectMove
{
    std::size_t object = 0;
    glm::dvec3 from{0.0};
    glm::dvec3 to{0.0};
};

/// Moves of dynamic objects among the strokes of brushes: one list of what can be undone and redone, in order. Strokes
/// are known by their numbers (EditHistory), so it does not matter which of them are dropped. A value: a copy restores
/// an earlier state.
class ObjectMoves
{
public:
    /// Adds a move behind the stroke with that number. Moves that could be redone are dropped; strokes are up to the
    /// caller.
    void add(const ObjectMove& move, std::uint64_t stroke);

    /// Takes back the last move, if no stroke came after it. stroke: the number of the last stroke that is not undone,
    /// or 0.
    std::optional<ObjectMove> undo(std::uint64_t stroke);

    /// The first of the moves that were taken back, if it comes before the next stroke that could be redone.
    std::optional<ObjectMove> redo(std::uint64_t next_stroke);

    /// Drops the moves that could be redone, because a stroke has begun.
    void dropRedo() { m_moves.resize(m_current); }

    [[nodiscard]] std::size_t undoCount() const { return m_current; }
    [[nodiscard]] std::size_t redoCount() const { return m_moves.size() - m_current; }

    /// The number of the last move that is not taken back, or 0. No two moves have the same number.
    [[nodiscard]] std::uint64_t move() const { return m_current == 0 ? 0 : m_moves[m_current - 1].number; }

private:
    struct Entry
    {
        ObjectMove move;
        std::uint64_t stroke; // that came before it
        std::uint64_t number;
    };

    std::vector<Entry> m_moves;
    std::size_t m_current = 0; // moves that are not taken back
    std::uint64_t m_move_count = 0;
};

} // namespace zvo
