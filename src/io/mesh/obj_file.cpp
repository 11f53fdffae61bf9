// SPDX-License-Identifier: MIT
#include "io/mesh/obj_file.h"

#include "core/base/finite.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/base/srgb.h"
#include "io/file/text_cursor.h"
#include "io/mesh/mtl_files.h"
#include "io/mesh/polygon_triangulator.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

// What a corner of a face names, in the order of the numbers between its slashes.
enum List : std::size_t
{
    Positions,
    Uvs,
    Normals,
    ListCount
};

constexpr std::array<std::string_view, ListCount> kListKeywords = {"v", "vt", "vn"};
constexpr std::array<std::string_view, ListCount> kListNames = {"vertex", "texture coordinate", "normal"};

using Corner = std::array<std::uint32_t, ListCount>; // indices, or kNone

/// Reads the lists first, as faces may stand before the vertices that they name.
class ObjReader
{
public:
    ObjReader(const std::filesystem::path& path, std::string_view text, ImageDecoding decoding)
        : m_path(path), m_text(text), m_bytes_left(path), m_scene(path, decoding), m_materials(path, m_scene)
    {
    }

    Scene read()
    {
        forEachStatement([this](std::string_view keyword) { readLists(keyword); });
        if (m_lists[Positions].empty())
        {
            throw inputError(m_path, fmt::format("not a valid OBJ file: it has no vertices; {}", kExportAgain));
        }
        forEachStatement([this](std::string_view keyword) { readFaces(keyword); });
        if (m_primitives.empty())
        {
            m_bytes_left.take(m_lists[Positions].size() * sizeof(glm::uvec3));
            m_colors.resize(m_colors.empty() ? 0 : m_lists[Positions].size(), glm::vec4(1.0F));
            Primitive points;
            points.positions = std::move(m_lists[Positions]);
            points.colors = std::move(m_colors);
            m_scene.add(std::move(points));
        }
        else if (m_has_points)
        {
            m_scene.warn(kNoTriangles);
        }
        for (auto& [material, primitive] : m_primitives)
        {
            m_materials.add(std::move(primitive), material);
        }
        return m_scene.finish();
    }

private:
    template <typename Read> void forEachStatement(const Read& read)
    {
        m_lines = TextCursor(m_text);
        for (m_line_number = 0; nextLine();)
        {
            read(word());
        }
    }

    bool nextLine()
    {
        const std::optional<std::string_view> line = m_lines.line();
        m_words = TextCursor(line.value_or(""));
        ++m_line_number;
        return line.has_value();
    }

    /// The next word of a statement, which goes on in the next line behind a backslash and ends before a comment.
    std::string_view word()
    {
        std::string_view word = m_words.word();
        while (word == "\\")
        {
            nextLine();
            word = m_words.word();
        }
        if (word.starts_with('#'))
        {
            return "";
        }
        if (word.ends_with('\\'))
        {
            word.remove_suffix(1);
            nextLine();
        }
        return word;
    }

    [[nodiscard]] Error fail(const std::string& what) const
    {
        return inputError(m_path,
                          fmt::format("not a valid OBJ file: line {} has {}; {}", m_line_number, what, kExportAgain));
    }

    void readLists(std::string_view keyword)
    {
        const auto list = static_cast<std::size_t>(std::ranges::find(kListKeywords, keyword) - kListKeywords.begin());
        if (keyword == "mtllib")
        {
            m_materials.read(m_words.rest());
        }
        else if (list < ListCount)
        {
            readNumbers(static_cast<List>(list));
        }
    }

    /// Reads a vertex, a texture coordinate or a normal. Numbers beyond those of a colour are left out, and so is a
    /// weight, which only curves have.
    void readNumbers(List list)
    {
        constexpr std::array<std::size_t, ListCount> kNumbersMin = {3, 1, 1};
        std::array<float, 6> numbers{};
        std::size_t count = 0;
        for (std::string_view text = word(); count < numbers.size() && !text.empty(); text = word())
        {
            const std::optional<float> number = parseSingle(text);
            if (!number)
            {
                break;
            }
            numbers[count++] = *number;
        }
        if (count < kNumbersMin[list])
        {
            throw fail(fmt::format("a {} of {} numbers", kListNames[list], count));
        }
        if (list == Positions && count == numbers.size())
        {
            m_bytes_left.take(sizeof(glm::vec4));
            m_colors.resize(m_lists[Positions].size(), glm::vec4(1.0F));
            m_colors.push_back(srgbToLinear(glm::dvec4(numbers[3], numbers[4], numbers[5], 1.0)));
        }
        m_bytes_left.take(sizeof(glm::vec3));
        m_lists[list].emplace_back(numbers[0], numbers[1], numbers[2]);
    }

