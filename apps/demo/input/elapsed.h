// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace zvo::demo
{

/// A fixed time for every frame, independent of the clock: numerator / denominator seconds.
struct FixedStep
{
    double numerator = 1;
    double denominator = 60;

    [[nodiscard]] double seconds() const { return numerator / denominator; }
};

/// The total time of frames. Fixed steps are multiplied, not added up: frame N with steps of 1/30 is at exactly N / 30
/// seconds, as in `zvo render`.
class Elapsed
{
public:
    explicit Elapsed(const std::optional<FixedStep>& step) : m_step(step) {}

    /// Adds a frame, whose duration is by the clock.
    void add(double seconds)
    {
        if (m_step)
        {
            ++m_count;
        }
        else
        {
            m_sum += seconds;
        }
    }

    [[nodiscard]] double seconds() const
    {
        return m_step ? static_cast<double>(m_count) * m_step->numerator / m_step->denominator : m_sum;
    }

    void reset()
    {
        m_count = 0;
        m_sum = 0;
    }

private:
    std::optional<FixedStep> m_step;
    std::uint64_t m_count = 0;
    double m_sum = 0;
};

} // namespace zvo::demo
