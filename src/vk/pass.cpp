// SPDX-License-Identifier: MIT
// Passes of kernels: their accesses and dispatches.
#include "vk/descriptor_sets.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "vk/frame_graph_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>

namespace zvo::vk
{

constexpr std::uint64_t kMaxThreads = std::uint64_t{1} << 32; // kernels number their threads with 32 bits

std::array<std::uint64_t, 2> foldGroups(std::uint64_t groups, std::uint32_t max_x)
{
    const std::uint64_t y = std::max<std::uint64_t>(1, (groups + max_x - 1) / max_x);
    return {(groups + y - 1) / y, y};
}

void AnyPass::declare(const Buffer& buffer, Access access)
{
    if (m_dispatched)
    {
        misuse(
            fmt::format("pass {} was already dispatched when buffer {} was declared", m_kernel->name, buffer.name()));
    }
    if (buffer.handle() != VK_NULL_HANDLE) // an empty buffer has nothing to wait for
    {
        m_accesses.push_back(accessOf(buffer, access));
        m_buffers.push_back(&buffer);
    }
}

void AnyPass::reach(std::string_view name, const Buffer& buffer)
{
    if (!m_kernel->interface.bindings.empty())
    {
        m_reached.push_back({name, &buffer});
    }
}

void AnyPass::prepare(const void* params, std::size_t params_bytes)
{
    if (m_dispatched)
    {
        misuse(fmt::format("pass {} was dispatched twice", m_kernel->name));
    }
    if (params_bytes != m_kernel->interface.push_constant_bytes)
    {
        misuse(fmt::format("kernel {} takes {} bytes of push constants but got {}", m_kernel->name,
                           m_kernel->interface.push_constant_bytes, params_bytes));
    }
    if (!m_kernel->interface.bindings.empty() && !findDescriptors(params))
    {
        m_kernel = &m_graph.m_device.kernels().get(m_kernel->name, m_kernel->specialization);
    }
    m_dispatched = true;
}

// The buffer of a binding, which is empty where the kernel does not use it; null if it is none that the pass knows.
const Buffer* AnyPass::boundBuffer(const ModuleBinding& binding, const void* params) const
{
    static const Buffer kEmpty;
    if (binding.address_offset == ModuleBinding::kNoAddress)
    {
        const auto found = std::ranges::find(m_reached, binding.name, &Reached::name);
        if (found == m_reached.end())
        {
            misuse(fmt::format("pass {} does not say which buffer {} is", m_kernel->name, binding.name));
        }
        return found->buffer;
    }
    std::uint64_t address = 0;
    std::memcpy(&address, static_cast<const std::byte*>(params) + binding.address_offset, sizeof(address));
    if (address == 0)
    {
        return &kEmpty;
    }
    const auto found = std::ranges::find(m_buffers, address, &Buffer::address);
    return found != m_buffers.end() ? *found : nullptr;
}

// Makes descriptors for the kernel's bindings. False if there is none for one of them.
bool AnyPass::findDescriptors(const void* params)
{
    DescriptorSets& descriptors = m_graph.m_device.descriptors();
    const std::vector<ModuleBinding>& bindings = m_kernel->interface.bindings;
    std::vector<const Buffer*> buffers;
    for (const ModuleBinding& binding : bindings)
    {
        const Buffer* const buffer = boundBuffer(binding, params);
        const bool is_empty = buffer != nullptr && buffer->handle() == VK_NULL_HANDLE;
        if (buffer == nullptr || (!is_empty && !descriptors.canBind(binding, *buffer)))
        {
            return false;
        }
        buffers.push_back(is_empty ? nullptr : buffer);
    }
    // Each descriptor needs a buffer, even if the kernel never reads it.
    std::vector<VkBuffer> handles;
    for (std::size_t i = 0; i < bindings.size(); ++i)
    {
        const auto usable = [&](const Buffer* buffer)
        { return buffer != nullptr && descriptors.canBind(bindings[i], *buffer); };
        const auto any = usable(buffers[i]) ? buffers.begin() + static_cast<std::ptrdiff_t>(i)
                                            : std::ranges::find_if(buffers, usable);
        if (any == buffers.end())
        {
            return false;
        }
        handles.push_back((*any)->handle());
    }
    m_descriptors = descriptors.get(bindings, handles);
    return true;
}

void AnyPass::bind(const void* params, std::size_t bytes)
{
    const Functions& fn = m_graph.m_device.fn();
    fn.vkCmdBindPipeline(m_graph.m_commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_kernel->pipeline);
    if (m_descriptors != VK_NULL_HANDLE)
    {
        fn.vkCmdBindDescriptorSets(m_graph.m_commands, VK_PIPELINE_BIND_POINT_COMPUTE, m_kernel->layout, 0, 1,
                                   &m_descriptors, 0, nullptr);
    }
    fn.vkCmdPushConstants(m_graph.m_commands, m_kernel->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                          static_cast<std::uint32_t>(bytes), params);
}

void AnyPass::dispatchRaw(std::uint64_t threads, const void* params, std::size_t bytes)
{
    prepare(params, bytes);
    if (threads == 0)
    {
        fmt::format_to(std::back_inserter(m_graph.m_dump), "pass {}: 0 threads, left out\n", m_kernel->name);
        return;
    }
    const VkPhysicalDeviceLimits& limits = m_graph.m_device.limits();
    const auto [size_x, size_y, size_z] = m_kernel->interface.local_size;
    const std::uint64_t group_threads = std::uint64_t{size_x} * size_y * size_z;
    const std::uint64_t groups = threads / group_threads + (threads % group_threads != 0 ? 1 : 0);
    const auto [x, y] = foldGroups(groups, limits.maxComputeWorkGroupCount[0]);
    if (y > limits.maxComputeWorkGroupCount[1] || threads > kMaxThreads || x * y * group_threads > kMaxThreads)
    {
        misuse(fmt::format("pass {} asks for {} threads, more than one dispatch can have", m_kernel->name, threads));
    }
    m_graph.declarePass(m_kernel->name, m_accesses,
                        fmt::format("{} threads in {} x {} groups of {}{}", threads, x, y, group_threads, formText()));
    recordGroups(groups, {x, y}, params, bytes);
}

void AnyPass::dispatchIndirectRaw(const Buffer& args, std::uint64_t offset, const void* params, std::size_t bytes,
                                  std::uint64_t max_groups)
{
    declare(args, Access::IndirectRead);
    prepare(params, bytes);
    checkRange(args, offset, sizeof(gpu::DispatchArgs));
    m_graph.declarePass(m_kernel->name, m_accesses, fmt::format("indirect{}", formText()));
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
    m_graph.openPiece(m_kernel->name);
    bind(params, bytes);
    m_graph.m_device.fn().vkCmdDispatchIndirect(m_graph.m_commands, args.handle(), offset);
    m_graph.closePiece();
}

// whole: workgroups along x and y when all of them go into one piece; 0: exactly groups of them.
void AnyPass::recordGroups(std::uint64_t groups, std::array<std::uint64_t, 2> whole, const void* params,
                           std::size_t bytes)
{
    // Ranges smaller than this could start where no base reaches.
    const std::uint64_t least = groups / m_graph.m_device.limits().maxComputeWorkGroupCount[1] + 1;
    m_graph.recordPieces(m_kernel->name, key(), groups, least,
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

// One row of workgroups after the other, each at a base such that row * row length + column, which is how kernels
// number their workgroups, is the number in the whole pass.
void AnyPass::recordGroupRange(std::uint64_t first, std::uint64_t count)
{
    const VkPhysicalDeviceLimits& limits = m_graph.m_device.limits();
    const std::uint64_t max_x = limits.maxComputeWorkGroupCount[0];
    const Functions& fn = m_graph.m_device.fn();
    const std::uint64_t longest = std::max<std::uint64_t>(1, max_x / 2);
    while (count != 0)
    {
        const std::uint64_t rows = (count + longest - 1) / longest;
        const std::uint64_t x = (count + rows - 1) / rows; // about equal: no base reaches a short row far behind
        const std::uint64_t base_x = std::min(first, first % x + (max_x - x - first % x) / x * x);
        const std::uint64_t base_y = (first - base_x) / x;
        if (base_y >= limits.maxComputeWorkGroupCount[1])
        {
            misuse(fmt::format("pass {} has no base for workgroup {} in a row of {}", m_kernel->name, first, x));
        }
        fn.vkCmdDispatchBase(m_graph.m_commands, static_cast<std::uint32_t>(base_x), static_cast<std::uint32_t>(base_y),
                             0, static_cast<std::uint32_t>(x), 1, 1);
        first += x;
        count -= x;
    }
    // Nothing at base 0: lavapipe (of Mesa 22.3, for one) keeps the last base for later indirect dispatches.
    fn.vkCmdDispatchBase(m_graph.m_commands, 0, 0, 0, 0, 0, 0);
}

} // namespace zvo::vk
