// SPDX-License-Identifier: MIT
#include "vk/log_file.h"

#include <fmt/format.h>

#include <cstdio>

namespace zvo::vk
{

namespace
{

const char* severityName(LogSeverity severity)
{
    switch (severity)
    {
    case LogSeverity::Debug:
        return "debug";
    case LogSeverity::Info:
        return "info";
    case LogSeverity::Warning:
        return "warning";
    }
    return "";
}

void appendLine(void* path, LogSeverity severity, const char* message)
{
    const std::string line = fmt::format("{}: {}\n", severityName(severity), message);
    std::FILE* const file = std::fopen(static_cast<const char*>(path), "a");
    if (file != nullptr)
    {
        std::fputs(line.c_str(), file); // written at once by fclose
        std::fclose(file);
    }
}

} // namespace

LogCallback logToFile(const char* path)
{
    if (path == nullptr || *path == '\0')
    {
        return {};
    }
    return {.function = appendLine, .user = const_cast<char*>(path)};
}

} // namespace zvo::vk
