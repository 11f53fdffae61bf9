// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace zvo
{

enum class Overwrite
{
    Refuse,
    Allow
};

/// A file that appears complete under its name or not at all: written beside the target under a temporary name, brought
/// to disk, then renamed. A link is followed; a target that is no regular file, such as a pipe or /dev/stdout, is
/// written directly. Every function throws Error{Output}.
class AtomicFile
{
public:
    /// Refuses at once when the target exists and overwriting was not allowed.
    AtomicFile(const std::filesystem::path& target, Overwrite overwrite);

    /// Removes the temporary file unless commit() was reached.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes);

    /// Puts the file in its place. With Overwrite::Refuse a file that came into being meanwhile stays.
    void commit();

private:
    void close();

    std::filesystem::path m_target;
    std::filesystem::path m_temporary; // empty: the target is written directly
    Overwrite m_overwrite;
    int m_descriptor = -1;
    int m_pending_slot = -1; // in the list of removePendingFiles()
};

/// The bytes as one atomic file.
void writeFileAtomically(const std::filesystem::path& target, std::span<const std::byte> bytes, Overwrite overwrite);

/// Removes the temporary files of all AtomicFiles that are not committed yet. Async-signal-safe: for a handler of
/// SIGINT that ends the process.
void removePendingFiles() noexcept;

} // namespace zvo
