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

/// A file that appears complete under its name or not at all: it is written beside the target under a temporary name,
/// brought to disk, then renamed. What killed processes have left in that folder is removed. Links are followed. A
/// target that is no regular file, such as a pipe or /dev/stdout, is written directly. Every function throws
/// Error{Output}.
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

    /// Gives the file its name. With Overwrite::Refuse, a file of that name that has appeared in the meantime stays as
    /// it is.
    void commit();

private:
    /// Creates the temporary file and locks it. Returns 0, EAGAIN where another name should be tried, or another errno.
    int createTemporary();
    void close();

    std::filesystem::path m_target;
    std::filesystem::path m_temporary; // empty: the target is written directly
    Overwrite m_overwrite;
    int m_descriptor = -1;
    int m_pending_slot = -1; // in the list of removePendingFiles()
};

/// Writes bytes as one atomic file.
void writeFileAtomically(const std::filesystem::path& target, std::span<const std::byte> bytes, Overwrite overwrite);

/// Removes the temporary files of all AtomicFiles that are not committed yet. Async-signal-safe: for a handler of
/// SIGINT that ends the process.
void removePendingFiles() noexcept;

} // namespace zvo
