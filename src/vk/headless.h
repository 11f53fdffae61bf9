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

/// Options of a HeadlessDevice.
struct HeadlessOptions
{
    std::string device;                   // name part, index, "cpu"; empty: the best usable one
    bool validation = false;              // core and synchronization validation
    bool gpu_assisted_validation = false; // instruments the kernels; implies validation
    std::uint64_t memory_budget_bytes = UINT64_MAX;
    std::string memory_budget_name = "the limit"; // for messages
    SliceOptions slices;                          // bounds on the submissions of run()
    std::uint32_t submissions_in_flight = 3;      // the most submissions of submit() under way; at least 1
    std::string pipeline_cache_path;              // empty: pipelines are not kept on disk
    std::uint32_t timer_capacity = 4096;          // passes of one run that are timed; 0: none
    std::optional<WindowSupport> window;          // support for showing results in a window (Swapchain)
    LogCallback log;                              // what zvo tells; may be empty
    /// Counts validation messages as well, until the instance is gone.
    std::atomic<std::uint32_t>* message_counter = nullptr;
    TuningValues tuning;                                        // as in DeviceHandles
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr; // null: of the machine's loader. For tests
    DeviceOverrides overrides;                                  // likewise
};

/// Reports of all physical devices, usable or not, in the loader's order. HeadlessOptions::device takes the index in
/// this list.
std::vector<DeviceReport> queryAllDevices();

/// The project's own Vulkan instance, device and queue, for work without a window unless options ask for one. It plays
/// the host of the embedding contract: it owns the objects that DeviceHandles names, it submits, and it waits.
class HeadlessDevice : public Uploader
{
public:
    /// Throws Error{Device} when zvo can use no device; the message lists every device with every reason.
    HeadlessDevice(const HeadlessOptions& options, std::span<const EmbeddedKernel> kernels);
    ~HeadlessDevice() override;
    HeadlessDevice(const HeadlessDevice&) = delete;
    HeadlessDevice& operator=(const HeadlessDevice&) = delete;

    [[nodiscard]] Device& device() override;

    /// The queue to which everything is submitted. Must not be used during a call of this class.
    [[nodiscard]] VkQueue queue();

    /// Records with `record`, submits and waits. Work that would take too long is split into several submissions
    /// (HeadlessOptions::slices), without influence on the results. Returns the GPU time of each pass, in order. Throws
    /// Error{Other} on a lost device.
    std::vector<PassTime> run(const std::function<void(FrameGraph&)>& record);

    /// Records with `record` and submits as a single submission, without waiting. All work runs in the order of
    /// submission, and sees what earlier work has written; run() and transfers are no exception. If
    /// HeadlessOptions::submissions_in_flight are under way already, waits for the oldest. Errors on the device are
    /// thrown by Submission::wait(). If `record` ends with FrameGraph::releaseToHost(), the host may read mapped
    /// buffers after wait(). sync: semaphores that the submission waits for and signals. Throws what `record` throws,
    /// and Error{Other} on a lost device; then the semaphores are not used.
    [[nodiscard]] Submission submit(const std::function<void(FrameGraph&)>& record, const SubmitSync& sync = {});

    /// Calls `work`. While it runs, run(), uploads and downloads call `pause` between their submissions, and the
    /// submissions of run() aim at submission_ms. So a window stays responsive while something long is made: `pause`
    /// may call submit() and run(). It must not touch what `work` is making, nor replace kernels. It can end the work
    /// by throwing. Throws what `work` throws.
    void withPauses(const std::function<void()>& pause, double submission_ms, const std::function<void()>& work);

    /// The number of submissions of the last run().
    [[nodiscard]] std::uint32_t submissionCount() const;

    /// Runs the passes of `record`, as run().
    void perform(const std::function<void(FrameGraph&, DeletionQueue&)>& record) override;

    /// Does nothing: users of this class know which submissions are under way, and keep objects themselves.
    void keep(std::shared_ptr<void> /*thing*/) override {}

    /// Copies `count` elements from element `first` on (by default all) to the host and waits. Throws Error{Other} when
    /// the buffer is not long enough.
    template <typename T>
    std::vector<T> download(const BufferOf<T>& buffer, std::uint64_t first = 0, std::uint64_t count = UINT64_MAX)
    {
        const std::uint64_t available = buffer.count() - std::min(first, buffer.count());
        std::vector<T> values(count == UINT64_MAX ? available : count);
        downloadBytes(buffer, first * sizeof(T), values.data(), values.size() * sizeof(T));
        return values;
    }

    /// The number of messages of the validation layers so far (0 without them). Messages are printed to stderr.
    [[nodiscard]] std::uint32_t validationMessageCount() const;

private:
    void uploadBytes(Buffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes) override;
    void downloadBytes(const Buffer& buffer, std::uint64_t offset, void* data, std::uint64_t bytes);

    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace zvo::vk
