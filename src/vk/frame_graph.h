// SPDX-License-Identifier: MIT
#pragma once

#include "shared/gpu.h"
#include "vk/buffer.h"
#include "vk/hazard_tracker.h"
#include "vk/kernel.h"
#include "vk/slicer.h"
#include "vk/timer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace zvo::vk
{

class FrameGraph;

/// Numbers of workgroups along x and y that make at least groups in all, with at most max_x along x and as few too many
/// as an even split allows.
std::array<std::uint64_t, 2> foldGroups(std::uint64_t groups, std::uint32_t max_x);

/// One pass while it is being declared, whatever its kernel. Declaring an access and getting the buffer's address are
/// the same call, so that a kernel cannot reach a buffer that the graph does not know of. A pass ends with exactly one
/// dispatch; the calls below throw Error{Other} when they are misused.
class AnyPass
{
public:
    /// The kernel reads buffer.
    template <typename T> gpu::ConstPtr<T> read(const BufferOf<T>& buffer)
    {
        declare(buffer, Access::KernelRead);
        return {buffer.address()};
    }

    /// The kernel writes buffer and reads nothing of what was in it before.
    template <typename T> gpu::Ptr<T> write(BufferOf<T>& buffer)
    {
        declare(buffer, Access::KernelWrite);
        return {buffer.address()};
    }

    /// The kernel reads and writes buffer.
    template <typename T> gpu::Ptr<T> readWrite(BufferOf<T>& buffer)
    {
        declare(buffer, Access::KernelReadWrite);
        return {buffer.address()};
    }

protected:
    friend class FrameGraph;
    AnyPass(FrameGraph& graph, const Kernel& kernel) : m_graph(graph), m_kernel(kernel) {}

    void dispatchRaw(std::uint64_t threads, const void* params, std::size_t bytes);
    void dispatchIndirectRaw(const BufferOf<gpu::DispatchArgs>& args, std::uint64_t index, const void* params,
                             std::size_t bytes, std::uint64_t max_groups);

private:
    void declare(const Buffer& buffer, Access access);
    void prepare(std::size_t params_bytes);
    void bind(const void* params, std::size_t bytes);
    void recordGroups(std::uint64_t groups, std::array<std::uint64_t, 2> whole, const void* params, std::size_t bytes);
    void recordGroupRange(std::uint64_t first, std::uint64_t count);
    [[nodiscard]] std::uint64_t key() const { return reinterpret_cast<std::uint64_t>(&m_kernel); }

    FrameGraph& m_graph;
    const Kernel& m_kernel;
    std::vector<BufferAccess> m_accesses;
    bool m_dispatched = false;
};

/// A pass of the kernel for which K stands: it takes K's parameters and nothing else.
template <DeclaredKernel K> class Pass : public AnyPass
{
public:
    using Params = typename K::Params;
    static_assert(std::is_trivially_copyable_v<Params>);

    /// Runs the kernel on at least threads threads (the excess of the last workgroups included; the kernel returns
    /// early there). Folds more workgroups than the device allows along x into y: kernels number themselves with
    /// lib/dispatch.glsl. Does nothing for 0 threads.
    void dispatch(std::uint64_t threads, const Params& params) { dispatchRaw(threads, &params, sizeof(Params)); }

    /// Runs the kernel on args.data[index] workgroups, which an earlier pass wrote: no more than max_groups, by which a
    /// slicer judges how long that may take (by default, it finds out).
    void dispatchIndirect(const BufferOf<gpu::DispatchArgs>& args, std::uint64_t index, const Params& params,
                          std::uint64_t max_groups = UINT64_MAX)
    {
        dispatchIndirectRaw(args, index, &params, sizeof(Params), max_groups);
    }

private:
    friend class FrameGraph;
    using AnyPass::AnyPass;
};

/// A pass of a kernel that no header declares. Params must have the size of the kernel's push constants.
class UntypedPass : public AnyPass
{
public:
    template <typename Params> void dispatch(std::uint64_t threads, const Params& params)
    {
        static_assert(std::is_trivially_copyable_v<Params>);
        dispatchRaw(threads, &params, sizeof(Params));
    }

private:
    friend class FrameGraph;
    using AnyPass::AnyPass;
};

/// A buffer that a pass of the caller's own commands copies from or to.
struct CopyUse
{
    static CopyUse read(const Buffer& buffer) { return {buffer.handle(), buffer.name(), Access::CopyRead}; }
    static CopyUse write(Buffer& buffer) { return {buffer.handle(), buffer.name(), Access::CopyWrite}; }

    VkBuffer buffer;
    std::string_view name; // for the dump
    Access access;
};

/// Records passes into a command buffer in the order in which they are declared, with one global memory barrier before
/// a pass that has a hazard. Records only: it never submits and never waits. The command buffer may be a host's. With a
/// slicer, passes and pieces of passes go into as many command buffers as that asks for; the results are the same.
class FrameGraph
{
public:
    /// Records into commands (in the recording state, outside a render pass). With timers, every pass is timed.
    FrameGraph(Device& device, VkCommandBuffer commands, TimerPool* timers = nullptr, Slicer* slicer = nullptr);

    /// Opens a pass. The kernel's name is the pass's debug label and timer name.
    template <DeclaredKernel K> Pass<K> addPass(const K& kernel)
    {
        return Pass<K>(*this, findKernel(K::kName, specializationOf(kernel)));
    }

    /// The same for kernels of hosts, and for what tests make of kernels.
    UntypedPass addPass(std::string_view kernel, const Specialization& specialization = {})
    {
        return UntypedPass(*this, findKernel(kernel, specialization));
    }

    /// Sets count 32-bit words from word first on to value (by default, all whole words to the end).
    void fill(Buffer& buffer, std::uint32_t value, std::uint64_t first = 0, std::uint64_t count = UINT64_MAX);

    /// Copies bytes between two buffers, or between two ranges of one buffer that do not overlap.
    void copy(const Buffer& from, std::uint64_t from_offset, Buffer& to, std::uint64_t to_offset, std::uint64_t bytes);

    /// Writes data to buffer from byte offset on; both lengths are multiples of 4. The bytes travel inside the command
    /// buffer: data may go on return, and nothing waits. For small things that change every frame: pieces of 64 KiB,
    /// one command each.
    void update(Buffer& buffer, std::uint64_t offset, std::span<const std::byte> data);

    /// The same for whole elements, from element first on.
    template <typename T>
    void update(BufferOf<T>& buffer, std::uint64_t first, std::span<const std::type_identity_t<T>> values)
    {
        update(static_cast<Buffer&>(buffer), first * sizeof(T), std::as_bytes(values));
    }

    /// Records a pass of the caller's own commands, which copy from and to buffers: what it reads and writes of them is
    /// declared here. Other resources are the caller's affair: passes before it may still be running when it begins.
    /// commands gets the command buffer, outside a render pass, and leaves it so.
    void record(const std::string& name, std::span<const CopyUse> uses,
                const std::function<void(VkCommandBuffer)>& commands);
    void record(const std::string& name, std::initializer_list<CopyUse> uses,
                const std::function<void(VkCommandBuffer)>& commands)
    {
        record(name, std::span(uses.begin(), uses.size()), commands);
    }

    /// Makes everything written so far visible to the host once the work is complete.
    void releaseToHost();

    /// Passes, their resources and the barriers between them, as text: one line each.
    [[nodiscard]] const std::string& dump() const { return m_dump; }

    /// Passes recorded so far. Work that is recorded between two calls has the passes from the first number on and
    /// before the second one; in that order the timers list them.
    [[nodiscard]] std::size_t passCount() const { return m_pass_count; }

    /// Passes that were recorded before this graph, with the same timers.
    void countFrom(std::size_t pass_count) { m_pass_count = pass_count; }

    [[nodiscard]] Device& device() { return m_device; }

    /// The command buffer that is recorded to: with a slicer, the one of the moment.
    [[nodiscard]] VkCommandBuffer commands() const { return m_commands; }

private:
    friend class AnyPass;
    const Kernel& findKernel(std::string_view name, const Specialization& specialization);
    void declarePass(const std::string& name, std::span<const BufferAccess> accesses, const std::string& work);
    void openPiece(const std::string& name);
    void closePiece();
    void recordPieces(const std::string& name, std::uint64_t key, std::uint64_t units, std::uint64_t least,
                      const std::function<void(std::uint64_t first, std::uint64_t count)>& record);
    std::uint64_t readGroups(const Buffer& args, std::uint64_t offset, Buffer& readback);
    void recordBarrier(const Barrier& barrier);

    Device& m_device;
    VkCommandBuffer m_commands;
    TimerPool* m_timers;
    Slicer* m_slicer;
    HazardTracker m_hazards;
    std::string m_dump;
    std::size_t m_pass_count = 0;
};

} // namespace zvo::vk
