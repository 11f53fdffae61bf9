// SPDX-License-Identifier: MIT
#include "core/base/byte_source.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"

#include <fmt/format.h>

namespace zvo
{

FileSource::FileSource(const std::filesystem::path& path, std::uint64_t size)
    : m_path(path), m_size(size), m_file(std::fopen(path.c_str(), "rb"))
{
    if (!m_file)
    {
        static_cast<void>(readFile(path)); // says why
        throw inputError(path, "cannot be opened; try again");
    }
}

void FileSource::read(std::uint64_t offset, std::span<std::byte> target)
{
    if (::fseeko(m_file.get(), static_cast<off_t>(offset), SEEK_SET) != 0 ||
        std::fread(target.data(), 1, target.size(), m_file.get()) != target.size())
    {
        throw inputError(m_path, fmt::format("byte {} cannot be read; {}", offset, kCutShort));
    }
}

} // namespace zvo
