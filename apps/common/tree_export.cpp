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
#include "io/voxel/write_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace zvo::cli
{

namespace
{

glm::vec3 voxelCenter(const Grid& grid, std::uint64_t code)
{
    return glm::vec3(glm::dvec3(grid.origin) + (glm::dvec3(cellOfCode(code)) + 0.5) * double{grid.voxel_size});
}

std::string plyHeader(const TreeData& tree)
{
    std::string header = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
                                     "property float x\nproperty float y\nproperty float z\n",
                                     tree.occupiedCount());
    if (tree.hasAttributes())
    {
        header += "property float nx\nproperty float ny\nproperty float nz\n"
                  "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    return header + "end_header\n";
}

void addAttribute(ByteCollector& bytes, const gpu::Attribute& attribute)
{
    bytes.add(decodeNormal(attribute.normal));
    for (std::uint32_t shift = 0; shift < 24; shift += 8)
    {
        bytes.add(static_cast<std::uint8_t>(attribute.color >> shift));
    }
}

WriteBytes into(Output& output)
{
    return [&output](std::span<const std::byte> bytes) { output.write(bytes); };
}

} // namespace

void writeMorton(const TreeData& tree, Output& output)
{
    const WriteBytes write = into(output);
    ByteCollector bytes;
    forEachCell(tree,
                [&](std::uint64_t code, bool)
                {
                    bytes.add(code);
                    bytes.passOn(write);
                });
    write(bytes.bytes());
}

void writePly(const TreeData& tree, Output& output)
{
    const WriteBytes write = into(output);
    ByteCollector bytes;
    bytes.addText(plyHeader(tree));
    std::size_t voxel = 0;
    forEachCell(tree,
                [&](std::uint64_t code, bool on_surface)
                {
                    bytes.add(voxelCenter(tree.grid, code));
                    if (tree.hasAttributes())
                    {
                        addAttribute(bytes, on_surface ? tree.voxelAttribute(voxel) : tree.interiorAttribute());
                    }
                    voxel += on_surface ? 1 : 0;
                    bytes.passOn(write);
                });
    write(bytes.bytes());
}

std::string treeFormatOf(const std::string& path)
{
    const std::string extension = extensionOf(path);
    const std::string format = extension.empty() ? extension : extension.substr(1);
    return std::ranges::find(kTreeFormats, format) != kTreeFormats.end() ? format : "";
}

std::string treeFormatFor(const std::string& path, const std::string& chosen)
{
    const std::string format = chosen.empty() ? treeFormatOf(path) : chosen;
    if (format.empty())
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: the format is not clear; name it .{}, or say --format", path,
                                                  fmt::join(kTreeFormats, ", .")));
    }
    return format;
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
    const WriteBytes write = into(output);
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
