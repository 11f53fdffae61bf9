// SPDX-License-Identifier: MIT
#pragma once

#include "vk/buffer.h"
#include "vk/frame_graph.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace zvo::vk
{

/// A few values of several buffers, which the host reads once the device is done with the frame that copied them.
class Readback
{
public:
    Readback() = default;

    /// Room for bytes; copies take whole multiples of 8. Throws Error{Memory}.
    Readback(Device& device, std::uint64_t bytes) : m_bytes(device, "readback", bytes, MemoryKind::Readback) {}

    /// Begins anew: what was copied before is overwritten.
    void clear() { m_end = 0; }

    /// Records the copy of count elements from first on. Returns the offset to read them at, in bytes.
    template <typename T>
    std::uint64_t copy(FrameGraph& graph, const BufferOf<T>& from, std::uint64_t first, std::uint64_t count)
    {
        const std::uint64_t offset = m_end;
        graph.copy(from, first * sizeof(T), m_bytes, offset, count * sizeof(T));
        m_end += (count * sizeof(T) + 7) / 8 * 8;
        return offset;
    }

    /// What was copied to that offset.
    template <typename T> [[nodiscard]] std::span<const T> at(std::uint64_t offset, std::uint64_t count) const
    {
        return {reinterpret_cast<const T*>(m_bytes.mappedData() + offset), count};
    }

private:
    BufferOf<std::byte> m_bytes;
    std::uint64_t m_end = 0;
};

} // namespace zvo::vk
