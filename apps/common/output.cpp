// SPDX-License-Identifier: MIT
#include "common/output.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <cctype>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <unistd.h>

namespace zvo::cli
{

Output::Output(const std::string& target, bool overwrite)
{
    if (target != "-")
    {
        m_file = std::make_unique<AtomicFile>(target, overwrite ? Overwrite::Allow : Overwrite::Refuse);
    }
}

void Output::write(std::span<const std::byte> bytes)
{
    if (m_file)
    {
        m_file->write(bytes);
        return;
    }
    while (!bytes.empty())
    {
        const ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR)
        {
            throw Error(ErrorCode::Output,
                        fmt::format("cannot write to standard output: {}", std::generic_category().message(errno)));
        }
        bytes = bytes.subspan(written < 0 ? 0 : static_cast<std::size_t>(written));
    }
}

void Output::finish()
{
    if (m_file)
    {
        m_file->commit();
    }
}

std::optional<Output> openReport(const OutputOptions& options)
{
    return options.json.empty() ? std::nullopt : std::optional<Output>(std::in_place, options.json, options.overwrite);
}

void checkPaths(const OutputOptions& options, std::span<const std::filesystem::path> inputs)
{
    const auto same = [](const std::filesystem::path& a, const std::filesystem::path& b)
    {
        std::error_code ignored;
        const auto placeOf = [&ignored](const std::filesystem::path& path)
        { return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored); };
        return placeOf(a) == placeOf(b) || std::filesystem::equivalent(a, b, ignored);
    };
    const bool both_to_stdout = options.path == "-" && options.json == "-";
    const bool both_to_files = options.path != "-" && options.json != "-" && !options.json.empty();
    if (both_to_stdout || (both_to_files && same(options.path, options.json)))
    {
        throw Error(ErrorCode::Usage, fmt::format("-o and --json both name {}; they need two places", options.path));
    }
    for (const std::filesystem::path& input : inputs)
    {
        for (const std::string& output : {options.path, options.json})
        {
            if (!output.empty() && output != "-" && same(output, input))
            {
                throw Error(ErrorCode::Usage, fmt::format("{} is an input and would be overwritten; name another "
                                                          "output",
                                                          output));
            }
        }
    }
}

std::string extensionOf(const std::string& path)
{
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& letter : extension)
    {
        letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    }
    return extension;
}

} // namespace zvo::cli
