// SPDX-License-Identifier: MIT
// The header of a PLY file, which describes its data; ply_file.h reads the data.
#pragma once

#include "io/file/text_cursor.h"
#include "zvo/error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace zvo
{

enum class PlyEncoding // in the order of the names in ply_header.cpp
{
    Text,
    LittleEndian,
    BigEndian
};

/// A type of numbers.
struct PlyType
{
    std::string_view names[2];
    std::size_t bytes = 0;
    double channel_max = 1.0;                     // the divisor of a colour channel
    double (*value)(const char* bytes) = nullptr; // in the byte order of this machine
    bool is_single = false;                       // single precision
};

/// The meaning of a number, as an index into the numbers of a vertex or face, or of a list: x, y and z from PlyPosition
/// on, and so on.
enum PlyUse : std::size_t
{
    PlyPosition,
    PlyNormal = 3,
    PlyColor = 6,
    PlyAlpha = 9,
    PlyUv,
    PlyPicture = 12,
    PlyCorners,   // a list
    PlyCornerUvs, // a list
    PlyNothing
};

struct PlyProperty
{
    std::string name;
    std::size_t use = PlyNothing;
    const PlyType* type = nullptr;
    const PlyType* count_type = nullptr; // of a list; null: one number
};

struct PlyElement
{
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Whether it has so many numbers of these meanings, from use on.
    [[nodiscard]] bool has(std::size_t use, std::size_t how_many) const;
};

/// How the data is written, and what it holds, in order.
struct PlyHeader
{
    std::string unknown_line; // the first that is not part of the format, such as a comment without its keyword
    PlyEncoding encoding = PlyEncoding::Text;
    std::vector<PlyElement> elements;
    std::vector<std::string> pictures; // names in comments of MeshLab, "TextureFile"
};

/// Reads the header. cursor: at the start of the file, and afterwards at the start of the data. path: for messages.
/// Lines of other keywords are left out. Throws Error{Input}.
PlyHeader readPlyHeader(TextCursor& cursor, const std::filesystem::path& path);

/// Error{Input}: why path is not a valid PLY file.
Error plyError(const std::filesystem::path& path, const std::string& what);

} // namespace zvo
