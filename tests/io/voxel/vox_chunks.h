// SPDX-License-Identifier: MIT
// MagicaVoxel's files, chunk by chunk as the format's author documents them.
#pragma once

#include "support/mesh_files.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace zvo::test::vox
{

inline std::string number(std::int32_t value)
{
    std::string bytes;
    appendBytes(bytes, value);
    return bytes;
}

inline std::string text(const std::string& value)
{
    return number(static_cast<std::int32_t>(value.size())) + value;
}

inline std::string chunk(const std::string& id, const std::string& content, const std::string& children = "")
{
    return id + number(static_cast<std::int32_t>(content.size())) + number(static_cast<std::int32_t>(children.size())) +
           content + children;
}

inline std::string voxFile(const std::string& chunks)
{
    return "VOX " + number(150) + chunk("MAIN", "", chunks);
}

inline std::string model(int x, int y, int z, const std::string& voxels)
{
    return chunk("SIZE", number(x) + number(y) + number(z)) +
           chunk("XYZI", number(static_cast<std::int32_t>(voxels.size() / 4)) + voxels);
}

using Entries = std::vector<std::pair<std::string, std::string>>;

inline std::string dictionary(const Entries& entries)
{
    std::string bytes = number(static_cast<std::int32_t>(entries.size()));
    for (const auto& [key, value] : entries)
    {
        bytes += text(key) + text(value);
    }
    return bytes;
}

inline std::string transform(int id, int child, const Entries& frame, const Entries& attributes = {}, int layer = 0)
{
    return chunk("nTRN", number(id) + dictionary(attributes) + number(child) + number(-1) + number(layer) + number(1) +
                             dictionary(frame));
}

inline std::string group(int id, const std::vector<int>& children)
{
    std::string content = number(id) + dictionary({}) + number(static_cast<std::int32_t>(children.size()));
    for (const int child : children)
    {
        content += number(child);
    }
    return chunk("nGRP", content);
}

inline std::string shape(int id, int model_number)
{
    return chunk("nSHP", number(id) + dictionary({}) + number(1) + number(model_number) + dictionary({}));
}

} // namespace zvo::test::vox
