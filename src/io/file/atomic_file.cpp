// SPDX-License-Identifier: MIT
#include "io/file/atomic_file.h"

#include "zvo/error.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <set>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace zvo
{

namespace
{

/// A temporary file that a signal handler should remove. The path is written in the state Filling and read in the state
/// Pending.
struct PendingFile
{
    enum State : int
    {
        Free,
        Filling,
        Pending
    };

    std::atomic<int> state{Free};
    std::array<char, PATH_MAX> path{};
};
static_assert(std::atomic<int>::is_always_lock_free); // so that a signal handler may use it

// Files written at the same time. Further ones are written, but not removed on a signal.
constexpr int kPendingFileCapacity = 16;
std::array<PendingFile, kPendingFileCapacity> g_pending_files;

/// Returns the slot taken, or -1 if there is none or the path is too long.
int addPendingFile(const std::string& path)
{
    if (path.size() >= PATH_MAX)
    {
        return -1;
    }
    for (int slot = 0; slot < kPendingFileCapacity; ++slot)
    {
        PendingFile& file = g_pending_files[slot];
        int expected = PendingFile::Free;
        if (file.state.compare_exchange_strong(expected, PendingFile::Filling))
        {
            std::memcpy(file.path.data(), path.c_str(), path.size() + 1);
            file.state = PendingFile::Pending;
            return slot;
        }
    }
    return -1;
}

void dropPendingFile(int slot)
{
    if (slot >= 0)
    {
        g_pending_files[slot].state = PendingFile::Free;
    }
}

Error writeError(const std::filesystem::path& target, int code)
{
    return {ErrorCode::Output, fmt::format("cannot write {}: {}; choose another place or make room", target.string(),
                                           std::generic_category().message(code))};
}

Error existsError(const std::filesystem::path& target)
{
    return {ErrorCode::Output, fmt::format("{} exists already; use -f to overwrite it", target.string())};
}

/// A hidden name, unique in this process. It is short, because the target's name may already have the longest length.
std::filesystem::path temporaryBeside(const std::filesystem::path& target)
{
    static std::atomic<unsigned> next{0};
    return target.parent_path() / fmt::format(".zvo-{}-{}.tmp", ::getpid(), next++);
}

/// Removes a temporary file of an AtomicFile unless it may still be written: its process has ended, and nobody holds
/// the lock on it, as a process of another machine or container would.
void removeIfAbandoned(const std::filesystem::path& path)
{
    pid_t process = 0;
    unsigned number = 0;
    int length = 0;
    const std::string name = path.filename().string();
    const bool is_temporary = std::sscanf(name.c_str(), ".zvo-%d-%u.tmp%n", &process, &number, &length) == 2 &&
                              static_cast<std::size_t>(length) == name.size();
    if (!is_temporary || process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH)
    {
        return;
    }
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor >= 0)
    {
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
        {
            ::unlink(path.c_str());
        }
        ::close(descriptor);
    }
}

/// Removes what killed processes have left in a folder, once for each folder.
void removeAbandoned(const std::filesystem::path& folder)
{
    static std::mutex mutex;
    static std::set<std::filesystem::path> seen;
    const std::lock_guard lock(mutex);
    if (!seen.insert(folder).second)
    {
        return;
    }
    std::error_code failure;
    for (std::filesystem::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure))
    {
        removeIfAbandoned(entry->path());
    }
}

/// Renames without replacing. If the file system cannot do that in one step, it checks first.
int renameIfAbsent(const char* from, const char* to)
{
    if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0)
    {
        return 0;
    }
    if (errno != EINVAL && errno != ENOSYS)
    {
        return errno;
    }
    if (::access(to, F_OK) == 0)
    {
        return EEXIST;
    }
    return ::rename(from, to) == 0 ? 0 : errno;
}

/// Syncs the directory's entry. Not every file system can, but the file itself is synced already.
void syncDirectory(const std::filesystem::path& directory)
{
    const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0)
    {
        static_cast<void>(::fsync(descriptor));
        ::close(descriptor);
    }
}

} // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target, Overwrite overwrite) : m_overwrite(overwrite)
{
    struct stat existing = {};
    const bool exists = ::stat(target.c_str(), &existing) == 0;
    if (exists && !S_ISREG(existing.st_mode))
    {
        m_target = target;
        m_descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
        if (m_descriptor < 0)
        {
            throw writeError(target, errno);
        }
        return;
    }
    // Absolute, because the working directory may change; with links resolved, so that a link stays a link.
    std::error_code failure;
    m_target = std::filesystem::weakly_canonical(std::filesystem::absolute(target, failure), failure);
    if (failure)
    {
        throw writeError(target, failure.value());
    }
    if (exists && overwrite == Overwrite::Refuse)
    {
        throw existsError(m_target);
    }
    removeAbandoned(m_target.parent_path());
    m_temporary = temporaryBeside(m_target);
    m_pending_slot = addPendingFile(m_temporary.string());
    constexpr mode_t kReadWriteForAll = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH; // less the umask
    m_descriptor = ::open(m_temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kReadWriteForAll);
    if (m_descriptor < 0)
    {
        const int code = errno;
        dropPendingFile(m_pending_slot);
        throw writeError(m_target, code);
    }
    static_cast<void>(::flock(m_descriptor, LOCK_EX | LOCK_NB)); // so that no process takes it for abandoned
    if (exists)
    {
        static_cast<void>(::fchmod(m_descriptor, existing.st_mode & ~static_cast<mode_t>(S_IFMT)));
    }
}

AtomicFile::~AtomicFile()
{
    close();
    if (!m_temporary.empty())
    {
        ::unlink(m_temporary.c_str());
        dropPendingFile(m_pending_slot);
    }
}

void AtomicFile::close()
{
    if (m_descriptor >= 0)
    {
        ::close(m_descriptor);
        m_descriptor = -1;
    }
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    while (!bytes.empty())
    {
        const ssize_t written = ::write(m_descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR)
        {
            throw writeError(m_target, errno);
        }
        bytes = bytes.subspan(written < 0 ? 0 : static_cast<std::size_t>(written));
    }
}

void AtomicFile::commit()
{
    if (m_temporary.empty())
    {
        close();
        return;
    }
    if (::fsync(m_descriptor) != 0)
    {
        throw writeError(m_target, errno);
    }
    const bool replace = m_overwrite == Overwrite::Allow;
    const int code = replace ? (::rename(m_temporary.c_str(), m_target.c_str()) == 0 ? 0 : errno)
                             : renameIfAbsent(m_temporary.c_str(), m_target.c_str());
    if (code != 0)
    {
        throw code == EEXIST && !replace ? existsError(m_target) : writeError(m_target, code);
    }
    close(); // until here its lock keeps others from taking it for abandoned
    dropPendingFile(m_pending_slot);
    m_temporary.clear();
    syncDirectory(m_target.parent_path());
}

void writeFileAtomically(const std::filesystem::path& target, std::span<const std::byte> bytes, Overwrite overwrite)
{
    AtomicFile file(target, overwrite);
    file.write(bytes);
    file.commit();
}

void removePendingFiles() noexcept
{
    for (PendingFile& file : g_pending_files)
    {
        if (file.state == PendingFile::Pending)
        {
            ::unlink(file.path.data());
        }
    }
}

} // namespace zvo
