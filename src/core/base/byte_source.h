// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>

namespace zvo
{

/// The bytes of a file, wherever they are stored.
class ByteSource
{
public:
    ByteSource() = default;
    virtual ~ByteSource() = default;
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;

    [[nodiscard]] virtual std::uint64_t size() const = 0;

    /// Fills target with the bytes from offset on. The file must be long enough. Throws Error{Input} when they cannot
    /// be read.
    virtual void read(std::uint64_t offset, std::span<std::byte> target) = 0;
};

/// Bytes in memory. They must outlive the source.
class MemorySource : public ByteSource
{
public:
    explicit MemorySource(std::span<const std::byte> bytes) : m_bytes(bytes) {}

    [[nodiscard]] std::uint64_t size() const override { return m_bytes.size(); }
    void read(std::uint64_t offset, std::span<std::byte> target) override
    {
        const std::span<const std::byte> from = m_bytes.subspan(offset, target.size());
        std::copy(from.begin(), from.end(), target.begin());
    }

private:
    std::span<const std::byte> m_bytes;
};

/// A file on disk, read at any offset.
class FileSource : public ByteSource
{
public:
    /// size: length of the file in bytes. Throws Error{Input} when the file cannot be opened.
    FileSource(const std::filesystem::path& path, std::uint64_t size);

    [[nodiscard]] std::uint64_t size() const override { return m_size; }
    void read(std::uint64_t offset, std::span<std::byte> target) override;

private:
    struct Close
    {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    std::filesystem::path m_path;
    std::uint64_t m_size;
    std::unique_ptr<std::FILE, Close> m_file;
};

} // namespace zvo
