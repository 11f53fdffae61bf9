// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/output.h"
#include "common/report.h"
#include "common/tree_input.h"
#include "common/words.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/file/tree_stats.h"
#include "core/file/zvo_file.h"
#include "io/file/sha256.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <string>
#include <vector>

namespace zvo::cli
{

namespace
{

// SHA-256 of a regular file, which can be read again.
std::string fileSha256(const std::filesystem::path& path)
{
    constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
    Sha256 sha;
    std::ifstream file(path, std::ios::binary);
    std::vector<char> piece(kPieceBytes);
    do
    {
        file.read(piece.data(), kPieceBytes);
        sha.update(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(file.gcount()))));
    } while (file);
    if (!file.eof())
    {
        throw inputError(path, "cannot be read to its end; try again");
    }
    return sha.hexDigest();
}

struct Inspected
{
    ZvoFile file; // of a .vox file the tree alone
    std::string sha256;
    bool is_vox = false;
};

// A file with its digest. A file that is not regular is read once.
Inspected readWithSha256(const std::filesystem::path& path)
{
    if (isVoxFile(path))
    {
        const std::vector<std::uint8_t> bytes = readFile(path);
        return {{{}, {}, treeOfVox(bytes, path)}, sha256Hex(std::as_bytes(std::span(bytes))), true};
    }
    std::error_code failure;
    if (std::filesystem::is_regular_file(path, failure))
    {
        ZvoFile file = readZvo(path);
        return {std::move(file), fileSha256(path)};
    }
    const std::vector<std::uint8_t> bytes = readFile(path);
    const auto read = std::as_bytes(std::span(bytes));
    return {readZvo(read, path), sha256Hex(read)};
}

double perVoxel(std::uint64_t bytes, const TreeData& tree)
{
    const std::uint64_t count = tree.occupiedCount();
    return count == 0 ? 0.0 : static_cast<double>(bytes) / static_cast<double>(count);
}

Json inspectJson(const TreeData& tree, const TreeStats& stats, const std::string& sha256)
{
    Json levels = Json::array();
    for (const DeviceTree::Level& level : tree.levels)
    {
        levels.push_back(level.node_count);
    }
    Json json;
    json["schema"] = "zvo.inspect/1";
    json["structure"] = structureName(tree.structure);
    json["grid"] = gridJson(tree.grid);
    json["voxels"] = tree.occupiedCount();
    json["interior_voxels"] = tree.interior_count;
    json["nodes"] = tree.nodes.size();
    json["nodes_per_level"] = levels;
    json["geometry_bytes"] = tree.geometryBytes();
    json["attribute_bytes"] = tree.attributeBytes();
    json["rank_bytes"] = tree.rankBytes();
    json["geometry_bytes_per_voxel"] = perVoxel(tree.geometryBytes(), tree);
    json["slides_octree_bytes"] = stats.slidesOctreeBytes();
    json["slides_dag_bytes"] = stats.slidesDagBytes();
    json["sha256"] = sha256;
    return json;
}

std::string attributesText(const TreeData& tree, bool is_vox)
{
    if (!tree.hasAttributes())
    {
        return "none";
    }
    if (is_vox)
    {
        return "colour; faces have the normals";
    }
    return fmt::format("form {}: colour{} normal{}, {:.3f} bytes a voxel", formatName(tree.attributeFormat()),
                       tree.emission.empty() ? " and" : ",",
                       tree.emission.empty() ? "" : fmt::format(", and emission of {}", tree.emission.size()),
                       perVoxel(tree.attributeBytes(), tree));
}

