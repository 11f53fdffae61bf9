// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace zvo::demo
{

/// How close together the dabs of a stroke are, in voxels.
struct DabSpacing
{
    double step = 1;  // between dabs
    double reach = 4; // voxels that were found one after the other and are farther apart are not joined
};

/// A stroke under the mouse button: decides at which points of the window to look, and which voxels that are found
/// there become dabs. Between two positions of the pointer there is a point every kLookStep units, and between two
/// voxels that are found there are dabs in space. So a stroke has no gaps, however fast the pointer moves. What is at
/// the points is known only some frames after it was asked for, in the same order.
class Stroke
{
public:
    static constexpr double kLookStep = 2;        // of the window's units
    static constexpr std::size_t kLooksMax = 256; // in a frame

    /// The button was pressed. A press continues a stroke that still waits for voxels, but is not joined to it. line:
    /// it is joined, straight, to the last dab of the last stroke.
    void press(const glm::dvec2& at, bool line = false);
    void release() { m_is_down = false; }

    /// The pointer has moved.
    void move(const glm::dvec2& at);

    [[nodiscard]] bool isDown() const { return m_is_down; }

    /// Whether the stroke waits for voxels.
    [[nodiscard]] bool isActive() const { return m_is_stroke; }

    /// Takes the points to look at next, at most kLooksMax.
    std::vector<glm::dvec2> takePoints();

    /// Takes what is at the oldest points that have no answer yet: voxels, or nothing. Returns the centres of dabs.
    std::vector<glm::ivec3> found(std::span<const std::optional<glm::ivec3>> voxels, const DabSpacing& spacing);

    /// Whether the next answer is of a point at which the button was pressed; and whether a line ends there.
    [[nodiscard]] bool nextIsPress() const { return m_awaited.front() != Joint::Before; }
    [[nodiscard]] bool nextEndsLine() const { return m_awaited.front() == Joint::Line; }

    /// The centre of the last dab, to which the next one is joined.
    [[nodiscard]] const std::optional<glm::ivec3>& lastDab() const { return m_last_dab; }

    /// Whether the stroke has just ended; true once.
    bool takeEnd();

private:
    // What a point is joined to.
    enum class Joint
    {
        Before, // the point before it, if that is near
        Nothing,
        Line // the last dab, wherever that is
    };
    struct Point
    {
        glm::dvec2 at;
        Joint joint;
    };

    void join(const glm::ivec3& voxel, const DabSpacing& spacing, std::vector<glm::ivec3>& dabs);

    std::deque<Point> m_points;  // to look at
    std::deque<Joint> m_awaited; // of points without an answer
    glm::dvec2 m_pointer{0.0};   // of the last point
    std::optional<glm::ivec3> m_last_dab;
    std::optional<glm::ivec3> m_line_from;
    bool m_is_down = false;
    bool m_is_stroke = false;
};

} // namespace zvo::demo
