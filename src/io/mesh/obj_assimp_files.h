// SPDX-License-Identifier: MIT
// The files that an OBJ file may name, and how assimp gets to see them; for obj_file.cpp.
#pragma once

#include <assimp/IOSystem.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace Assimp
{
class IOStream;
}

namespace zvo
{

/// The file that a name in another file means. Nothing where it leaves the folder.
std::optional<std::filesystem::path> fileBeside(const std::filesystem::path& scene, std::string name);

bool isFile(const std::filesystem::path& path);

/// The only files that assimp sees: the scene in memory under a plain name, and material files in its folder.
class SceneFiles final : public Assimp::IOSystem
{
public:
    SceneFiles(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, std::string name);
    ~SceneFiles() override;

    bool Exists(const char* file) const override { return file == m_name; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* file) override;

    /// Names that leave the folder.
    [[nodiscard]] const std::vector<std::string>& outside() const { return m_outside; }

    /// The first material file that is not there, where none is.
    [[nodiscard]] std::optional<std::string> missing() const
    {
        return m_material_files.empty() && !m_missing.empty() ? std::optional(m_missing.front()) : std::nullopt;
    }

private:
    Assimp::IOStream* keep(std::unique_ptr<Assimp::IOStream> file);

    const std::filesystem::path& m_path;
    std::span<const std::uint8_t> m_bytes;
    std::string m_name;
    std::vector<std::string> m_outside;
    std::vector<std::string> m_missing;
    std::set<std::filesystem::path> m_material_files;
    std::vector<std::unique_ptr<Assimp::IOStream>> m_streams;
};

} // namespace zvo
