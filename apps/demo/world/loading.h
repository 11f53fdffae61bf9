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
    /// Begins to read. Threads may tell things (cli::talk) from then on.
    explicit Loading(WorldOptions options);

    /// Waits for what is being read.
    ~Loading() = default;
    Loading(const Loading&) = delete;
    Loading& operator=(const Loading&) = delete;

    [[nodiscard]] const WorldOptions& options() const { return m_options; }

    /// Whether everything is read, so that finish() can go on; what is being read cannot be stopped.
    [[nodiscard]] bool isRead() const;

    /// Makes the world; frame is called again and again meanwhile, about every interval_ms, and draws what was shown
    /// before. Null where it was cancelled. Throws as World::make(), and what frame throws.
    std::unique_ptr<World> finish(vk::HeadlessDevice& device, double interval_ms, const std::function<void()>& frame);

    void cancel() { m_is_cancelled = true; }

    /// What is being done, and how much of everything is done before that, more or less: 0 to 1.
    [[nodiscard]] const std::string& step() const { return m_step; }
    [[nodiscard]] double done() const;

private:
    WorldOptions m_options;
    std::future<WorldInput> m_input;
    std::string m_step = "reading";
    bool m_is_cancelled = false;
};

} // namespace zvo::demo
