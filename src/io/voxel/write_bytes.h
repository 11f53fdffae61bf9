// SPDX-License-Identifier: MIT
// How the writers of voxel files pass on their bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace zvo
{

/// Receives the bytes of a file, piece by piece.
using WriteBytes = std::function<void(std::span<const std::byte>)>;

/// Collects numbers, little-endian, and texts.
class ByteCollector
{
public:
    template <typename T> void add(const T& value)
    {
        static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");
        append(std::as_bytes(std::span(&value, 1)));
    }
    void addText(std::string_view text) { append(std::as_bytes(std::span(text))); }
    void append(std::span<const std::byte> bytes) { m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end()); }

    [[nodiscard]] const std::vector<std::byte>& bytes() const { return m_bytes; }

    /// Passes the bytes on, and forgets them, if they are as many as a piece has.
    void passOn(const WriteBytes& write)
    {
        constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
        if (m_bytes.size() >= kPieceBytes)
        {
            write(m_bytes);
            m_bytes.clear();
        }
    }

private:
    std::vector<std::byte> m_bytes;
};

} // namespace zvo
