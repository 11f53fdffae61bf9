// SPDX-License-Identifier: MIT
// How the programs read their command lines: help, version, errors, and the choice of a command.
#pragma once

#include "zvo/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace zvo::cli
{

/// Sets the form of a program's help, its last lines, and --version. app: has its name.
void describeProgram(CLI::App& app, const char* footer);

/// A usage error that points to the help of the program, or of the command that was chosen.
Error usageError(const CLI::App& app, std::string what);

/// Reads the arguments. Returns the text that --help or --version asks for, or nothing. Throws Error{Usage}, one line,
/// for anything that is not understood, and where a command is missing.
std::optional<std::string> parse(CLI::App& app, int argc, const char* const* argv);

/// A command of a program. Command: a std::variant of the options of each, and a std::string for texts.
template <typename Command> struct CommandEntry
{
    const char* name;
    const char* about;
    const char* footer; // the last lines of its help
    Command options;    // as they are where nothing is given
};

/// Reads the command line of a program that has these commands. add(app, options): adds the options of a command, for
/// each type that Command has. Returns the options of the command that was chosen, or a text that is printed (help,
/// version). Throws as parse() does.
template <typename Command, typename Add>
Command parseCommand(CLI::App& app, std::vector<CommandEntry<Command>> commands, const Add& add, int argc,
                     const char* const* argv)
{
    for (CommandEntry<Command>& command : commands)
    {
        CLI::App* const command_app = app.add_subcommand(command.name, command.about);
        command_app->footer(command.footer);
        const auto add_to_app = [&]<typename Options>(Options& options)
        {
            if constexpr (!std::is_same_v<Options, std::string>)
            {
                add(*command_app, options);
            }
        };
        std::visit(add_to_app, command.options);
    }
    if (const std::optional<std::string> text = parse(app, argc, argv))
    {
        return *text;
    }
    return std::ranges::find(commands, app.get_subcommands().front()->get_name(), &CommandEntry<Command>::name)
        ->options;
}

} // namespace zvo::cli
