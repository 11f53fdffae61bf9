// SPDX-License-Identifier: MIT
#include "common/tree_export.h"

#include "common/normal.h"
#include "common/progress.h"
#include "common/words.h"
#include "core/base/morton.h"
#include "core/file/zvo_file.h"
#include "io/voxel/glb_write.h"
#include "io/voxel/nvdb_write.h"
#include "io/voxel/vox_file.h"

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

static_assert(std::endian::native == std::endian::little); // numbers are written as they are in memory

glm::vec3 voxelCenter(const Grid& grid, std::uint64_t code)
{
    return glm::vec3(glm::dvec3(grid.origin) + (glm::dvec3(cellOfCode(code)) + 0.5) * double{grid.voxel_size});
}

std::string plyHeader(const TreeData& tree)
{
    std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                                     "property float x\nproperty float y\nproperty float z\n",
                                     tree.voxel_count);
    if (tree.hasAttributes())
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

// Collects bytes, and writes them in pieces.
class Pieces
{
public:
    explicit Pieces(Output& output) : m_output(output) {}

    std::vector<std::byte>& bytes() { return m_bytes; }

    void endVoxel()
    {
        if (m_bytes.size() >= kPieceBytes)
        {
            flush();
        }
    }

    void flush()
    {
        m_output.write(m_bytes);
        m_bytes.clear();
    }

private:
    static constexpr std::size_t kPieceBytes = std::size_t{1} << 20;

    Output& m_output;
    std::vector<std::byte> m_bytes;
};

} // namespace

void writeMorton(const TreeData& tree, Output& output)
{
    Pieces pieces(output);
    forEachVoxel(tree,
                 [&pieces](std::uint64_t code)
                 {
                     append(pieces.bytes(), code);
                     pieces.endVoxel();
                 });
    pieces.flush();
}

void writePly(const TreeData& tree, Output& output)
{
    output.write(plyHeader(tree));
    Pieces pieces(output);
    std::size_t voxel = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     append(pieces.bytes(), voxelCenter(tree.grid, code));
                     if (tree.hasAttributes())
                     {
                         appendAttribute(pieces.bytes(), tree.voxelAttribute(voxel));
                     }
                     ++voxel;
                     pieces.endVoxel();
                 });
    pieces.flush();
}

std::string treeFormatOf(const std::string& path)
{
    const std::string extension = extensionOf(path);
    const std::string format = extension.empty() ? extension : extension.substr(1);
    return std::ranges::find(kTreeFormats, format) != kTreeFormats.end() ? format : "";
}

void warnOfLostEmission(const TreeData& tree, std::string_view format, bool strict)
{
    if (!tree.emission.empty() && (format == "ply" || format == "morton" || format == "nvdb"))
    {
        warnOrRefuse({fmt::format("the emission of {} left out, as a .{} file has none",
                                  counted(tree.emission.size(), "voxel"), format)},
                     strict);
    }
}

void writeTree(const TreeData& tree, std::string_view format, Output& output, bool strict)
{
    warnOfLostEmission(tree, format, strict);
    const auto write = [&output](std::span<const std::byte> bytes) { output.write(bytes); };
    if (format == "ply")
    {
        writePly(tree, output);
    }
    else if (format == "morton")
    {
        writeMorton(tree, output);
    }
    else if (format == "vox")
    {
        writeVox(tree, write);
    }
    else if (format == "glb")
    {
        writeGlb(tree, write);
    }
    else if (format == "nvdb")
    {
        writeNvdb(tree, write);
    }
    else
    {
        writeZvo(tree, write);
    }
}

} // namespace zvo::cli
