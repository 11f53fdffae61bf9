// SPDX-License-Identifier: MIT
#include "io/mesh/obj_file.h"

#include "core/base/finite.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/scene/scene_size.h"
#include "io/file/text_cursor.h"
#include "io/file/utf16.h"
#include "io/image/srgb.h"
#include "io/mesh/obj_assimp_files.h"
#include "io/mesh/polygon_triangulator.h"

#include <algorithm>
#include <array>
#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

/// Removes all other formats from an importer, as the file's format is known.
void keepObj(Assimp::Importer& importer)
{
    for (std::size_t i = importer.GetImporterCount(); i > 0; --i)
    {
        if (importer.GetImporterInfo(i - 1)->mFileExtensions != std::string_view("obj"))
        {
            Assimp::BaseImporter* other = importer.GetImporter(i - 1);
            importer.UnregisterLoader(other);
            delete other; // the caller owns it now
        }
    }
}

glm::vec3 toVec3(const aiVector3D& vector)
{
    return {vector.x, vector.y, vector.z};
}

WrapMode toWrapMode(int mode)
{
    return mode == aiTextureMapMode_Clamp    ? WrapMode::ClampToEdge
           : mode == aiTextureMapMode_Mirror ? WrapMode::MirroredRepeat
                                             : WrapMode::Repeat;
}

/// What a face of an OBJ file names, in the order of the numbers between its slashes.
struct ObjList
{
    std::string_view keyword; // of the lines that add to it
    std::string_view name;
    std::int64_t count = 0;
};

using ObjLists = std::array<ObjList, 3>;

/// Counts a line that adds to a list.
void countLine(std::string_view keyword, ObjLists& lists)
{
    for (ObjList& list : lists)
    {
        list.count += list.keyword == keyword ? 1 : 0;
    }
}

/// The fault of a corner of a face, such as "3/1/2"; empty: it has none. above: the lists up to its line; all: the
/// whole ones.
std::string findCornerFault(std::string_view corner, const ObjLists& above, const ObjLists& all)
{
    for (std::size_t i = 0; i < all.size() && !corner.empty(); ++i)
    {
        const std::string_view word = corner.substr(0, corner.find('/'));
        corner.remove_prefix(std::min(corner.size(), word.size() + 1));
        const std::optional<std::int64_t> number = parseNumber<std::int64_t>(word);
        const bool is_missing = word.empty() && i > 0;
        const bool fits = number && (*number > 0 ? *number <= all[i].count : *number < 0 && *number >= -above[i].count);
        if (!is_missing && !fits)
        {
            return fmt::format("has a face with the {} \"{}\", but there are {}", all[i].name, word, all[i].count);
        }
    }
    return {};
}

/// Says why an OBJ file cannot be read.
std::string findObjFault(std::string_view text)
{
    ObjLists all = {{{"v", "vertex"}, {"vt", "texture coordinate"}, {"vn", "normal"}}};
    ObjLists above = all;
    for (TextCursor lines(text); const std::optional<std::string_view> line = lines.line();)
    {
        countLine(TextCursor(*line).word(), all);
    }
    std::size_t number = 0;
    for (TextCursor lines(text); const std::optional<std::string_view> line = lines.line();)
    {
        ++number;
        TextCursor words(*line);
        const std::string_view keyword = words.word();
        countLine(keyword, above);
        for (auto corner = keyword == "f" ? words.word() : ""; !corner.empty(); corner = words.word())
        {
            if (const std::string fault = findCornerFault(corner, above, all); !fault.empty())
            {
                return fmt::format("line {} {}", number, fault);
            }
        }
    }
    return all[0].count == 0 ? "it has no vertices" : "its lines are not in order";
}

/// Makes a Scene of assimp's result, and checks every count and index.
class ObjReader
{
public:
    ObjReader(const std::filesystem::path& path, const aiScene& source, bool with_materials, ImageDecoding decoding)
        : m_path(path), m_source(source), m_with_materials(with_materials), m_decoding(decoding)
    {
    }

