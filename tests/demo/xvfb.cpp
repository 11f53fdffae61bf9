// SPDX-License-Identifier: MIT
#include "demo/xvfb.h"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT: POSIX

namespace zvo::test
{

namespace
{

constexpr int kDisplayDescriptor = 3; // to which the server writes its number
constexpr int kPatienceMs = 30'000;

// A line, without its end, that arrives in time.
std::string readLine(int descriptor)
{
    std::string line;
    for (;;)
    {
        pollfd wait = {descriptor, POLLIN, 0};
        char letter = 0;
        if (::poll(&wait, 1, kPatienceMs) != 1 || ::read(descriptor, &letter, 1) != 1)
        {
            return {};
        }
        if (letter == '\n')
        {
            return line;
        }
        line += letter;
    }
}

} // namespace

Xvfb::Xvfb()
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    {
        return;
    }
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    // A descriptor that is its own copy would be closed.
    const int source =
        ends[1] == kDisplayDescriptor ? ::fcntl(ends[1], F_DUPFD_CLOEXEC, kDisplayDescriptor + 1) : ends[1];
    posix_spawn_file_actions_adddup2(&actions, source, kDisplayDescriptor);
    std::array arguments = {std::string("Xvfb"),      std::string("-displayfd"), std::to_string(kDisplayDescriptor),
                            std::string("-screen"),   std::string("0"),          std::string("1400x1000x24"),
                            std::string("-nolisten"), std::string("tcp"),        std::string("-noreset")};
    std::array<char*, arguments.size() + 1> pointers{};
    for (std::size_t i = 0; i < arguments.size(); ++i)
    {
        pointers[i] = arguments[i].data();
    }
    const int failure = posix_spawnp(&m_pid, "Xvfb", &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(source);
    if (source != ends[1])
    {
        ::close(ends[1]);
    }
    if (failure != 0)
    {
        m_pid = -1;
    }
    else
    {
        const std::string number = readLine(ends[0]);
        m_display = number.empty() ? number : ":" + number;
    }
    ::close(ends[0]);
}

Xvfb::~Xvfb()
{
    if (m_pid > 0)
    {
        ::kill(m_pid, SIGTERM);
        ::waitpid(m_pid, nullptr, 0);
    }
}

} // namespace zvo::test
