// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

namespace zvo::demo
{

/// A stroke under the mouse button: decides which of the voxels that were found under the pointer become dabs. What is
/// under the pointer is known only some frames after it was asked for, so each such request, a probe, has a number.
class Stroke
{
public:
    /// The button was pressed, or released. A press continues a stroke that still waits for voxels.
    void press();
    void release() { m_is_down = false; }

    /// The pointer moved.
    void move();

    /// The number of the request for what is under the pointer now.
    [[nodiscard]] std::uint64_t probe() const { return m_probe; }

    [[nodiscard]] bool isDown() const { return m_is_down; }

    /// Whether the stroke waits for voxels.
    [[nodiscard]] bool isActive() const { return m_is_stroke; }

    /// Takes the result of a probe: a voxel, or nothing. Returns whether it becomes a dab; results of older pointer
    /// positions do not.
    bool found(std::uint64_t probe, bool has_voxel);

    /// Whether the stroke has just ended; true once.
    bool takeEnd();

private:
    std::uint64_t m_probe = 0;
    std::uint64_t m_answered = 0; // the last probe of the stroke that found something or nothing
    bool m_is_down = false;
    bool m_is_stroke = false;
};

} // namespace zvo::demo
