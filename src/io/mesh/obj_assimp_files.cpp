// SPDX-License-Identifier: MIT
#include "io/mesh/obj_assimp_files.h"

#include "core/base/read_file.h"
#include "io/file/folder_bounds.h"
#include "io/file/utf16.h"

#include <algorithm>
#include <assimp/MemoryIOWrapper.h>
#include <system_error>
#include <utility>

namespace zvo
{

std::optional<std::filesystem::path> fileBeside(const std::filesystem::path& scene, std::string name)
{
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::filesystem::path folder = scene.has_parent_path() ? scene.parent_path() : ".";
    const std::filesystem::path file = folder / name;
    return liesBelow(folder, file) ? std::optional(file) : std::nullopt;
}

bool isFile(const std::filesystem::path& path)
{
    std::error_code absent;
    return std::filesystem::is_regular_file(path, absent);
}

SceneFiles::SceneFiles(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, std::string name)
    : m_path(path), m_bytes(bytes), m_name(std::move(name))
{
}

SceneFiles::~SceneFiles() = default;

Assimp::IOStream* SceneFiles::Open(const char* file, const char* /*mode*/)
{
    if (file == m_name)
    {
        return keep(m_bytes, false);
    }
    const std::optional<std::filesystem::path> beside = fileBeside(m_path, file);
    if (!beside)
    {
        m_outside.push_back(file);
        return nullptr;
    }
    if (!isFile(*beside))
    {
        m_missing.push_back(file);
        return nullptr;
    }
    // A scene may name it several times; only the first one loads its materials.
    const bool is_new = m_material_files.insert(*beside).second;
    std::vector<std::uint8_t> content = is_new ? readFile(*beside) : std::vector<std::uint8_t>();
    if (auto utf8 = asUtf8(content))
    {
        content = *std::move(utf8);
    }
    constexpr std::size_t kBytesMin = 16; // assimp refuses files of very few bytes
    content.resize(std::max(content.size(), kBytesMin), '\n');
    auto* const copy = new std::uint8_t[content.size()]; // the stream owns it from now on
    std::copy(content.begin(), content.end(), copy);
    return keep({copy, content.size()}, true);
}

void SceneFiles::Close(Assimp::IOStream* file)
{
    std::erase_if(m_streams, [file](const auto& stream) { return stream.get() == file; });
}

// Keeps the file, as assimp does not close files that it fails to read.
Assimp::IOStream* SceneFiles::keep(std::span<const std::uint8_t> bytes, bool own)
{
    return m_streams.emplace_back(std::make_unique<Assimp::MemoryIOStream>(bytes.data(), bytes.size(), own)).get();
}

} // namespace zvo
