// SPDX-License-Identifier: MIT
#include "core/base/read_file.h"

#include "zvo/error.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <system_error>

namespace zvo
{

namespace
{

constexpr std::size_t kFirstBlockBytes = std::size_t{1} << 16U;

Error readError(const std::filesystem::path& path, int code)
{
    return {ErrorCode::Input,
            fmt::format("cannot read {}: {}; check the path and its permissions", path.empty() ? "\"\"" : path.string(),
                        std::generic_category().message(code))};
}

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};

} // namespace

std::vector<std::uint8_t> readFile(const std::filesystem::path& path)
{
    std::error_code ignored;
    // Opening a pipe may wait for ever; those in /dev, standard input and the shell's, are open already.
    const bool is_pipe = std::filesystem::is_fifo(path, ignored) && !path.string().starts_with("/dev/");
    if (is_pipe || std::filesystem::is_character_file(path, ignored) || std::filesystem::is_block_file(path, ignored))
    {
        throw Error(ErrorCode::Input,
                    fmt::format("cannot read {}: it is a {}, not a file", path.string(), is_pipe ? "pipe" : "device"));
    }
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    if (!file)
    {
        throw readError(path, errno);
    }
    // The size is a hint: a pipe has none, and one byte more lets the first read see the end.
    std::error_code no_size;
    const std::uintmax_t size = std::filesystem::file_size(path, no_size);
    std::vector<std::uint8_t> bytes(no_size ? kFirstBlockBytes : static_cast<std::size_t>(size) + 1);
    std::size_t used = 0;
    while (true)
    {
        used += std::fread(bytes.data() + used, 1, bytes.size() - used, file.get());
        if (std::ferror(file.get()) != 0)
        {
            throw readError(path, errno);
        }
        if (used < bytes.size())
        {
            break;
        }
        bytes.resize(std::max(bytes.size() * 2, kFirstBlockBytes));
    }
    bytes.resize(used);
    return bytes;
}

std::vector<std::uint8_t> readFile(const std::filesystem::path& path, std::uint64_t first, std::uint64_t count)
{
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    if (!file || fseeko(file.get(), static_cast<off_t>(first), SEEK_SET) != 0)
    {
        throw readError(path, errno);
    }
    std::vector<std::uint8_t> bytes(count);
    if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    {
        throw Error(ErrorCode::Input,
                    fmt::format("cannot read {}: it has become shorter; load it again", path.string()));
    }
    return bytes;
}

} // namespace zvo
