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
#include <utility>

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

constexpr int kTriesMax = 1000; // names of a temporary file

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

/// Whether path still names the open file.
bool isNamed(int descriptor, const std::filesystem::path& path)
{
    struct stat open = {};
    struct stat named = {};
    return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
           open.st_ino == named.st_ino;
}

/// Removes a temporary file of an AtomicFile unless it may still be written: its process has ended or is this one, and
/// nobody holds the lock on it, as a process of another machine or container with the same number would.
void removeIfAbandoned(const std::filesystem::path& path)
{
    pid_t process = 0;
    unsigned number = 0;
    int length = 0;
    const std::string name = path.filename().string();
    const bool is_temporary = std::sscanf(name.c_str(), ".zvo-%d-%u.tmp%n", &process, &number, &length) == 2 &&
                              static_cast<std::size_t>(length) == name.size();
    if (!is_temporary || process <= 0)
    {
        return;
    }
    if (process != ::getpid() && (::kill(process, 0) == 0 || errno != ESRCH))
    {
        return;
    }
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor >= 0)
    {
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && isNamed(descriptor, path))
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
    int code = createTemporary();
    for (int tries = 1; code == EAGAIN && tries < kTriesMax; ++tries)
    {
        code = createTemporary();
    }
    if (code != 0)
    {
        throw writeError(m_target, code);
    }
    if (exists)
    {
        static_cast<void>(::fchmod(m_descriptor, existing.st_mode & ~static_cast<mode_t>(S_IFMT)));
    }
}

int AtomicFile::createTemporary()
{
    std::filesystem::path temporary = temporaryBeside(m_target);
    const int slot = addPendingFile(temporary.string());
    constexpr mode_t kReadWriteForAll = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH; // less the umask
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kReadWriteForAll);
    if (descriptor < 0)
    {
        const int code = errno;
        dropPendingFile(slot);
        return code == EEXIST ? EAGAIN : code;
    }
    // Locked, so that no process takes it for abandoned. One that did so before holds the lock, or has removed it. File
    // systems without locks fail otherwise: there nobody removes anything.
    const bool is_taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (is_taken || !isNamed(descriptor, temporary))
    {
        ::close(descriptor);
        dropPendingFile(slot);
        return EAGAIN;
    }
    m_temporary = std::move(temporary);
    m_descriptor = descriptor;
    m_pending_slot = slot;
    return 0;
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
