// SPDX-License-Identifier: MIT
#include "io/mesh/obj_assimp_files.h"

#include "core/base/read_file.h"
#include "io/file/folder_bounds.h"
#include "io/file/utf16.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstring>
#include <system_error>
#include <utility>

namespace zvo
{

namespace
{

/// A file in memory, for assimp.
class MemoryStream final : public Assimp::IOStream
{
public:
    explicit MemoryStream(std::span<const std::uint8_t> bytes) : m_bytes(bytes) {}
    explicit MemoryStream(std::vector<std::uint8_t> storage) : m_storage(std::move(storage)), m_bytes(m_storage) {}

    std::size_t Read(void* target, std::size_t size, std::size_t count) override
    {
        const std::size_t whole = size == 0 ? 0 : std::min(count, (m_bytes.size() - m_at) / size);
        if (whole != 0)
        {
            std::memcpy(target, m_bytes.data() + m_at, whole * size);
        }
        m_at += whole * size;
        return whole;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override
    {
        const std::size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? m_at : m_bytes.size();
        if (offset > m_bytes.size() - base)
        {
            return aiReturn_FAILURE;
        }
        m_at = base + offset;
        return aiReturn_SUCCESS;
    }
    [[nodiscard]] std::size_t Tell() const override { return m_at; }
    [[nodiscard]] std::size_t FileSize() const override { return m_bytes.size(); }
    void Flush() override {}

private:
    std::vector<std::uint8_t> m_storage;
    std::span<const std::uint8_t> m_bytes;
    std::size_t m_at = 0;
};

/// A material file with padding, because assimp refuses files of very few bytes.
std::vector<std::uint8_t> padded(std::vector<std::uint8_t> material_file)
{
    constexpr std::size_t kBytesMin = 16;
    material_file.resize(std::max(material_file.size(), kBytesMin), '\n');
    return material_file;
}

} // namespace

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
        return keep(std::make_unique<MemoryStream>(m_bytes));
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
    return keep(std::make_unique<MemoryStream>(padded(std::move(content))));
}

void SceneFiles::Close(Assimp::IOStream* file)
{
    std::erase_if(m_streams, [file](const auto& stream) { return stream.get() == file; });
}

// Keeps the file, as assimp does not close files that it fails to read.
Assimp::IOStream* SceneFiles::keep(std::unique_ptr<Assimp::IOStream> file)
{
    m_streams.push_back(std::move(file));
    return m_streams.back().get();
}

} // namespace zvo
