// SPDX-License-Identifier: MIT
#include "common/command_line.h"

#include "common/output.h"
#include "common/words.h"
#include "zvo/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
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

// What an argument that looks like word might have been: an option of app, or one of its commands.
std::vector<std::string> namesLike(const CLI::App& app, std::string_view word)
{
    std::vector<std::string> names;
    if (word.starts_with('-'))
    {
        for (const CLI::Option* option : app.get_options())
        {
            std::ranges::transform(option->get_lnames(), std::back_inserter(names),
                                   [](const std::string& name) { return "--" + name; });
        }
        return names;
    }
    const std::vector<const CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
    std::ranges::transform(commands, std::back_inserter(names), &CLI::App::get_name);
    return names;
}

// Names the first argument that no option has taken.
std::string strangerText(const CLI::App& app)
{
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const std::string argument = app.remaining(true).front();
    const std::string word = argument.substr(0, argument.find('='));
    const char* const what = word.starts_with('-') && !chosen.empty() ? "there is no option"
                             : !chosen.empty()                        ? "not understood:"
                             : commandNames(app).empty()              ? "there is no option"
                                                                      : "there is no command or option";
    return fmt::format("{} {}{}", what, word,
                       suggestion(word, namesLike(chosen.empty() ? app : *chosen.front(), word)));
}

// "help" as the first word, and a command behind it, mean --help.
std::vector<std::string> withoutHelpWord(const CLI::App& app, std::vector<std::string> words)
{
    if (words.empty() || words.front() != "help" || commandNames(app).empty())
    {
        return words;
    }
    if (words.size() == 1)
    {
        return {"--help"};
    }
    const std::vector<std::string> names = namesLike(app, words[1]);
    if (words.size() > 2 || std::ranges::find(names, words[1]) == names.end())
    {
        throw usageError(app, fmt::format("help takes one command, {}{}", commandNames(app),
                                          words.size() > 2 ? "" : suggestion(words[1], names)));
    }
    return {words[1], "--help"};
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
    what.erase(what.find_last_not_of("\n.") + 1);
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const std::string command = chosen.empty() ? "" : " " + chosen.front()->get_name();
    return {ErrorCode::Usage, fmt::format("{}; see {}{} --help", what, app.get_name(), command)};
}

bool parse(CLI::App& app, int argc, const char* const* argv)
{
    const std::string commands = commandNames(app);
    std::vector<std::string> words = withoutHelpWord(app, {argv + std::min(argc, 1), argv + argc});
    try
    {
        std::ranges::reverse(words); // as CLI11 takes them
        app.parse(std::move(words));
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
    catch (const CLI::RequiredError& error) // a name may be missing because it was mistyped
    {
        throw usageError(app, app.remaining(true).empty() ? error.what() : strangerText(app));
    }
    catch (const CLI::ParseError& error)
    {
        const std::string what = error.what();
        const std::size_t twice = what.find(": At Most 1 required"); // as CLI11 says it
        throw usageError(app, twice == std::string::npos ? what : what.substr(0, twice) + " is given more than once");
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
