// SPDX-License-Identifier: MIT
#pragma once

#include "vk/uploader.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

namespace zvo::vk
{

/// Uploads that a frame carries out. They wait in staging buffers until flush(), or perform(), records their copies, so
/// that what fails half way can be taken back: discard() before the buffers go. Not thread safe.
class RecordedUploads final : public Uploader
{
public:
    /// Staging buffers go to deletion_queue, which outlives this.
    RecordedUploads(Device& device, DeletionQueue& deletion_queue) : m_device(device), m_deletion_queue(deletion_queue)
    {
    }

    /// What is recorded from now on goes to graph; null: nothing can be.
    void attach(FrameGraph* graph) { m_graph = graph; }

    /// Records the copies that wait.
    void flush();

    /// Forgets them.
    void discard() noexcept { m_copies.clear(); }

    [[nodiscard]] Device& device() override { return m_device; }
    void perform(const std::function<void(FrameGraph&, DeletionQueue&)>& record) override;
    void keep(std::shared_ptr<void> thing) override;

private:
    struct Copy
    {
        Buffer staging;
        VkBuffer target;
        std::string target_name;
        std::uint64_t offset;
    };

    void uploadBytes(Buffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes) override;

    Device& m_device;
    DeletionQueue& m_deletion_queue;
    FrameGraph* m_graph = nullptr;
    std::deque<Copy> m_copies;
};

} // namespace zvo::vk
