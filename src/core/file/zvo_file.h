// SPDX-License-Identifier: MIT
// `.zvo` files: a tree with its attributes. docs/file-format.md documents every byte; the structs below are those of
// the file, little-endian.
//
//     ZvoHeader 128 bytes | ZvoSection 48 bytes each | zeros up to 64 | section | zeros up to 64 | section ...
#pragma once

#include "core/base/divide_up.h"
#include "core/tree/tree_data.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The first bytes of a file. If a transfer as text has changed the file (line ends, the eighth bit, an end at byte
/// 26), they no longer match.
inline constexpr std::array<char, 8> kZvoMagic = {'\x8a', 'Z', 'V', 'O', '\r', '\n', '\x1a', '\n'};

inline constexpr std::uint32_t kZvoByteOrder = 0x01020304U;
inline constexpr std::uint16_t kZvoVersionMajor = 2; // readers refuse later ones
inline constexpr std::uint16_t kZvoVersionMinor = 1; // of files with filled octrees, of others 0; readers accept any
inline constexpr std::uint64_t kZvoAlignment = 64;   // of sections, in bytes
inline constexpr std::uint32_t kZvoSectionsMax = 1024;

/// What sections hold. Ids are never used again.
enum class ZvoSectionId : std::uint32_t
{
    Levels = 1,           ///< number of nodes of each level, 64-bit
    Nodes = 2,            ///< gpu::Node; of trees of several levels without the leaves, since version 2
    Lists = 3,            ///< 32-bit
    Before = 4,           ///< gpu::BeforeChild
    VoxelsBeforeLeaf = 5, ///< 16-bit, two to a word
    VoxelAttributes = 6,  ///< as ZvoFormat says
    NodeAttributes = 7,   ///< as ZvoFormat says
    EmissionWords = 8,    ///< two 32-bit words for 32 voxels
    Emission = 9,         ///< RGB9E5
    Leaves = 10,          ///< masks, 64-bit
    Occupied = 11,        ///< masks of the leaves of a filled octree, 64-bit, since version 2.1
};

/// How the elements of a section are laid out. All formats but Plain are for attributes only.
enum class ZvoFormat : std::uint32_t
{
    Plain = 1,       ///< as in device memory; attributes: gpu::Attribute, 8 bytes
    Attributes4 = 2, ///< a word each (shared/attribute_formats.h)
    Blocks = 3,      ///< of voxels: 6 words for 16 of them (likewise)
};

/// The section format that holds attributes in `format`.
constexpr ZvoFormat zvoFormat(AttributeFormat format)
{
    return format == AttributeFormat::Bytes4
               ? ZvoFormat::Attributes4
               : (format == AttributeFormat::Blocks ? ZvoFormat::Blocks : ZvoFormat::Plain);
}

/// How many values of the array in memory make one element of a section.
constexpr std::uint64_t valuesPerElement(ZvoFormat format)
{
    return format == ZvoFormat::Blocks ? gpu::kBlockWords : 1;
}

/// Flag of a section: a reader that does not know the section's id or format must refuse the file.
inline constexpr std::uint32_t kZvoMustUnderstand = 1;

/// The header, at byte 0 of a file.
struct ZvoHeader
{
    std::array<char, 8> magic = kZvoMagic;
    std::uint32_t byte_order = kZvoByteOrder;
    std::uint16_t version_major = kZvoVersionMajor;
    std::uint16_t version_minor = kZvoVersionMinor;
    std::uint32_t header_bytes = 128;
    std::uint32_t section_count = 0;
    std::uint32_t structure = 0; // TreeStructure
    std::uint32_t reserved_0 = 0;
    std::uint64_t file_bytes = 0;
    std::array<float, 3> origin{};
    float voxel_size = 0;
    std::uint32_t depth = 0;
    float emission_scale = 0;
    std::uint64_t voxel_count = 0;
    std::uint64_t node_count = 0;        // stored in the file
    std::uint64_t octree_node_count = 0; // before equal subtrees became one
    std::uint64_t entry_count = 0;
    std::uint64_t long_entry_count = 0;
    std::uint64_t reserved_1 = 0;
    std::uint64_t table_checksum = 0;  // crc64 of the section table
    std::uint64_t header_checksum = 0; // crc64 of the bytes before
};
static_assert(sizeof(ZvoHeader) == 128);

/// One line of the section table.
struct ZvoSection
{
    std::uint32_t id = 0;     // ZvoSectionId, ascending
    std::uint32_t format = 0; // ZvoFormat
    std::uint32_t flags = 0;
    std::uint32_t reserved = 0;
    std::uint64_t offset = 0; // from the file's first byte
    std::uint64_t bytes = 0;
    std::uint64_t count = 0;    // elements
    std::uint64_t checksum = 0; // crc64
};
static_assert(sizeof(ZvoSection) == 48);

/// A section's name in messages and listings; "section N" for ids that this version does not know.
std::string sectionName(std::uint32_t id);

/// Where a section may start: the first multiple of kZvoAlignment at or after `byte`.
constexpr std::uint64_t zvoAligned(std::uint64_t byte)
{
    return divideUp(byte, kZvoAlignment) * kZvoAlignment;
}

/// The value that ZvoHeader::header_checksum must have.
std::uint64_t headerChecksum(const ZvoHeader& header);

/// The contents of a file.
struct ZvoFile
{
    ZvoHeader header;
    std::vector<ZvoSection> sections;
    TreeData tree;
};

/// Whether a file is meant to be a .zvo file: judged by its first bytes, or else by its name.
bool isZvoFile(const std::filesystem::path& path);

/// Reads a file and checks everything in it: sizes, checksums, and the tree (core/file/tree_check.h). Memory stays in
/// proportion to the size of the file. Throws Error{Input}, one line with the path.
ZvoFile readZvo(const std::filesystem::path& path);

/// The same for a file in memory. name: the path that messages show.
ZvoFile readZvo(std::span<const std::byte> bytes, const std::filesystem::path& name);

/// Passes the bytes of a file to `write`, piece by piece from the first on. Equal trees give equal bytes.
void writeZvo(const TreeData& tree, const std::function<void(std::span<const std::byte>)>& write);

} // namespace zvo
