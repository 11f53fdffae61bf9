// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace zvo::demo
{

/// The time that every frame takes, whatever the clock says: numerator / denominator seconds.
struct FixedStep
{
    double numerator = 1;
    double denominator = 60;

    [[nodiscard]] double seconds() const { return numerator / denominator; }
};

/// Time that frames add up to. Of fixed steps it is what multiplying says, not what adding up says: frame N of steps of
/// 1/30 is at N / 30 seconds exactly, as `zvo render` has it.
class Elapsed
{
public:
    explicit Elapsed(const std::optional<FixedStep>& step) : m_step(step) {}

    /// A frame more, which took this long by the clock.
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
