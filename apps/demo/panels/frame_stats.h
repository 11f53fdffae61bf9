// SPDX-License-Identifier: MIT
#pragma once

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

/// The last values of something, frame by frame.
class History
{
public:
    static constexpr std::size_t kLength = 240; // frames

    void add(double value);

    /// From the oldest to the newest.
    [[nodiscard]] const std::vector<float>& values() const { return m_values; }

    [[nodiscard]] double last() const { return m_values.empty() ? 0.0 : double{m_values.back()}; }
    [[nodiscard]] double mean() const;

    /// The value that 95 % do not exceed: of n values, the ceil(0.95 n)-th smallest.
    [[nodiscard]] double p95() const;

private:
    std::vector<float> m_values;
};

/// How long frames took: by the clock, and on the device by pass.
class FrameStats
{
public:
    /// A frame took this long, from its beginning to the next one's.
    void addFrame(double ms) { m_frame_ms.add(ms); }

    /// The passes of a frame. Those of the same name count together; one that a frame does not have took nothing.
    void addPasses(std::span<const vk::PassTime> passes, std::uint64_t ray_count);

    [[nodiscard]] const History& frameMs() const { return m_frame_ms; }
    [[nodiscard]] const History& gpuMs() const { return m_gpu_ms; }

    /// Passes by name, in the order in which they first occurred.
    [[nodiscard]] const std::vector<std::string>& names() const { return m_names; }
    [[nodiscard]] const History& pass(const std::string& name) const { return m_passes.at(name); }

    /// Passes of an operation together, and the operations in the order in which they first occurred.
    [[nodiscard]] const std::vector<std::string>& operations() const { return m_operation_names; }
    [[nodiscard]] const History& operation(const std::string& name) const { return m_operations.at(name); }

    /// Frames a second, by the clock, on average.
    [[nodiscard]] double framesPerSecond() const;

    /// Primary rays of a second of the passes that trace them, in millions.
    [[nodiscard]] double megaraysPerSecond() const { return m_megarays.mean(); }

private:
    History m_frame_ms;
    History m_gpu_ms;
    History m_megarays;
    std::vector<std::string> m_names;
    std::map<std::string, History> m_passes;
    std::vector<std::string> m_operation_names;
    std::map<std::string, History> m_operations;
};

/// The operation that a pass belongs to, by its name: "trace" of "trace/primary" and of "fill trace/args"; "other"
/// where the name does not tell.
std::string operationOf(std::string_view pass);

} // namespace zvo::demo
