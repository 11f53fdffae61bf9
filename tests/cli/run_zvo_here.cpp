// SPDX-License-Identifier: MIT
// Apart from run_zvo.cpp, so that tests of other programs need no commands of zvo.
#include "cli/run_zvo.h"

#include "common/session.h"
#include "common/signals.h"
#include "support/temp_dir.h"
#include "zvo/run_command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fcntl.h>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <unistd.h>

namespace zvo::test
{

namespace
{

// Kept from the first run to the end of all tests, as drivers may not be called from static destructors.
std::optional<cli::KeptDevices> g_devices;

class DevicesEnd : public testing::Environment
{
    void TearDown() override { g_devices.reset(); }
};
const testing::Environment* const g_devices_end = testing::AddGlobalTestEnvironment(new DevicesEnd);

// While it exists, a file stands for a descriptor of this process.
class Redirection
{
public:
    Redirection(int descriptor, const std::filesystem::path& file, int flags)
        : m_descriptor(descriptor), m_before(::dup(descriptor))
    {
        const int opened = ::open(file.c_str(), flags, 0600);
        if (m_before < 0 || opened < 0 || ::dup2(opened, descriptor) < 0)
        {
            throw std::runtime_error("cannot redirect to " + file.string());
        }
        ::close(opened);
    }
    ~Redirection()
    {
        std::fflush(nullptr);
        ::dup2(m_before, m_descriptor);
        ::close(m_before);
    }
    Redirection(const Redirection&) = delete;
    Redirection& operator=(const Redirection&) = delete;

private:
    int m_descriptor;
    int m_before;
};

class WorkingFolder
{
public:
    explicit WorkingFolder(const std::filesystem::path& folder) : m_before(std::filesystem::current_path())
    {
        std::filesystem::current_path(folder);
    }
    ~WorkingFolder() { std::filesystem::current_path(m_before); }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;

private:
    std::filesystem::path m_before;
};

} // namespace

Outcome runZvo(const std::filesystem::path& folder, const CommandLine& arguments,
               const std::vector<std::string>& environment)
{
    if (!environment.empty())
    {
        return ZvoProcess(folder, arguments, environment).wait();
    }
    if (!g_devices)
    {
        cli::installSignalHandlers();
        g_devices.emplace();
    }
    const std::vector<std::string> command = zvoCommand(arguments);
    std::vector<const char*> words;
    std::ranges::transform(command, std::back_inserter(words), &std::string::c_str);
    words.push_back(nullptr);
    const TempDir output;
    Outcome outcome;
    std::fflush(nullptr);
    {
        const WorkingFolder there(folder);
        const Redirection in(STDIN_FILENO, "/dev/null", O_RDONLY);
        const Redirection out(STDOUT_FILENO, output.path() / "out", O_WRONLY | O_CREAT);
        const Redirection err(STDERR_FILENO, output.path() / "err", O_WRONLY | O_CREAT);
        outcome.exit_code = cli::runCommandLine(static_cast<int>(command.size()), words.data());
    }
    outcome.out = contentOf(output.path() / "out");
    outcome.err = contentOf(output.path() / "err");
    return outcome;
}

} // namespace zvo::test
