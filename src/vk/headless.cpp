// SPDX-License-Identifier: MIT
#include "vk/headless.h"

#include "vk/check.h"
#include "vk/command_context.h"
#include "vk/deletion_queue.h"
#include "vk/flight.h"
#include "vk/instance.h"
#include "vk/logical_device.h"
#include "vk/pipeline_cache.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

namespace zvo::vk
{

namespace
{

// Size of one transfer between host and device; larger ones are split. A larger size gains nothing, as a transfer costs
// tens of microseconds.
constexpr std::uint64_t kStagingBytes = 16ull << 20;
constexpr std::uint64_t kStagingBytesMin = 64ull << 10; // if memory is short

// Spreads a run over submissions that are waited for one by one, and measures them.
class RunSlicer : public Slicer
{
public:
    RunSlicer(CommandContext& commands, SlicePlanner& planner, TimerPool& timers, Buffer& readback,
              std::function<void()> pause)
        : m_commands(commands), m_planner(planner), m_timers(timers), m_readback(readback), m_pause(std::move(pause))
    {
        m_planner.beginRun();
    }

    std::uint64_t admit(std::uint64_t key, std::uint64_t units) override { return m_planner.admit(key, units); }
    bool admitUnseen(std::uint64_t key, std::uint64_t bound) override { return m_planner.admitUnseen(key, bound); }
    void learnCount(std::uint64_t key, std::uint64_t bound, std::uint64_t units) override
    {
        m_planner.learnCount(key, bound, units);
    }
    Buffer* readback() override { return &m_readback; }

    VkCommandBuffer begin()
    {
        m_timers.reset();
        return m_commands.begin();
    }

    VkCommandBuffer next() override
    {
        submit();
        m_pause();
        return begin();
    }

    void submit()
    {
        const auto start = std::chrono::steady_clock::now();
        m_commands.submit();
        m_commands.wait();
        const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
        ++m_submission_count;
        std::vector<PassTime> times = m_timers.collect();
        std::vector<double> pass_ms;
        for (const PassTime& time : times)
        {
            pass_ms.push_back(time.ms);
        }
        m_planner.endSubmission(pass_ms, wall.count());
        append(std::move(times));
    }

    [[nodiscard]] std::vector<PassTime> takeTimes() { return std::move(m_times); }
    [[nodiscard]] std::uint32_t submissionCount() const { return m_submission_count; }

private:
    // A pass that continues in the next submission gives one time.
    void append(std::vector<PassTime>&& times)
    {
        auto first = times.begin();
        if (first != times.end() && !m_times.empty() && m_times.back().name == first->name)
        {
            m_times.back().ms += first->ms;
            ++first;
        }
        m_times.insert(m_times.end(), std::make_move_iterator(first), std::make_move_iterator(times.end()));
    }

