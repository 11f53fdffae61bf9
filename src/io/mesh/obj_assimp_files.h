// SPDX-License-Identifier: MIT
// The files that an OBJ file may name, in the form in which assimp reads them; for obj_file.cpp.
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

/// The path of the file that a name in another file refers to. Nothing if it lies outside of the folder.
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

    /// Names of files outside of the folder that were asked for.
    [[nodiscard]] const std::vector<std::string>& outside() const { return m_outside; }

    /// The first material file that was asked for and not found; nothing if any material file was found.
    [[nodiscard]] std::optional<std::string> missing() const
    {
        return m_material_files.empty() && !m_missing.empty() ? std::optional(m_missing.front()) : std::nullopt;
    }

private:
    Assimp::IOStream* keep(std::span<const std::uint8_t> bytes, bool own);

    const std::filesystem::path& m_path;
    std::span<const std::uint8_t> m_bytes;
    std::string m_name;
    std::vector<std::string> m_outside;
    std::vector<std::string> m_missing;
    std::set<std::filesystem::path> m_material_files;
    std::vector<std::unique_ptr<Assimp::IOStream>> m_streams;
};

} // namespace zvo
