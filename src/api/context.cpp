// SPDX-License-Identifier: MIT
#include "zvo/context.h"

#include "api/checked.h"
#include "api/context_impl.h"
#include "api/convert.h"
#include "core/base/kernels.h"
#include "core/base/tuning.h"

#include <fmt/format.h>

#include <exception>

namespace zvo
{

namespace
{

// The stages of zvo's work on its own resources.
constexpr VkPipelineStageFlags2 kStages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                          VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;

constexpr VkAccessFlags2 kWrites = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

constexpr VkAccessFlags2 kAccesses = kWrites | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                     VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT |
                                     VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT;

// Records that zvo's writes, and what else these stages do, come before these accesses in those stages.
void recordBarrier(const vk::Device& device, VkCommandBuffer commands, VkPipelineStageFlags2 before,
                   VkPipelineStageFlags2 after, VkAccessFlags2 accesses)
{
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = before;
    barrier.srcAccessMask = kWrites;
    barrier.dstStageMask = after;
    barrier.dstAccessMask = accesses;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    device.fn().vkCmdPipelineBarrier2(commands, &info);
}

// The stages that run no shader. A stage of an extension that zvo does not know may run some.
constexpr VkPipelineStageFlags2 kStagesWithoutShaders =
    VK_PIPELINE_STAGE_2_TOP_OF_PIPE_BIT | VK_PIPELINE_STAGE_2_BOTTOM_OF_PIPE_BIT |
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT |
    VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT | VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
    VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT |
    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_RESOLVE_BIT |
    VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;

// Each takes up to three timestamps, whose number must fit 32 bits.
constexpr std::uint32_t kTimedPassesMax = 1U << 16;

// No host has so many frames under way.
constexpr std::size_t kFramesExpected = 64;

vk::DeviceHandles handlesOf(const ContextInfo& info)
{
    requireAtMost(info.timed_passes_per_frame, kTimedPassesMax, "ContextInfo::timed_passes_per_frame");
    vk::DeviceHandles handles;
    handles.get_instance_proc_addr = info.get_instance_proc_addr;
    handles.instance = info.instance;
    handles.physical_device = info.physical_device;
    handles.device = info.device;
    handles.queue_family = info.queue_family;
    handles.enabled_features = info.enabled_features;
    handles.enabled_core_features = info.enabled_core_features;
    handles.instance_api_version = info.instance_api_version;
    handles.instance_extensions = {info.instance_extensions.begin(), info.instance_extensions.end()};
    handles.device_extensions = {info.device_extensions.begin(), info.device_extensions.end()};
    handles.allocation_callbacks = info.allocation_callbacks;
    handles.pipeline_cache = info.pipeline_cache;
    handles.memory = info.memory;
    handles.memory_budget_bytes = info.memory_budget_bytes;
    handles.memory_budget_name = "ContextInfo::memory_budget_bytes";
    handles.log = info.log;
    handles.tuning = parseTuning("ContextInfo::tuning", info.tuning);
    if (info.subgroup_size != 0)
    {
        handles.tuning[vk::kSubgroupSizeName] = info.subgroup_size;
    }
    return handles;
}

} // namespace

Context::Impl::Impl(const ContextInfo& info)
    : device(handlesOf(info), zvoKernels()), uploads(device, deletion_queue), timed_passes(info.timed_passes_per_frame),
      up(checkedUp(info.up, "ContextInfo::up"))
{
}

// No frame is under way, so waiting objects are destroyed at once.
Context::Impl::~Impl()
{
    frames.clear();
    deletion_queue = {};
}

std::shared_ptr<FrameState> Context::Impl::beginFrame(std::uint64_t number)
{
    if (!frames.empty() && frames.back()->number == number)
    {
        return frames.back();
    }
    if (done && number <= *done)
    {
        throw Error(ErrorCode::Usage, fmt::format("frame {} is done; the numbers of frames must grow: begin one after "
                                                  "{}",
                                                  number, frames.empty() ? *done : frames.back()->number));
    }
    if (!frames.empty() && number < frames.back()->number)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("frame {} was begun after {}: their numbers must grow", number, frames.back()->number));
    }
    auto frame = std::make_shared<FrameState>();
    frame->number = number;
    if (timed_passes != 0)
    {
        if (free_timers.empty())
        {
            free_timers.push_back(std::make_unique<vk::TimerPool>(device, timed_passes));
        }
        frame->timers = std::move(free_timers.back());
        free_timers.pop_back();
        frame->timers->reset();
    }
    frames.push_back(frame);
    was_lost = false;
    deletion_queue.beginFrame(number);
    if (frames.size() > kFramesExpected && !has_told_waiting)
    {
        has_told_waiting = true;
        device.log(LogSeverity::Warning,
                   "{} frames have begun since one was done: memory of all of them is kept. Call Context::frameDone()",
                   frames.size());
    }
    return frame;
}

