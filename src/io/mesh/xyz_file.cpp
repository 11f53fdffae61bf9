// SPDX-License-Identifier: MIT
#include "io/mesh/xyz_file.h"

#include "core/base/finite.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/base/srgb.h"
#include "io/file/text_cursor.h"
#include "io/mesh/mesh_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::size_t kColumnsMax = 10;

// Three columns behind the coordinates, and what tells normals from colours.
struct Triple
{
    std::vector<glm::vec3> values;
    bool is_negative = false;
    bool has_unit_length = true; // each that is not 0
    float largest = 0.0F;

    void add(const glm::vec3& value)
    {
        values.push_back(value);
        const float length = glm::length(value);
        is_negative = is_negative || std::min({value.x, value.y, value.z}) < 0.0F;
        has_unit_length = has_unit_length && (length == 0.0F || std::abs(length - 1.0F) < 0.01F);
        largest = std::max({largest, value.x, value.y, value.z});
    }

    [[nodiscard]] bool areNormals() const { return is_negative || (has_unit_length && largest > 0.0F); }
};

class XyzReader
{
public:
    XyzReader(const std::filesystem::path& path, std::string_view content)
        : m_path(path), m_lines(content), m_bytes_left(path)
    {
    }

    Scene read()
    {
        std::optional<std::string_view> line;
        for (std::size_t number = 1; (line = m_lines.line()); ++number)
        {
            readLine(*line, number);
        }
        if (m_primitive.positions.empty())
        {
            throw inputError(m_path, fmt::format("has no points; {}", kExportAgain));
        }
        addTriples();
        MeshScene scene(m_path, ImageDecoding::WhenLoaded);
        scene.add(std::move(m_primitive));
        return scene.finish();
    }

private:
    /// Before the first point, a line of one number (PTS has the count there) or of words (names of columns) is no
    /// point.
    void readLine(std::string_view line, std::size_t number)
    {
        std::array<float, kColumnsMax> numbers{};
        std::size_t count = 0;
        bool are_numbers = true;
        for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
        {
            if (word.starts_with('#') || word.starts_with("//"))
            {
                break;
            }
            const std::optional<float> value = parseSingle(word);
            are_numbers = are_numbers && value;
            numbers[std::min(count++, kColumnsMax - 1)] = value.value_or(0.0F);
        }
        const bool is_head = m_columns == 0 && (count == 1 || !are_numbers);
        if (count == 0 || is_head)
        {
            return;
        }
        const bool fits = count >= 3 && count <= kColumnsMax && count != 5 && count != 8;
        if (!are_numbers || !fits || (m_columns != 0 && count != m_columns))
        {
            throw inputError(m_path,
                             fmt::format("line {} has {}; expected {} of a point: x y z [intensity] [r g b] "
                                         "[nx ny nz]",
                                         number, are_numbers ? fmt::format("{} numbers", count) : "words",
                                         m_columns != 0 ? fmt::format("{} numbers", m_columns) : "the numbers"));
        }
        m_columns = count;
        addPoint(numbers);
    }

    static std::string_view takeWord(std::string_view& line)
    {
        constexpr std::string_view kBetween = " \t,;";
        line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBetween)));
        const std::string_view word = line.substr(0, line.find_first_of(kBetween));
        line.remove_prefix(word.size());
        return word;
    }

    void addPoint(const std::array<float, kColumnsMax>& numbers)
    {
        const std::size_t triple_count = (m_columns - 3) / 3;
        m_bytes_left.take((2 + triple_count) * sizeof(glm::vec3) + sizeof(glm::vec4));
        m_primitive.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
        if (m_columns % 3 == 1)
        {
            m_intensities.push_back(numbers[3]);
        }
        for (std::size_t i = 0; i < triple_count; ++i)
        {
            const std::size_t first = m_columns - 3 * (triple_count - i);
            m_triples[i].add({numbers[first], numbers[first + 1], numbers[first + 2]});
        }
    }

    void addTriples()
    {
        const bool has_both = !m_triples[1].values.empty();
        const bool first_is_normals = m_triples[0].areNormals() && !(has_both && m_triples[1].areNormals());
        const Triple& normals = m_triples[first_is_normals ? 0 : 1];
        const Triple& colors = m_triples[first_is_normals ? 1 : 0];
        for (const glm::vec3& normal : normals.values)
        {
            m_primitive.normals.push_back(unitOrZero(glm::dvec3(normal)));
        }
        const double channel_max = colors.largest > 1.0F ? (colors.largest > 255.0F ? 65535.0 : 255.0) : 1.0;
        for (const glm::vec3& color : colors.values)
        {
            m_primitive.colors.push_back(srgbToLinear(glm::dvec4(glm::dvec3(color) / channel_max, 1.0)));
        }
        if (colors.values.empty() && !m_intensities.empty())
        {
            addGreys();
        }
    }

    /// The least intensity is black, the largest white.
    void addGreys()
    {
        const auto [least, largest] = std::ranges::minmax(m_intensities);
        const double range = static_cast<double>(largest) - static_cast<double>(least);
        for (const float intensity : m_intensities)
        {
            const double grey =
                range > 0.0 ? (static_cast<double>(intensity) - static_cast<double>(least)) / range : 1.0;
            m_primitive.colors.push_back(srgbToLinear(glm::dvec4(glm::dvec3(grey), 1.0)));
        }
    }

    const std::filesystem::path& m_path;
    TextCursor m_lines;
    SceneBytesLeft m_bytes_left;
    std::size_t m_columns = 0; // of the first point
    std::vector<float> m_intensities;
    std::array<Triple, 2> m_triples; // in the order of their columns
    Primitive m_primitive;
};

} // namespace

bool isXyzExtension(std::string_view extension)
{
    constexpr std::array<std::string_view, 5> kExtensions = {".xyz", ".pts", ".txt", ".asc", ".csv"};
    return std::ranges::find(kExtensions, extension) != kExtensions.end();
}

Scene readXyz(const std::filesystem::path& path, std::span<const std::uint8_t> bytes)
{
    return XyzReader(path, asText(bytes)).read();
}

} // namespace zvo
