// SPDX-License-Identifier: MIT
#include "io/mesh/ply_file.h"

#include "core/base/input_error.h"
#include "core/scene/scene_size.h"
#include "io/file/text_cursor.h"
#include "io/image/srgb.h"
#include "io/mesh/ply_header.h"
#include "io/mesh/polygon_triangulator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
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

/// The divisor of a colour channel of that type.
double channelMax(PlyType type)
{
    return type == PlyType::UInt8    ? std::numeric_limits<std::uint8_t>::max()
           : type == PlyType::UInt16 ? std::numeric_limits<std::uint16_t>::max()
                                     : 1.0;
}

/// The meaning of a number of a vertex, as an index into VertexValues.
enum class Use : std::size_t
{
    X,
    Y,
    Z,
    NormalX,
    NormalY,
    NormalZ,
    Red,
    Green,
    Blue,
    Alpha,
    Nothing
};

constexpr std::size_t kUseCount = static_cast<std::size_t>(Use::Nothing);
using VertexValues = std::array<double, kUseCount>;

Use useOf(std::string_view name)
{
    constexpr std::array<std::pair<std::string_view, Use>, 17> kNames = {{{"x", Use::X},
                                                                          {"y", Use::Y},
                                                                          {"z", Use::Z},
                                                                          {"nx", Use::NormalX},
                                                                          {"ny", Use::NormalY},
                                                                          {"nz", Use::NormalZ},
                                                                          {"red", Use::Red},
                                                                          {"green", Use::Green},
                                                                          {"blue", Use::Blue},
                                                                          {"alpha", Use::Alpha},
                                                                          {"r", Use::Red},
                                                                          {"g", Use::Green},
                                                                          {"b", Use::Blue},
                                                                          {"a", Use::Alpha},
                                                                          {"diffuse_red", Use::Red},
                                                                          {"diffuse_green", Use::Green},
                                                                          {"diffuse_blue", Use::Blue}}};
    const auto found =
        std::find_if(kNames.begin(), kNames.end(), [name](const auto& entry) { return entry.first == name; });
    return found != kNames.end() ? found->second : Use::Nothing;
}

struct Polygon
{
    std::size_t triangles_before = 0; // in the file
    std::size_t vertex_count = 0;
};

class PlyReader
{
public:
    PlyReader(const std::filesystem::path& path, std::string_view content)
        : m_path(path), m_cursor(content), m_bytes_left(path)
    {
    }

    Primitive read(std::vector<std::string>& notes)
    {
        const PlyHeader header = readPlyHeader(m_cursor, m_path);
        if (!header.unknown_line.empty())
        {
            notes.push_back(
                fmt::format("lines of the header without a keyword of PLY left out (\"{}\")", header.unknown_line));
        }
        m_encoding = header.encoding;
        m_data = m_cursor.rest();
        for (const PlyElement& element : header.elements)
        {
            readElement(element);
        }
        checkIndices();
        cutPolygons();
        if (m_triangles.empty() && m_polygons.empty() && !m_primitive.positions.empty())
        {
            notes.emplace_back("a cloud of points, without faces; only triangles become voxels");
        }
        m_primitive.triangles = std::move(m_triangles);
        return std::move(m_primitive);
    }

private:
    [[nodiscard]] Error fail(const std::string& what) const { return plyError(m_path, what); }

    [[nodiscard]] Error cutShort() const
    {
        return inputError(m_path, fmt::format("the PLY file ends before its last element; {}", kCutShort));
    }

    void readElement(const PlyElement& element)
    {
        if (element.properties.empty())
        {
            return; // its elements have no data, whatever their number
        }
        if (element.name == "vertex")
        {
            if (!m_primitive.positions.empty())
            {
                throw fail("it has several lists of vertices");
            }
            readVertices(element);
            return;
        }
        const bool has_faces = element.name == "face" || element.name == "tristrips";
        for (std::uint64_t i = 0; i < element.count; ++i)
        {
            for (const PlyProperty& property : element.properties)
            {
                const bool is_face = has_faces && property.count_type &&
                                     (property.name == "vertex_indices" || property.name == "vertex_index");
                if (!is_face)
                {
                    skip(property);
                }
                else if (element.name == "face")
                {
                    readFace(property);
                }
                else
                {
                    readStrips(property);
                }
            }
        }
    }