    void readFaces(std::string_view keyword)
    {
        if (keyword == "f" || keyword == "fo")
        {
            readFace();
        }
        else if (keyword == "usemtl")
        {
            m_primitive = nullptr;
            m_material = m_words.rest();
        }
        else if (keyword == "p")
        {
            m_has_points = true;
        }
        else if (keyword == "l")
        {
            m_scene.warn(kNoTriangles);
        }
        else if (keyword == "curv" || keyword == "surf")
        {
            m_scene.warn("free-form curves and surfaces left out; export polygons");
        }
        for (std::size_t list = 0; list < ListCount; ++list)
        {
            m_above[list] += keyword == kListKeywords[list] ? 1 : 0;
        }
    }

    void readFace()
    {
        m_corners.clear();
        for (std::string_view text = word(); !text.empty(); text = word())
        {
            m_corners.push_back(readCorner(text));
        }
        const std::size_t count = m_corners.size();
        if (count < 3)
        {
            m_scene.warn(kNoTriangles);
            return;
        }
        m_primitive = m_primitive == nullptr ? &m_primitives[m_material] : m_primitive;
        m_vertices.clear();
        std::ranges::for_each(m_corners, [this](const Corner& corner) { addVertex(corner, *m_primitive); });
        m_bytes_left.take((count > 4 ? 2 * count : count - 2) * sizeof(glm::uvec3)); // PolygonTriangulator
        m_triangulator.triangulate(std::span(m_primitive->positions).last(count), m_vertices, m_primitive->triangles);
    }

    /// A corner of a face, such as "3/1/2" or "-1//-1". Negative numbers count back from the line.
    Corner readCorner(std::string_view text)
    {
        Corner corner = {kNone, kNone, kNone};
        for (std::size_t list = 0; list < ListCount && !text.empty(); ++list)
        {
            const std::string_view word = text.substr(0, text.find('/'));
            text.remove_prefix(std::min(text.size(), word.size() + 1));
            const std::int64_t number = parseNumber<std::int64_t>(word).value_or(0);
            const std::int64_t index = number > 0 ? number - 1 : number < 0 ? m_above[list] + number : -1;
            if (index >= 0 && static_cast<std::uint64_t>(index) < std::min<std::size_t>(m_lists[list].size(), kNone))
            {
                corner[list] = static_cast<std::uint32_t>(index);
            }
            else if (list == Positions)
            {
                throw fail(fmt::format("a face with the {} \"{}\", but there are {}", kListNames[list], word,
                                       m_lists[list].size()));
            }
            else if (!word.empty())
            {
                m_scene.warn(fmt::format("faces name a {} that is not there, which is left out", kListNames[list]));
            }
        }
        return corner;
    }

    /// Adds what the lists of the file have; where the corner names nothing of it, no normal, 0 and white.
    void addVertex(const Corner& corner, Primitive& primitive)
    {
        m_bytes_left.take(2 * sizeof(glm::vec3) + sizeof(glm::vec2) + sizeof(glm::vec4));
        m_vertices.push_back(static_cast<std::uint32_t>(primitive.positions.size()));
        primitive.positions.push_back(m_lists[Positions][corner[Positions]]);
        const auto listed = [&](List list)
        { return corner[list] != kNone ? m_lists[list][corner[list]] : glm::vec3(0.0F); };
        if (!m_lists[Normals].empty())
        {
            primitive.normals.push_back(unitOrZero(listed(Normals)));
        }
        if (!m_lists[Uvs].empty())
        {
            primitive.uvs.emplace_back(listed(Uvs));
        }
        if (!m_colors.empty())
        {
            primitive.colors.push_back(corner[Positions] < m_colors.size() ? m_colors[corner[Positions]]
                                                                           : glm::vec4(1.0F));
        }
    }

    static constexpr const char* kNoTriangles = "points and lines left out, only triangles become voxels";

    const std::filesystem::path& m_path;
    std::string_view m_text;
    TextCursor m_lines{""};
    TextCursor m_words{""}; // of the current line
    std::size_t m_line_number = 0;
    SceneBytesLeft m_bytes_left;
    MeshScene m_scene;
    MtlFiles m_materials;
    std::array<std::vector<glm::vec3>, ListCount> m_lists;
    std::array<std::int64_t, ListCount> m_above{}; // the current line
    std::vector<glm::vec4> m_colors;               // of the first vertices, up to the last that has one
    bool m_has_points = false;                     // statements for points
    std::vector<Corner> m_corners;                 // of the current face
    std::vector<std::uint32_t> m_vertices;
    PolygonTriangulator m_triangulator;
    std::string m_material;                        // of the next face
    Primitive* m_primitive = nullptr;              // of m_material, when a face has it
    std::map<std::string, Primitive> m_primitives; // [material]
};

} // namespace

Scene readObj(const std::filesystem::path& path, std::span<const std::uint8_t> bytes, ImageDecoding decoding)
{
    return ObjReader(path, asText(bytes), decoding).read();
}

} // namespace zvo
