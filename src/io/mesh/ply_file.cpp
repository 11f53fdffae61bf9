// SPDX-License-Identifier: MIT
#include "io/mesh/ply_file.h"

#include "core/base/finite.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/base/srgb.h"
#include "io/file/text_cursor.h"
#include "io/mesh/mesh_scene.h"
#include "io/mesh/ply_header.h"
#include "io/mesh/polygon_triangulator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

class PlyReader
{
public:
    PlyReader(const std::filesystem::path& path, std::string_view content, ImageDecoding decoding)
        : m_path(path), m_cursor(content), m_bytes_left(path), m_scene(path, decoding)
    {
    }

    Scene read()
    {
        m_header = readPlyHeader(m_cursor, m_path);
        if (!m_header.unknown_line.empty())
        {
            m_scene.warn(
                fmt::format("lines of the header without a keyword of PLY left out (\"{}\")", m_header.unknown_line));
        }
        readElements();
        if (!m_vertices.triangles.empty() || m_pieces.empty())
        {
            addPrimitive(0, std::move(m_vertices));
        }
        for (auto& [picture, piece] : m_pieces)
        {
            addPrimitive(picture, std::move(piece));
        }
        return m_scene.finish();
    }

private:
    [[nodiscard]] Error fail(const std::string& what) const { return plyError(m_path, what); }

    /// Reads the vertices first, as faces may stand before those that they name.
    void readElements()
    {
        const std::vector<PlyElement>& elements = m_header.elements;
        const auto vertices = std::find_if(elements.begin(), elements.end(), hasVertices);
        const TextCursor start = m_cursor;
        std::for_each(elements.begin(), vertices, [this](const PlyElement& element) { forEachItem(element, [] {}); });
        if (vertices != elements.end())
        {
            readVertices(*vertices);
        }
        const TextCursor behind_vertices = std::exchange(m_cursor, start);
        for (auto element = elements.begin(); element != elements.end(); ++element)
        {
            if (element == vertices)
            {
                m_cursor = behind_vertices;
            }
            else if (hasVertices(*element))
            {
                throw fail("it has several lists of vertices");
            }
            else
            {
                readFaces(*element);
            }
        }
    }

    static bool hasVertices(const PlyElement& element)
    {
        return element.name == "vertex" && element.count != 0 && !element.properties.empty();
    }

    /// Calls use after each item was read into m_values, m_indices and m_wedges. An element without properties has no
    /// data, whatever its count.
    template <typename Use> void forEachItem(const PlyElement& element, const Use& use)
    {
        for (std::uint64_t i = 0; !element.properties.empty() && i < element.count; ++i)
        {
            m_values = {};
            m_values[PlyAlpha] = 1.0;
            m_indices.clear();
            m_wedges.clear();
            std::ranges::for_each(element.properties, [this](const PlyProperty& property) { readProperty(property); });
            use();
        }
    }

