// SPDX-License-Identifier: MIT
#pragma once

#include "vk/command_context.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "vk/slice_planner.h"
#include "vk/submission.h"
#include "vk/uploader.h"
#include "vk/window_support.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace zvo::vk
{

/// How a HeadlessDevice is made.
struct HeadlessOptions
{
    std::string device;                   // name part, index, "cpu"; empty: the best usable one
    bool validation = false;              // core and synchronization validation
    bool gpu_assisted_validation = false; // instruments the kernels; implies validation
    std::uint64_t memory_budget_bytes = UINT64_MAX;
    std::string memory_budget_name = "the limit";               // for messages
    SliceOptions slices;                                        // how long submissions of run() may take
    std::uint32_t submissions_in_flight = 3;                    // of submit(): at most; at least 1
    std::string pipeline_cache_path;                            // empty: pipelines are not kept on disk
    std::uint32_t timer_capacity = 4096;                        // passes of one run that are timed; 0: none
    std::optional<WindowSupport> window;                        // for work that a window shows: a Swapchain
    std::atomic<std::uint32_t>* message_counter = nullptr;      // also counts validation messages, to the very end
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr; // null: of the machine's loader. For tests
    DeviceOverrides overrides;                                  // likewise
};

/// Reports of all physical devices, usable or not, in the loader's order; the index is their number for `device`.
std::vector<DeviceReport> queryAllDevices();

/// The project's own Vulkan instance, device and queue: for work without a window, unless options ask for one. It plays
/// the host of the embedding contract: it owns what DeviceHandles names, submits and waits.
class HeadlessDevice : public Uploader
{
public:
    /// Throws Error{Device} when no device will do; the message lists every device with every reason.
    HeadlessDevice(const HeadlessOptions& options, std::span<const EmbeddedKernel> kernels);
    ~HeadlessDevice() override;
    HeadlessDevice(const HeadlessDevice&) = delete;
    HeadlessDevice& operator=(const HeadlessDevice&) = delete;

    [[nodiscard]] Device& device() override;

    /// The queue that everything is submitted to. Not to be used while a call of this class is going on.
    [[nodiscard]] VkQueue queue();

    /// Records with record, submits and waits; in several submissions where one would take too long
    /// (HeadlessOptions::slices), which the results do not depend on. Returns the GPU time of each pass, in order.
    /// Throws Error{Other} on a lost device.
    std::vector<PassTime> run(const std::function<void(FrameGraph&)>& record);

    /// Records with record and submits, without waiting for it: what runs is as long as what was recorded, never split.
    /// Work runs, and sees what was written, in the order of submission, run() and transfers included. When
    /// HeadlessOptions::submissions_in_flight are under way, waits for the oldest. What fails on the device is thrown
    /// by Submission::wait(). The host may read mapped buffers then if record ends with FrameGraph::releaseToHost().
    /// sync: semaphores that it waits for and signals. Throws what record throws, and Error{Other} on a lost device:
    /// then it does neither.
    [[nodiscard]] Submission submit(const std::function<void(FrameGraph&)>& record, const SubmitSync& sync = {});

    /// Calls work, in which run(), uploads and downloads call pause between their submissions; those of run() aim at
    /// submission_ms meanwhile. So a window stays alive while something long is made: pause may submit() and run(). It
    /// must not touch what work is making, nor replace kernels, and ends it by throwing. Throws what work throws.
    void withPauses(const std::function<void()>& pause, double submission_ms, const std::function<void()>& work);

    /// Submissions of the last run().
    [[nodiscard]] std::uint32_t submissionCount() const;

    /// Runs record's passes, as run().
    void perform(const std::function<void(FrameGraph&, DeletionQueue&)>& record) override;

    /// Does nothing: who submits knows what is under way.
    void keep(std::shared_ptr<void> /*thing*/) override {}

    /// Copies count elements from element first on (all of them by default) to the host and waits. Throws Error{Other}
    /// when the buffer does not have them.
    template <typename T>
    std::vector<T> download(const BufferOf<T>& buffer, std::uint64_t first = 0, std::uint64_t count = UINT64_MAX)
    {
        const std::uint64_t available = buffer.count() - std::min(first, buffer.count());
        std::vector<T> values(count == UINT64_MAX ? available : count);
        downloadBytes(buffer, first * sizeof(T), values.data(), values.size() * sizeof(T));
        return values;
    }

    /// What the validation layers have said so far (0 without them). Messages go to stderr as they come.
    [[nodiscard]] std::uint32_t validationMessageCount() const;

private:
    void uploadBytes(Buffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes) override;
    void downloadBytes(const Buffer& buffer, std::uint64_t offset, void* data, std::uint64_t bytes);

    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo::vk
