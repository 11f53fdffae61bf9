// SPDX-License-Identifier: MIT
#include "common/command_line.h"

#include "common/output.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr std::size_t kHelpColumn = 34;

// The names of all commands of a program: "a, b or c".
std::string commandNames(const CLI::App& app)
{
    const std::vector<const CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
    std::string names;
    for (std::size_t i = 0; i < commands.size(); ++i)
    {
        const char* const before = i == 0 ? "" : i + 1 == commands.size() ? " or " : ", ";
        names += before + commands[i]->get_name();
    }
    return names;
}

// Names the arguments that no option has taken.
std::string strangerText(const CLI::App& app)
{
    const std::vector<std::string> strangers = app.remaining(true);
    const char* const what = !app.get_subcommands().empty() ? "not understood:"
                             : commandNames(app).empty()    ? "there is no option"
                                                            : "there is no command or option";
    return fmt::format("{} {}", what, fmt::join(strangers, " "));
}

} // namespace

void describeProgram(CLI::App& app, const char* footer)
{
    app.get_formatter()->column_width(kHelpColumn);
    app.footer(footer);
    app.set_version_flag("--version", app.get_name() + " " ZVO_VERSION_TEXT, "print the version");
}

Error usageError(const CLI::App& app, std::string what)
{
    while (!what.empty() && (what.back() == '\n' || what.back() == '.'))
    {
        what.pop_back();
    }
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return {ErrorCode::Usage, fmt::format("{}; see {}{} --help", what, app.get_name(), command)};
}

bool parse(CLI::App& app, int argc, const char* const* argv)
{
    const std::string commands = commandNames(app);
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::CallForHelp&)
    {
        Output("-", true).write(app.help());
        return false;
    }
    catch (const CLI::CallForVersion& version)
    {
        Output("-", true).write(std::string(version.what()) + "\n");
        return false;
    }
    catch (const CLI::ExtrasError&)
    {
        throw usageError(app, strangerText(app));
    }
    catch (const CLI::ParseError& error)
    {
        throw usageError(app, error.what());
    }
    catch (const Error& error)
    {
        throw usageError(app, error.what());
    }
    if (!commands.empty() && app.get_subcommands().empty())
    {
        throw usageError(app, "a command is missing: " + commands);
    }
    return true;
}

void Commands::run(int argc, const char* const* argv)
{
    if (parse(m_app, argc, argv))
    {
        m_runs.at(m_app.get_subcommands().front())();
    }
}

} // namespace zvo::cli
