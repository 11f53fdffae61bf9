// SPDX-License-Identifier: MIT
#pragma once

#include "vk/timer.h"

#include <exception>
#include <memory>
#include <vector>

namespace zvo::vk
{

class Flight;

/// Work that HeadlessDevice::submit() gave to the device, and that may still be under way. What it uses must live until
/// it is done. Destroying it waits, and so does destroying the device, after which it can still be asked. Move-only.
class Submission
{
public:
    /// No work: done, without passes.
    Submission() = default;
    ~Submission();
    Submission(Submission&& other) noexcept = default;
    Submission& operator=(Submission&& other) noexcept; ///< waits for the work that it replaces

    /// Whether wait() would return, or throw, at once. Does not wait.
    [[nodiscard]] bool done() const;

    /// Waits, and returns the GPU time of each pass in order: the same however often it is called. Throws Error{Other}
    /// when the device was lost.
    std::vector<PassTime> wait();

private:
    friend class Flight;

    struct State
    {
        Flight* flight = nullptr; // that the work is under way in
        std::vector<PassTime> times;
        std::exception_ptr failure;
    };

    void finish() noexcept;

    std::unique_ptr<State> m_state;
};

} // namespace zvo::vk
