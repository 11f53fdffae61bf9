// SPDX-License-Identifier: MIT
#include "core/base/byte_source.h"
#include "core/base/crc64.h"
#include "core/base/divide_up.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "core/file/tree_check.h"
#include "core/file/zvo_file.h"
#include "core/tree/leaf_words.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace zvo
{

namespace
{

static_assert(std::endian::native == std::endian::little); // structs are read as they stand in memory

/// Reads one file.
class Reader
{
public:
    Reader(ByteSource& source, const std::filesystem::path& path) : m_source(source), m_path(path) {}

    ZvoFile read()
    {
        readHeader();
        readTable();
        setUpTree();
        for (const ZvoSection& section : m_file.sections)
        {
            checkOffset(section);
            readSection(section);
        }
        failUnless(m_end == m_file.header.file_bytes, "the last section ends at byte {} of {}", m_end,
                   m_file.header.file_bytes);
        requireSections();
        appendLeaves(m_leaves, m_file.tree);
        requireNone(checkTree(m_file.tree));
        m_file.tree.interior_count = interiorCount(m_file.tree);
        return std::move(m_file);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw inputError(m_path, what); }

    template <typename... Arguments>
    void failUnless(bool condition, fmt::format_string<Arguments...> fault, Arguments&&... arguments) const
    {
        if (!condition)
        {
            fail(fmt::format("{}; {}", fmt::format(fault, std::forward<Arguments>(arguments)...), kExportAgain));
        }
    }

    void requireNone(const std::optional<std::string>& fault) const { failUnless(!fault, "{}", fault.value_or("")); }

    void readHeader()
    {
        ZvoHeader& header = m_file.header;
        const std::uint64_t size = m_source.size();
        std::vector<std::byte> bytes(std::min<std::uint64_t>(size, sizeof(header)));
        m_source.read(0, bytes);
        const std::size_t magic_bytes = std::min(bytes.size(), kZvoMagic.size());
        if (magic_bytes == 0 || std::memcmp(bytes.data(), kZvoMagic.data(), magic_bytes) != 0)
        {
            fail("not a .zvo file: it does not begin as one; zvo build makes one of a scene");
        }
        if (bytes.size() < sizeof(header))
        {
            fail(fmt::format("{} bytes are less than a header; {}", size, kCutShort));
        }
        std::memcpy(&header, bytes.data(), sizeof(header));
        if (header.byte_order != kZvoByteOrder)
        {
            const bool swapped = header.byte_order == __builtin_bswap32(kZvoByteOrder);
            failUnless(swapped, "its byte order is unknown ({:#010x})", header.byte_order);
            fail("its numbers are big-endian, those of .zvo files are little-endian; convert it again");
        }
        if (header.version_major == 0 || header.version_major > kZvoVersionMajor)
        {
            fail(fmt::format("version {}.{} of the format, this program reads versions 1 to {}; use a matching zvo",
                             header.version_major, header.version_minor, kZvoVersionMajor));
        }
        failUnless(header.header_checksum == headerChecksum(header), "the header does not match its checksum");
        checkHeader(size);
    }

    void checkHeader(std::uint64_t size) const
    {
        const ZvoHeader& header = m_file.header;
        failUnless(header.header_bytes == sizeof(header), "the header states another size than it has");
        const bool is_newer = header.version_minor > kZvoVersionMinor; // reserved bytes may mean something
        failUnless(is_newer || (header.reserved_0 == 0 && header.reserved_1 == 0),
                   "reserved bytes of the header are not 0");
        if (header.file_bytes > size)
        {
            fail(fmt::format("{} bytes of {} are there; {}", size, header.file_bytes, kCutShort));
        }
        failUnless(header.file_bytes == size, "{} bytes follow its end", size - header.file_bytes);
        if (header.structure != static_cast<std::uint32_t>(TreeStructure::Svo) &&
            header.structure != static_cast<std::uint32_t>(TreeStructure::Svdag))
        {
            fail(fmt::format("structure {} is unknown to this version; use a newer zvo", header.structure));
        }
        const std::pair<const char*, std::uint64_t> counts[] = {{"voxels", header.voxel_count},
                                                                {"nodes", header.node_count},
                                                                {"octree nodes", header.octree_node_count},
                                                                {"list entries", header.entry_count},
                                                                {"long list entries", header.long_entry_count}};
        for (const auto& [what, count] : counts)
        {
            if (count > UINT32_MAX)
            {
                fail(fmt::format("{} {} are more than this version can hold ({})", count, what, UINT32_MAX));
            }
        }
        failUnless(header.long_entry_count <= header.entry_count, "more list entries are long than there are");
        requireNone(checkGrid(gridOf(header)));
    }

    static Grid gridOf(const ZvoHeader& header)
    {
        return {{header.origin[0], header.origin[1], header.origin[2]}, header.voxel_size, header.depth};
    }

    void readTable()
    {
        const ZvoHeader& header = m_file.header;
        const std::uint64_t table_bytes = std::uint64_t{header.section_count} * sizeof(ZvoSection);
        failUnless(header.section_count <= kZvoSectionsMax, "{} sections are more than the {} that are possible",
                   header.section_count, kZvoSectionsMax);
        failUnless(table_bytes <= header.file_bytes - sizeof(header), "the section table does not fit into the file");
        m_file.sections.resize(header.section_count);
        m_source.read(sizeof(header), std::as_writable_bytes(std::span(m_file.sections)));
        failUnless(header.table_checksum == crc64(std::as_bytes(std::span(m_file.sections))),
                   "the section table does not match its checksum");
        m_end = sizeof(header) + table_bytes;
        std::uint32_t last_id = 0;
        for (const ZvoSection& section : m_file.sections)
        {
            failUnless(section.id > last_id, "{} stands behind {}", sectionName(section.id), sectionName(last_id));
            last_id = section.id;
        }
    }

    // Sections stand one behind the other, each from the next multiple of kZvoAlignment on; between them are zeros.
    void checkOffset(const ZvoSection& section)
    {
        const std::string name = sectionName(section.id);
        const std::uint64_t offset = zvoAligned(m_end);
        failUnless(section.offset == offset, "{} starts at byte {}, not at {}", name, section.offset, offset);
        const std::uint64_t file_bytes = m_file.header.file_bytes;
        failUnless(section.bytes != 0 && offset <= file_bytes && section.bytes <= file_bytes - offset,
                   "{} of {} bytes at byte {} does not fit into the file's {}", name, section.bytes, offset,
                   file_bytes);
        std::array<std::byte, kZvoAlignment> padding{};
        const std::span<std::byte> between = std::span(padding).first(offset - m_end);
        m_source.read(m_end, between);
        failUnless(std::ranges::count(between, std::byte{0}) == std::ssize(between),
                   "there is something between the sections before {}", name);
        m_end = offset + section.bytes;
    }

    void setUpTree()
    {
        const ZvoHeader& header = m_file.header;
        TreeData& tree = m_file.tree;
        tree.structure = static_cast<TreeStructure>(header.structure);
        tree.grid = gridOf(header);
        tree.voxel_count = static_cast<std::uint32_t>(header.voxel_count);
        tree.octree_node_count = static_cast<std::uint32_t>(header.octree_node_count);
        tree.long_entry_count = header.long_entry_count;
        tree.emission_scale = header.emission_scale;
    }

    void readSection(const ZvoSection& section)
    {
        const ZvoHeader& header = m_file.header;
        TreeData& tree = m_file.tree;
        const std::uint64_t short_count = header.entry_count - header.long_entry_count;
        switch (static_cast<ZvoSectionId>(section.id))
        {
        case ZvoSectionId::Levels:
            return readLevels(section);
        case ZvoSectionId::Nodes:
            return readArray(section, tree.nodes, header.node_count - leafCount());
        case ZvoSectionId::Lists:
            return readLists(section);
        case ZvoSectionId::Before:
            return readArray(section, tree.before, header.long_entry_count);
        case ZvoSectionId::VoxelsBeforeLeaf:
            return readArray(section, tree.voxels_before_leaf, divideUp(short_count, 2));
        case ZvoSectionId::VoxelAttributes:
            return readVoxelAttributes(section);
        case ZvoSectionId::NodeAttributes:
            return readNodeAttributes(section);
        case ZvoSectionId::EmissionWords:
            return readArray(section, tree.emission_words, divideUp(header.voxel_count, gpu::kVoxelsPerEmissionWord));
        case ZvoSectionId::Emission:
            return readArray(section, tree.emission, section.count);
        case ZvoSectionId::Leaves:
            return readArray(section, m_leaves, leafCount());
        case ZvoSectionId::Occupied:
            return readArray(section, tree.occupied, leafCount());
        }
        skip(section);
    }

    // Leaves that have a section of their own.
    [[nodiscard]] std::uint32_t leafCount() const
    {
        return m_file.header.version_major == 1 ? 0 : leafWordsOf(m_file.tree.levels);
    }

    // What this version does not know.
    void skip(const ZvoSection& section)
    {
        if ((section.flags & kZvoMustUnderstand) != 0)
        {
            fail(fmt::format("{} is unknown to this version and cannot be left out; use a newer zvo",
                             sectionName(section.id)));
        }
        constexpr std::uint64_t kPieceBytes = std::uint64_t{1} << 20;
        std::vector<std::byte> piece(std::min(section.bytes, kPieceBytes));
        std::uint64_t checksum = 0;
        for (std::uint64_t done = 0; done < section.bytes; done += piece.size())
        {
            piece.resize(std::min(section.bytes - done, kPieceBytes));
            m_source.read(section.offset + done, piece);
            checksum = crc64(piece, checksum);
        }
        checkSum(section, checksum);
    }

    void checkSum(const ZvoSection& section, std::uint64_t checksum) const
    {
        failUnless(checksum == section.checksum, "{} do not match their checksum", sectionName(section.id));
    }

    void readVoxelAttributes(const ZvoSection& section)
    {
        TreeData& tree = m_file.tree;
        const std::uint64_t count = m_file.header.voxel_count;
        switch (static_cast<ZvoFormat>(section.format))
        {
        case ZvoFormat::Attributes4:
            tree.packed.format = AttributeFormat::Bytes4;
            return readArray(section, tree.packed.voxels, count, ZvoFormat::Attributes4);
        case ZvoFormat::Blocks:
            tree.packed.format = AttributeFormat::Blocks;
            return readArray(section, tree.packed.voxels, divideUp(count, gpu::kBlockVoxels), ZvoFormat::Blocks);
        default:
            return readArray(section, tree.voxel_attributes, count);
        }
    }

    // Voxels, whose section comes first, say which format nodes have.
    void readNodeAttributes(const ZvoSection& section)
    {
        TreeData& tree = m_file.tree;
        const ZvoFormat format = zvoFormat(nodeFormat(tree.packed.format));
        const bool is_known = section.format >= static_cast<std::uint32_t>(ZvoFormat::Plain) &&
                              section.format <= static_cast<std::uint32_t>(ZvoFormat::Blocks);
        failUnless(!is_known || section.format == static_cast<std::uint32_t>(format),
                   "attributes of nodes have format {}, which does not go with that of voxels", section.format);
        const std::uint64_t count = m_file.header.octree_node_count;
        format == ZvoFormat::Plain ? readArray(section, tree.node_attributes, count)
                                   : readArray(section, tree.packed.nodes, count, format);
    }

    template <typename T>
    void readArray(const ZvoSection& section, std::vector<T>& target, std::uint64_t count,
                   ZvoFormat format = ZvoFormat::Plain)
    {
        const std::string name = sectionName(section.id);
        if (section.format != static_cast<std::uint32_t>(format))
        {
            fail(fmt::format("{} have format {}, unknown to this version; use a newer zvo", name, section.format));
        }
        const bool is_newer = m_file.header.version_minor > kZvoVersionMinor;
        failUnless(is_newer || (section.reserved == 0 && section.flags == kZvoMustUnderstand),
                   "flags or reserved bytes of {} are wrong", name);
        failUnless(section.count == count, "there are {} {} where the header asks for {}", section.count, name, count);
        const std::uint64_t element_bytes = valuesPerElement(format) * sizeof(T);
        failUnless(section.bytes / element_bytes == count && section.bytes % element_bytes == 0,
                   "{} {} take {} bytes, not {}", count, name, section.bytes, element_bytes);
        target.resize(count * valuesPerElement(format)); // no more than the file has
        m_source.read(section.offset, std::as_writable_bytes(std::span(target)));
        checkSum(section, crc64(std::as_bytes(std::span(target))));
    }

    void readLevels(const ZvoSection& section)
    {
        std::vector<std::uint64_t> counts;
        readArray(section, counts, m_file.tree.grid.nodeLevels());
        std::uint64_t first_node = 0;
        for (const std::uint64_t count : counts)
        {
            failUnless(count <= m_file.header.node_count - first_node,
                       "the levels have more nodes than the {} that there are", m_file.header.node_count);
            m_file.tree.levels.push_back({static_cast<std::uint32_t>(first_node), static_cast<std::uint32_t>(count)});
            first_node += count;
        }
    }

    void readLists(const ZvoSection& section)
    {
        const ZvoHeader& header = m_file.header;
        const ListPacking packing = ListPacking::tightest(header.node_count, 0, header.entry_count);
        std::vector<std::uint64_t> words;
        readArray(section, words, packing.wordCount());
        m_file.tree.lists = unpackEntries(words, packing.entry_count, packing.per_word);
        failUnless(packEntries(m_file.tree.lists, packing.per_word) == words,
                   "there is something between the entries of lists");
    }

    // Counts of the header whose sections are missing. What else belongs together, checkTree knows.
    void requireSections() const
    {
        const ZvoHeader& header = m_file.header;
        const TreeData& tree = m_file.tree;
        const auto require = [this](ZvoSectionId id, std::size_t have, std::uint64_t wanted)
        { failUnless(have == wanted, "{} are missing", sectionName(static_cast<std::uint32_t>(id))); };
        require(ZvoSectionId::Nodes, tree.nodes.size(), header.node_count - leafCount());
        require(ZvoSectionId::Leaves, m_leaves.size(), leafCount());
        require(ZvoSectionId::Lists, tree.lists.size(), header.entry_count);
    }

    ByteSource& m_source;
    const std::filesystem::path& m_path;
    ZvoFile m_file;
    std::vector<std::uint64_t> m_leaves; // of a tree whose nodes are without them
    std::uint64_t m_end = 0;             // of what was read
};

} // namespace

ZvoFile readZvo(const std::filesystem::path& path)
{
    std::error_code failure;
    const bool is_regular = std::filesystem::is_regular_file(path, failure);
    const std::uintmax_t size = is_regular ? std::filesystem::file_size(path, failure) : 0;
    if (!is_regular || failure)
    {
        const std::vector<std::uint8_t> bytes = readFile(path);
        return readZvo(std::as_bytes(std::span(bytes)), path);
    }
    FileSource source(path, size);
    return Reader(source, path).read();
}

ZvoFile readZvo(std::span<const std::byte> bytes, const std::filesystem::path& name)
{
    MemorySource source(bytes);
    return Reader(source, name).read();
}

} // namespace zvo