    CommandContext& m_commands;
    SlicePlanner& m_planner;
    TimerPool& m_timers;
    Buffer& m_readback;
    std::function<void()> m_pause; // called between two submissions
    std::vector<PassTime> m_times;
    std::uint32_t m_submission_count = 0;
};

void checkRange(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes)
{
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
    {
        throw Error(ErrorCode::Other, fmt::format("a transfer of {} bytes from byte {} on lies outside buffer {} of {} "
                                                  "bytes",
                                                  bytes, offset, buffer.name(), buffer.bytes()));
    }
}

// Staging bytes for a transfer of bytes, which leave room for its target.
std::uint64_t stagingBytes(const Device& device, std::uint64_t bytes)
{
    return std::min(bytes, std::clamp(device.memory().roomBytes() / 2, kStagingBytesMin, kStagingBytes));
}

InstanceOptions instanceOptions(const HeadlessOptions& options)
{
    return {.validation = options.validation,
            .gpu_assisted_validation = options.gpu_assisted_validation,
            .extensions = options.window ? options.window->instance_extensions : std::vector<const char*>(),
            .message_counter = options.message_counter,
            .get_instance_proc_addr = options.get_instance_proc_addr};
}

std::vector<DeviceReport> queryFor(const Instance& instance, const HeadlessOptions& options)
{
    std::vector<DeviceReport> reports = instance.queryAll();
    if (options.window)
    {
        for (DeviceReport& report : reports)
        {
            requireWindow(*options.window, instance, report);
        }
    }
    return reports;
}

} // namespace

struct HeadlessDevice::Impl
{
    Impl(const HeadlessOptions& options, std::span<const EmbeddedKernel> kernels)
        : instance(instanceOptions(options)), reports(queryFor(instance, options)),
          chosen(chooseDevice(reports, options.device)), logical(instance, chosen, options),
          cache(logical.fn(), chosen.physical_device, logical.handle(), options.pipeline_cache_path),
          device(handles(options), kernels), commands(device, logical.queue()), timers(device, options.timer_capacity),
          readback(device, "slice readback", sizeof(gpu::DispatchArgs), MemoryKind::Readback),
          pause_readback(device, "slice readback of pauses", sizeof(gpu::DispatchArgs), MemoryKind::Readback),
          planner(options.slices), timer_capacity(options.timer_capacity),
          flights_max(std::max(options.submissions_in_flight, 1U))
    {
        device.setName(VK_OBJECT_TYPE_QUEUE, reinterpret_cast<std::uint64_t>(logical.queue()), "headless queue");
    }

    [[nodiscard]] DeviceHandles handles(const HeadlessOptions& options) const
    {
        return {.get_instance_proc_addr = instance.fn().vkGetInstanceProcAddr,
                .instance = instance.handle(),
                .physical_device = chosen.physical_device,
                .device = logical.handle(),
                .queue_family = chosen.queue_family,
                .instance_api_version = kInstanceApiVersion,
                .instance_extensions = instance.extensions(),
                .device_extensions = logical.extensions(),
                .enabled_features = logical.features(),
                .pipeline_cache = cache.handle(),
                .memory_budget_bytes = options.memory_budget_bytes,
                .memory_budget_name = options.memory_budget_name,
                .log = options.log,
                .tuning = options.tuning,
                .overrides = options.overrides,
                .functions = &logical.fn()};
    }

    void transfer(const std::function<void(FrameGraph&)>& record)
    {
        FrameGraph graph(device, commands.begin());
        record(graph);
        commands.submit();
        commands.wait();
        pauseHere();
    }

    // Calls the pause; no command buffer may be under recording. Work of the pause has no pauses itself.
    void pauseHere()
    {
        if (pause)
        {
            const std::function<void()> call = std::exchange(pause, nullptr);
            is_pausing = true;
            call();
            is_pausing = false;
            pause = call;
        }
    }

    // A free flight, or else the one with the oldest submission.
    Flight& nextFlight(std::size_t number)
    {
        if (number == flights.size())
        {
            flights.push_back(std::make_unique<Flight>(device, logical.queue(), timer_capacity));
        }
        flights[number]->finish();
        return *flights[number];
    }

