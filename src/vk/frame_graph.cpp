// SPDX-License-Identifier: MIT
#include "vk/frame_graph.h"

#include "vk/device.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>

namespace zvo::vk
{

namespace
{

constexpr std::uint64_t kWordBytes = 4;
// Bytes of a fill or copy that a slicer counts as one unit, and of an update the most that one command takes.
constexpr std::uint64_t kPieceBytes = 64 << 10;
constexpr std::uint64_t kFillKey = 1; // cannot be the address of a kernel
constexpr std::uint64_t kCopyKey = 2;
constexpr std::uint64_t kUpdateKey = 3;
constexpr std::uint64_t kRecordKey = 4;
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

void AnyPass::declare(const Buffer& buffer, Access access)
{
    if (m_dispatched)
    {
        misuse(fmt::format("pass {} was already dispatched when buffer {} was declared", m_kernel.name, buffer.name()));
    }
    if (buffer.handle() != VK_NULL_HANDLE) // an empty buffer needs no barrier
    {
        m_accesses.push_back(accessOf(buffer, access));
    }
}

void AnyPass::prepare(std::size_t params_bytes)
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

void AnyPass::bind(const void* params, std::size_t bytes)
{
    const Functions& fn = m_graph.m_device.fn();
    fn.vkCmdBindPipeline(m_graph.m_commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_kernel.pipeline);
    fn.vkCmdPushConstants(m_graph.m_commands, m_kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                          static_cast<std::uint32_t>(bytes), params);
}

void AnyPass::dispatchRaw(std::uint64_t threads, const void* params, std::size_t bytes)
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
    m_graph.declarePass(m_kernel.name, m_accesses,
                        fmt::format("{} threads in {} x {} groups of {}", threads, x, y, group_threads));
    recordGroups(groups, {x, y}, params, bytes);
}

void AnyPass::dispatchIndirectRaw(const BufferOf<gpu::DispatchArgs>& args, std::uint64_t index, const void* params,
                                  std::size_t bytes, std::uint64_t max_groups)
{
    const std::uint64_t offset = index * sizeof(gpu::DispatchArgs);
    declare(args, Access::IndirectRead);
    prepare(bytes);
    checkRange(args, offset, sizeof(gpu::DispatchArgs));
    m_graph.declarePass(m_kernel.name, m_accesses, "indirect");
    Slicer* const slicer = m_graph.m_slicer;
    if (slicer != nullptr && !slicer->admitUnseen(key(), max_groups))
    {
        if (Buffer* const readback = slicer->readback())
        {
            const std::uint64_t groups = m_graph.readGroups(args, offset, *readback);
            slicer->learnCount(key(), max_groups, groups);
            recordGroups(groups, {0, 0}, params, bytes);
            return;
        }
    }
    m_graph.openPiece(m_kernel.name);
    bind(params, bytes);
    m_graph.m_device.fn().vkCmdDispatchIndirect(m_graph.m_commands, args.handle(), offset);
    m_graph.closePiece();
}

// whole: workgroups along x and y, which are used if all go into one piece; 0: records exactly that many workgroups.
void AnyPass::recordGroups(std::uint64_t groups, std::array<std::uint64_t, 2> whole, const void* params,
                           std::size_t bytes)
{
    // A smaller range could begin where no base can be set.
    const std::uint64_t least = groups / m_graph.m_device.limits().maxComputeWorkGroupCount[1] + 1;
    m_graph.recordPieces(m_kernel.name, key(), groups, least,
                         [&](std::uint64_t first, std::uint64_t count)
                         {
                             bind(params, bytes);
                             if (count == groups && whole[0] != 0)
                             {
                                 m_graph.m_device.fn().vkCmdDispatch(m_graph.m_commands,
                                                                     static_cast<std::uint32_t>(whole[0]),
                                                                     static_cast<std::uint32_t>(whole[1]), 1);
                             }
                             else
                             {
                                 recordGroupRange(first, count);
                             }
                         });
}

// Records rows of workgroups. The base of each is such that row * row length + column, by which kernels number their
// workgroups, is the number in the whole pass.
void AnyPass::recordGroupRange(std::uint64_t first, std::uint64_t count)
{
    const VkPhysicalDeviceLimits& limits = m_graph.m_device.limits();
    const std::uint64_t max_x = limits.maxComputeWorkGroupCount[0];
    const Functions& fn = m_graph.m_device.fn();
    const std::uint64_t longest = std::max<std::uint64_t>(1, max_x / 2);
    while (count != 0)
    {
        const std::uint64_t rows = (count + longest - 1) / longest;
        const std::uint64_t x =
            (count + rows - 1) /
            rows; // rows have about equal length, since a short one far behind could not be reached by a base
        const std::uint64_t base_x = std::min(first, first % x + (max_x - x - first % x) / x * x);
        const std::uint64_t base_y = (first - base_x) / x;
        if (base_y >= limits.maxComputeWorkGroupCount[1])
        {
            misuse(fmt::format("pass {} has no base for workgroup {} in a row of {}", m_kernel.name, first, x));
        }
        fn.vkCmdDispatchBase(m_graph.m_commands, static_cast<std::uint32_t>(base_x), static_cast<std::uint32_t>(base_y),
                             0, static_cast<std::uint32_t>(x), 1, 1);
        first += x;
        count -= x;
    }
    // Resets the base by an empty dispatch: lavapipe (Mesa 22.3 at least) keeps the last one for later indirect
    // dispatches.
    fn.vkCmdDispatchBase(m_graph.m_commands, 0, 0, 0, 0, 0, 0);
}

FrameGraph::FrameGraph(Device& device, VkCommandBuffer commands, TimerPool* timers, Slicer* slicer)
    : m_device(device), m_commands(commands), m_timers(timers), m_slicer(slicer)
{
}

const Kernel& FrameGraph::findKernel(std::string_view name, const Specialization& specialization)
{
    return m_device.kernels().get(name, specialization);
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
    const std::string name = "fill " + buffer.name();
    const std::uint64_t bytes = count * kWordBytes;
    declarePass(name, {&access, 1}, fmt::format("{} bytes", bytes));
    recordPieces(name, kFillKey, (bytes + kPieceBytes - 1) / kPieceBytes, 1,
                 [&](std::uint64_t piece, std::uint64_t pieces)
                 {
                     const std::uint64_t offset = piece * kPieceBytes;
                     m_device.fn().vkCmdFillBuffer(m_commands, buffer.handle(), first * kWordBytes + offset,
                                                   std::min(pieces * kPieceBytes, bytes - offset), value);
                 });
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
    const std::string name = "copy " + from.name() + " to " + to.name();
    declarePass(name, accesses, fmt::format("{} bytes", bytes));
    recordPieces(name, kCopyKey, (bytes + kPieceBytes - 1) / kPieceBytes, 1,
                 [&](std::uint64_t piece, std::uint64_t pieces)
                 {
                     const std::uint64_t offset = piece * kPieceBytes;
                     const VkBufferCopy region{from_offset + offset, to_offset + offset,
                                               std::min(pieces * kPieceBytes, bytes - offset)};
                     m_device.fn().vkCmdCopyBuffer(m_commands, from.handle(), to.handle(), 1, &region);
                 });
}

void FrameGraph::update(Buffer& buffer, std::uint64_t offset, std::span<const std::byte> data)
{
    checkRange(buffer, offset, data.size());
    if (offset % kWordBytes != 0 || data.size() % kWordBytes != 0)
    {
        misuse(fmt::format("an update of {} bytes from byte {} of buffer {} on is not of whole words", data.size(),
                           offset, buffer.name()));
    }
    if (data.empty())
    {
        return;
    }
    const BufferAccess access = accessOf(buffer, Access::CopyWrite);
    const std::string name = "update " + buffer.name();
    declarePass(name, {&access, 1}, fmt::format("{} bytes", data.size()));
    recordPieces(name, kUpdateKey, (data.size() + kPieceBytes - 1) / kPieceBytes, 1,
                 [&](std::uint64_t piece, std::uint64_t pieces)
                 {
                     for (std::uint64_t i = piece; i < piece + pieces; ++i)
                     {
                         const std::uint64_t first = i * kPieceBytes;
                         m_device.fn().vkCmdUpdateBuffer(m_commands, buffer.handle(), offset + first,
                                                         std::min(kPieceBytes, data.size() - first),
                                                         data.data() + first);
                     }
                 });
}

void FrameGraph::record(const std::string& name, std::span<const CopyUse> uses,
                        const std::function<void(VkCommandBuffer)>& commands)
{
    std::vector<BufferAccess> accesses;
    for (const CopyUse& use : uses)
    {
        if (use.buffer != VK_NULL_HANDLE)
        {
            accesses.push_back({reinterpret_cast<std::uint64_t>(use.buffer), use.access, use.name});
        }
    }
    declarePass(name, accesses, "commands");
    recordPieces(name, kRecordKey, 1, 1, [&](std::uint64_t, std::uint64_t) { commands(m_commands); });
}

void FrameGraph::releaseToHost()
{
    recordBarrier(m_hazards.releaseToHost());
}

void FrameGraph::declarePass(const std::string& name, std::span<const BufferAccess> accesses, const std::string& work)
{
    ++m_pass_count;
    recordBarrier(m_hazards.next(accesses));
    auto out = std::back_inserter(m_dump);
    fmt::format_to(out, "pass {}: {}", name, work);
    for (const BufferAccess& access : accesses)
    {
        fmt::format_to(out, "; {} {}", accessText(access.access), access.name);
    }
    m_dump += '\n';
}

// Calls record for the pieces of a pass in order. They have no barriers between them, as no piece reads what another
// one writes.
void FrameGraph::recordPieces(const std::string& name, std::uint64_t key, std::uint64_t units, std::uint64_t least,
                              const std::function<void(std::uint64_t first, std::uint64_t count)>& record)
{
    for (std::uint64_t first = 0; first < units;)
    {
        std::uint64_t count = m_slicer != nullptr ? m_slicer->admit(key, units - first) : units;
        if (count == 0)
        {
            m_commands = m_slicer->next();
            continue;
        }
        count = std::max(count, least);
        count = units - first < count + least ? units - first : count;
        openPiece(name);
        record(first, count);
        closePiece();
        first += count;
    }
}

// Reads the workgroup count of an indirect dispatch on the host before it is recorded.
std::uint64_t FrameGraph::readGroups(const Buffer& args, std::uint64_t offset, Buffer& readback)
{
    const BufferAccess accesses[] = {accessOf(args, Access::CopyRead), accessOf(readback, Access::CopyWrite)};
    recordBarrier(m_hazards.next(accesses));
    const VkBufferCopy region{offset, 0, sizeof(gpu::DispatchArgs)};
    m_device.fn().vkCmdCopyBuffer(m_commands, args.handle(), readback.handle(), 1, &region);
    releaseToHost();
    m_commands = m_slicer->next();
    gpu::DispatchArgs groups{};
    std::memcpy(&groups, readback.mapped(), sizeof(groups));
    return std::uint64_t{groups.x} * groups.y * groups.z;
}

void FrameGraph::openPiece(const std::string& name)
{
    const Functions& fn = m_device.fn();
    if (m_device.hasDebugUtils() && fn.vkCmdBeginDebugUtilsLabelEXT != nullptr)
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

void FrameGraph::closePiece()
{
    if (m_timers != nullptr)
    {
        m_timers->end(m_commands);
    }
    const Functions& fn = m_device.fn();
    if (m_device.hasDebugUtils() && fn.vkCmdEndDebugUtilsLabelEXT != nullptr)
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