    void readProperty(const PlyProperty& property)
    {
        if (property.count_type == nullptr)
        {
            const bool is_color = property.use >= PlyColor && property.use <= PlyAlpha;
            m_values[property.use] = number(*property.type) / (is_color ? property.type->channel_max : 1.0);
            return;
        }
        const double count = number(*property.count_type);
        if (!(count >= 0.0) || count != std::floor(count) || count > std::numeric_limits<std::uint32_t>::max())
        {
            throw fail(fmt::format("a list {} has {} entries", property.name, count));
        }
        std::vector<double>* const list = property.use == PlyCorners     ? &m_indices
                                          : property.use == PlyCornerUvs ? &m_wedges
                                                                         : nullptr;
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i)
        {
            const double value = number(*property.type);
            if (list != nullptr)
            {
                list->push_back(value);
            }
        }
    }

    void readVertices(const PlyElement& element)
    {
        if (!element.has(PlyPosition, 3))
        {
            throw fail("its vertices have no x, y and z");
        }
        const bool has_normals = element.has(PlyNormal, 3);
        const bool has_colors = element.has(PlyColor, 3);
        const bool has_uvs = element.has(PlyUv, 2);
        m_vertex_bytes = sizeof(glm::vec3) + sizeof(glm::uvec3) + (has_normals ? sizeof(glm::vec3) : 0) +
                         (has_colors ? sizeof(glm::vec4) : 0) + (has_uvs ? sizeof(glm::vec2) : 0); // as a point
        const auto addVertex = [&]
        {
            m_bytes_left.take(m_vertex_bytes);
            m_vertices.positions.emplace_back(values(PlyPosition));
            if (has_normals)
            {
                m_vertices.normals.push_back(unitOrZero(values(PlyNormal)));
            }
            if (has_colors)
            {
                m_vertices.colors.push_back(color());
            }
            if (has_uvs)
            {
                m_vertices.uvs.emplace_back(m_values[PlyUv], 1.0 - m_values[PlyUv + 1]); // v points up
            }
        };
        forEachItem(element, addVertex);
    }

    [[nodiscard]] glm::dvec3 values(std::size_t use) const
    {
        return {m_values[use], m_values[use + 1], m_values[use + 2]};
    }

    [[nodiscard]] glm::vec4 color() const { return srgbToLinear(glm::dvec4(values(PlyColor), m_values[PlyAlpha])); }

    void readFaces(const PlyElement& element)
    {
        const bool is_face = element.name == "face";
        const bool is_strip = element.name == "tristrips";
        if (!is_face && !is_strip && element.count != 0 && !element.properties.empty())
        {
            m_scene.warn(fmt::format("elements left out that are no vertices, faces or strips ({})", element.name));
        }
        m_face_colors = is_face && element.has(PlyColor, 3) && m_vertices.colors.empty();
        m_face_uvs = is_face && element.has(PlyCornerUvs, 1) && !m_header.pictures.empty();
        const bool is_split = m_face_colors || m_face_uvs || (is_face && element.has(PlyPicture, 1));
        if (is_face && element.has(PlyColor, 3) && !m_face_colors)
        {
            m_scene.warn("colours of faces left out, as the vertices have colours");
        }
        forEachItem(element, [&] { is_strip ? addStrips() : is_face ? addFace(is_split) : void(); });
    }

    /// is_split: its vertices become its own, with what only the face has.
    void addFace(bool is_split)
    {
        const std::size_t count = m_indices.size();
        m_corners.clear();
        m_corner_positions.clear();
        for (const double index : m_indices)
        {
            m_corners.push_back(vertexIndex(index));
            m_corner_positions.push_back(m_vertices.positions[m_corners.back()]);
        }
        if (m_face_uvs && m_wedges.size() != 2 * count && !m_wedges.empty())
        {
            m_scene.warn("texture coordinates of faces left out that are not two for each corner");
        }
        Primitive& piece = is_split ? m_pieces[pictureIndex()] : m_vertices;
        for (std::size_t i = 0; is_split && i < count; ++i)
        {
            m_corners[i] = addCorner(m_corners[i], i, piece);
        }
        m_bytes_left.take((count > 3 ? 2 * count : count / 3) * sizeof(glm::uvec3)); // PolygonTriangulator
        m_triangulator.triangulate(m_corner_positions, m_corners, piece.triangles);
    }

    [[nodiscard]] std::size_t pictureIndex() const
    {
        const double index = m_values[PlyPicture];
        return index > 0.0 && index < static_cast<double>(m_header.pictures.size()) ? static_cast<std::size_t>(index)
                                                                                    : 0;
    }

    std::uint32_t addCorner(std::uint32_t vertex, std::size_t corner, Primitive& piece)
    {
        m_bytes_left.take(m_vertex_bytes + sizeof(glm::vec4) + sizeof(glm::vec2));
        piece.positions.push_back(m_vertices.positions[vertex]);
        if (!m_vertices.normals.empty())
        {
            piece.normals.push_back(m_vertices.normals[vertex]);
        }
        if (m_face_colors || !m_vertices.colors.empty())
        {
            piece.colors.push_back(m_face_colors ? color() : m_vertices.colors[vertex]);
        }
        if (m_face_uvs && m_wedges.size() == 2 * m_indices.size())
        {
            piece.uvs.resize(piece.positions.size() - 1);
            piece.uvs.emplace_back(m_wedges[2 * corner], 1.0 - m_wedges[2 * corner + 1]);
        }
        else if (!m_vertices.uvs.empty())
        {
            piece.uvs.push_back(m_vertices.uvs[vertex]);
        }
        return static_cast<std::uint32_t>(piece.positions.size() - 1);
    }

    void addStrips()
    {
        std::size_t first = 0; // of the strip
        m_corners.clear();
        for (std::size_t i = 0; i < m_indices.size(); ++i)
        {
            const bool is_end = m_indices[i] == -1.0;
            m_corners.push_back(is_end ? kNone : vertexIndex(m_indices[i]));
            first = is_end ? i + 1 : first;
            if (i >= first + 2)
            {
                const std::size_t odd = (i - first) % 2;
                m_bytes_left.take(sizeof(glm::uvec3));
                m_vertices.triangles.emplace_back(m_corners[i - 2 + odd], m_corners[i - 1 - odd], m_corners[i]);
            }
        }
    }

    std::uint32_t vertexIndex(double value) const
    {
        const auto vertex_count = static_cast<double>(std::min<std::size_t>(m_vertices.positions.size(), kNone));
        if (!(value >= 0.0) || value >= vertex_count || value != std::floor(value))
        {
            throw fail(fmt::format("a face has the vertex {}, but there are {}", value, vertex_count));
        }
        return static_cast<std::uint32_t>(value);
    }

    /// The next number of the data. Numbers that are text are parsed in single precision, so they are rounded once.
    double number(const PlyType& type)
    {
        const bool is_text = m_header.encoding == PlyEncoding::Text;
        const std::string_view data = is_text ? m_cursor.word() : m_cursor.take(type.bytes);
        if (data.size() < (is_text ? 1 : type.bytes))
        {
            throw inputError(m_path, fmt::format("the PLY file ends before its last element; {}", kCutShort));
        }
        if (is_text)
        {
            const auto value = type.is_single ? std::optional<double>(parseSingle(data)) : parseNumber<double>(data);
            return value ? *value : throw fail(fmt::format("\"{}\" is not a number", data));
        }
        std::array<char, sizeof(double)> bytes;
        std::copy(data.begin(), data.end(), bytes.begin());
        if ((m_header.encoding == PlyEncoding::BigEndian) != (std::endian::native == std::endian::big))
        {
            std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
        }
        return type.value(bytes.data());
    }

    /// Adds a primitive with a material for its picture.
    void addPrimitive(std::size_t picture, Primitive piece)
    {
        Material material;
        if (picture < m_header.pictures.size() && piece.uvs.empty())
        {
            m_scene.warn(
                fmt::format("texture left out: {}: there are no texture coordinates", m_header.pictures[picture]));
        }
        else if (picture < m_header.pictures.size())
        {
            piece.uvs.resize(piece.positions.size());
            material.base_color_texture = m_scene.addTexture(m_header.pictures[picture], m_path, WrapMode::Repeat);
        }
        m_scene.add(std::move(piece), std::move(material));
    }

    const std::filesystem::path& m_path;
    TextCursor m_cursor;
    PlyHeader m_header;
    SceneBytesLeft m_bytes_left;
    std::array<double, PlyNothing + 1> m_values{}; // of the current vertex or face
    std::vector<double> m_indices;
    std::vector<double> m_wedges;
    std::vector<std::uint32_t> m_corners;
    std::vector<glm::vec3> m_corner_positions;
    PolygonTriangulator m_triangulator;
    std::size_t m_vertex_bytes = 0;
    bool m_face_colors = false;
    bool m_face_uvs = false;
    Primitive m_vertices;                      // and the triangles that share them
    std::map<std::size_t, Primitive> m_pieces; // of faces with vertices of their own, by picture
    MeshScene m_scene;
};

} // namespace

Scene readPly(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, ImageDecoding decoding)
{
    return PlyReader(path, asText(bytes), decoding).read();
}

} // namespace zvo