    Instance instance;
    std::vector<DeviceReport> reports;
    const DeviceReport& chosen;
    LogicalDevice logical;
    PipelineCacheFile cache;
    Device device;
    CommandContext commands;
    TimerPool timers;
    Buffer readback;       // arguments of an indirect dispatch
    Buffer pause_readback; // the same for work of a pause
    SlicePlanner planner;
    std::function<void()> pause;        // called between submissions; may be empty
    bool is_pausing = false;            // pause is being called
    std::uint32_t submission_count = 0; // of the last run
    std::uint32_t timer_capacity;
    std::size_t flights_max;
    std::size_t next_flight = 0;
    std::vector<std::unique_ptr<Flight>> flights; // made when needed, used in turns
};

std::vector<DeviceReport> queryAllDevices()
{
    return Instance({}).queryAll();
}

HeadlessDevice::HeadlessDevice(const HeadlessOptions& options, std::span<const EmbeddedKernel> kernels)
    : m_impl(std::make_unique<Impl>(options, kernels))
{
}

HeadlessDevice::~HeadlessDevice() = default;

Device& HeadlessDevice::device()
{
    return m_impl->device;
}

VkQueue HeadlessDevice::queue()
{
    return m_impl->logical.queue();
}

std::vector<PassTime> HeadlessDevice::run(const std::function<void(FrameGraph&)>& record)
{
    Buffer& readback = m_impl->is_pausing ? m_impl->pause_readback : m_impl->readback;
    RunSlicer slicer(m_impl->commands, m_impl->planner, m_impl->timers, readback, [this] { m_impl->pauseHere(); });
    FrameGraph graph(m_impl->device, slicer.begin(), &m_impl->timers, &slicer);
    record(graph);
    slicer.submit();
    m_impl->submission_count = slicer.submissionCount();
    return slicer.takeTimes();
}

void HeadlessDevice::perform(const std::function<void(FrameGraph&, DeletionQueue&)>& record)
{
    DeletionQueue deletion_queue;
    run([&](FrameGraph& graph) { record(graph, deletion_queue); });
}

Submission HeadlessDevice::submit(const std::function<void(FrameGraph&)>& record, const SubmitSync& sync)
{
    Submission submission = m_impl->nextFlight(m_impl->next_flight).submit(record, sync);
    m_impl->next_flight = (m_impl->next_flight + 1) % m_impl->flights_max;
    return submission;
}

void HeadlessDevice::withPauses(const std::function<void()>& pause, double submission_ms,
                                const std::function<void()>& work)
{
    const double usual_ms = m_impl->planner.aimAt(submission_ms);
    m_impl->pause = pause;
    try
    {
        work();
    }
    catch (...)
    {
        m_impl->is_pausing = false;
        m_impl->pause = nullptr;
        m_impl->planner.aimAt(usual_ms);
        throw;
    }
    m_impl->pause = nullptr;
    m_impl->planner.aimAt(usual_ms);
}

std::uint32_t HeadlessDevice::submissionCount() const
{
    return m_impl->submission_count;
}

std::uint32_t HeadlessDevice::validationMessageCount() const
{
    return m_impl->instance.validationMessageCount();
}

void HeadlessDevice::uploadBytes(Buffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes)
{
    checkRange(buffer, offset, bytes);
    if (bytes == 0)
    {
        return;
    }
    Buffer staging(m_impl->device, "upload staging", stagingBytes(m_impl->device, bytes), MemoryKind::Upload);
    for (std::uint64_t done = 0; done < bytes;)
    {
        const std::uint64_t chunk = std::min(bytes - done, staging.bytes());
        std::memcpy(staging.mapped(), static_cast<const std::byte*>(data) + done, chunk);
        m_impl->transfer([&](FrameGraph& graph) { graph.copy(staging, 0, buffer, offset + done, chunk); });
        done += chunk;
    }
}

void HeadlessDevice::downloadBytes(const Buffer& buffer, std::uint64_t offset, void* data, std::uint64_t bytes)
{
    checkRange(buffer, offset, bytes);
    if (bytes == 0)
    {
        return;
    }
    Buffer staging(m_impl->device, "download staging", stagingBytes(m_impl->device, bytes), MemoryKind::Readback);
    for (std::uint64_t done = 0; done < bytes;)
    {
        const std::uint64_t chunk = std::min(bytes - done, staging.bytes());
        m_impl->transfer(
            [&](FrameGraph& graph)
            {
                graph.copy(buffer, offset + done, staging, 0, chunk);
                graph.releaseToHost();
            });
        std::memcpy(static_cast<std::byte*>(data) + done, staging.mapped(), chunk);
        done += chunk;
    }
}

} // namespace zvo::vk
