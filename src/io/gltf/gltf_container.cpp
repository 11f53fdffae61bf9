// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_container.h"

#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "io/file/json_cursor.h"
#include "io/gltf/gltf_document.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace zvo
{

namespace
{

using nlohmann::json;
using Bytes = std::span<const std::uint8_t>;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian and is read by copying");

constexpr int kJsonDepthMax = 256; // nesting that all recursive functions can handle

// Binary glTF: a header of magic, version, length; then chunks of length, type and data.
constexpr std::string_view kGlbMagic = "glTF";
constexpr std::string_view kJsonChunk = "JSON";
constexpr std::string_view kBinChunk{"BIN\0", 4};
constexpr std::uint32_t kGlbVersion = 2;
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t readU32(Bytes bytes, std::size_t offset)
{
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

GltfContainer splitGlb(Bytes file, const std::filesystem::path& path)
{
    if (file.size() < kGlbHeaderBytes)
    {
        throw gltfError(path,
                        fmt::format("a binary glTF header has 12 bytes, the file {}; {}", file.size(), kCutShort));
    }
    const std::uint32_t version = readU32(file, 4);
    if (version != kGlbVersion)
    {
        throw gltfError(path, fmt::format("binary glTF version {} is not supported; export it as glTF 2.0", version));
    }
    const std::uint32_t length = readU32(file, 8);
    if (length > file.size())
    {
        throw gltfError(
            path, fmt::format("the header announces {} bytes, the file has {}; {}", length, file.size(), kCutShort));
    }
    GltfContainer container;
    Bytes rest = file.first(length);
    rest = rest.subspan(std::min(kGlbHeaderBytes, rest.size()));
    for (std::size_t chunk = 0; rest.size() >= kChunkHeaderBytes; ++chunk)
    {
        const std::uint32_t chunk_bytes = readU32(rest, 0);
        const std::string_view type = asText(rest.subspan(4, 4));
        rest = rest.subspan(kChunkHeaderBytes);
        if (chunk_bytes > rest.size())
        {
            throw gltfError(path, fmt::format("chunk {} announces {} bytes, {} are left in the file; {}", chunk,
                                              chunk_bytes, rest.size(), kCutShort));
        }
        if (chunk == 0 && type == kJsonChunk)
        {
            container.json = asText(rest.first(chunk_bytes));
        }
        else if (chunk == 1 && type == kBinChunk)
        {
            container.bin = rest.first(chunk_bytes);
        }
        rest = rest.subspan(chunk_bytes);
    }
    if (container.json.empty())
    {
        throw gltfError(path, fmt::format("the first chunk is not JSON; {}", kExportAgain));
    }
    return container;
}

/// The depth of nested arrays and objects in JSON text.
int nestingDepth(std::string_view text)
{
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const char character = text[i];
        if (in_string && character == '\\')
        {
            ++i; // skips the escaped character, which may be a quote
        }
        else if (character == '"')
        {
            in_string = !in_string;
        }
        else if (!in_string && (character == '{' || character == '['))
        {
            deepest = std::max(deepest, ++depth);
        }
        else if (!in_string && (character == '}' || character == ']'))
        {
            --depth;
        }
    }
    return deepest;
}

} // namespace

GltfContainer openGltfContainer(Bytes file, const std::filesystem::path& path)
{
    return asText(file).starts_with(kGlbMagic) ? splitGlb(file, path) : GltfContainer{asText(file), {}};
}

json parseGltfJson(std::string_view text, const std::filesystem::path& path)
{
    // Not by a callback of the parser, which then walks all of an array at the end of each of its items.
    if (nestingDepth(text) > kJsonDepthMax)
    {
        throw gltfError(path, fmt::format("its JSON is nested more than {} deep; {}", kJsonDepthMax, kExportAgain));
    }
    try
    {
        return json::parse(text);
    }
    catch (const json::exception& failure)
    {
        throw gltfError(path, fmt::format("not a glTF file: {}; check that it is glTF 2.0 (.gltf or .glb)",
                                          jsonFault(text, failure)));
    }
}

} // namespace zvo
