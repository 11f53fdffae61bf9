// SPDX-License-Identifier: MIT
#include "common/output.h"

#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <unistd.h>

namespace zvo::cli
{

namespace
{

bool isFile(const std::string& output)
{
    return !output.empty() && output != "-";
}

bool areSame(const std::filesystem::path& a, const std::filesystem::path& b)
{
    std::error_code ignored;
    const auto canonical = [](const std::filesystem::path& path)
    {
        std::error_code failure; // as in a folder that nobody may look into
        const std::filesystem::path whole = std::filesystem::absolute(path, failure);
        std::filesystem::path found = std::filesystem::weakly_canonical(whole, failure);
        return failure ? whole.lexically_normal() : found;
    };
    return canonical(a) == canonical(b) || std::filesystem::equivalent(a, b, ignored);
}

} // namespace

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
    const bool both_to_stdout = options.path == "-" && options.json == "-";
    if (both_to_stdout || (isFile(options.path) && isFile(options.json) && areSame(options.path, options.json)))
    {
        throw Error(ErrorCode::Usage, fmt::format("-o and --json both name {}; they need two places", options.path));
    }
    checkOutputs(std::array{options.path, options.json}, inputs);
}

void checkOutputs(std::span<const std::string> outputs, std::span<const std::filesystem::path> inputs)
{
    for (const std::string& output : outputs)
    {
        const auto isOutput = [&](const std::filesystem::path& other) { return areSame(output, other); };
        if (isFile(output) && std::ranges::any_of(inputs, isOutput))
        {
            throw Error(ErrorCode::Usage,
                        fmt::format("{} is an input and would be overwritten; name another output", output));
        }
        if (isFile(output) && std::ranges::count_if(outputs, isOutput) > 1)
        {
            throw Error(ErrorCode::Usage, fmt::format("{} is named for two outputs; they need two places", output));
        }
    }
}

void checkPictureName(std::string_view option, const std::string& path, std::span<const std::string_view> extensions)
{
    if (std::ranges::find(extensions, extensionOf(path)) == extensions.end())
    {
        throw Error(ErrorCode::Usage, fmt::format("{} {}: pictures are files that end in {}; name it so", option, path,
                                                  fmt::join(extensions, ", ")));
    }
}

bool holdsRadiance(const std::string& path)
{
    const std::string extension = extensionOf(path);
    return extension == ".exr" || extension == ".hdr";
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
