// SPDX-License-Identifier: MIT
#include "io/mesh/stl_file.h"

#include "core/base/input_error.h"
#include "core/scene/scene_size.h"
#include "io/file/text_cursor.h"

#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <string_view>

namespace zvo
{

namespace
{

static_assert(std::endian::native == std::endian::little, "STL is little-endian and is read by copying");

// A binary file has a header without meaning, the number of facets, and the facets.
constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetsOffset = kHeaderBytes + sizeof(std::uint32_t);
constexpr std::size_t kNormalBytes = 3 * sizeof(float);
constexpr std::size_t kFacetBytes = 50; // normal, three corners, 16 bits

constexpr std::uint64_t kTriangleBytes = 3 * sizeof(glm::vec3) + sizeof(glm::uvec3);

/// Adds a triangle of three new vertices.
void addVertices(Primitive& primitive, const std::array<glm::vec3, 3>& corners)
{
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    primitive.positions.insert(primitive.positions.end(), corners.begin(), corners.end());
    primitive.triangles.emplace_back(first, first + 1, first + 2);
}

std::uint32_t facetCount(std::span<const std::uint8_t> bytes)
{
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeaderBytes, sizeof(count));
    return count;
}

Primitive readBinary(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    if (bytes.size() < kFacetsOffset)
    {
        throw inputError(path, fmt::format("not a valid STL file: {} bytes, without the head of a binary one and not "
                                           "starting with \"solid\"; {}",
                                           bytes.size(), kExportAgain));
    }
    const std::uint32_t facet_count = facetCount(bytes);
    if (facet_count > (bytes.size() - kFacetsOffset) / kFacetBytes)
    {
        throw inputError(path, fmt::format("announces {} facets of {} bytes, the STL file has {} bytes for them; {}",
                                           facet_count, kFacetBytes, bytes.size() - kFacetsOffset, kCutShort));
    }
    SceneBytesLeft(path).take(facet_count * kTriangleBytes);
    Primitive primitive;
    primitive.positions.reserve(3 * std::size_t{facet_count});
    primitive.triangles.reserve(facet_count);
    for (std::uint32_t i = 0; i < facet_count; ++i)
    {
        std::array<glm::vec3, 3> corners;
        static_assert(sizeof(corners) == 9 * sizeof(float));
        std::memcpy(corners.data(), bytes.data() + kFacetsOffset + i * kFacetBytes + kNormalBytes, sizeof(corners));
        addVertices(primitive, corners);
    }
    return primitive;
}

class TextReader
{
public:
    TextReader(const std::filesystem::path& path, std::string_view content)
        : m_path(path), m_lines(content), m_bytes_left(path)
    {
    }

    Primitive read()
    {
        bool ended = false;
        for (auto line = m_lines.line(); line; line = m_lines.line())
        {
            ++m_line_number;
            TextCursor words(*line);
            const std::string_view keyword = words.word();
            ended = keyword.empty() ? ended : keyword == "endsolid";
            if (keyword == "vertex")
            {
                readVertex(words);
            }
            else if (keyword == "outer" || keyword == "endloop")
            {
                const std::size_t expected = keyword == "outer" ? 0 : m_corners.size();
                if (m_corner_count != expected)
                {
                    throw fail(fmt::format("a facet of {} vertices", m_corner_count));
                }
                if (keyword == "endloop")
                {
                    m_bytes_left.take(kTriangleBytes);
                    addVertices(m_primitive, m_corners);
                }
                m_corner_count = 0;
            }
            else if (!keyword.empty() && keyword != "solid" && keyword != "facet" && keyword != "endfacet" &&
                     keyword != "endsolid")
            {
                throw fail(fmt::format("\"{}\"", keyword));
            }
        }
        if (!ended)
        {
            throw inputError(m_path, fmt::format("the STL file has no \"endsolid\" at its end; {}", kCutShort));
        }
        return std::move(m_primitive);
    }

private:
    [[nodiscard]] Error fail(const std::string& what) const
    {
        return inputError(m_path,
                          fmt::format("not a valid STL file: {} in line {}; {}", what, m_line_number, kExportAgain));
    }

    void readVertex(TextCursor& words)
    {
        if (m_corner_count == m_corners.size())
        {
            throw fail("a facet of more than 3 vertices");
        }
        for (int axis = 0; axis < 3; ++axis)
        {
            const std::string_view word = words.word();
            const std::optional<float> value = parseSingle(word);
            if (!value)
            {
                throw fail(fmt::format("the coordinate \"{}\"", word));
            }
            m_corners[m_corner_count][axis] = *value;
        }
        ++m_corner_count;
    }

    const std::filesystem::path& m_path;
    TextCursor m_lines;
    std::size_t m_line_number = 0;
    std::array<glm::vec3, 3> m_corners{};
    std::size_t m_corner_count = 0; // of the current facet
    SceneBytesLeft m_bytes_left;
    Primitive m_primitive;
};

} // namespace

bool isBinaryStl(std::span<const std::uint8_t> content)
{
    return content.size() >= kFacetsOffset &&
           content.size() - kFacetsOffset == std::uint64_t{facetCount(content)} * kFacetBytes;
}

Primitive readStl(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const bool is_text = content.starts_with("solid") && !isBinaryStl(bytes);
    return is_text ? TextReader(path, content).read() : readBinary(path, bytes);
}

} // namespace zvo
