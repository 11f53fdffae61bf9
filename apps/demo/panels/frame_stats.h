// SPDX-License-Identifier: MIT
#pragma once

#include "core/frame/frame_options.h"
#include "vk/timer.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::demo
{

/// The last values of a quantity, one for each frame.
class History
{
public:
    static constexpr std::size_t kLength = 240; // frames

    void add(double value);

    /// Values from the oldest to the newest.
    [[nodiscard]] const std::vector<float>& values() const { return m_values; }

    [[nodiscard]] double last() const { return m_values.empty() ? 0.0 : double{m_values.back()}; }
    [[nodiscard]] double mean() const;

    /// The value that 95 % do not exceed: of n values, the ceil(0.95 n)-th smallest.
    [[nodiscard]] double p95() const;

private:
    std::vector<float> m_values;
};

/// The rays of a frame by which its speed is measured.
struct RaysOfFrame
{
    std::uint64_t count = 0;
    Integrator integrator = Integrator::Primary; // Path: rays of paths, from the camera, of bounces and to lights
};

/// Durations of frames by the clock, and of their passes on the device.
class FrameStats
{
public:
    /// Adds the duration of a frame, from its beginning to the next one's.
    void addFrame(double ms) { m_frame_ms.add(ms); }

    /// Adds the passes of a frame. Times of passes with the same name are summed; missing passes count as 0.
    void addPasses(std::span<const vk::PassTime> passes, const RaysOfFrame& rays);

    [[nodiscard]] const History& frameMs() const { return m_frame_ms; }
    [[nodiscard]] const History& gpuMs() const { return m_gpu_ms; }

    /// Passes by name, in the order in which they first occurred.
    [[nodiscard]] const std::vector<std::string>& names() const { return m_names; }
    [[nodiscard]] const History& pass(const std::string& name) const { return m_passes.at(name); }

    /// Times of the passes of each operation, and the operations in the order in which they first occurred.
    [[nodiscard]] const std::vector<std::string>& operations() const { return m_operation_names; }
    [[nodiscard]] const History& operation(const std::string& name) const { return m_operations.at(name); }

    /// Average frames a second, by the clock.
    [[nodiscard]] double framesPerSecond() const;

    /// The integrator of the last frame.
    [[nodiscard]] Integrator integrator() const { return m_integrator; }

    /// Its rays in a second of the passes that trace them, in millions. Those of paths find light, too.
    [[nodiscard]] double megaraysPerSecond() const { return m_megarays.mean(); }

private:
    History m_frame_ms;
    History m_gpu_ms;
    Integrator m_integrator = Integrator::Primary;
    History m_megarays; // of frames with this integrator
    std::vector<std::string> m_names;
    std::map<std::string, History> m_passes;
    std::vector<std::string> m_operation_names;
    std::map<std::string, History> m_operations;
};

/// The operation of a pass, from its name: "trace" for "trace/primary" and for "fill trace/args"; "other" if the name
/// has none.
std::string operationOf(std::string_view pass);

} // namespace zvo::demo
