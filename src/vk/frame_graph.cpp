// SPDX-License-Identifier: MIT
#include "vk/frame_graph.h"

#include "vk/device.h"
#include "vk/frame_graph_checks.h"

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
    case Access::KernelAccumulate:
        return "accumulates in";
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

} // namespace

FrameGraph::FrameGraph(Device& device, VkCommandBuffer commands, TimerPool* timers, Slicer* slicer)
    : m_device(device), m_commands(commands), m_timers(timers), m_slicer(slicer)
{
}

const Kernel& FrameGraph::findKernel(std::string_view name, const Specialization& specialization)
{
    KernelCache& kernels = m_device.kernels();
    return kernels.get(name, specialization, kernels.usualForm(name));
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
