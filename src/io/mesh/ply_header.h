// SPDX-License-Identifier: MIT
// The header of a PLY file, which describes its data; ply_file.h reads the data.
#pragma once

#include "io/file/text_cursor.h"
#include "zvo/error.h"

#include <cstdint>
#include <filesystem>
#include <optional>
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

enum class PlyType
{
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Float32,
    Float64
};

struct PlyProperty
{
    std::string name;
    PlyType type = PlyType::Float32;
    std::optional<PlyType> count_type; // of a list
};

struct PlyElement
{
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

/// How the data is written, and what it holds, in order.
struct PlyHeader
{
    std::string unknown_line; // the first that is not part of the format, such as a comment without its keyword
    PlyEncoding encoding = PlyEncoding::Text;
    std::vector<PlyElement> elements;
};

/// Reads the header. cursor: at the start of the file, and afterwards at the start of the data. path: for messages.
/// Lines of other keywords are left out. Throws Error{Input}.
PlyHeader readPlyHeader(TextCursor& cursor, const std::filesystem::path& path);

/// Error{Input}: why path is not a valid PLY file.
Error plyError(const std::filesystem::path& path, const std::string& what);

} // namespace zvo
