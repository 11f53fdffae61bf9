// SPDX-License-Identifier: MIT
#include "vk/recorded_uploads.h"

#include "vk/deletion_queue.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <cassert>
#include <cstring>
#include <utility>

namespace zvo::vk
{

void RecordedUploads::flush()
{
    assert(m_copies.empty() || m_graph != nullptr);
    while (!m_copies.empty()) // a copy leaves the list first, so that a failure leaves none without its staging buffer
    {
        Copy copy = std::move(m_copies.front());
        m_copies.pop_front();
        const Buffer& from = m_deletion_queue.keep(std::move(copy.staging));
        m_graph->record("upload " + copy.target_name,
                        {CopyUse::read(from), {copy.target, copy.target_name, Access::CopyWrite}},
                        [&](VkCommandBuffer commands)
                        {
                            const VkBufferCopy region{0, copy.offset, from.bytes()};
                            m_device.fn().vkCmdCopyBuffer(commands, from.handle(), copy.target, 1, &region);
                        });
    }
}

void RecordedUploads::perform(const std::function<void(FrameGraph&, DeletionQueue&)>& record)
{
    assert(m_graph != nullptr);
    flush();
    record(*m_graph, m_deletion_queue);
}

void RecordedUploads::keep(std::shared_ptr<void> thing)
{
    m_deletion_queue.keep(std::move(thing));
}

void RecordedUploads::uploadBytes(Buffer& buffer, std::uint64_t offset, const void* data, std::uint64_t bytes)
{
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
    {
        throw Error(ErrorCode::Other, fmt::format("an upload of {} bytes from byte {} on lies outside buffer {} of {} "
                                                  "bytes",
                                                  bytes, offset, buffer.name(), buffer.bytes()));
    }
    if (bytes == 0)
    {
        return;
    }
    Buffer staging(m_device, "upload staging", bytes, MemoryKind::Upload);
    std::memcpy(staging.mapped(), data, bytes);
    m_copies.push_back({std::move(staging), buffer.handle(), buffer.name(), offset});
}

} // namespace zvo::vk