    Scene read()
    {
        checkSize();
        for (unsigned int i = 0; i < m_source.mNumMeshes; ++i)
        {
            const aiMesh* mesh = m_source.mMeshes[i];
            if (mesh == nullptr || mesh->mVertices == nullptr || (mesh->mNumFaces > 0 && mesh->mFaces == nullptr))
            {
                continue;
            }
            Primitive primitive;
            primitive.triangles = readTriangles(*mesh);
            if (primitive.triangles.empty())
            {
                continue;
            }
            readVertices(*mesh, primitive);
            primitive.material = material(mesh->mMaterialIndex);
            m_scene.instances.push_back({static_cast<std::uint32_t>(m_scene.primitives.size()), glm::mat4(1.0F)});
            m_scene.primitives.push_back(std::move(primitive));
        }
        return std::move(m_scene);
    }

    /// Warns once for each kind.
    void warn(const std::string& kind)
    {
        const std::string line = inputError(m_path, kind).what();
        if (std::find(m_scene.warnings.begin(), m_scene.warnings.end(), line) == m_scene.warnings.end())
        {
            m_scene.warnings.push_back(line);
        }
    }

private:
    /// Adds up the memory that read() will take, before it is taken.
    void checkSize() const
    {
        SceneSize size;
        for (unsigned int i = 0; i < m_source.mNumMeshes; ++i)
        {
            if (const aiMesh* mesh = m_source.mMeshes[i])
            {
                const std::size_t vertex_bytes = sizeof(glm::vec3) +
                                                 (mesh->mNormals != nullptr ? sizeof(glm::vec3) : 0) +
                                                 (mesh->mTextureCoords[0] != nullptr ? sizeof(glm::vec2) : 0) +
                                                 (mesh->mColors[0] != nullptr ? sizeof(glm::vec4) : 0);
                const std::size_t triangle_count = triangleCount(*mesh);
                ++size.instance_count;
                size.triangle_count += static_cast<double>(triangle_count);
                size.vertex_count = std::max(size.vertex_count, static_cast<double>(mesh->mNumVertices));
                size.bytes +=
                    static_cast<double>(mesh->mNumVertices * vertex_bytes + triangle_count * sizeof(glm::uvec3));
            }
        }
        checkSceneSize(m_path, size);
    }

    /// The most triangles that the faces of a mesh become.
    static std::size_t triangleCount(const aiMesh& mesh)
    {
        std::size_t count = 0;
        for (unsigned int i = 0; mesh.mFaces != nullptr && i < mesh.mNumFaces; ++i)
        {
            const unsigned int corners = mesh.mFaces[i].mNumIndices;
            count += corners <= 4 ? std::max(corners, 2U) - 2 : 2 * std::size_t{corners}; // PolygonTriangulator
        }
        return count;
    }

    std::vector<glm::uvec3> readTriangles(const aiMesh& mesh)
    {
        std::vector<glm::uvec3> triangles;
        triangles.reserve(triangleCount(mesh));
        for (unsigned int i = 0; i < mesh.mNumFaces; ++i)
        {
            const aiFace& face = mesh.mFaces[i];
            if (face.mNumIndices < 3 || face.mIndices == nullptr)
            {
                warn("points and lines left out, only triangles become voxels");
                continue;
            }
            const std::span corners(face.mIndices, face.mNumIndices);
            const unsigned int largest = *std::max_element(corners.begin(), corners.end());
            if (largest >= mesh.mNumVertices)
            {
                throw inputError(m_path, fmt::format("face {} has vertex {}, but there are {}; {}", i, largest,
                                                     mesh.mNumVertices, kExportAgain));
            }
            m_corners.clear();
            for (const unsigned int corner : corners)
            {
                m_corners.push_back(toVec3(mesh.mVertices[corner]));
            }
            m_triangulator.triangulate(m_corners, corners, triangles);
        }
        return triangles;
    }

