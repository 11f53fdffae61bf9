// SPDX-License-Identifier: MIT
#include "core/file/zvo_file.h"

#include "core/base/crc64.h"
#include "core/tree/leaf_words.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <iterator>
#include <memory>

namespace zvo
{

namespace
{

static_assert(std::endian::native == std::endian::little); // structs are written as they stand in memory
static_assert(offsetof(ZvoHeader, header_checksum) == 120);

template <typename T> std::span<const std::byte> bytesOf(const T& value)
{
    return std::as_bytes(std::span(&value, 1));
}

/// What a section is going to hold.
struct Content
{
    ZvoSection section;
    std::span<const std::byte> bytes;
};

template <typename T>
void addContent(std::vector<Content>& contents, ZvoSectionId id, std::span<const T> values,
                ZvoFormat format = ZvoFormat::Plain)
{
    if (values.empty())
    {
        return;
    }
    Content& content = contents.emplace_back();
    content.bytes = std::as_bytes(values);
    content.section.id = static_cast<std::uint32_t>(id);
    content.section.format = static_cast<std::uint32_t>(format);
    content.section.flags = kZvoMustUnderstand;
    content.section.bytes = content.bytes.size();
    content.section.count = values.size() / valuesPerElement(format);
    content.section.checksum = crc64(content.bytes);
}

template <typename T>
void addContent(std::vector<Content>& contents, ZvoSectionId id, const std::vector<T>& values,
                ZvoFormat format = ZvoFormat::Plain)
{
    addContent(contents, id, std::span<const T>(values), format);
}

ZvoHeader headerOf(const TreeData& tree)
{
    ZvoHeader header;
    header.version_minor = tree.isFilled() ? kZvoVersionMinor : 0;
    header.structure = static_cast<std::uint32_t>(tree.structure);
    header.origin = {tree.grid.origin.x, tree.grid.origin.y, tree.grid.origin.z};
    header.voxel_size = tree.grid.voxel_size;
    header.depth = tree.grid.depth;
    header.emission_scale = tree.emission_scale;
    header.voxel_count = tree.voxel_count;
    header.node_count = tree.nodes.size();
    header.octree_node_count = tree.octree_node_count;
    header.entry_count = tree.lists.size();
    header.long_entry_count = tree.long_entry_count;
    return header;
}

bool hasZvoName(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension == ".zvo";
}

} // namespace

std::string sectionName(std::uint32_t id)
{
    constexpr const char* kNames[] = {"levels", // ZvoSectionId::Levels and those behind it
                                      "nodes",
                                      "lists",
                                      "counts beside long lists",
                                      "counts beside lists of leaves",
                                      "attributes of voxels",
                                      "attributes of nodes",
                                      "words of the emission table",
                                      "emissions",
                                      "leaves",
                                      "occupied cells"};
    return id != 0 && id <= std::size(kNames) ? kNames[id - 1] : fmt::format("section {}", id);
}

std::uint64_t headerChecksum(const ZvoHeader& header)
{
    return crc64(bytesOf(header).first(offsetof(ZvoHeader, header_checksum)));
}

bool isZvoFile(const std::filesystem::path& path)
{
    if (hasZvoName(path))
    {
        return true;
    }
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure))
    {
        return false; // a pipe gives its first bytes only once
    }
    std::array<char, kZvoMagic.size()> first{};
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    return file && std::fread(first.data(), 1, first.size(), file.get()) == first.size() && first == kZvoMagic;
}

void writeZvo(const TreeData& tree, const std::function<void(std::span<const std::byte>)>& write)
{
    std::vector<std::uint64_t> levels;
    for (const DeviceTree::Level& level : tree.levels)
    {
        levels.push_back(level.node_count);
    }
    std::vector<Content> contents;
    addContent(contents, ZvoSectionId::Levels, levels);
    const std::span<const gpu::Node> nodes = tree.nodes;
    const std::uint32_t leaf_count = leafWordsOf(tree.levels);
    addContent(contents, ZvoSectionId::Nodes, nodes.first(nodes.size() - leaf_count));
    const std::vector<std::uint64_t> list_words = packEntries(tree.lists, tree.packing().per_word);
    addContent(contents, ZvoSectionId::Lists, list_words);
    addContent(contents, ZvoSectionId::Before, tree.before);
    addContent(contents, ZvoSectionId::VoxelsBeforeLeaf, tree.voxels_before_leaf);
    addContent(contents, ZvoSectionId::VoxelAttributes, tree.voxel_attributes);
    addContent(contents, ZvoSectionId::VoxelAttributes, tree.packed.voxels, zvoFormat(tree.packed.format));
    addContent(contents, ZvoSectionId::NodeAttributes, tree.node_attributes);
    addContent(contents, ZvoSectionId::NodeAttributes, tree.packed.nodes, zvoFormat(nodeFormat(tree.packed.format)));
    addContent(contents, ZvoSectionId::EmissionWords, tree.emission_words);
    addContent(contents, ZvoSectionId::Emission, tree.emission);
    std::vector<std::uint64_t> leaves(leaf_count);
    std::ranges::transform(nodes.last(leaf_count), leaves.begin(), cellMask);
    addContent(contents, ZvoSectionId::Leaves, leaves);
    addContent(contents, ZvoSectionId::Occupied, tree.occupied);

    std::uint64_t end = sizeof(ZvoHeader) + contents.size() * sizeof(ZvoSection);
    std::vector<ZvoSection> table;
    for (Content& content : contents)
    {
        content.section.offset = zvoAligned(end);
        end = content.section.offset + content.section.bytes;
        table.push_back(content.section);
    }
    ZvoHeader header = headerOf(tree);
    header.section_count = static_cast<std::uint32_t>(table.size());
    header.file_bytes = end;
    header.table_checksum = crc64(std::as_bytes(std::span(table)));
    header.header_checksum = headerChecksum(header);

    constexpr std::array<std::byte, kZvoAlignment> kZeros{};
    write(bytesOf(header));
    write(std::as_bytes(std::span(table)));
    std::uint64_t written = sizeof(header) + table.size() * sizeof(ZvoSection);
    for (const Content& content : contents)
    {
        write(std::span(kZeros).first(content.section.offset - written));
        write(content.bytes);
        written = content.section.offset + content.bytes.size();
    }
}

} // namespace zvo
