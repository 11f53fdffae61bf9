// SPDX-License-Identifier: MIT
#pragma once

#include "vk/timer.h"

#include <exception>
#include <memory>
#include <vector>

namespace zvo::vk
{

class Flight;

/// Work that HeadlessDevice::submit() gave to the device and that may still be under way. Objects that it uses must
/// live until it is done. The destructor waits, and so does that of the device, after which the Submission may still be
/// asked. Move-only.
class Submission
{
public:
    /// No work: done, without passes.
    Submission() = default;
    ~Submission();
    Submission(Submission&& other) noexcept = default;
    Submission& operator=(Submission&& other) noexcept; ///< waits for the work that it replaces

    /// Whether wait() would return, or throw, without waiting.
    [[nodiscard]] bool done() const;

    /// Waits, and returns the GPU time of each pass, in order. Every call returns the same. Throws Error{Other} when
    /// the device was lost.
    std::vector<PassTime> wait();

private:
    friend class Flight;

    struct State
    {
        Flight* flight = nullptr; // the Flight in which the work is under way
        std::vector<PassTime> times;
        std::exception_ptr failure;
    };

    void finish() noexcept;

    std::unique_ptr<State> m_state;
};

} // namespace zvo::vk
