// SPDX-License-Identifier: MIT
#include "io/mesh/ply_header.h"

#include "core/base/input_error.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <type_traits>

namespace zvo
{

namespace
{

template <typename T> double valueOf(const char* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof(value));
    return static_cast<double>(value);
}

template <typename T> constexpr PlyType typeOf(std::string_view name, std::string_view other, double channel_max = 1.0)
{
    return {{name, other}, sizeof(T), channel_max, valueOf<T>, std::is_same_v<T, float>};
}

constexpr PlyType kTypes[] = {
    typeOf<std::int8_t>("char", "int8"),    typeOf<std::uint8_t>("uchar", "uint8", 255.0),
    typeOf<std::int16_t>("short", "int16"), typeOf<std::uint16_t>("ushort", "uint16", 65535.0),
    typeOf<std::int32_t>("int", "int32"),   typeOf<std::uint32_t>("uint", "uint32"),
    typeOf<float>("float", "float32"),      typeOf<double>("double", "float64")};

const PlyType* findType(std::string_view name)
{
    const auto* const found = std::ranges::find_if(kTypes, [&](const PlyType& type)
                                                   { return type.names[0] == name || type.names[1] == name; });
    return found != std::end(kTypes) ? found : nullptr;
}

std::size_t useOf(std::string_view name)
{
    constexpr std::string_view kNames[] = {
        // in the order of PlyUse; - is no name
        "x y z nx ny nz red green blue alpha s t texnumber vertex_indices texcoord",
        "- - - -  -  -  r   g     b    a     u v -         vertex_index   -",
        "- - - -  -  -  diffuse_red diffuse_green diffuse_blue - texture_u texture_v - - -"};
    for (TextCursor names : {TextCursor(kNames[0]), TextCursor(kNames[1]), TextCursor(kNames[2])})
    {
        for (std::size_t use = 0; use < PlyNothing; ++use)
        {
            if (names.word() == name && name != "-")
            {
                return use;
            }
        }
    }
    return PlyNothing;
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
    const bool is_list = type_name == "list";
    PlyProperty property;
    if (is_list)
    {
        property.count_type = findType(words.word());
        type_name = words.word();
    }
    property.type = findType(type_name);
    if (property.type == nullptr || (is_list && property.count_type == nullptr) || header.elements.empty())
    {
        throw plyError(path, fmt::format("\"{}\" has an unknown type or no element", line));
    }
    property.name = words.word();
    const std::size_t use = useOf(property.name);
    property.use = is_list == (use == PlyCorners || use == PlyCornerUvs) ? use : std::size_t{PlyNothing};
    header.elements.back().properties.push_back(property);
}

} // namespace

bool PlyElement::has(std::size_t use, std::size_t how_many) const
{
    const auto is_there = std::ranges::find(properties, use, &PlyProperty::use) != properties.end();
    return how_many == 0 || (is_there && has(use + 1, how_many - 1));
}

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
        else if (keyword == "comment" && words.word() == "TextureFile")
        {
            header.pictures.emplace_back(words.rest());
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
