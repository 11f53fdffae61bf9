// SPDX-License-Identifier: MIT
// Runs the program, as a shell would or in this process.
#pragma once

#include <concepts>
#include <filesystem>
#include <initializer_list>
#include <ostream>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace zvo::test
{

/// The words of a command line: a text that is split at its blanks or, where words have blanks, a list.
class CommandLine : public std::vector<std::string>
{
public:
    CommandLine(std::initializer_list<std::string> words) : vector(words) {}
    CommandLine(std::vector<std::string> words) : vector(std::move(words)) {}
    CommandLine(const std::convertible_to<std::string_view> auto& text) { split(text); }

private:
    void split(std::string_view text);
};

/// What a finished run of zvo left behind.
struct Outcome
{
    int exit_code = -1; // 128 + n: ended by signal n
    std::string out;
    std::string err;
};

/// A run of zvo that is going on.
class ZvoProcess
{
public:
    /// Starts zvo with arguments in folder, its output going to files elsewhere. environment: "NAME=value" beside this
    /// process's own variables. On the software device; with validation where the tests' devices have it.
    ZvoProcess(const std::filesystem::path& folder, const CommandLine& arguments,
               const std::vector<std::string>& environment = {});

    /// Starts any program. command: its name as it sees it, then its arguments, nothing added.
    ZvoProcess(const std::filesystem::path& program, const std::filesystem::path& folder,
               std::vector<std::string> command, const std::vector<std::string>& environment);
    ~ZvoProcess();
    ZvoProcess(const ZvoProcess&) = delete;
    ZvoProcess& operator=(const ZvoProcess&) = delete;

    void signal(int number) const;
    Outcome wait();

private:
    std::filesystem::path m_out;
    std::filesystem::path m_err;
    pid_t m_pid = -1;
};

/// The arguments of a run that uses a device: the one that they name, or else this one, or that of the tests. With
/// validation where the tests' devices have it.
std::vector<std::string> onTestDevice(std::vector<std::string> arguments, const std::string& device = "");

/// The command line of zvo: its name, arguments and, where a scene is rendered or voxelized, the tests' device.
std::vector<std::string> zvoCommand(std::vector<std::string> arguments);

/// Runs zvo to its end in folder. With an environment, "NAME=value" beside this process's own variables, in a process
/// of its own; otherwise here, on a device that these runs share: then this process has the folder, the standard
/// streams and the signal handlers of zvo meanwhile, and two runs cannot overlap.
Outcome runZvo(const std::filesystem::path& folder, const CommandLine& arguments,
               const std::vector<std::string>& environment = {});

/// The environment in which a software device has vectors of so many bits, and its own cache of kernels:
/// scripts/vectors says why.
std::vector<std::string> vectorsOf(int bits);

/// A command line that a program refuses.
struct WrongUse
{
    const char* name;
    int exit_code;
    CommandLine arguments;
    std::vector<std::string> words;            // in the message
    std::vector<std::string> environment = {}; // as of ZvoProcess
};

inline void PrintTo(const WrongUse& use, std::ostream* stream)
{
    *stream << use.name;
}

/// Expects that a run of a program failed with exit_code, and told why in one line that has each of words; it printed
/// nothing else.
void expectErrorLine(const Outcome& outcome, int exit_code, const std::vector<std::string>& words,
                     const std::string& program = "zvo");

/// All bytes of a file.
std::string contentOf(const std::filesystem::path& file);

/// Names of everything in folder, hidden files included, sorted.
std::vector<std::string> filesIn(const std::filesystem::path& folder);

} // namespace zvo::test
