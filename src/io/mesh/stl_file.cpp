// SPDX-License-Identifier: MIT
#include "io/mesh/stl_file.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/base/srgb.h"
#include "io/file/text_cursor.h"
#include "io/mesh/mesh_scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <string_view>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

static_assert(std::endian::native == std::endian::little, "STL is little-endian and is read by copying");

// A binary file has a header, the number of facets, and the facets.
constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetsOffset = kHeaderBytes + sizeof(std::uint32_t);
constexpr std::size_t kFacetBytes = 50; // without the padding of Facet

struct Facet
{
    glm::vec3 normal;
    std::array<glm::vec3, 3> corners;
    std::uint16_t bits; // five for each channel of a colour, and one
};

constexpr std::uint64_t kTriangleBytes = sizeof(Facet::corners) + sizeof(glm::uvec3);

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

/// What stands behind a mark in the head of a binary file: red, green, blue and alpha. Nothing without the mark.
std::optional<glm::u8vec4> colorBehind(std::string_view mark, std::span<const std::uint8_t> bytes)
{
    glm::u8vec4 color(0);
    const std::size_t at = asText(bytes.first(kHeaderBytes)).find(mark);
    if (at > kHeaderBytes - mark.size() - sizeof(color))
    {
        return std::nullopt;
    }
    std::memcpy(&color, bytes.data() + at + mark.size(), sizeof(color));
    return color;
}

/// Adds the colours of facets; returns whether all have their own. of_head: behind "COLOR=". Materialise Magics: the
/// head has a colour of all, and facets without the highest bit have their own, red in the lowest bits. VisCAM and
/// SolidView: facets with the highest bit have their own, red in the highest bits; the others are white.
bool addColors(const std::optional<glm::u8vec4>& of_head, const std::vector<std::uint16_t>& facets,
               Primitive& primitive)
{
    constexpr std::uint32_t kHighest = 1U << 15U;
    constexpr std::uint32_t kChannelMax = 31;
    const bool is_magics = of_head.has_value();
    const glm::dvec3 of_all = is_magics ? glm::dvec3(*of_head) / 255.0 : glm::dvec3(1.0);
    const bool are_set =
        std::ranges::any_of(facets, [&](auto bits) { return is_magics ? bits != 0 : bits >= kHighest; });
    // MeshLab writes the colours of Magics with the highest bit of every facet.
    const bool is_always_own = is_magics && std::ranges::all_of(facets, [](auto bits) { return bits >= kHighest; }) &&
                               std::ranges::any_of(facets, [](auto bits) { return bits != kHighest; });
    bool are_own = are_set;
    for (std::size_t i = 0; (are_set || is_magics) && i < facets.size(); ++i)
    {
        const std::uint32_t bits = facets[i];
        const bool is_own = are_set && (is_always_own || (bits >= kHighest) != is_magics);
        are_own = are_own && is_own;
        const glm::dvec3 own(bits & kChannelMax, bits >> 5U & kChannelMax, bits >> 10U & kChannelMax);
        const glm::dvec3 color = !is_own ? of_all : (is_magics ? own : glm::dvec3(own.z, own.y, own.x)) / 31.0;
        primitive.colors.insert(primitive.colors.end(), 3, srgbToLinear(glm::dvec4(color, 1.0)));
    }
    return are_own;
}

Primitive readBinary(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, MeshScene& scene)
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
    SceneBytesLeft(path).take(facet_count * (kTriangleBytes + 3 * sizeof(glm::vec4)));
    Primitive primitive;
    primitive.positions.reserve(3 * std::size_t{facet_count});
    primitive.triangles.reserve(facet_count);
    std::vector<std::uint16_t> bits;
    for (std::uint32_t i = 0; i < facet_count; ++i)
    {
        Facet facet;
        static_assert(offsetof(Facet, bits) + sizeof(facet.bits) == kFacetBytes);
        std::memcpy(&facet, bytes.data() + kFacetsOffset + i * kFacetBytes, kFacetBytes);
        addVertices(primitive, facet.corners);
        bits.push_back(facet.bits);
    }
    const auto color = colorBehind("COLOR=", bytes);
    const auto material = colorBehind("MATERIAL=", bytes); // its diffuse colour
    if (!addColors(color, bits, primitive) && material && material != color)
    {
        scene.warn("the material in the head left out (MATERIAL=)");
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
            std::string keyword = lowered(words.word());
            keyword += keyword == "end" ? lowered(words.word()) : "";
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

bool isTextStl(std::span<const std::uint8_t> content)
{
    constexpr std::size_t kHead = 512; // a binary file has a byte 0 in it, if only in its count of facets
    const std::string_view text = asText(content.first(std::min(content.size(), kHead)));
    const std::string first = lowered(TextCursor(text).word());
    return (first == "solid" || first == "facet") && text.find('\0') == text.npos && !isBinaryStl(content);
}

Scene readStl(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    const std::string_view content = asText(bytes);
    MeshScene scene(path, ImageDecoding::WhenLoaded);
    scene.add(isTextStl(bytes) ? TextReader(path, content).read() : readBinary(path, bytes, scene));
    return scene.finish();
}

} // namespace zvo
