// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/device.h"
#include "zvo/export.h"
#include "zvo/log.h"
#include "zvo/memory.h"
#include "zvo/types.h"

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace zvo
{

/// What a host hands over. zvo creates none of these handles and destroys none of them; they must outlive the Context.
struct ContextInfo
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE; // created for Vulkan 1.3 or later
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0; // of the queues to which recordings are submitted; it must support compute

    // What was enabled when instance and device were created; Vulkan cannot be asked for it. Give what vkCreateInstance
    // and vkCreateDevice got, with the chain as patchFeatures() has left it. Only the constructor reads this.
    std::uint32_t instance_api_version = 0;                          // VkApplicationInfo::apiVersion
    std::span<const char* const> instance_extensions = {};           // with VK_EXT_debug_utils objects get names
    std::span<const char* const> device_extensions = {};             // none makes a difference so far
    const void* enabled_features = nullptr;                          // VkDeviceCreateInfo::pNext
    const VkPhysicalDeviceFeatures* enabled_core_features = nullptr; // VkDeviceCreateInfo::pEnabledFeatures

    // Choices of the host.
    const VkAllocationCallbacks* allocation_callbacks = nullptr; // for every Vulkan object; must outlive the Context
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;             // used when kernels are made
    MemoryCallbacks memory = {};                                 // in place of vkAllocateMemory
    std::uint64_t memory_budget_bytes = UINT64_MAX;              // of device memory that zvo holds
    LogCallback log = {};
    DVec3 up = {0, 1, 0}; // of the world, any length: where the simple sky and maps of light have their zenith
    std::uint32_t subgroup_size = 0; // of kernels, from DeviceReport::min_subgroup_size to max_subgroup_size, a power
                                     // of two; takes OptionalFeatures::subgroup_sizes. 0: the driver's, or 32 where
                                     // it would take more and can be asked
    std::uint32_t timed_passes_per_frame = 0; // passes of a frame whose times passTimes() tells, at most 65536; 0:
                                              // none. Without OptionalFeatures::pass_times there are none either
    std::string_view tuning = {}; // "NAME=VALUE,..." as `zvo-bench tune` prints it: forms and sizes of kernels in
                                  // place of those that zvo chooses for the device (docs/performance.md). Results stay
                                  // the same. Only the constructor reads it; subgroup_size, if not 0, goes before it
};

/// Device memory of a context, in bytes.
struct MemoryUse
{
    std::uint64_t used = 0; // by existing objects
    std::uint64_t held = 0; // taken from the driver or the host, unused parts of blocks included; at most the budget
    std::uint64_t peak_held = 0;
};

/// zvo on a host's Vulkan device: its function table, memory and kernels. Several contexts are independent of each
/// other.
///
/// A context never submits, waits or presents, and calls no function of the Vulkan loader but those that it got through
/// get_instance_proc_addr. A Recorder records work into the host's command buffers, frame by frame. When an object is
/// destroyed, whatever frames may still use of it is kept until the host says that the device is done with them.
///
/// Not thread safe: a context and everything that was made with it is used by one thread at a time, but for
/// KernelPreparation::make(). Everything that was
/// made with it must be destroyed before it, and the device must be done with all frames by then.
class ZVO_API Context
{
public:
    /// Throws Error{Device}, with every reason, when zvo cannot use the device or a required feature was not enabled;
    /// Error{Usage} for null handles, for more timed passes than the maximum, and for names and values that tuning
    /// does not know; Error{Memory}.
    explicit Context(const ContextInfo& info);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Tells that the device is done with a frame and all frames before it. frame: the host's number of the frame, or
    /// the value that a timeline semaphore has reached. Memory that only these frames used is freed. A number that is
    /// not higher than the last one changes nothing. If some passes of a frame were not carried out, passTimes() has no
    /// times of it. Throws Error{Usage} for a frame whose Recorder still exists; then nothing changes. Throws what
    /// reading times throws, as on a lost device, after everything else is done.
    void frameDone(std::uint64_t frame);

    /// Tells that a frame, the one that was begun last, did not reach the device: its command buffers were thrown away,
    /// and none of them was submitted. Models, trees, environments, dynamic trees and dynamic objects that were made in
    /// the frame are lost: using them throws Error{Usage}. Dynamic trees are as they were before the frame. Steps of
    /// TreeBuild and TreeCompression are recorded again, unless their source was lost. The number can be used again.
    /// Nothing happens for a frame that never began, such as one whose Recorder could not be made. Throws Error{Usage}
    /// for frames before the last one, which must reach the device.
    ///
    /// A frame that has reached the device in part is not lost: memory that the device may be using would be freed, and
    /// what the device has changed would not be restored. Submit the frame's other command buffers as well. Where that
    /// is impossible, wait until the device is idle; then destroy everything that was made with the Context, and the
    /// Context.
    void frameLost(std::uint64_t frame);

    /// The device's time of each pass, in the order of recording, in the newest frame that is done and has times.
    [[nodiscard]] const std::vector<PassTime>& passTimes() const;

    [[nodiscard]] const DeviceReport& report() const;
    [[nodiscard]] MemoryUse memory() const;

    struct Impl;
    [[nodiscard]] Impl& impl() { return *m_impl; } // only for the library

private:
    std::unique_ptr<Impl> m_impl;
};

/// Records zvo's work into a host's command buffer. Every function that records takes one.
///
/// The command buffer must be in the recording state, outside a render pass, and stays so. Of its state, zvo changes
/// only the compute pipeline and its push constants. Work is ordered: a recording begins behind all work of zvo that
/// was submitted to the same queue before it (or for which a semaphore makes it wait), and behind the readers. zvo
/// records the barriers among its own resources. The barriers for the host's images, and for trees and radiance caches
/// that the host's shaders read, are up to the host: each operation names the stages and accesses on its side.
///
/// After an exception the command buffer is as valid as before: it can be submitted, or thrown away
/// (Context::frameLost()).
class ZVO_API Recorder
{
public:
    /// frame: a number of the host's, or the value that a timeline semaphore will get when the frame is done; never
    /// lower than that of the frame before. Several recordings may have the same frame. readers: stages in which the
    /// host's own shaders read trees and radiance caches. Throws Error{Usage} for null, for a lower number, and while
    /// another Recorder exists.
    Recorder(Context& context, VkCommandBuffer commands, std::uint64_t frame, VkPipelineStageFlags2 readers = 0);
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Records the barrier after which the host's own shaders, in these stages, see all trees and radiance caches as
    /// they have been recorded so far, through their addresses. Access: VK_ACCESS_2_SHADER_STORAGE_READ_BIT. stages: 0
    /// records nothing. Throws Error{Usage} if none of the stages runs shaders.
    void makeVisible(VkPipelineStageFlags2 stages);

    struct Impl;
    [[nodiscard]] Impl& impl() { return *m_impl; } // only for the library

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
