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

/// Numbers of workgroups along x and y whose product is at least `groups`, with at most max_x along x. The product
/// exceeds `groups` by as little as rows of equal length allow.
std::array<std::uint64_t, 2> foldGroups(std::uint64_t groups, std::uint32_t max_x);

/// A pass while it is being declared, whatever its kernel. Declaring an access and getting the buffer's address are the
/// same call, so that a kernel cannot reach a buffer that the graph does not know. A pass ends with exactly one
/// dispatch. The functions below throw Error{Other} when they are misused.
class AnyPass
{
public:
    /// The kernel reads buffer.
    template <typename T> gpu::ConstPtr<T> read(const BufferOf<T>& buffer)
    {
        declare(buffer, Access::KernelRead);
        return {buffer.address()};
    }

    /// The kernel reads buffer if `reads`; else it gets a null address.
    template <typename T> gpu::ConstPtr<T> readIf(bool reads, const BufferOf<T>& buffer)
    {
        return reads ? read(buffer) : gpu::ConstPtr<T>{};
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

    /// The kernel changes buffer by atomics whose order does not matter, as those of its own workgroups. Passes that
    /// follow each other and accumulate in the same buffer may run at the same time.
    template <typename T> gpu::Ptr<T> accumulate(BufferOf<T>& buffer)
    {
        declare(buffer, Access::KernelAccumulate);
        return {buffer.address()};
    }

    /// The kernel finds the address of buffer in a table on the device, and its bound form (lib/bound.glsl) the buffer
    /// by this name, which must be a literal. Where earlier passes write to the buffer, the access is declared as well.
    void reach(std::string_view name, const Buffer& buffer);

protected:
    friend class FrameGraph;
    AnyPass(FrameGraph& graph, const Kernel& kernel) : m_graph(graph), m_kernel(&kernel) {}

    void dispatchRaw(std::uint64_t threads, const void* params, std::size_t bytes);
    void dispatchIndirectRaw(const Buffer& args, std::uint64_t offset, const void* params, std::size_t bytes,
                             std::uint64_t max_groups);

private:
    struct Reached
    {
        std::string_view name;
        const Buffer* buffer;
    };

    void declare(const Buffer& buffer, Access access);
    void prepare(const void* params, std::size_t params_bytes);
    [[nodiscard]] const Buffer* boundBuffer(const ModuleBinding& binding, const void* params) const;
    bool findDescriptors(const void* params);
    [[nodiscard]] const char* formText() const
    {
        return m_descriptors != VK_NULL_HANDLE ? ", through descriptors" : "";
    }
    void bind(const void* params, std::size_t bytes);
    void recordGroups(std::uint64_t groups, std::array<std::uint64_t, 2> whole, const void* params, std::size_t bytes);
    void recordGroupRange(std::uint64_t first, std::uint64_t count);
    [[nodiscard]] std::uint64_t key() const { return reinterpret_cast<std::uint64_t>(m_kernel); }

    FrameGraph& m_graph;
    const Kernel* m_kernel;
    VkDescriptorSet m_descriptors = VK_NULL_HANDLE; // of a kernel's bound form
    std::vector<BufferAccess> m_accesses;
    std::vector<const Buffer*> m_buffers; // those of m_accesses
    std::vector<Reached> m_reached;
    bool m_dispatched = false;
};

/// A pass of the kernel for which the type K stands. Its dispatches take K's parameters and nothing else.
template <DeclaredKernel K> class Pass : public AnyPass
{
public:
    using Params = typename K::Params;
    static_assert(std::is_trivially_copyable_v<Params>);

    /// Runs the kernel on at least `threads` threads; those of the last workgroups beyond that number return early.
    /// Where there are more workgroups than the device allows along x, they are folded into y, and kernels number
    /// themselves with lib/dispatch.glsl. Does nothing for 0 threads.
    void dispatch(std::uint64_t threads, const Params& params) { dispatchRaw(threads, &params, sizeof(Params)); }

    /// Runs the kernel on args.data[index] workgroups, which an earlier pass has written. max_groups: an upper bound,
    /// from which a slicer estimates the time; by default, the slicer reads the number.
    void dispatchIndirect(const BufferOf<gpu::DispatchArgs>& args, std::uint64_t index, const Params& params,
                          std::uint64_t max_groups = UINT64_MAX)
    {
        dispatchIndirectRaw(args, index * sizeof(gpu::DispatchArgs), &params, sizeof(Params), max_groups);
    }

    /// The same with arguments that are a member of the buffer's first element.
    template <typename T>
    void dispatchIndirect(const BufferOf<T>& buffer, gpu::DispatchArgs T::*args, const Params& params,
                          std::uint64_t max_groups = UINT64_MAX)
    {
        const T element{};
        const auto* const first = reinterpret_cast<const std::byte*>(&element);
        const auto* const member = reinterpret_cast<const std::byte*>(&(element.*args));
        dispatchIndirectRaw(buffer, static_cast<std::uint64_t>(member - first), &params, sizeof(Params), max_groups);
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

/// A buffer that the caller's own commands (FrameGraph::record) read or write.
struct CopyUse
{
    static CopyUse read(const Buffer& buffer) { return {buffer.handle(), buffer.name(), Access::CopyRead}; }
    static CopyUse write(Buffer& buffer) { return {buffer.handle(), buffer.name(), Access::CopyWrite}; }

    VkBuffer buffer;
    std::string_view name; // for the dump
    Access access;
};

/// Records passes into a command buffer in the order in which they are declared, with one global memory barrier before
/// each pass that has a hazard. Never submits and never waits. The command buffer may be a host's. With a slicer,
/// passes and pieces of passes are spread over as many command buffers as the slicer asks for; the results are the
/// same.
class FrameGraph
{
public:
    /// Records into commands, in the recording state and outside a render pass. If timers are given, every pass is
    /// timed.
    FrameGraph(Device& device, VkCommandBuffer commands, TimerPool* timers = nullptr, Slicer* slicer = nullptr);

    /// Opens a pass. The kernel's name is the pass's debug label and timer name.
    template <DeclaredKernel K> Pass<K> addPass(const K& kernel)
    {
        return Pass<K>(*this, findKernel(K::kName, specializationOf(kernel)));
    }

    /// The same for kernels of hosts, and for passes of tests with other parameters.
    UntypedPass addPass(std::string_view kernel, const Specialization& specialization = {})
    {
        return UntypedPass(*this, findKernel(kernel, specialization));
    }

    /// Sets `count` 32-bit words, from word `first` on, to `value`; by default all whole words to the end.
    void fill(Buffer& buffer, std::uint32_t value, std::uint64_t first = 0, std::uint64_t count = UINT64_MAX);

    /// Copies bytes between two buffers, or between two ranges of one buffer that do not overlap.
    void copy(const Buffer& from, std::uint64_t from_offset, Buffer& to, std::uint64_t to_offset, std::uint64_t bytes);

    /// Writes data to buffer from byte `offset` on; offset and length are multiples of 4. The bytes travel inside the
    /// command buffer, so data is not needed after the call, and nothing waits. Meant for small data that change every
    /// frame: each piece of 64 KiB is a command of its own.
    void update(Buffer& buffer, std::uint64_t offset, std::span<const std::byte> data);

    /// The same for whole elements, from element first on.
    template <typename T>
    void update(BufferOf<T>& buffer, std::uint64_t first, std::span<const std::type_identity_t<T>> values)
    {
        update(static_cast<Buffer&>(buffer), first * sizeof(T), std::as_bytes(values));
    }

    /// Records a pass of the caller's own commands. The buffers that they copy from and to are declared here; other
    /// resources are up to the caller, as passes before this one may still be running when it begins. commands: is
    /// called with the command buffer, which is outside a render pass and must stay so.
    void record(const std::string& name, std::span<const CopyUse> uses,
                const std::function<void(VkCommandBuffer)>& commands);
    void record(const std::string& name, std::initializer_list<CopyUse> uses,
                const std::function<void(VkCommandBuffer)>& commands)
    {
        record(name, std::span(uses.begin(), uses.size()), commands);
    }

    /// Makes everything written so far visible to the host once the work is complete.
    void releaseToHost();

    /// The passes, their buffers and the barriers between them as text, one line each.
    [[nodiscard]] const std::string& dump() const { return m_dump; }

    /// The number of passes recorded so far. Work that is recorded between two calls consists of the passes from the
    /// first number up to, but without, the second, in the order in which the timers list them.
    [[nodiscard]] std::size_t passCount() const { return m_pass_count; }

    /// The number of passes that were recorded with the same timers before this graph.
    void countFrom(std::size_t pass_count) { m_pass_count = pass_count; }

    [[nodiscard]] Device& device() { return m_device; }

    /// The command buffer that is recorded to. With a slicer it changes.
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
