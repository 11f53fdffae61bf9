// SPDX-License-Identifier: MIT
#include "export.h"

#include "core/pipeline.h"
#include "morton.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

namespace zvo::cli
{

namespace
{

static_assert(std::endian::native == std::endian::little); // numbers are written as they stand in memory

constexpr std::size_t kPieceVoxels = std::size_t{1} << 16; // converted and written at a time

glm::vec3 voxelCentre(const Grid& grid, std::uint64_t code)
{
    return glm::vec3(glm::dvec3(grid.origin) + (glm::dvec3(cellOf(code)) + 0.5) * double{grid.voxel_size});
}

std::string plyHeader(const Octree& octree)
{
    std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                                     "property float x\nproperty float y\nproperty float z\n",
                                     octree.voxel_count);
    if (octree.hasAttributes())
    {
        header += "property float nx\nproperty float ny\nproperty float nz\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    return header + "end_header\n";
}

template <typename T> void append(std::vector<std::byte>& bytes, const T& value)
{
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(value));
}

void appendAttribute(std::vector<std::byte>& bytes, const gpu::Attribute& attribute)
{
    append(bytes, decodeNormal(attribute.normal));
    for (std::uint32_t shift = 0; shift < 24; shift += 8)
    {
        append(bytes, static_cast<std::uint8_t>(attribute.color >> shift));
    }
}

} // namespace

void writeMorton(vk::HeadlessDevice& device, const Octree& octree, Output& output)
{
    const std::vector<std::uint64_t> codes = voxelCodes(device, octree);
    output.write(std::as_bytes(std::span(codes)));
}

void writePly(vk::HeadlessDevice& device, const Octree& octree, Output& output)
{
    const std::vector<std::uint64_t> codes = voxelCodes(device, octree);
    output.write(plyHeader(octree));
    std::vector<gpu::Attribute> attributes;
    std::vector<std::byte> bytes;
    for (std::size_t first = 0; first < codes.size(); first += kPieceVoxels)
    {
        const std::size_t count = std::min(kPieceVoxels, codes.size() - first);
        if (octree.hasAttributes())
        {
            attributes = device.download(octree.voxel_attributes, first, count);
        }
        bytes.clear();
        for (std::size_t i = 0; i < count; ++i)
        {
            append(bytes, voxelCentre(octree.grid, codes[first + i]));
            if (octree.hasAttributes())
            {
                appendAttribute(bytes, attributes[i]);
            }
        }
        output.write(bytes);
    }
}

glm::vec3 decodeNormal(std::uint32_t code)
{
    constexpr double kOne = 32767.0; // 1 as a snorm16
    const double x = static_cast<std::int16_t>(code) / kOne;
    const double y = static_cast<std::int16_t>(code >> 16) / kOne;
    glm::dvec3 v(x, y, 1.0 - std::abs(x) - std::abs(y));
    if (v.z < 0.0)
    {
        v.x = std::copysign(1.0 - std::abs(y), x);
        v.y = std::copysign(1.0 - std::abs(x), y);
    }
    return glm::vec3(glm::normalize(v));
}

} // namespace zvo::cli
