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
#include <vector>

namespace zvo
{

/// What a host hands over. zvo creates none of these handles and destroys none of them; they outlive the Context.
struct ContextInfo
{
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE; // created for Vulkan 1.3 or later
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0; // of the queues that recordings are submitted to: it computes

    // What was enabled, which Vulkan cannot be asked: as it was given to vkCreateInstance and vkCreateDevice, the chain
    // as patchFeatures() left it. Looked at by the constructor only.
    std::uint32_t instance_api_version = 0;                          // VkApplicationInfo::apiVersion
    std::span<const char* const> instance_extensions = {};           // VK_EXT_debug_utils: objects get names
    std::span<const char* const> device_extensions = {};             // none makes a difference as yet
    const void* enabled_features = nullptr;                          // VkDeviceCreateInfo::pNext
    const VkPhysicalDeviceFeatures* enabled_core_features = nullptr; // VkDeviceCreateInfo::pEnabledFeatures

    // What is the host's choice.
    const VkAllocationCallbacks* allocation_callbacks = nullptr; // of every Vulkan object; outlive the Context
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;             // used when kernels are made
    MemoryCallbacks memory = {};                                 // in place of vkAllocateMemory
    std::uint64_t memory_budget_bytes = UINT64_MAX;              // of device memory that zvo holds
    LogCallback log = {};
    std::uint32_t subgroup_size = 0; // of kernels, from DeviceReport::min_subgroup_size to max_subgroup_size, a power
                                     // of two; takes OptionalFeatures::subgroup_sizes. 0: the driver chooses
    std::uint32_t timed_passes_per_frame = 0; // passes of a frame whose times passTimes() tells, at most 65536; 0:
                                              // none. Without OptionalFeatures::pass_times there are none either
};

/// Device memory of a context, in bytes.
struct MemoryUse
{
    std::uint64_t used = 0; // by what there is
    std::uint64_t held = 0; // of the driver or the host: unused parts of blocks included; at most the budget
    std::uint64_t peak_held = 0;
};

/// zvo on a host's Vulkan device: its function table, memory and kernels. Several contexts do not know of each other.
///
/// A context never submits, waits or presents, and calls no function of the loader but those that it got through
/// get_instance_proc_addr. Work is recorded by a Recorder into the host's command buffers, frame by frame; what a frame
/// may still use when it goes is kept until the host says that the device is done with that frame.
///
/// Not thread safe: a context and everything that was made of it is used by one thread at a time. Everything that was
/// made of it goes before it does, and the device is done with all frames by then.
class ZVO_API Context
{
public:
    /// Throws Error{Device} with every reason when the device will not do or lacks something that was not enabled,
    /// Error{Usage} for null handles and more timed passes than there can be, Error{Memory}.
    explicit Context(const ContextInfo& info);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// The device is done with a frame and all before it: a frame number of the host's, or the value that a timeline
    /// semaphore has reached. Gives memory back that only those used. Numbers that are not higher than before change
    /// nothing. A frame whose passes were not all carried out has no times. Throws Error{Usage} for the frame of a
    /// Recorder that is still there: nothing changes. What reading times throws, as on a lost device, it throws when
    /// all else is done.
    void frameDone(std::uint64_t frame);

    /// A frame, the one that was begun last, did not reach the device: its command buffers were thrown away, and none
    /// was submitted. Models, trees, dynamic trees and dynamic objects that were made in it are lost: using them throws
    /// Error{Usage}. Dynamic trees are as they were before it, steps of TreeBuild and TreeCompression are recorded
    /// again, unless what they are made of was lost. The number can be used again. Nothing happens for one that never
    /// began, as where its Recorder could not be made; throws Error{Usage} for those before the last, which must reach
    /// the device.
    ///
    /// A frame of which the device got a part is not lost: memory that it may be using would be freed, and what it has
    /// changed not be as before. Submit its other command buffers as well. Where that cannot be, wait until the device
    /// is idle; then the Context goes, with everything that was made of it.
    void frameLost(std::uint64_t frame);

    /// Of the newest frame that is done and has any: the device's time of each pass, in the order of recording.
    [[nodiscard]] const std::vector<PassTime>& passTimes() const;

    [[nodiscard]] const DeviceReport& report() const;
    [[nodiscard]] MemoryUse memory() const;

    struct Impl;
    [[nodiscard]] Impl& impl() { return *m_impl; } // of the library

private:
    std::unique_ptr<Impl> m_impl;
};

/// Records zvo's work into a host's command buffer. Whatever records takes one.
///
/// The command buffer is in the recording state, outside a render pass, and stays so; of its state, zvo changes the
/// compute pipeline, its push constants and nothing else. Work is ordered: a recording begins behind all of zvo's work
/// that was submitted to the same queue before (or that a semaphore makes wait for), and behind readers; barriers among
/// zvo's own resources are zvo's. Those of the host's images and of what the host's shaders read are the host's: each
/// operation names its edges.
///
/// Where something throws, the command buffer is as valid as before: it can be submitted, or thrown away
/// (Context::frameLost()).
class ZVO_API Recorder
{
public:
    /// frame: a number of the host's, or the value that a timeline semaphore gets with it: never lower than the one
    /// before. Several recordings may have one frame. readers: stages in which the host's own shaders read trees.
    /// Throws Error{Usage} for null, for such numbers and for a second Recorder at a time.
    Recorder(Context& context, VkCommandBuffer commands, std::uint64_t frame, VkPipelineStageFlags2 readers = 0);
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// Records the barrier after which the host's own shaders, in these stages, see all trees as they were recorded so
    /// far: through a tree's address. Edge: VK_ACCESS_2_SHADER_STORAGE_READ_BIT. 0: nothing. Throws Error{Usage} for
    /// stages of which none runs shaders.
    void makeVisible(VkPipelineStageFlags2 stages);

    struct Impl;
    [[nodiscard]] Impl& impl() { return *m_impl; } // of the library

private:
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo
