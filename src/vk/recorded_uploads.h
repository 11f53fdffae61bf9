// SPDX-License-Identifier: MIT
#pragma once

#include "vk/uploader.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

namespace zvo::vk
{

/// Uploads that become part of a frame. They wait in staging buffers until flush(), or perform(), records the copies.
/// So an object that could not be made completely can take its uploads back, by discard() before its buffers are
/// destroyed. Not thread safe.
class RecordedUploads final : public Uploader
{
public:
    /// deletion_queue receives the staging buffers, and must outlive this object.
    RecordedUploads(Device& device, DeletionQueue& deletion_queue) : m_device(device), m_deletion_queue(deletion_queue)
    {
    }

    /// Sets the graph that records the copies; null: nothing can be recorded.
    void attach(FrameGraph* graph) { m_graph = graph; }

    /// Records the copies of all waiting uploads.
    void flush();

    /// Drops all waiting uploads.
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