    void readVertices(const aiMesh& mesh, Primitive& primitive) const
    {
        primitive.positions.reserve(mesh.mNumVertices);
        for (unsigned int i = 0; i < mesh.mNumVertices; ++i)
        {
            primitive.positions.push_back(toVec3(mesh.mVertices[i]));
        }
        for (unsigned int i = 0; mesh.mNormals != nullptr && i < mesh.mNumVertices; ++i)
        {
            primitive.normals.push_back(unitOrZero(toVec3(mesh.mNormals[i])));
        }
        for (unsigned int i = 0; mesh.mTextureCoords[0] != nullptr && i < mesh.mNumVertices; ++i)
        {
            // v points up in OBJ files.
            primitive.uvs.emplace_back(mesh.mTextureCoords[0][i].x, 1.0F - mesh.mTextureCoords[0][i].y);
        }
        for (unsigned int i = 0; mesh.mColors[0] != nullptr && i < mesh.mNumVertices; ++i)
        {
            const aiColor4D& color = mesh.mColors[0][i];
            primitive.colors.push_back(srgbToLinear(glm::dvec4(color.r, color.g, color.b, color.a)));
        }
    }

    /// Index into Scene::materials.
    std::uint32_t material(unsigned int index)
    {
        const bool is_default = !m_with_materials || index >= m_source.mNumMaterials ||
                                m_source.mMaterials[index] == nullptr ||
                                m_source.mMaterials[index]->GetName() == aiString(AI_DEFAULT_MATERIAL_NAME);
        const auto [known, is_new] = m_materials.emplace(is_default ? std::nullopt : std::optional(index), 0U);
        if (is_new)
        {
            known->second = static_cast<std::uint32_t>(m_scene.materials.size());
            Material loaded;
            loaded.name = "default";
            m_scene.materials.push_back(is_default ? loaded : readMaterial(*m_source.mMaterials[index]));
        }
        return known->second;
    }

    Material readMaterial(const aiMaterial& source)
    {
        Material material;
        material.name = source.GetName().C_Str();
        aiColor3D diffuse(1.0F, 1.0F, 1.0F);
        aiColor3D emission(0.0F, 0.0F, 0.0F);
        float opacity = 1.0F;
        source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
        source.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
        source.Get(AI_MATKEY_OPACITY, opacity);
        material.base_color = {factor(diffuse.r), factor(diffuse.g), factor(diffuse.b),
                               std::min(factor(opacity), 1.0F)};
        material.emission = {factor(emission.r), factor(emission.g), factor(emission.b)};
        material.alpha_mode = material.base_color.a < 1.0F ? AlphaMode::Blend : AlphaMode::Opaque;
        material.base_color_texture = texture(source, aiTextureType_DIFFUSE);
        const bool has_texture = !texturePath(source, aiTextureType_DIFFUSE).empty(); // even if it cannot be used
        if (has_texture && glm::vec3(material.base_color) == glm::vec3(0.0F))
        {
            material.base_color = glm::vec4(
                1.0F, 1.0F, 1.0F, material.base_color.a); // black would hide the texture, which exporters do not mean
        }
        if (material.emission != glm::vec3(0.0F))
        {
            material.emission_texture = texture(source, aiTextureType_EMISSIVE);
        }
        const std::string cut_out = texturePath(source, aiTextureType_OPACITY);
        if (!cut_out.empty() && cut_out == texturePath(source, aiTextureType_DIFFUSE))
        {
            material.alpha_mode = AlphaMode::Mask; // taken from the colour texture's own alpha
        }
        else if (!cut_out.empty())
        {
            warn("textures of transparency (map_d) left out; put them into the alpha of the colour textures");
        }
        return material;
    }

    float factor(float value) const
    {
        if (!(value >= 0.0F) || !std::isfinite(value))
        {
            throw inputError(m_path, fmt::format("a material has the factor {}, not in the range from 0 to 3.4e38; {}",
                                                 value, kExportAgain));
        }
        return value;
    }