    void readVertices(const PlyElement& element)
    {
        std::array<bool, kUseCount + 1> has{};
        for (const PlyProperty& property : element.properties)
        {
            has[static_cast<std::size_t>(useOf(property.name))] |= !property.count_type;
        }
        const auto all = [&](Use a, Use b, Use c) {
            return has[static_cast<std::size_t>(a)] && has[static_cast<std::size_t>(b)] &&
                   has[static_cast<std::size_t>(c)];
        };
        if (!all(Use::X, Use::Y, Use::Z))
        {
            throw fail("its vertices have no x, y and z");
        }
        const bool has_normals = all(Use::NormalX, Use::NormalY, Use::NormalZ);
        const bool has_colors = all(Use::Red, Use::Green, Use::Blue);
        const std::uint64_t vertex_bytes =
            sizeof(glm::vec3) + (has_normals ? sizeof(glm::vec3) : 0) + (has_colors ? sizeof(glm::vec4) : 0);
        for (std::uint64_t i = 0; i < element.count; ++i)
        {
            m_bytes_left.take(vertex_bytes);
            VertexValues values{};
            values[static_cast<std::size_t>(Use::Alpha)] = 1.0;
            for (const PlyProperty& property : element.properties)
            {
                const Use use = property.count_type ? Use::Nothing : useOf(property.name);
                if (use == Use::Nothing)
                {
                    skip(property);
                }
                else
                {
                    const double value = number(property.type);
                    values[static_cast<std::size_t>(use)] = use >= Use::Red ? value / channelMax(property.type) : value;
                }
            }
            addVertex(values, has_normals, has_colors);
        }
    }

    void addVertex(const VertexValues& values, bool has_normals, bool has_colors)
    {
        const auto vector = [&](Use first)
        {
            const auto at = static_cast<std::size_t>(first);
            return glm::dvec3(values[at], values[at + 1], values[at + 2]);
        };
        m_primitive.positions.emplace_back(vector(Use::X));
        if (has_normals)
        {
            const glm::dvec3 normal = vector(Use::NormalX);
            const double length = std::sqrt(glm::dot(normal, normal));
            m_primitive.normals.push_back(length > 0.0 && std::isfinite(length) ? glm::vec3(normal / length)
                                                                                : glm::vec3(0.0F));
        }
        if (has_colors)
        {
            const glm::dvec3 color = vector(Use::Red);
            const double alpha = values[static_cast<std::size_t>(Use::Alpha)];
            m_primitive.colors.emplace_back(srgbToLinear(color.r), srgbToLinear(color.g), srgbToLinear(color.b),
                                            alpha > 0.0 ? std::min(alpha, 1.0) : 0.0);
        }
    }

    void readFace(const PlyProperty& property)
    {
        const std::uint64_t count = listCount(property);
        const std::size_t first = m_polygon_vertices.size();
        for (std::uint64_t i = 0; i < count; ++i)
        {
            m_bytes_left.take(count > 3 ? sizeof(std::uint32_t) + 2 * sizeof(glm::uvec3) : 0); // PolygonTriangulator
            m_polygon_vertices.push_back(vertexIndex(number(property.type)));
        }
        if (count > 3)
        {
            m_bytes_left.take(sizeof(Polygon));
            m_polygons.push_back({m_triangles.size(), static_cast<std::size_t>(count)});
            return;
        }
        if (count == 3)
        {
            const std::uint32_t* corners = &m_polygon_vertices[first];
            addTriangle({corners[0], corners[1], corners[2]});
        }
        m_polygon_vertices.resize(first);
    }

    void readStrips(const PlyProperty& property)
    {
        const std::uint64_t count = listCount(property);
        std::array<std::uint32_t, 2> last{}; // the vertex before the previous one, and the previous one
        std::uint64_t in_strip = 0;
        for (std::uint64_t i = 0; i < count; ++i)
        {
            const double value = number(property.type);
            if (value == -1.0)
            {
                in_strip = 0;
                continue;
            }
            const std::uint32_t vertex = vertexIndex(value);
            if (in_strip >= 2)
            {
                const bool odd = in_strip % 2 == 1;
                addTriangle({last[odd ? 1 : 0], last[odd ? 0 : 1], vertex});
            }
            last = {last[1], vertex};
            ++in_strip;
        }
    }

    void addTriangle(const glm::uvec3& triangle)
    {
        m_bytes_left.take(sizeof(triangle));
        m_triangles.push_back(triangle);
    }

    std::uint32_t vertexIndex(double value) const
    {
        if (!(value >= 0.0) || value >= std::numeric_limits<std::uint32_t>::max() || value != std::floor(value))
        {
            throw fail(fmt::format("a face has the vertex {}", value));
        }
        return static_cast<std::uint32_t>(value);
    }

