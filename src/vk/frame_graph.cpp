// SPDX-License-Identifier: MIT
#include "vk/frame_graph.h"

#include "vk/device.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace zvo::vk
{

namespace
{

constexpr std::uint64_t kWordBytes = 4;
constexpr std::uint64_t kMaxThreads = std::uint64_t{1} << 32; // kernels number their threads with 32 bits

[[noreturn]] void misuse(const std::string& what)
{
    throw Error(ErrorCode::Other, "frame graph: " + what);
}

const char* accessText(Access access)
{
    switch (access)
    {
    case Access::KernelRead:
        return "reads";
    case Access::KernelWrite:
        return "writes";
    case Access::KernelReadWrite:
        return "reads and writes";
    case Access::IndirectRead:
        return "dispatched by";
    case Access::CopyRead:
        return "copies from";
    case Access::CopyWrite:
        return "copies to";
    case Access::HostRead:
        return "shown to the host";
    }
    return "";
}

std::string stagesText(std::uint64_t stages)
{
    std::vector<const char*> names;
    const auto note = [&](VkPipelineStageFlags2 stage, const char* name)
    {
        if ((stages & stage) != 0)
        {
            names.push_back(name);
        }
    };
    note(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, "compute");
    note(VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, "indirect");
    note(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, "transfer");
    note(VK_PIPELINE_STAGE_2_HOST_BIT, "host");
    return fmt::format("{}", fmt::join(names, "|"));
}

BufferAccess accessOf(const Buffer& buffer, Access access)
{
    return {reinterpret_cast<std::uint64_t>(buffer.handle()), access, buffer.name()};
}

void checkRange(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes)
{
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
    {
        misuse(fmt::format("{} bytes from byte {} on lie outside buffer {} of {} bytes", bytes, offset, buffer.name(),
                           buffer.bytes()));
    }
}

} // namespace

std::array<std::uint64_t, 2> foldGroups(std::uint64_t groups, std::uint32_t max_x)
{
    const std::uint64_t y = std::max<std::uint64_t>(1, (groups + max_x - 1) / max_x);
    return {(groups + y - 1) / y, y};
}

void Pass::declare(const Buffer& buffer, Access access)
{
    if (m_dispatched)
    {
        misuse(fmt::format("pass {} was already dispatched when buffer {} was declared", m_kernel.name, buffer.name()));
    }
    if (buffer.handle() != VK_NULL_HANDLE) // an empty buffer has nothing to wait for
    {
        m_accesses.push_back(accessOf(buffer, access));
    }
}

void Pass::prepare(std::size_t params_bytes)
{
    if (m_dispatched)
    {
        misuse(fmt::format("pass {} was dispatched twice", m_kernel.name));
    }
    if (params_bytes != m_kernel.interface.push_constant_bytes)
    {
        misuse(fmt::format("kernel {} takes {} bytes of push constants but got {}", m_kernel.name,
                           m_kernel.interface.push_constant_bytes, params_bytes));
    }
    m_dispatched = true;
}

void Pass::bind(const void* params, std::size_t bytes)
{
    const Functions& fn = m_graph.m_device.fn();
    fn.vkCmdBindPipeline(m_graph.m_commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_kernel.pipeline);
    fn.vkCmdPushConstants(m_graph.m_commands, m_kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                          static_cast<std::uint32_t>(bytes), params);
}

void Pass::dispatchRaw(std::uint64_t threads, const void* params, std::size_t bytes)
{
    prepare(bytes);
    if (threads == 0)
    {
        fmt::format_to(std::back_inserter(m_graph.m_dump), "pass {}: 0 threads, left out\n", m_kernel.name);
        return;
    }
    const VkPhysicalDeviceLimits& limits = m_graph.m_device.limits();
    const auto [size_x, size_y, size_z] = m_kernel.interface.local_size;
    const std::uint64_t group_threads = std::uint64_t{size_x} * size_y * size_z;
    const std::uint64_t groups = threads / group_threads + (threads % group_threads != 0 ? 1 : 0);
    const auto [x, y] = foldGroups(groups, limits.maxComputeWorkGroupCount[0]);
    if (y > limits.maxComputeWorkGroupCount[1] || threads > kMaxThreads || x * y * group_threads > kMaxThreads)
    {
        misuse(fmt::format("pass {} asks for {} threads, more than one dispatch can have", m_kernel.name, threads));
    }
    m_graph.beginPass(m_kernel.name, m_accesses,
                      fmt::format("{} threads in {} x {} groups of {}", threads, x, y, group_threads));
    bind(params, bytes);
    m_graph.m_device.fn().vkCmdDispatch(m_graph.m_commands, static_cast<std::uint32_t>(x),
                                        static_cast<std::uint32_t>(y), 1);
    m_graph.endPass();
}

void Pass::dispatchIndirectRaw(const Buffer& args, std::uint64_t offset, const void* params, std::size_t bytes)
{
    prepare(bytes);
    checkRange(args, offset, sizeof(gpu::DispatchArgs));
    m_graph.beginPass(m_kernel.name, m_accesses, "indirect");
    bind(params, bytes);
    m_graph.m_device.fn().vkCmdDispatchIndirect(m_graph.m_commands, args.handle(), offset);
    m_graph.endPass();
}

FrameGraph::FrameGraph(Device& device, VkCommandBuffer commands, TimerPool* timers)
    : m_device(device), m_commands(commands), m_timers(timers)
{
}

Pass FrameGraph::addPass(std::string_view kernel, const Specialization& specialization)
{
    return Pass(*this, m_device.kernels().get(kernel, specialization));
}

void FrameGraph::fill(Buffer& buffer, std::uint32_t value, std::uint64_t first, std::uint64_t count)
{
    const std::uint64_t words = buffer.bytes() / kWordBytes;
    if (first > words || (count != UINT64_MAX && count > words - first))
    {
        misuse(fmt::format("{} words from word {} on lie outside buffer {} of {} words", count, first, buffer.name(),
                           words));
    }
    count = std::min(count, words - first);
    if (count == 0)
    {
        return;
    }
    const BufferAccess access = accessOf(buffer, Access::CopyWrite);
    beginPass("fill " + buffer.name(), {&access, 1}, fmt::format("{} bytes", count * kWordBytes));
    m_device.fn().vkCmdFillBuffer(m_commands, buffer.handle(), first * kWordBytes, count * kWordBytes, value);
    endPass();
}

void FrameGraph::copy(const Buffer& from, std::uint64_t from_offset, Buffer& to, std::uint64_t to_offset,
                      std::uint64_t bytes)
{
    checkRange(from, from_offset, bytes);
    checkRange(to, to_offset, bytes);
    if (bytes == 0)
    {
        return;
    }
    if (&from == &to && from_offset < to_offset + bytes && to_offset < from_offset + bytes)
    {
        misuse(fmt::format("a copy within buffer {} overlaps itself", from.name()));
    }
    const BufferAccess accesses[] = {accessOf(from, Access::CopyRead), accessOf(to, Access::CopyWrite)};
    beginPass("copy " + from.name() + " to " + to.name(), accesses, fmt::format("{} bytes", bytes));
    const VkBufferCopy region{from_offset, to_offset, bytes};
    m_device.fn().vkCmdCopyBuffer(m_commands, from.handle(), to.handle(), 1, &region);
    endPass();
}

void FrameGraph::releaseToHost()
{
    recordBarrier(m_hazards.releaseToHost());
}

void FrameGraph::beginPass(const std::string& name, std::span<const BufferAccess> accesses, const std::string& work)
{
    recordBarrier(m_hazards.next(accesses));
    auto out = std::back_inserter(m_dump);
    fmt::format_to(out, "pass {}: {}", name, work);
    for (const BufferAccess& access : accesses)
    {
        fmt::format_to(out, "; {} {}", accessText(access.access), access.name);
    }
    m_dump += '\n';

    const Functions& fn = m_device.fn();
    if (m_device.handles().debug_utils && fn.vkCmdBeginDebugUtilsLabelEXT != nullptr)
    {
        VkDebugUtilsLabelEXT label{};
        label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
        label.pLabelName = name.c_str();
        fn.vkCmdBeginDebugUtilsLabelEXT(m_commands, &label);
    }
    if (m_timers != nullptr)
    {
        m_timers->begin(m_commands, name);
    }
}

void FrameGraph::endPass()
{
    if (m_timers != nullptr)
    {
        m_timers->end(m_commands);
    }
    const Functions& fn = m_device.fn();
    if (m_device.handles().debug_utils && fn.vkCmdEndDebugUtilsLabelEXT != nullptr)
    {
        fn.vkCmdEndDebugUtilsLabelEXT(m_commands);
    }
}

void FrameGraph::recordBarrier(const Barrier& barrier)
{
    if (!barrier.needed())
    {
        return;
    }
    VkMemoryBarrier2 memory{};
    memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    memory.srcStageMask = barrier.source_stages;
    memory.srcAccessMask = barrier.source_accesses;
    memory.dstStageMask = barrier.destination_stages;
    memory.dstAccessMask = barrier.destination_accesses;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &memory;
    m_device.fn().vkCmdPipelineBarrier2(m_commands, &dependency);
    fmt::format_to(std::back_inserter(m_dump), "barrier {} -> {}\n", stagesText(barrier.source_stages),
                   stagesText(barrier.destination_stages));
}

} // namespace zvo::vk
