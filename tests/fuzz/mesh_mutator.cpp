// SPDX-License-Identifier: MIT
#include "fuzz/mesh_mutator.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace zvo::test
{

namespace
{

constexpr std::string_view kSpace = " \t\r\n";

constexpr auto kWords = std::to_array<std::string_view>(
    {"0", "1", "-1", "2", "3", "-4", "0.5", "1e-45", "1e38", "1e39", "-1e300", "nan", "inf", "255", "256", "65536",
     "4294967295", "4294967296", "18446744073709551615", "1/1", "1//1", "1/1/1", "-1/-1/-1", "9/9/9", "/", "\\", "#",
     // OBJ
     "v", "vt", "vn", "f", "l", "p", "g", "o", "s", "usemtl", "mtllib", "side.mtl", "side.png", "../side.mtl",
     "/dev/zero", "a", "b", "newmtl", "Kd", "Ke", "d", "Tr", "map_Kd", "map_Ke", "map_d", "-s", "-o", "-t", "-mm",
     "-clamp", "on", "-halo", "input.xyz",
     // PLY
     "ply", "format", "ascii", "binary_little_endian", "binary_big_endian", "1.0", "comment", "element", "vertex",
     "face", "tristrips", "property", "list", "char", "uchar", "short", "ushort", "int", "uint", "float", "double", "x",
     "y", "z", "nx", "red", "green", "blue", "alpha", "vertex_indices", "texcoord", "texnumber", "TextureFile",
     "end_header",
     // STL
     "solid", "facet", "normal", "outer", "loop", "endloop", "endfacet", "endsolid", "SOLID", "END",
     // text with points
     ",", ";", "//", "0 0 1", "255 0 9", "0 0 0 0 0 0"});

constexpr auto kNumbers = std::to_array<std::uint32_t>(
    {0, 1, 2, 3, 255, 256, 65535, 0x80000000, 0xffffffff, 0x3f800000, 0x7f800000, 0x7fc00000, 0x7f7fffff, 1});

struct Part
{
    std::size_t at = 0;
    std::size_t size = 0;
};

/// The word or line around a random place.
Part pickPart(const std::string& content, std::string_view ends, std::mt19937& random)
{
    const std::size_t place = random() % content.size();
    const std::size_t before = content.find_last_of(ends, place);
    const std::size_t first = before == std::string::npos ? 0 : before + 1;
    const std::size_t last = content.find_first_of(ends, first);
    return {first, std::min(last, content.size()) - first};
}

std::string pickLine(const std::string& content, std::mt19937& random)
{
    const Part line = pickPart(content, "\n", random);
    return content.substr(line.at, line.size) + "\n";
}

void changeNumber(std::string& content, std::mt19937& random)
{
    const std::size_t bytes = std::size_t{1} << (random() % 3);
    if (content.size() >= bytes)
    {
        const std::uint32_t number = kNumbers[random() % kNumbers.size()];
        std::memcpy(content.data() + random() % (content.size() - bytes + 1), &number, bytes);
    }
}

} // namespace

void mutateMesh(std::string& content, std::mt19937& random)
{
    if (content.empty())
    {
        content = "ply\n";
        return;
    }
    for (std::uint32_t i = 0; i <= random() % 3 && !content.empty(); ++i)
    {
        const std::string_view word = kWords[random() % kWords.size()];
        const Part place = pickPart(content, random() % 2 == 0 ? kSpace : "\n", random);
        switch (random() % 6)
        {
        case 0:
            content.erase(place.at, place.size);
            break;
        case 1:
            content.insert(place.at, std::string(word) + (random() % 2 == 0 ? " " : "\n"));
            break;
        case 2:
            content.insert(place.at, pickLine(content, random));
            break;
        case 3:
            changeNumber(content, random);
            break;
        default:
        {
            const Part old = pickPart(content, kSpace, random);
            content.replace(old.at, old.size, word);
            break;
        }
        }
    }
}

void crossMesh(std::string& content, const std::string& other, std::mt19937& random)
{
    for (std::uint32_t i = 0; i <= random() % 4 && !content.empty() && !other.empty(); ++i)
    {
        content.insert(pickPart(content, "\n", random).at, pickLine(other, random));
    }
}

} // namespace zvo::test
