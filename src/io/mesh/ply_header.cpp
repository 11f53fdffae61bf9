// SPDX-License-Identifier: MIT
#include "io/mesh/ply_header.h"

#include "core/base/input_error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <string_view>

namespace zvo
{

namespace
{

std::optional<PlyType> typeOf(std::string_view name)
{
    constexpr std::string_view kNames[][2] = {{"char", "int8"},     {"uchar", "uint8"},   {"short", "int16"},
                                              {"ushort", "uint16"}, {"int", "int32"},     {"uint", "uint32"},
                                              {"float", "float32"}, {"double", "float64"}}; // in the order of PlyType
    const auto* const found = std::find_if(std::begin(kNames), std::end(kNames),
                                           [&](const auto& names) { return names[0] == name || names[1] == name; });
    return found != std::end(kNames) ? std::optional(static_cast<PlyType>(found - std::begin(kNames))) : std::nullopt;
}

PlyEncoding encodingOf(std::string_view name, const std::filesystem::path& path)
{
    constexpr std::array<std::string_view, 3> kNames = {"ascii", "binary_little_endian", "binary_big_endian"};
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    if (found == kNames.end())
    {
        throw plyError(path, fmt::format("its format is \"{}\"", name));
    }
    return static_cast<PlyEncoding>(found - kNames.begin());
}

void addProperty(TextCursor& words, std::string_view line, PlyHeader& header, const std::filesystem::path& path)
{
    std::string_view type_name = words.word();
    PlyProperty property;
    if (type_name == "list")
    {
        property.count_type = typeOf(words.word());
        type_name = words.word();
        if (!property.count_type)
        {
            throw plyError(path, fmt::format("\"{}\" has an unknown type", line));
        }
    }
    const std::optional<PlyType> type = typeOf(type_name);
    if (!type || header.elements.empty())
    {
        throw plyError(path, fmt::format("\"{}\" has an unknown type or no element", line));
    }
    property.type = *type;
    property.name = words.word();
    header.elements.back().properties.push_back(property);
}

} // namespace

PlyHeader readPlyHeader(TextCursor& cursor, const std::filesystem::path& path)
{
    const auto fail = [&](const std::string& what) { return plyError(path, what); };
    PlyHeader header;
    if (TextCursor(cursor.line().value_or("")).word() != "ply")
    {
        throw fail("its first line is not \"ply\"");
    }
    for (auto line = cursor.line(); line; line = cursor.line())
    {
        TextCursor words(*line);
        const std::string_view keyword = words.word();
        if (keyword == "end_header")
        {
            return header;
        }
        if (keyword == "format")
        {
            header.encoding = encodingOf(words.word(), path);
        }
        else if (keyword == "element")
        {
            const std::string name(words.word());
            const auto count = parseNumber<std::uint64_t>(words.word());
            if (!count)
            {
                throw fail(fmt::format("\"{}\" has no count", *line));
            }
            header.elements.push_back({name, *count, {}});
        }
        else if (keyword == "property")
        {
            addProperty(words, *line, header, path);
        }
        else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info" && header.unknown_line.empty())
        {
            header.unknown_line = *line;
        }
    }
    throw fail("its header has no end");
}

Error plyError(const std::filesystem::path& path, const std::string& what)
{
    return inputError(path, fmt::format("not a valid PLY file: {}; {}", what, kExportAgain));
}

} // namespace zvo
