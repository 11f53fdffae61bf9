// SPDX-License-Identifier: MIT
#include "io/mesh/ply_header.h"

#include "core/base/input_error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace zvo
{

namespace
{

std::optional<PlyType> typeOf(std::string_view name)
{
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames = {{{"char", PlyType::Int8},
                                                                              {"int8", PlyType::Int8},
                                                                              {"uchar", PlyType::UInt8},
                                                                              {"uint8", PlyType::UInt8},
                                                                              {"short", PlyType::Int16},
                                                                              {"int16", PlyType::Int16},
                                                                              {"ushort", PlyType::UInt16},
                                                                              {"uint16", PlyType::UInt16},
                                                                              {"int", PlyType::Int32},
                                                                              {"int32", PlyType::Int32},
                                                                              {"uint", PlyType::UInt32},
                                                                              {"uint32", PlyType::UInt32},
                                                                              {"float", PlyType::Float32},
                                                                              {"float32", PlyType::Float32},
                                                                              {"double", PlyType::Float64},
                                                                              {"float64", PlyType::Float64}}};
    const auto found =
        std::find_if(kNames.begin(), kNames.end(), [name](const auto& entry) { return entry.first == name; });
    return found != kNames.end() ? std::optional(found->second) : std::nullopt;
}

PlyEncoding encodingOf(std::string_view name, const std::filesystem::path& path)
{
    if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
    {
        throw plyError(path, fmt::format("its format is \"{}\"", name));
    }
    return name == "ascii"                  ? PlyEncoding::Text
           : name == "binary_little_endian" ? PlyEncoding::LittleEndian
                                            : PlyEncoding::BigEndian;
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
