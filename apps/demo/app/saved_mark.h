// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace zvo::demo
{

/// A place in the history of strokes.
struct EditPoint
{
    std::size_t undo_count = 0;
    std::uint64_t change_count = 0; // of LiveScene: dabs and moves so far

    bool operator==(const EditPoint&) const = default;
};

/// Knows whether the strokes that are shown are in a file. What is not edited at all is.
class SavedMark
{
public:
    void save(const EditPoint& point) { m_saved = point; }
    void reset() { m_saved = {}; }

    /// Undo and redo come back to what was saved. After other strokes, an entry of the same number is another one.
    [[nodiscard]] bool holds(const EditPoint& point) const
    {
        const bool is_unedited = point.undo_count == 0 && m_saved.undo_count == 0;
        return is_unedited || point == m_saved;
    }

private:
    EditPoint m_saved;
};

} // namespace zvo::demo
