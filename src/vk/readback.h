// SPDX-License-Identifier: MIT
#pragma once

#include "vk/buffer.h"
#include "vk/frame_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace zvo::vk
{

/// Collects a few values of several buffers for the host, which reads them when the device is done with the frame's
/// copies.
class Readback
{
public:
    Readback() = default;

    /// bytes: the capacity; each copy takes a multiple of 8. Throws Error{Memory}.
    Readback(Device& device, std::uint64_t bytes) : m_bytes(device, "readback", bytes, MemoryKind::Readback) {}

    /// Starts again at the beginning: earlier copies are overwritten.
    void clear() { m_end = 0; }

    /// Records the copy of `count` elements from element `first` on. Returns the offset in bytes at which to read them.
    template <typename T>
    std::uint64_t copy(FrameGraph& graph, const BufferOf<T>& from, std::uint64_t first, std::uint64_t count)
    {
        const std::uint64_t offset = m_end;
        graph.copy(from, first * sizeof(T), m_bytes, offset, count * sizeof(T));
        m_end += (count * sizeof(T) + 7) / 8 * 8;
        return offset;
    }

    /// The values that were copied to that offset.
    template <typename T> [[nodiscard]] std::span<const T> at(std::uint64_t offset, std::uint64_t count) const
    {
        return {reinterpret_cast<const T*>(m_bytes.mappedData() + offset), count};
    }

private:
    BufferOf<std::byte> m_bytes;
    std::uint64_t m_end = 0;
};

} // namespace zvo::vk