    void checkIndices() const
    {
        const std::size_t vertex_count = m_primitive.positions.size();
        const auto check = [&](std::uint32_t vertex)
        {
            if (vertex >= vertex_count)
            {
                throw fail(fmt::format("a face has the vertex {}, but there are {}", vertex, vertex_count));
            }
        };
        for (const glm::uvec3& triangle : m_triangles)
        {
            check(std::max({triangle.x, triangle.y, triangle.z}));
        }
        std::for_each(m_polygon_vertices.begin(), m_polygon_vertices.end(), check);
    }

    /// Puts the triangles of the polygons among the others, in the order of the file.
    void cutPolygons()
    {
        if (m_polygons.empty())
        {
            return;
        }
        const std::vector<glm::uvec3> others = std::exchange(m_triangles, {});
        std::span<const glm::uvec3> others_left(others);
        std::span<const std::uint32_t> vertices_left(m_polygon_vertices);
        std::vector<glm::vec3> positions;
        PolygonTriangulator triangulator;
        for (const Polygon& polygon : m_polygons)
        {
            const auto before = others_left.first(polygon.triangles_before - (others.size() - others_left.size()));
            m_triangles.insert(m_triangles.end(), before.begin(), before.end());
            others_left = others_left.subspan(before.size());
            const auto vertices = vertices_left.first(polygon.vertex_count);
            vertices_left = vertices_left.subspan(polygon.vertex_count);
            positions.clear();
            for (const std::uint32_t vertex : vertices)
            {
                positions.push_back(m_primitive.positions[vertex]);
            }
            triangulator.triangulate(positions, vertices, m_triangles);
        }
        m_triangles.insert(m_triangles.end(), others_left.begin(), others_left.end());
    }

    std::uint64_t listCount(const PlyProperty& property)
    {
        const double count = number(*property.count_type);
        if (!(count >= 0.0) || count != std::floor(count) || count > std::numeric_limits<std::uint32_t>::max())
        {
            throw fail(fmt::format("a list {} has {} entries", property.name, count));
        }
        return static_cast<std::uint64_t>(count);
    }

    void skip(const PlyProperty& property)
    {
        const std::uint64_t count = property.count_type ? listCount(property) : 1;
        for (std::uint64_t i = 0; i < count; ++i)
        {
            number(property.type);
        }
    }

    /// The next number of the data. Numbers that are text are parsed in single precision, so they are rounded once.
    double number(PlyType type)
    {
        if (m_encoding == PlyEncoding::Text)
        {
            return textNumber(type);
        }
        switch (type)
        {
        case PlyType::Int8:
            return binaryNumber<std::int8_t>();
        case PlyType::UInt8:
            return binaryNumber<std::uint8_t>();
        case PlyType::Int16:
            return binaryNumber<std::int16_t>();
        case PlyType::UInt16:
            return binaryNumber<std::uint16_t>();
        case PlyType::Int32:
            return binaryNumber<std::int32_t>();
        case PlyType::UInt32:
            return binaryNumber<std::uint32_t>();
        case PlyType::Float32:
            return binaryNumber<float>();
        default:
            return binaryNumber<double>();
        }
    }

    template <typename T> double binaryNumber()
    {
        if (m_data.size() < sizeof(T))
        {
            throw cutShort();
        }
        std::array<char, sizeof(T)> bytes;
        std::copy_n(m_data.begin(), sizeof(T), bytes.begin());
        if ((m_encoding == PlyEncoding::BigEndian) != (std::endian::native == std::endian::big))
        {
            std::reverse(bytes.begin(), bytes.end());
        }
        m_data.remove_prefix(sizeof(T));
        return static_cast<double>(std::bit_cast<T>(bytes));
    }

    double textNumber(PlyType type)
    {
        const std::string_view word = m_cursor.word();
        if (word.empty())
        {
            throw cutShort();
        }
        const std::optional<double> value =
            type == PlyType::Float32 ? std::optional<double>(parseSingle(word)) : parseNumber<double>(word);
        if (!value)
        {
            throw fail(fmt::format("\"{}\" is not a number", word));
        }
        return *value;
    }

    const std::filesystem::path& m_path;
    TextCursor m_cursor; // in the header, and in the data if it is text
    std::string_view m_data;
    PlyEncoding m_encoding = PlyEncoding::Text;
    SceneBytesLeft m_bytes_left;
    std::vector<glm::uvec3> m_triangles;
    std::vector<Polygon> m_polygons; // faces of more than three vertices, in the order of the file
    std::vector<std::uint32_t> m_polygon_vertices;
    Primitive m_primitive;
};

} // namespace

Primitive readPly(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                  std::vector<std::string>& notes)
{
    return PlyReader(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}).read(notes);
}

} // namespace zvo
