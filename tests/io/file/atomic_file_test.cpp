// SPDX-License-Identifier: MIT
#include "io/file/atomic_file.h"

#include "support/errors.h"
#include "support/temp_dir.h"
#include "zvo/error.h"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <stdexcept>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace
{

std::function<void()> g_before_lock; // called once, before the next flock()

} // namespace

// In place of the C library's.
extern "C" int flock(int descriptor, int operation) noexcept
{
    if (const std::function<void()> call = std::exchange(g_before_lock, nullptr))
    {
        call();
    }
    return static_cast<int>(syscall(SYS_flock, descriptor, operation));
}

namespace zvo
{

namespace
{

std::span<const std::byte> asBytes(std::string_view text)
{
    return std::as_bytes(std::span(text));
}

std::string contentOf(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t fileCount(const std::filesystem::path& folder)
{
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

void expectOutputError(const std::function<void()>& write, const std::string& part)
{
    test::expectParts(test::messageOf(write, ErrorCode::Output), {part});
}

TEST(AtomicFile, AppearsOnlyWhenCommitted)
{
    const test::TempDir dir;
    const auto path = dir.path() / "out.bin";
    {
        AtomicFile file(path, Overwrite::Refuse);
        file.write(asBytes("one "));
        file.write(asBytes("two"));
        EXPECT_FALSE(std::filesystem::exists(path));
        file.commit();
    }
    EXPECT_EQ(contentOf(path), "one two");
    EXPECT_EQ(fileCount(dir.path()), 1U);
}

TEST(AtomicFile, RefusesToOverwriteWithAHint)
{
    const test::TempDir dir;
    const auto path = dir.write("out.bin", "old");
    expectOutputError([&] { AtomicFile(path, Overwrite::Refuse); }, "use -f to overwrite");
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(fileCount(dir.path()), 1U);
}

TEST(AtomicFile, RefusesToOverwriteWhatAppearedMeanwhile)
{
    const test::TempDir dir;
    const auto path = dir.path() / "out.bin";
    expectOutputError(
        [&]
        {
            AtomicFile file(path, Overwrite::Refuse);
            file.write(asBytes("new"));
            dir.write("out.bin", "somebody else's");
            file.commit();
        },
        "use -f to overwrite");
    EXPECT_EQ(contentOf(path), "somebody else's");
    EXPECT_EQ(fileCount(dir.path()), 1U);
}

TEST(AtomicFile, OverwritesWhenAllowedAndKeepsThePermissions)
{
    const test::TempDir dir;
    const auto path = dir.write("out.bin", "old");
    constexpr auto kOwnerOnly = std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
    std::filesystem::permissions(path, kOwnerOnly);
    writeFileAtomically(path, asBytes("new"), Overwrite::Allow);
    EXPECT_EQ(contentOf(path), "new");
    EXPECT_EQ(std::filesystem::status(path).permissions(), kOwnerOnly);
}

TEST(AtomicFile, LeavesNothingBehindWhenSomethingThrows)
{
    const test::TempDir dir;
    const auto path = dir.write("out.bin", "old");
    try
    {
        AtomicFile file(path, Overwrite::Allow);
        file.write(asBytes("half"));
        EXPECT_EQ(fileCount(dir.path()), 2U);
        throw std::runtime_error("in between");
    }
    catch (const std::runtime_error&)
    {
        EXPECT_EQ(fileCount(dir.path()), 1U);
    }
    EXPECT_EQ(contentOf(path), "old");
}

TEST(AtomicFile, MissingFolderIsAnOutputError)
{
    const test::TempDir dir;
    expectOutputError([&] { writeFileAtomically(dir.path() / "no" / "out.bin", {}, Overwrite::Refuse); },
                      "No such file or directory");
    expectOutputError([&] { writeFileAtomically("", {}, Overwrite::Refuse); }, "cannot write");
    expectOutputError([&] { writeFileAtomically(dir.path(), {}, Overwrite::Allow); }, "Is a directory");
}

TEST(AtomicFile, FullDiskIsAnOutputError)
{
    if (!std::filesystem::exists("/dev/full"))
    {
        GTEST_SKIP() << "no /dev/full";
    }
    expectOutputError([] { writeFileAtomically("/dev/full", asBytes("x"), Overwrite::Refuse); }, "No space left");
}

TEST(AtomicFile, DeviceIsWrittenDirectly)
{
    writeFileAtomically("/dev/null", asBytes("x"), Overwrite::Refuse);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, PipeIsWrittenDirectly)
{
    const test::TempDir dir;
    const auto path = dir.path() / "pipe";
    ASSERT_EQ(mkfifo(path.c_str(), S_IRUSR | S_IWUSR), 0);
    std::fstream reader(path); // open for reading and writing, so that opening does not wait
    writeFileAtomically(path, asBytes("through\n"), Overwrite::Refuse);
    std::string line;
    std::getline(reader, line);
    EXPECT_EQ(line, "through");
    EXPECT_EQ(fileCount(dir.path()), 1U);
}

TEST(AtomicFile, LinkStaysALink)
{
    const test::TempDir dir;
    const auto path = dir.write("real.bin", "old");
    const auto link = dir.path() / "link.bin";
    std::filesystem::create_symlink(path, link);
    writeFileAtomically(link, asBytes("new"), Overwrite::Allow);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(contentOf(path), "new");
}

TEST(AtomicFile, NameMayHaveTheLongestLength)
{
    const test::TempDir dir;
    const auto path = dir.path() / std::string(255, 'n');
    writeFileAtomically(path, asBytes("new"), Overwrite::Refuse);
    EXPECT_EQ(contentOf(path), "new");
}

TEST(AtomicFile, MoreFilesThanSlotsAreWritten)
{
    const test::TempDir dir;
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (int i = 0; i < 40; ++i)
    {
        files.push_back(std::make_unique<AtomicFile>(dir.path() / std::to_string(i), Overwrite::Refuse));
    }
    for (const auto& file : files)
    {
        file->commit();
    }
    EXPECT_EQ(fileCount(dir.path()), 40U);
}

void removeAndExit(int)
{
    removePendingFiles();
    _exit(3);
}

TEST(AtomicFile, InterruptRemovesTheTemporary)
{
    const test::TempDir dir;
    const auto path = dir.write("out.bin", "old");
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
        std::signal(SIGINT, removeAndExit);
        writeFileAtomically(dir.path() / "done.bin", asBytes("done"), Overwrite::Refuse);
        AtomicFile file(path, Overwrite::Allow);
        file.write(asBytes("half"));
        std::raise(SIGINT);
        _exit(1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_EQ(contentOf(path), "old");
    EXPECT_EQ(contentOf(dir.path() / "done.bin"), "done");
    EXPECT_EQ(fileCount(dir.path()), 2U);
}

// Runs what in a process of its own, which is killed then. Returns the process's number.
template <typename Work> pid_t runAndKill(const Work& work)
{
    const pid_t child = fork();
    if (child == 0)
    {
        work();
        std::raise(SIGKILL);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status));
    return child;
}

TEST(AtomicFile, WhatAKilledProcessLeftIsRemoved)
{
    const test::TempDir dir;
    runAndKill(
        [&]
        {
            AtomicFile file(dir.path() / "lost.bin", Overwrite::Refuse);
            file.write(asBytes("half"));
            std::raise(SIGKILL);
        });
    EXPECT_EQ(fileCount(dir.path()), 1U);
    writeFileAtomically(dir.path() / "out.bin", asBytes("whole"), Overwrite::Refuse);
    EXPECT_EQ(fileCount(dir.path()), 1U);
    EXPECT_EQ(contentOf(dir.path() / "out.bin"), "whole");
}

TEST(AtomicFile, WhatMayStillBeWrittenStays)
{
    const test::TempDir dir;
    const pid_t gone = runAndKill([] {});
    const auto temporary = [&](pid_t process, const std::string& end)
    { return dir.write(".zvo-" + std::to_string(process) + "-0" + end, "half"); };
    // Of a living process; of one whose number is unknown here, as in another container, but which holds its lock; and
    // what has another name.
    const auto living = temporary(getppid(), ".tmp");
    const auto locked = temporary(gone, ".tmp");
    const auto other = temporary(gone, ".tmp.png");
    const int descriptor = ::open(locked.c_str(), O_RDONLY);
    ASSERT_GE(descriptor, 0);
    ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
    writeFileAtomically(dir.path() / "out.bin", asBytes("whole"), Overwrite::Refuse);
    EXPECT_TRUE(std::filesystem::exists(living));
    EXPECT_TRUE(std::filesystem::exists(locked));
    EXPECT_TRUE(std::filesystem::exists(other));
    ::close(descriptor);
}

std::vector<std::filesystem::path> temporariesIn(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
        if (entry.path().extension() == ".tmp")
        {
            found.push_back(entry.path());
        }
    }
    return found;
}

TEST(AtomicFile, TemporaryThatWasRemovedBeforeItWasLockedIsMadeAgain)
{
    const test::TempDir dir;
    int removed_count = 0;
    g_before_lock = [&]
    {
        for (const auto& path : temporariesIn(dir.path()))
        {
            removed_count += std::filesystem::remove(path) ? 1 : 0;
        }
    };
    writeFileAtomically(dir.path() / "out.bin", asBytes("whole"), Overwrite::Refuse);
    EXPECT_EQ(removed_count, 1);
    EXPECT_EQ(contentOf(dir.path() / "out.bin"), "whole");
    EXPECT_EQ(fileCount(dir.path()), 1U);
}

TEST(AtomicFile, TemporaryThatAnotherHasLockedIsMadeAgain)
{
    const test::TempDir dir;
    std::filesystem::path taken;
    int descriptor = -1;
    g_before_lock = [&]
    {
        taken = temporariesIn(dir.path()).at(0);
        descriptor = ::open(taken.c_str(), O_RDONLY);
        ASSERT_EQ(syscall(SYS_flock, descriptor, LOCK_EX), 0);
    };
    AtomicFile file(dir.path() / "out.bin", Overwrite::Refuse);
    EXPECT_TRUE(std::filesystem::remove(taken)); // as the holder of the lock does
    ::close(descriptor);
    file.write(asBytes("whole"));
    file.commit();
    EXPECT_EQ(contentOf(dir.path() / "out.bin"), "whole");
    EXPECT_EQ(fileCount(dir.path()), 1U);
}

// As in a container, where each process may have the same number.
TEST(AtomicFile, TemporariesOfAnEarlierProcessWithThisNumberAreNotInTheWay)
{
    const test::TempDir other;
    const AtomicFile before(other.path() / "before.bin", Overwrite::Refuse);
    pid_t process = 0;
    unsigned number = 0;
    ASSERT_EQ(std::sscanf(temporariesIn(other.path()).at(0).filename().c_str(), ".zvo-%d-%u.tmp", &process, &number),
              2);
    EXPECT_EQ(process, getpid());
    const test::TempDir dir;
    const auto temporary = [&](unsigned i)
    { return dir.write(".zvo-" + std::to_string(process) + "-" + std::to_string(number + i) + ".tmp", "half"); };
    const auto held = temporary(1); // by a process of another container
    const int descriptor = ::open(held.c_str(), O_RDONLY);
    ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
    temporary(2);
    temporary(3);
    writeFileAtomically(dir.path() / "out.bin", asBytes("whole"), Overwrite::Refuse);
    EXPECT_EQ(contentOf(dir.path() / "out.bin"), "whole");
    EXPECT_EQ(contentOf(held), "half");
    EXPECT_EQ(fileCount(dir.path()), 2U);
    ::close(descriptor);
}

} // namespace

} // namespace zvo
