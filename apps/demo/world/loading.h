// SPDX-License-Identifier: MIT
#pragma once

#include "demo/world/world.h"
#include "vk/headless.h"

#include <functional>
#include <future>
#include <memory>
#include <string>

namespace zvo::demo
{

/// A world that is made while another one is shown: its files are read on a thread of their own, then the device works
/// on it between frames.
class Loading
{
public:
    /// Begins reading. From then on, cli::talk may be called by another thread.
    explicit Loading(WorldOptions options);

    /// Waits until reading has ended.
    ~Loading() = default;
    Loading(const Loading&) = delete;
    Loading& operator=(const Loading&) = delete;

    [[nodiscard]] const WorldOptions& options() const { return m_options; }

    /// Whether everything is read, so that finish() can be called. Reading cannot be interrupted.
    [[nodiscard]] bool isRead() const;

    /// Makes the world. Meanwhile `frame` is called about every interval_ms, and draws what was shown before. Returns
    /// null if loading was cancelled. Throws what World::make() and `frame` throw.
    std::unique_ptr<World> finish(vk::HeadlessDevice& device, double interval_ms, const std::function<void()>& frame);

    void cancel() { m_is_cancelled = true; }

    /// What is being done, and about how much of everything was done before that: 0 to 1.
    [[nodiscard]] const std::string& operation() const { return m_operation; }
    [[nodiscard]] double done() const;

private:
    WorldOptions m_options;
    std::future<WorldInput> m_input;
    std::string m_operation = "reading";
    bool m_is_cancelled = false;
};

} // namespace zvo::demo
