// SPDX-License-Identifier: MIT
#include "io/mesh/stl_file.h"

#include "core/base/input_error.h"
#include "io/file/text_cursor.h"
#include "io/image/srgb.h"
#include "io/mesh/mesh_scene.h"

#include <algorithm>
#include <array>
#include <bit>
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

template <typename T> T read(std::span<const std::uint8_t> bytes, std::size_t at)
{
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

/// The 16 bits of a facet.
std::uint32_t facetBits(std::span<const std::uint8_t> bytes, std::size_t facet)
{
    return read<std::uint16_t>(bytes, kFacetsOffset + (facet + 1) * kFacetBytes - sizeof(std::uint16_t));
}

/// A facet's colour: five bits for each channel, red in the highest or the lowest ones.
glm::vec4 facetColor(std::uint32_t bits, bool is_red_first)
{
    constexpr std::uint32_t kChannelMax = 31;
    const glm::dvec3 channels(bits >> 10U & kChannelMax, bits >> 5U & kChannelMax, bits & kChannelMax);
    const double max = kChannelMax;
    return srgbToLinear(
        glm::dvec4((is_red_first ? channels : glm::dvec3(channels.z, channels.y, channels.x)) / max, 1.0));
}

/// Reads the colours of facets. Materialise Magics: the head has a colour of all, behind "COLOR=", and facets without
/// the highest bit have their own, red in the lowest bits. VisCAM and SolidView: facets with the highest bit have their
/// own, red in the highest bits; the others are white.
void readColors(std::span<const std::uint8_t> bytes, SceneBytesLeft& bytes_left, Primitive& primitive)
{
    constexpr std::uint32_t kHighest = 1U << 15U;
    constexpr std::string_view kMark = "COLOR=";
    const std::size_t facet_count = primitive.triangles.size();
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), kHeaderBytes);
    const std::size_t mark = head.find(kMark);
    const bool is_magics = mark < kHeaderBytes - kMark.size() - 4;
    glm::vec4 color_of_all(1.0F);
    std::uint32_t all_bits = 0;
    for (std::size_t facet = 0; facet < facet_count; ++facet)
    {
        all_bits |= facetBits(bytes, facet);
    }
    if (is_magics)
    {
        const auto* const color = bytes.data() + mark + kMark.size();
        color_of_all = srgbToLinear(glm::dvec4(glm::dvec3(color[0], color[1], color[2]) / 255.0, 1.0));
    }
    else if ((all_bits & kHighest) == 0)
    {
        return;
    }
    bytes_left.take(primitive.positions.size() * sizeof(glm::vec4));
    for (std::size_t facet = 0; facet < facet_count; ++facet)
    {
        const std::uint32_t bits = facetBits(bytes, facet);
        const bool is_own = all_bits != 0 && ((bits & kHighest) != 0) != is_magics; // all 0: nobody has set them
        primitive.colors.insert(primitive.colors.end(), 3, is_own ? facetColor(bits, !is_magics) : color_of_all);
    }
}

Primitive readBinary(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    if (bytes.size() < kFacetsOffset)
    {
        throw inputError(path, fmt::format("not a valid STL file: {} bytes, without the head of a binary one and not "
                                           "starting with \"solid\"; {}",
                                           bytes.size(), kExportAgain));
    }
    const auto facet_count = read<std::uint32_t>(bytes, kHeaderBytes);
    if (facet_count > (bytes.size() - kFacetsOffset) / kFacetBytes)
    {
        throw inputError(path, fmt::format("announces {} facets of {} bytes, the STL file has {} bytes for them; {}",
                                           facet_count, kFacetBytes, bytes.size() - kFacetsOffset, kCutShort));
    }
    SceneBytesLeft bytes_left(path);
    bytes_left.take(facet_count * kTriangleBytes);
    Primitive primitive;
    primitive.positions.reserve(3 * std::size_t{facet_count});
    primitive.triangles.reserve(facet_count);
    for (std::uint32_t i = 0; i < facet_count; ++i)
    {
        using Corners = std::array<glm::vec3, 3>;
        static_assert(sizeof(Corners) == 9 * sizeof(float));
        addVertices(primitive, read<Corners>(bytes, kFacetsOffset + i * kFacetBytes + kNormalBytes));
    }
    readColors(bytes, bytes_left, primitive);
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
           content.size() - kFacetsOffset == std::uint64_t{read<std::uint32_t>(content, kHeaderBytes)} * kFacetBytes;
}

bool isTextStl(std::span<const std::uint8_t> content)
{
    constexpr std::size_t kHead = 512; // a binary file has a byte 0 in it, if only in its count of facets
    const std::string_view text(reinterpret_cast<const char*>(content.data()), std::min(content.size(), kHead));
    const std::string first = lowered(TextCursor(text).word());
    return (first == "solid" || first == "facet") && text.find('\0') == text.npos && !isBinaryStl(content);
}

Scene readStl(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    MeshScene scene(path, ImageDecoding::WhenLoaded);
    Material material;
    material.name = "default";
    scene.add(std::move(material));
    std::vector<Primitive> primitives;
    primitives.push_back(isTextStl(bytes) ? TextReader(path, content).read() : readBinary(path, bytes));
    return scene.finish(std::move(primitives));
}

} // namespace zvo
