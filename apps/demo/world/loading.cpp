// SPDX-License-Identifier: MIT
#include "demo/world/loading.h"

#include <chrono>
#include <utility>

namespace zvo::demo
{

namespace
{

struct Cancelled
{
};

} // namespace

Loading::Loading(WorldOptions options)
    : m_options(std::move(options)), m_input(std::async(std::launch::async, [this] { return World::read(m_options); }))
{
}

bool Loading::isRead() const
{
    return m_input.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::unique_ptr<World> Loading::finish(vk::HeadlessDevice& device, double interval_ms,
                                       const std::function<void()>& frame)
{
    if (m_is_cancelled)
    {
        m_input.wait();
        return nullptr;
    }
    WorldInput input = m_input.get();
    using Clock = std::chrono::steady_clock;
    const std::chrono::duration<double, std::milli> interval(interval_ms);
    Clock::time_point last_frame = Clock::now();
    const auto pause = [&]
    {
        if (Clock::now() - last_frame >= interval) // transfers pause, too
        {
            frame();
            last_frame = Clock::now();
        }
        if (m_is_cancelled)
        {
            throw Cancelled();
        }
    };
    const auto listen = [&](std::string_view step, double done)
    {
        m_step = step;
        m_done = done;
    };
    std::unique_ptr<World> world;
    try
    {
        device.withPauses(pause, interval_ms,
                          [&] { world = World::make(device, m_options, std::move(input), listen); });
    }
    catch (const Cancelled&)
    {
        return nullptr;
    }
    return world;
}

} // namespace zvo::demo