void Context::Impl::takeTimes(FrameState& frame)
{
    std::unique_ptr<vk::TimerPool> timers = std::move(frame.timers);
    if (!timers)
    {
        return;
    }
    frame.times = timers->collectIfReady().value_or(std::vector<PassTime>());
    if (!frame.times.empty())
    {
        times = frame.times;
    }
    free_timers.push_back(std::move(timers));
}

Context::Context(const ContextInfo& info) : m_impl(std::make_unique<Impl>(info)) {}

Context::~Context() = default;

void Context::frameDone(std::uint64_t frame)
{
    Impl& impl = *m_impl;
    if (impl.is_recording && frame >= impl.frames.back()->number)
    {
        throw Error(ErrorCode::Usage,
                    fmt::format("frame {} cannot be done: its Recorder is still there", impl.frames.back()->number));
    }
    impl.has_told_waiting = false;
    std::exception_ptr failure;
    while (!impl.frames.empty() && impl.frames.front()->number <= frame)
    {
        const std::shared_ptr<FrameState> state = std::move(impl.frames.front());
        impl.frames.pop_front();
        state->is_done = true;
        impl.done = state->number;
        try
        {
            impl.takeTimes(*state);
        }
        catch (...) // the frame's memory is given back all the same
        {
            failure = failure ? failure : std::current_exception();
        }
    }
    impl.deletion_queue.frameDone(frame);
    if (failure)
    {
        std::rethrow_exception(failure);
    }
}

void Context::frameLost(std::uint64_t frame)
{
    Impl& impl = *m_impl;
    if (impl.is_recording)
    {
        throw Error(ErrorCode::Usage, "a frame can be lost only when its Recorder is gone");
    }
    if (impl.frames.empty() || frame > impl.frames.back()->number)
    {
        return; // the frame never began
    }
    if (impl.was_lost || frame != impl.frames.back()->number)
    {
        throw Error(ErrorCode::Usage, "only the frame that was begun last can be lost: those before it must reach the "
                                      "device");
    }
    impl.was_lost = true;
    FrameState& state = *impl.frames.back();
    state.is_lost = true;
    if (state.timers)
    {
        impl.free_timers.push_back(std::move(state.timers));
    }
    const std::uint64_t number = state.number;
    impl.frames.pop_back();
    if (impl.frames.empty()) // no frame is under way
    {
        impl.deletion_queue.frameDone(number);
    }
}

const std::vector<PassTime>& Context::passTimes() const
{
    return m_impl->times;
}

const DeviceReport& Context::report() const
{
    return m_impl->device.report();
}

MemoryUse Context::memory() const
{
    const vk::MemoryAllocator& memory = m_impl->device.memory();
    return {memory.usedBytes(), memory.heldBytes(), memory.peakHeldBytes()};
}

Recorder::Recorder(Context& context, VkCommandBuffer commands, std::uint64_t frame, VkPipelineStageFlags2 readers)
{
    Context::Impl& impl = context.impl();
    if (commands == VK_NULL_HANDLE)
    {
        throw Error(ErrorCode::Usage, "a Recorder needs a command buffer: it got null");
    }
    if (impl.is_recording)
    {
        throw Error(ErrorCode::Usage, "a context has one Recorder at a time");
    }
    std::shared_ptr<FrameState> state = impl.beginFrame(frame);
    vk::TimerPool* const timers = state->timers.get();
    const std::size_t pass_count = state->pass_count;
    m_impl = std::make_unique<Impl>(Impl{impl, std::move(state), vk::FrameGraph(impl.device, commands, timers)});
    m_impl->graph.countFrom(pass_count);
    recordBarrier(impl.device, commands, kStages | readers, kStages, kAccesses);
    impl.uploads.attach(&m_impl->graph);
    impl.is_recording = true;
}

Recorder::~Recorder()
{
    m_impl->frame->pass_count = m_impl->graph.passCount();
    m_impl->context.uploads.attach(nullptr);
    m_impl->context.is_recording = false;
}

void Recorder::makeVisible(VkPipelineStageFlags2 stages)
{
    if (stages == 0) // nobody reads
    {
        return;
    }
    if ((stages & ~kStagesWithoutShaders) == 0)
    {
        throw Error(ErrorCode::Usage, fmt::format("trees are made visible to stages that run shaders: none of {:#x} "
                                                  "does",
                                                  stages));
    }
    recordBarrier(m_impl->context.device, m_impl->graph.commands(), kStages, stages,
                  VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
}

} // namespace zvo
