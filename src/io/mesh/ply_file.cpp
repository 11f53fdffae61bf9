// SPDX-License-Identifier: MIT
#include "io/mesh/ply_file.h"

#include "core/base/finite.h"
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
#include <fmt/format.h>
#include <iterator>
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
    constexpr std::string_view kNames[kUseCount][3] = {{"x"},
                                                       {"y"},
                                                       {"z"},
                                                       {"nx"},
                                                       {"ny"},
                                                       {"nz"},
                                                       {"red", "r", "diffuse_red"},
                                                       {"green", "g", "diffuse_green"},
                                                       {"blue", "b", "diffuse_blue"},
                                                       {"alpha", "a"}};
    const auto hasName = [&](const auto& names)
    { return std::find(std::begin(names), std::end(names), name) != std::end(names); };
    const auto found = std::find_if(std::begin(kNames), std::end(kNames), hasName);
    return name.empty() ? Use::Nothing : static_cast<Use>(found - std::begin(kNames));
}

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
        readElements(header.elements);
        if (!m_has_faces && !m_primitive.positions.empty())
        {
            notes.emplace_back("a cloud of points, without faces; only triangles become voxels");
        }
        return std::move(m_primitive);
    }

private:
    [[nodiscard]] Error fail(const std::string& what) const { return plyError(m_path, what); }

    [[nodiscard]] Error cutShort() const
    {
        return inputError(m_path, fmt::format("the PLY file ends before its last element; {}", kCutShort));
    }

    /// Reads the vertices first, as faces may stand before those that they name.
    void readElements(const std::vector<PlyElement>& elements)
    {
        const auto vertices = std::find_if(elements.begin(), elements.end(), hasVertices);
        const TextCursor start = m_cursor;
        std::for_each(elements.begin(), vertices, [this](const PlyElement& element) { skip(element); });
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

    /// Calls read with each property of each item, whose data comes in this order. An element without properties has
    /// no data, whatever its count.
    template <typename Read> static void forEachProperty(const PlyElement& element, const Read& read)
    {
        for (std::uint64_t i = 0; !element.properties.empty() && i < element.count; ++i)
        {
            std::for_each(element.properties.begin(), element.properties.end(), read);
        }
    }

    void skip(const PlyElement& element)
    {
        forEachProperty(element, [this](const PlyProperty& property) { skip(property); });
    }

    void readFaces(const PlyElement& element)
    {
        forEachProperty(element,
                        [&](const PlyProperty& property)
                        {
                            const bool has_corners = property.count_type && (property.name == "vertex_indices" ||
                                                                             property.name == "vertex_index");
                            if (has_corners && element.name == "face")
                            {
                                readFace(property);
                            }
                            else if (has_corners && element.name == "tristrips")
                            {
                                readStrips(property);
                            }
                            else
                            {
                                skip(property);
                            }
                        });
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
            m_primitive.normals.push_back(unitOrZero(vector(Use::NormalX)));
        }
        if (has_colors)
        {
            m_primitive.colors.push_back(
                srgbToLinear(glm::dvec4(vector(Use::Red), values[static_cast<std::size_t>(Use::Alpha)])));
        }
    }

    void readFace(const PlyProperty& property)
    {
        const std::uint64_t count = listCount(property);
        const std::uint64_t triangles_max = count > 3 ? 2 * count : count / 3; // PolygonTriangulator
        m_corners.clear();
        m_corner_positions.clear();
        for (std::uint64_t i = 0; i < count; ++i)
        {
            m_corners.push_back(vertexIndex(number(property.type)));
            m_corner_positions.push_back(m_primitive.positions[m_corners.back()]);
        }
        m_bytes_left.take(triangles_max * sizeof(glm::uvec3));
        m_triangulator.triangulate(m_corner_positions, m_corners, m_primitive.triangles);
        m_has_faces = m_has_faces || count >= 3;
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
                m_bytes_left.take(sizeof(glm::uvec3));
                m_primitive.triangles.emplace_back(last[odd ? 1 : 0], last[odd ? 0 : 1], vertex);
                m_has_faces = true;
            }
            last = {last[1], vertex};
            ++in_strip;
        }
    }

    std::uint32_t vertexIndex(double value) const
    {
        const std::size_t vertex_count = m_primitive.positions.size();
        if (!(value >= 0.0) || value >= std::numeric_limits<std::uint32_t>::max() || value != std::floor(value))
        {
            throw fail(fmt::format("a face has the vertex {}", value));
        }
        if (value >= static_cast<double>(vertex_count))
        {
            throw fail(fmt::format("a face has the vertex {}, but there are {}", value, vertex_count));
        }
        return static_cast<std::uint32_t>(value);
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
        const std::string_view data = m_cursor.take(sizeof(T));
        if (data.size() < sizeof(T))
        {
            throw cutShort();
        }
        std::array<char, sizeof(T)> bytes;
        std::copy_n(data.begin(), sizeof(T), bytes.begin());
        if ((m_encoding == PlyEncoding::BigEndian) != (std::endian::native == std::endian::big))
        {
            std::reverse(bytes.begin(), bytes.end());
        }
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
    TextCursor m_cursor;
    PlyEncoding m_encoding = PlyEncoding::Text;
    SceneBytesLeft m_bytes_left;
    std::vector<std::uint32_t> m_corners; // of the current face
    std::vector<glm::vec3> m_corner_positions;
    PolygonTriangulator m_triangulator;
    bool m_has_faces = false; // of three corners at least
    Primitive m_primitive;
};

} // namespace

Primitive readPly(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                  std::vector<std::string>& notes)
{
    return PlyReader(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}).read(notes);
}

} // namespace zvo
