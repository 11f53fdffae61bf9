// SPDX-License-Identifier: MIT
#pragma once

#include "io/file/text_cursor.h"
#include "io/mesh/mesh_scene.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace zvo
{

/// A picture that a material file names, and where it lies: texture coordinates are scaled, then moved.
struct MtlTexture
{
    std::string name = {}; // empty: none
    std::filesystem::path named_in;
    WrapMode wrap = WrapMode::Repeat;
    glm::vec3 scale{1.0F}; // the third number is that of solid textures
    glm::vec3 offset{0.0F};
};

/// What a material file says about a material.
struct MtlMaterial
{
    glm::vec3 color{1.0F};
    std::optional<glm::vec3> emission;
    std::optional<float> opacity;      // "d"
    std::optional<float> transparency; // "Tr"
    MtlTexture color_texture;
    MtlTexture emission_texture;
    MtlTexture cut_out;
};

/// The material files of an OBJ file. After: Diane Ramey et al., MTL material format, Wavefront, 1995, and what
/// exporters write beside it. Statements that have no effect on voxels are left out.
class MtlFiles
{
public:
    /// path: of the OBJ file.
    MtlFiles(const std::filesystem::path& path, MeshScene& scene) : m_path(path), m_scene(scene) {}

    /// Reads the files of a line "mtllib": one whose name may have spaces, or several. Where several files define a
    /// material, the first counts.
    void read(std::string_view names);

    /// Adds a primitive to the scene, with a material, which is white if no file defines it. The v of its texture
    /// coordinates points up; they are moved to where the material's textures lie.
    void add(Primitive primitive, const std::string& name);

private:
    bool readFileNamed(const std::string& name);
    void readStatement(std::string_view line, const std::filesystem::path& file, MtlMaterial& material);
    std::optional<glm::vec3> readColor(std::string_view line, TextCursor words);
    std::optional<float> readFraction(std::string_view line, TextCursor words);
    MtlTexture readTexture(TextCursor words, const std::filesystem::path& file);

    const std::filesystem::path& m_path;
    MeshScene& m_scene;
    bool m_all_found = true;
    std::set<std::string> m_names; // that were looked for
    std::set<std::filesystem::path> m_files;
    std::map<std::string, MtlMaterial> m_materials;
};

} // namespace zvo
