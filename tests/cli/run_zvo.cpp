// SPDX-License-Identifier: MIT
#include "cli/run_zvo.h"

#include "support/device.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace zvo::test
{

namespace
{

// What becomes of the child's files and signals.
struct SpawnSetup
{
    posix_spawn_file_actions_t actions{};
    posix_spawnattr_t attributes{};

    SpawnSetup()
    {
        posix_spawn_file_actions_init(&actions);
        posix_spawnattr_init(&attributes);
        sigset_t defaults;
        sigemptyset(&defaults);
        // Ignored in background jobs, or by runs in this process, and that would be inherited.
        sigaddset(&defaults, SIGINT);
        sigaddset(&defaults, SIGPIPE);
        sigaddset(&defaults, SIGXFSZ);
        posix_spawnattr_setsigdefault(&attributes, &defaults);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnSetup()
    {
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
    }
    SpawnSetup(const SpawnSetup&) = delete;
    SpawnSetup& operator=(const SpawnSetup&) = delete;
};

std::vector<char*> pointersTo(std::vector<std::string>& strings)
{
    std::vector<char*> pointers;
    std::transform(strings.begin(), strings.end(), std::back_inserter(pointers),
                   [](std::string& string) { return string.data(); });
    pointers.push_back(nullptr);
    return pointers;
}

std::vector<std::string> environmentWith(const std::vector<std::string>& more)
{
    std::vector<std::string> all = more;
    for (char** variable = environ; *variable != nullptr; ++variable)
    {
        const std::string text = *variable;
        const std::string name = text.substr(0, text.find('=') + 1);
        if (std::none_of(more.begin(), more.end(), [&](const std::string& own) { return own.starts_with(name); }))
        {
            all.push_back(text);
        }
    }
    return all;
}

std::filesystem::path newFile()
{
    std::string pattern = (std::filesystem::temp_directory_path() / "zvo-output-XXXXXX").string();
    const int descriptor = mkstemp(pattern.data());
    if (descriptor < 0)
    {
        throw std::runtime_error("cannot create " + pattern);
    }
    ::close(descriptor);
    return pattern;
}

} // namespace

void CommandLine::split(std::string_view text)
{
    std::istringstream words{std::string(text)};
    assign(std::istream_iterator<std::string>(words), {});
}

ZvoProcess::ZvoProcess(const std::filesystem::path& folder, const CommandLine& arguments,
                       const std::vector<std::string>& environment)
    : ZvoProcess(placeOf(ZVO_PROGRAM, "bin/zvo"), folder, zvoCommand(arguments), environment)
{
}

ZvoProcess::ZvoProcess(const std::filesystem::path& program, const std::filesystem::path& folder,
                       std::vector<std::string> command, const std::vector<std::string>& environment)
    : m_out(newFile()), m_err(newFile())
{
    std::vector<std::string> variables = environmentWith(environment);
    SpawnSetup setup;
    posix_spawn_file_actions_addopen(&setup.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&setup.actions, STDOUT_FILENO, m_out.c_str(), O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&setup.actions, STDERR_FILENO, m_err.c_str(), O_WRONLY, 0);
    posix_spawn_file_actions_addchdir_np(&setup.actions, folder.c_str());
    const int failure = posix_spawn(&m_pid, program.c_str(), &setup.actions, &setup.attributes,
                                    pointersTo(command).data(), pointersTo(variables).data());
    if (failure != 0)
    {
        throw std::system_error(failure, std::generic_category(), program.string());
    }
}

ZvoProcess::~ZvoProcess()
{
    if (m_pid > 0)
    {
        ::kill(m_pid, SIGKILL);
        ::waitpid(m_pid, nullptr, 0);
    }
    std::error_code ignored;
    std::filesystem::remove(m_out, ignored);
    std::filesystem::remove(m_err, ignored);
}

void ZvoProcess::signal(int number) const
{
    ::kill(m_pid, number);
}

Outcome ZvoProcess::wait()
{
    int status = 0;
    while (::waitpid(m_pid, &status, 0) < 0 && errno == EINTR)
    {
    }
    m_pid = -1;
    constexpr int kSignalExit = 128;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : kSignalExit + WTERMSIG(status), contentOf(m_out),
            contentOf(m_err)};
}

std::vector<std::string> zvoCommand(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "zvo");
    const bool runs = arguments.size() > 2 && (arguments[1] == "render" || arguments[1] == "voxelize");
    return runs ? onTestDevice(std::move(arguments)) : arguments;
}

std::vector<std::string> onTestDevice(std::vector<std::string> arguments, const std::string& device)
{
    if (std::find(arguments.begin(), arguments.end(), "--device") == arguments.end())
    {
        arguments.insert(arguments.end(), {"--device", device.empty() ? deviceOptions().device : device});
    }
    if (deviceOptions().validation)
    {
        arguments.emplace_back("--validation");
    }
    return arguments;
}

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<std::string> filesIn(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<std::string> vectorsOf(int bits)
{
    const std::filesystem::path build = placeOf(ZVO_PROGRAM, "bin/zvo").parent_path().parent_path();
    const std::filesystem::path kernels = build / ("kernels-" + std::to_string(bits));
    std::filesystem::create_directories(kernels);
    return {"LP_NATIVE_VECTOR_WIDTH=" + std::to_string(bits), "MESA_SHADER_CACHE_DIR=" + kernels.string()};
}

void expectErrorLine(const Outcome& outcome, int exit_code, const std::vector<std::string>& words,
                     const std::string& program)
{
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with(program + ": error: ")) << outcome.err;
    EXPECT_EQ(outcome.err.find_first_of("\n\r\t"), outcome.err.size() - 1) << outcome.err;
    for (const std::string& word : words)
    {
        EXPECT_NE(outcome.err.find(word), std::string::npos) << '"' << word << "\" is not in: " << outcome.err;
    }
}

} // namespace zvo::test
