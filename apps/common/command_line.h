// SPDX-License-Identifier: MIT
// How the programs read their command lines: help, version, errors, and the choice of a command.
#pragma once

#include "zvo/error.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace zvo::cli
{

/// Sets the form of a program's help, its last lines, and --version. app: has its name.
void describeProgram(CLI::App& app, const char* footer);

/// A usage error that points to the help of the program, or of the command that was chosen.
Error usageError(const CLI::App& app, std::string what);

/// Reads the arguments; of a program with commands, "help COMMAND" means "COMMAND --help". Prints the text that --help
/// or --version asks for and returns false, or returns true. Throws usageError(), one line, for anything that is not
/// understood, and where a command is missing; an Error that a callback of app throws becomes one.
bool parse(CLI::App& app, int argc, const char* const* argv);

/// The commands of a program.
class Commands
{
public:
    /// app: the program; must outlive this.
    explicit Commands(CLI::App& app) : m_app(app) {}

    /// Adds a command. footer: the last lines of its help. declare: adds its options to an app. perform: does what they
    /// ask for.
    template <typename Options>
    void add(const char* name, const char* about, const char* footer, void (*declare)(CLI::App&, Options&),
             void (*perform)(const Options&))
    {
        const auto options = std::make_shared<Options>();
        CLI::App* const command = m_app.add_subcommand(name, about);
        command->footer(footer);
        declare(*command, *options);
        m_runs[command] = [options, perform] { perform(*options); };
    }

    /// Does what the command line asks for. Throws as parse() does, and what the command throws.
    void run(int argc, const char* const* argv);

private:
    CLI::App& m_app;
    std::map<const CLI::App*, std::function<void()>> m_runs;
};

} // namespace zvo::cli