std::string summaryText(const Inspected& inspected)
{
    const auto& [file, sha256, is_vox] = inspected;
    const TreeData& tree = file.tree;
    std::string text;
    const auto add = [&text](const char* label, const std::string& value)
    { text += fmt::format("{:<12}{}\n", label, value); };
    add("structure", is_vox ? "voxels of MagicaVoxel, as an octree" : structureName(tree.structure));
    if (!is_vox)
    {
        add("version", fmt::format("{}.{}", file.header.version_major, file.header.version_minor));
    }
    add("grid", fmt::format("{}^3 from ({}, {}, {}) on, voxels of {}", tree.grid.resolution(), tree.grid.origin.x,
                            tree.grid.origin.y, tree.grid.origin.z, tree.grid.voxel_size));
    add("voxels", tree.isFilled() ? fmt::format("{}, {} of them inside", tree.occupiedCount(), tree.interior_count)
                                  : fmt::format("{}", tree.voxel_count));
    add("nodes", fmt::format("{} for the {} of the octree", tree.nodes.size(), tree.octree_node_count));
    add("attributes", attributesText(tree, is_vox));
    add("sha256", sha256);
    return text;
}

std::string levelsText(const TreeData& tree, const TreeStats& stats)
{
    std::string text = fmt::format("\n{:<12}{:>14}{:>14}\n", "level", "nodes", "different");
    for (std::size_t level = 0; level < tree.levels.size(); ++level)
    {
        text +=
            fmt::format("{:<12}{:>14}{:>14}\n", level, tree.levels[level].node_count, stats.unique_per_level[level]);
    }
    return text;
}

std::string sectionsText(const ZvoFile& file)
{
    std::string text = fmt::format("\n{:<32}{:>14}{:>16}{:>16}\n", "section", "elements", "at byte", "bytes");
    for (const ZvoSection& section : file.sections)
    {
        text += fmt::format("{:<32}{:>14}{:>16}{:>16}\n", sectionName(section.id), section.count, section.offset,
                            section.bytes);
    }
    return text;
}

std::string bytesText(const TreeData& tree, const TreeStats& stats, bool is_vox)
{
    std::string text = fmt::format("\n{:<32}{:>14}{:>16}{:>16}\n", "geometry", "nodes", "bytes", "bytes a voxel");
    const auto add = [&](const std::string& what, std::uint64_t nodes, std::uint64_t bytes)
    { text += fmt::format("{:<32}{:>14}{:>16}{:>16.3f}\n", what, nodes, bytes, perVoxel(bytes, tree)); };
    add(is_vox ? "zvo's octree" : "this file", tree.nodes.size(), tree.geometryBytes());
    if (tree.rankBytes() != 0)
    {
        add("... with ranks, for attributes", tree.nodes.size(), tree.geometryBytes() + tree.rankBytes());
    }
    add("octree, 16-byte nodes", tree.octree_node_count, tree.octree_node_count * sizeof(gpu::Node));
    add("2x2x2 octree, 36-byte nodes", stats.binary_node_count, stats.slidesOctreeBytes());
    add("2x2x2 DAG, 68-byte nodes", stats.binary_unique_count, stats.slidesDagBytes());
    return text;
}

} // namespace

void inspect(const InspectOptions& options)
{
    const Inspected inspected = readWithSha256(options.file);
    const auto& [file, sha256, is_vox] = inspected;
    const TreeStats stats = treeStats(file.tree);
    Output output("-", true);
    output.write(options.json ? jsonText(inspectJson(file.tree, stats, sha256))
                              : summaryText(inspected) + levelsText(file.tree, stats) +
                                    (is_vox ? "" : sectionsText(file)) + bytesText(file.tree, stats, is_vox));
}

void validate(const ValidateOptions& options)
{
    const TreeData tree =
        isVoxFile(options.file) ? treeOfVox(readFile(options.file), options.file) : readZvo(options.file).tree;
    const TreeStats stats = treeStats(tree);
    for (std::size_t level = 0; level < tree.levels.size() && tree.structure == TreeStructure::Svdag; ++level)
    {
        if (stats.unique_per_level[level] != tree.levels[level].node_count)
        {
            throw inputError(options.file,
                             fmt::format("level {} has {} nodes of which {} are different; {}", level,
                                         tree.levels[level].node_count, stats.unique_per_level[level], kExportAgain));
        }
    }
    Output("-", true).write(fmt::format("{}: sound, {} with {} of {}^3, {}\n", options.file.string(),
                                        structureName(tree.structure), counted(tree.occupiedCount(), "voxel"),
                                        tree.grid.resolution(),
                                        tree.hasAttributes() ? "with attributes" : "without attributes"));
}

} // namespace zvo::cli