    static std::string texturePath(const aiMaterial& source, aiTextureType type)
    {
        aiString path;
        return source.GetTexture(type, 0, &path) == aiReturn_SUCCESS ? path.C_Str() : "";
    }

    std::optional<std::uint32_t> texture(const aiMaterial& source, aiTextureType type)
    {
        const std::string name = texturePath(source, type);
        const std::optional<std::uint32_t> image = name.empty() ? std::nullopt : readImage(name);
        if (!image)
        {
            return std::nullopt;
        }
        int wrap_u = aiTextureMapMode_Wrap;
        int wrap_v = aiTextureMapMode_Wrap;
        source.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), wrap_u);
        source.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), wrap_v);
        m_scene.textures.push_back({*image, toWrapMode(wrap_u), toWrapMode(wrap_v)});
        return static_cast<std::uint32_t>(m_scene.textures.size() - 1);
    }

    /// Index into Scene::images, or nothing, with a warning, if the image cannot be used.
    std::optional<std::uint32_t> readImage(const std::string& name)
    {
        const auto [known, is_new] = m_images.emplace(name, std::nullopt);
        if (!is_new)
        {
            return known->second;
        }
        const std::optional<std::filesystem::path> file = fileBeside(m_path, name);
        if (!file)
        {
            warn(fmt::format("texture left out: {}: it leaves the file's folder; only files in it and below are read; "
                             "put it there and name it",
                             name));
            return std::nullopt;
        }
        if (!isFile(*file))
        {
            warn(fmt::format("texture left out: {}: there is no such file; put it there, or name another", name));
            return std::nullopt;
        }
        try
        {
            const std::vector<std::uint8_t> encoded = readFile(*file);
            m_scene.images.push_back(
                m_decoding == ImageDecoding::WhenLoaded
                    ? decodeImage(encoded, name, name, m_image_bytes_left)
                    : deferImage(encoded, {*file, 0, encoded.size()}, name, name, m_path, m_image_bytes_left));
            m_image_bytes_left -= m_scene.images.back().rgba.size();
        }
        catch (const Error& failure)
        {
            warn(fmt::format("texture left out: {}", failure.what()));
            return std::nullopt;
        }
        known->second = static_cast<std::uint32_t>(m_scene.images.size() - 1);
        return known->second;
    }

    const std::filesystem::path& m_path;
    const aiScene& m_source;
    bool m_with_materials;
    ImageDecoding m_decoding;
    std::uint64_t m_image_bytes_left = sceneBytesMax();
    PolygonTriangulator m_triangulator;
    std::vector<glm::vec3> m_corners; // of the current face
    Scene m_scene;
    std::map<std::optional<unsigned int>, std::uint32_t> m_materials;
    std::map<std::string, std::optional<std::uint32_t>> m_images;
};

} // namespace

Scene readObj(const std::filesystem::path& path, std::span<const std::uint8_t> content, ImageDecoding decoding)
{
    const std::optional<std::vector<std::uint8_t>> utf8 = asUtf8(content);
    const std::span<const std::uint8_t> bytes = utf8 ? *utf8 : content;
    const std::string name = path.stem().string() + ".obj";
    Assimp::Importer importer;
    keepObj(importer);
    auto* files = new SceneFiles(path, bytes, name); // the importer owns it from now on
    importer.SetIOHandler(files);
    const aiScene* source = importer.ReadFile(name, 0);
    if (!files->outside().empty())
    {
        throw inputError(path, fmt::format("the material file {} leaves the folder; only files in it and below are "
                                           "read; put it there and name it",
                                           files->outside().front()));
    }
    if (source == nullptr)
    {
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        throw inputError(path, fmt::format("not a valid OBJ file: {}; {}", findObjFault(text), kExportAgain));
    }
    const std::optional<std::string> missing = files->missing();
    ObjReader reader(path, *source, !missing, decoding);
    if (missing)
    {
        reader.warn(fmt::format("colours left out, as there is no material file {}", *missing));
    }
    return reader.read();
}

} // namespace zvo
