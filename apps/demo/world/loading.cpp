// SPDX-License-Identifier: MIT
#include "demo/world/loading.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string_view>
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

double Loading::done() const
{
    constexpr std::pair<std::string_view, double> kBegins[] = {
        {"copying to the device", 0.3}, {"voxelizing", 0.45}, {"compressing", 0.8}, {"copying what moves", 0.9}};
    const auto* const begins = std::ranges::find(kBegins, m_operation, [](const auto& begin) { return begin.first; });
    return begins != std::end(kBegins) ? begins->second : 0;
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
        if (Clock::now() - last_frame >= interval) // transfers cause pauses, too
        {
            frame();
            last_frame = Clock::now();
        }
        if (m_is_cancelled)
        {
            throw Cancelled();
        }
    };
    StaticListener listener;
    listener.operation = [&](std::string_view operation) { m_operation = operation; };
    std::unique_ptr<World> world;
    try
    {
        device.withPauses(pause, interval_ms,
                          [&] { world = World::make(device, m_options, std::move(input), listener); });
    }
    catch (const Cancelled&)
    {
        return nullptr;
    }
    return world;
}

} // namespace zvo::demo
