// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

namespace zvo::demo
{

/// A stroke under the mouse button: decides which of the voxels that were found under the pointer become dabs. What is
/// under the pointer is known some frames after it was asked for, so each look is numbered.
class Stroke
{
public:
    /// The button went down, or up. Presses go on with a stroke whose voxels are waited for.
    void press();
    void release() { m_is_down = false; }

    /// The pointer moved.
    void move();

    /// Number of a look at what is under the pointer now.
    [[nodiscard]] std::uint64_t look() const { return m_look; }

    [[nodiscard]] bool isDown() const { return m_is_down; }

    /// Whether voxels are waited for.
    [[nodiscard]] bool isActive() const { return m_is_stroke; }

    /// What a look has found: a voxel, or nothing. Whether it is to be a dab. Those of an older pointer are not.
    bool found(std::uint64_t look, bool has_voxel);

    /// Whether the stroke has just ended; true once.
    bool takeEnd();

private:
    std::uint64_t m_look = 0;
    std::uint64_t m_answered = 0; // the last look of the stroke that found something or nothing
    bool m_is_down = false;
    bool m_is_stroke = false;
};

} // namespace zvo::demo
