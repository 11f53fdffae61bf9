// SPDX-License-Identifier: MIT
// The format of docs/file-format.md, and files that break it. tree_check_test.cpp has faults of trees.
#include "core/file/zvo_file.h"

#include "core/base/crc64.h"
#include "support/errors.h"
#include "support/sweep.h"
#include "support/temp_dir.h"
#include "support/tree_samples.h"
#include "support/zvo_parts.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <ostream>

namespace zvo::test
{
namespace
{

// The message of the refusal, or "" if the file is accepted.
std::string refusalOf(std::span<const std::byte> file)
{
    try
    {
        static_cast<void>(readZvo(file, "a.zvo"));
        return "";
    }
    catch (const Error& error)
    {
        const std::string message = error.what();
        EXPECT_EQ(error.code(), ErrorCode::Input) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_TRUE(message.starts_with("a.zvo: ")) << message;
        return message;
    }
}

template <typename T> T at(const Bytes& file, std::size_t offset)
{
    T value{};
    std::memcpy(&value, file.data() + offset, sizeof(T));
    return value;
}

TEST(ZvoFile, TreesComeBackAndGiveTheSameBytesAgain)
{
    const TempDir dir;
    for (const TreeSample& sample : treeSamples())
    {
        const Bytes bytes = zvoBytes(sample.tree);
        const ZvoFile in_memory = readZvo(bytes, sample.name);
        EXPECT_EQ(treeDifference(in_memory.tree, sample.tree), "") << sample.name;
        const auto path =
            dir.write(sample.name, std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
        const ZvoFile from_disk = readZvo(path);
        EXPECT_EQ(treeDifference(from_disk.tree, sample.tree), "") << sample.name;
        EXPECT_EQ(zvoBytes(from_disk.tree), bytes) << sample.name;
        EXPECT_TRUE(isZvoFile(path)) << sample.name;
    }
}

// Reads byte by byte as the document says, without the program's structs.
TEST(ZvoFile, BytesStandWhereTheDocumentSays)
{
    const TreeData tree = treeSample("random_5_with_attributes_dag");
    const Bytes file = zvoBytes(tree);
    EXPECT_EQ(std::memcmp(file.data(), "\x8aZVO\r\n\x1a\n\x04\x03\x02\x01", 12), 0);
    EXPECT_EQ(at<std::uint16_t>(file, 12), 2);
    EXPECT_EQ(at<std::uint16_t>(file, 14), 0);
    EXPECT_EQ(at<std::uint32_t>(file, 16), 128U);
    const auto section_count = at<std::uint32_t>(file, 20);
    EXPECT_EQ(section_count, 10U);
    EXPECT_EQ(at<std::uint32_t>(file, 24), 2U);
    EXPECT_EQ(at<std::uint64_t>(file, 32), file.size());
    EXPECT_EQ(at<float>(file, 40), -3.5F);
    EXPECT_EQ(at<float>(file, 52), 0.1F);
    EXPECT_EQ(at<std::uint32_t>(file, 56), 5U);
    EXPECT_EQ(at<float>(file, 60), 2.5F);
    EXPECT_EQ(at<std::uint64_t>(file, 64), tree.voxel_count);
    EXPECT_EQ(at<std::uint64_t>(file, 72), tree.nodes.size());
    EXPECT_EQ(at<std::uint64_t>(file, 80), tree.octree_node_count);
    EXPECT_EQ(at<std::uint64_t>(file, 88), tree.lists.size());
    EXPECT_EQ(at<std::uint64_t>(file, 96), tree.long_entry_count);
    EXPECT_EQ(at<std::uint64_t>(file, 112), crc64(std::span(file).subspan(128, section_count * 48)));
    EXPECT_EQ(at<std::uint64_t>(file, 120), crc64(std::span(file).first(120)));
    std::size_t end = 128 + section_count * 48;
    const std::vector<std::uint32_t> widths = {8, 16, 8, 8, 4, 8, 8, 8, 4, 8};
    for (std::uint32_t i = 0; i < section_count; ++i)
    {
        const std::size_t entry = 128 + std::size_t{48} * i;
        const auto offset = at<std::uint64_t>(file, entry + 16);
        const auto bytes = at<std::uint64_t>(file, entry + 24);
        EXPECT_EQ(at<std::uint32_t>(file, entry), i + 1);
        EXPECT_EQ(at<std::uint32_t>(file, entry + 4), 1U);
        EXPECT_EQ(at<std::uint32_t>(file, entry + 8), 1U);
        EXPECT_EQ(at<std::uint32_t>(file, entry + 12), 0U);
        EXPECT_EQ(offset % 64, 0U);
        EXPECT_LT(offset - end, 64U);
        EXPECT_EQ(bytes, widths[i] * at<std::uint64_t>(file, entry + 32));
        EXPECT_EQ(at<std::uint64_t>(file, entry + 40), crc64(std::span(file).subspan(offset, bytes)));
        end = offset + bytes;
    }
    EXPECT_EQ(end, file.size());
}

TEST(ZvoFile, EveryChangeOfAByteIsRefused)
{
    Sweep sweep;
    for (const char* const name :
         {"random_3_with_attributes", "random_3_with_attributes_dag", "random_3_with_attributes_4",
          "random_3_with_attributes_block", "one_voxel", "nothing"})
    {
        const Bytes file = zvoBytes(treeSample(name));
        for (std::size_t i = sweep.first(); i < file.size(); i += sweep.step())
        {
            const std::uint32_t step = i < 1024 ? 1 : 51; // all changes in the header and the table
            for (std::uint32_t change = 1; change < 256; change += step)
            {
                Bytes changed = file;
                changed[i] ^= static_cast<std::byte>(change);
                ASSERT_NE(refusalOf(changed), "") << name << " byte " << i << " ^ " << change;
            }
        }
    }
}

TEST(ZvoFile, EveryTruncationIsRefused)
{
    for (const char* const name : {"random_3_with_attributes", "random_4_with_attributes_dag"})
    {
        const Bytes file = zvoBytes(treeSample(name));
        for (std::size_t size = 0; size < file.size(); ++size)
        {
            const std::string message = refusalOf(std::span(file).first(size));
            const char* const expected = size == 0 ? "not a .zvo file" : "cut short";
            ASSERT_NE(message.find(expected), std::string::npos) << size << " bytes: " << message;
        }
    }
}

TEST(ZvoFile, IsKnownByItsNameOrItsFirstBytes)
{
    const TempDir dir;
    EXPECT_TRUE(isZvoFile("absent.zvo"));
    EXPECT_TRUE(isZvoFile("ABSENT.ZVO"));
    EXPECT_FALSE(isZvoFile("absent.glb"));
    EXPECT_FALSE(isZvoFile(dir.write("empty", "")));
    EXPECT_FALSE(isZvoFile(dir.write("text", "\x8aZVO\n\x1a\n of which a transfer took the first line end")));
}

TEST(ZvoFile, MissingFilesAndFoldersAreInputErrors)
{
    const TempDir dir;
    for (const std::filesystem::path& path :
         {dir.path() / "absent.zvo", dir.path(), std::filesystem::path("/dev/null")})
    {
        expectParts(messageOf([&] { static_cast<void>(readZvo(path)); }, ErrorCode::Input), {path.c_str()});
    }
}

// A fault in a file whose checksums are correct, except where they are the fault.
struct FileFault
{
    const char* name;
    std::function<void(Bytes&)> break_file;
    const char* words;
    const char* sample = "random_5_with_attributes_dag";
};

void PrintTo(const FileFault& fault, std::ostream* stream)
{
    *stream << fault.name;
}

template <typename T> std::function<void(Bytes&)> set(std::size_t offset, T value)
{
    return [offset, value](Bytes& file)
    {
        std::memcpy(file.data() + offset, &value, sizeof(value));
        fixChecksums(file);
    };
}

// The offset of a member in the i-th entry of the section table.
constexpr std::size_t entryAt(std::size_t i, std::size_t offset)
{
    return 128 + 48 * i + offset;
}

std::function<void(Bytes&)> change(const std::function<void(ZvoParts&)>& edit)
{
    return [edit](Bytes& file)
    {
        ZvoParts parts = ZvoParts::split(file).value();
        edit(parts);
        file = parts.join();
    };
}

std::function<void(Bytes&)> withoutSection(ZvoSectionId id)
{
    return change(
        [id](ZvoParts& parts)
        {
            std::erase_if(parts.sections,
                          [id](const auto& section) { return section.entry.id == static_cast<std::uint32_t>(id); });
        });
}

void addSection(ZvoParts& parts, std::uint32_t id, std::uint32_t flags)
{
    ZvoParts::Section section;
    section.entry.id = id;
    section.entry.format = 77;
    section.entry.flags = flags;
    section.entry.reserved = 5;
    section.content = Bytes(100, std::byte{42});
    parts.sections.push_back(section);
}

const std::vector<FileFault>& fileFaults()
{
    constexpr std::uint64_t kHuge = UINT64_MAX;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    static const std::vector<FileFault> faults = {
        {"Magic", set<char>(1, 'X'), "not a .zvo file"},
        {"BigEndian", set(8, 0x04030201U), "big-endian"},
        {"ByteOrder", set(8, 0x01020305U), "byte order is unknown"},
        {"NewerVersion", set<std::uint16_t>(12, 3), "version 3.0 of the format, this program reads versions 1 to 2"},
        {"OlderVersion", set<std::uint16_t>(12, 0), "version 0.0"},
        {"HeaderChecksum", [](Bytes& file) { file[120] ^= std::byte{1}; }, "header does not match its checksum"},
        {"HeaderBytes", set(16, 136U), "header states another size"},
        {"Structure", set(24, 3U), "structure 3 is unknown"},
        {"ReservedOfHeader", set(28, 1U), "reserved bytes of the header"},
        {"ReservedOfHeaderToo", set<std::uint64_t>(104, 1), "reserved bytes of the header"},
        {"FileBytesMore", set<std::uint64_t>(32, kHuge), "cut short"},
        {"FileBytesFewer", set<std::uint64_t>(32, 600), "bytes follow its end"},
        {"BytesBehind", [](Bytes& file) { file.push_back(std::byte{0}); }, "1 bytes follow its end"},
        {"OriginNan", set(44, nan), "not finite"},
        {"VoxelSizeInfinite", set(52, infinity), "not finite"},
        {"VoxelSizeZero", set(52, 0.0F), "the size above 0"},
        {"VoxelSizeNegative", set(52, -1.0F), "the size above 0"},
        {"FarCornerInfinite", set(52, 3e38F), "not finite"},
        {"DepthZero", set(56, 0U), "depth 0"},
        {"DepthHuge", set(56, 18U), "depth 18"},
        {"EmissionScale", set(60, nan), "scale of emission"},
        {"VoxelsOverflow", set<std::uint64_t>(64, 1ULL << 32), "4294967296 voxels are more"},
        {"NodesOverflow", set<std::uint64_t>(72, kHuge), "nodes are more"},
        {"OctreeNodesOverflow", set<std::uint64_t>(80, kHuge), "octree nodes are more"},
        {"EntriesOverflow", set<std::uint64_t>(88, 1ULL << 62), "list entries are more"},
        {"LongEntriesOverflow", set<std::uint64_t>(96, kHuge), "long list entries are more"},
        {"MoreLongEntriesThanEntries", set<std::uint64_t>(96, UINT32_MAX), "more list entries are long"},
        {"VoxelsMore", set<std::uint64_t>(64, 1000000), "attributes of voxels where the header asks for 1000000"},
        {"NodesMore", set<std::uint64_t>(72, UINT32_MAX), "nodes where the header asks for 4294967175"},
        {"EntriesMore", set<std::uint64_t>(88, UINT32_MAX), "lists where the header asks for 1073741824"},
        {"OctreeNodesMore", set<std::uint64_t>(80, 5), "attributes of nodes where the header asks for 5"},
        {"SectionsMany", set(20, 1025U), "1025 sections are more than the 1024"},
        {"SectionsManyMore", set(20, UINT32_MAX), "sections are more"},
        {"SectionsPastTheEnd", set(20, 1000U), "table does not fit"},
        {"TableChecksum",
         [](Bytes& file)
         {
             file[112] ^= std::byte{1};
             const std::uint64_t sum = crc64(std::span(file).first(120));
             std::memcpy(file.data() + 120, &sum, sizeof(sum));
         },
         "section table does not match its checksum"},
        {"SectionIdZero", set(entryAt(0, 0), 0U), "stands behind"},
        {"SectionsOutOfOrder", set(entryAt(2, 0), 2U), "nodes stands behind nodes"},
        {"SectionFormat", set(entryAt(5, 4), 4U), "attributes of voxels have format 4, unknown"},
        {"SectionFormatOfBlocks", set(entryAt(5, 4), 3U), "attributes of voxels where the header asks for 19"},
        {"SectionBlocksOfNodes", set(entryAt(6, 4), 3U), "format 3, which does not go with that of voxels",
         "random_5_with_attributes_block_dag"},
        {"SectionBlockCount", set<std::uint64_t>(entryAt(5, 32), 20), "20 attributes of voxels where the header asks",
         "random_5_with_attributes_block_dag"},
        {"SectionFormatOfNodes", set(entryAt(1, 4), 2U), "nodes have format 2, unknown"},
        {"SectionFormatOfOtherAttributes", set(entryAt(5, 4), 2U), "attributes of voxels take"},
        {"SectionFormatsDiffer", set(entryAt(6, 4), 2U), "format 2, which does not go with that of voxels"},
        {"SectionFormatsDifferToo", set(entryAt(6, 4), 1U), "format 1, which does not go with that of voxels",
         "random_5_with_attributes_4_dag"},
        {"NoPackedVoxelAttributes", withoutSection(ZvoSectionId::VoxelAttributes), "format 2, which does not go with",
         "random_5_with_attributes_4"},
        {"NoPackedNodeAttributes", withoutSection(ZvoSectionId::NodeAttributes), "and 0 words",
         "random_5_with_attributes_4"},
        {"SectionFlags", set(entryAt(1, 8), 0U), "flags or reserved bytes of nodes"},
        {"SectionReserved", set(entryAt(1, 12), 1U), "flags or reserved bytes of nodes"},
        {"SectionOffset", set<std::uint64_t>(entryAt(1, 16), 64), "nodes starts at byte 64"},
        {"SectionOffsetHuge", set<std::uint64_t>(entryAt(1, 16), kHuge), "nodes starts at byte"},
        {"SectionBytesHuge", set<std::uint64_t>(entryAt(1, 24), kHuge), "does not fit into the file"},
        {"SectionBytesZero", set<std::uint64_t>(entryAt(1, 24), 0), "does not fit into the file"},
        {"SectionBytesOdd", set<std::uint64_t>(entryAt(8, 24), 6), "emissions take 6 bytes"},
        {"SectionCount", set<std::uint64_t>(entryAt(1, 32), 3), "3 nodes where the header asks for"},
        {"SectionCountOverflows", set<std::uint64_t>(entryAt(8, 32), (1ULL << 62) + 1), "emissions take"},
        {"SectionChecksum", [](Bytes& file) { file[at<std::uint64_t>(file, entryAt(1, 16))] ^= std::byte{1}; },
         "nodes do not match their checksum"},
        {"SomethingBetweenSections",
         [](Bytes& file) { file[at<std::uint64_t>(file, entryAt(1, 16)) - 1] ^= std::byte{1}; },
         "something between the sections before nodes"},
        {"BytesBehindTheLastSection",
         [](Bytes& file)
         {
             file.resize(file.size() + 8);
             set<std::uint64_t>(32, file.size())(file);
         },
         "last section ends at byte"},
        {"UnknownSection", change([](ZvoParts& parts) { addSection(parts, 99, kZvoMustUnderstand); }),
         "section 99 is unknown to this version and cannot be left out"},
        {"NoLevels", withoutSection(ZvoSectionId::Levels), "nodes where the header asks for"},
        {"NoLevelsOfALeaf", withoutSection(ZvoSectionId::Levels), "0 levels of nodes where a grid of depth",
         "one_voxel"},
        {"NoLeaves", withoutSection(ZvoSectionId::Leaves), "leaves are missing"},
        {"NoNodes", withoutSection(ZvoSectionId::Nodes), "nodes are missing"},
        {"NoLists", withoutSection(ZvoSectionId::Lists), "lists are missing"},
        {"NoBefore", withoutSection(ZvoSectionId::Before), "counts beside the lists"},
        {"NoVoxelsBeforeLeaf", withoutSection(ZvoSectionId::VoxelsBeforeLeaf), "counts beside the lists"},
        {"NoVoxelAttributes", withoutSection(ZvoSectionId::VoxelAttributes), "counts beside the lists"},
        {"NoVoxelAttributesOfOctree", withoutSection(ZvoSectionId::VoxelAttributes), "attributes of 0 voxels",
         "random_5_with_attributes"},
        {"NoNodeAttributes", withoutSection(ZvoSectionId::NodeAttributes), "and 0 nodes"},
        {"NoEmissionWords", withoutSection(ZvoSectionId::EmissionWords), "emits by its attribute alone"},
        {"NoEmission", withoutSection(ZvoSectionId::Emission), "there are 0 emissions"},
        {"DepthOfAnotherTree", set(56, 3U), "levels where the header asks for 2"},
        {"LevelsOverflow",
         change(
             [](ZvoParts& parts)
             {
                 const std::uint64_t count = UINT64_MAX;
                 std::memcpy(parts.find(ZvoSectionId::Levels)->content.data() + 8, &count, sizeof(count));
             }),
         "the levels have more nodes than"},
    };
    return faults;
}

using ZvoFault = testing::TestWithParam<FileFault>;

INSTANTIATE_TEST_SUITE_P(File, ZvoFault, testing::ValuesIn(fileFaults()),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST_P(ZvoFault, HasItsOwnMessage)
{
    Bytes file = zvoBytes(treeSample(GetParam().sample));
    ASSERT_EQ(refusalOf(file), "");
    GetParam().break_file(file);
    const std::string message = refusalOf(file);
    EXPECT_NE(message.find(GetParam().words), std::string::npos) << message;
}

TEST(ZvoFile, OfVersionOneIsRead)
{
    for (const TreeSample& sample : treeSamples())
    {
        Bytes file = zvoBytes(sample.tree);
        change(
            [&](ZvoParts& parts)
            {
                parts.header.version_major = 1;
                std::erase_if(parts.sections, [](const ZvoParts::Section& section)
                              { return section.entry.id == static_cast<std::uint32_t>(ZvoSectionId::Leaves); });
                if (!sample.tree.nodes.empty()) // leaves stood among the nodes
                {
                    const std::span<const std::byte> nodes = std::as_bytes(std::span(sample.tree.nodes));
                    parts.find(ZvoSectionId::Nodes)->content.assign(nodes.begin(), nodes.end());
                    parts.find(ZvoSectionId::Nodes)->entry.count = sample.tree.nodes.size();
                }
            })(file);
        EXPECT_EQ(treeDifference(readZvo(file, "one.zvo").tree, sample.tree), "") << sample.name;
    }
}

TEST(ZvoFile, OfALaterMinorVersionIsReadWithoutWhatIsNew)
{
    const TreeData tree = treeSample("random_5_with_attributes_dag");
    Bytes file = zvoBytes(tree);
    change(
        [](ZvoParts& parts)
        {
            parts.header.version_minor = 7;
            parts.header.reserved_1 = 3;
            addSection(parts, 99, 0);
        })(file);
    const ZvoFile read = readZvo(file, "later.zvo");
    EXPECT_EQ(treeDifference(read.tree, tree), "");
    EXPECT_EQ(read.sections.size(), 11U);
    file[file.size() - 1] ^= std::byte{1}; // the new section has its checksum, too
    EXPECT_NE(refusalOf(file).find("section 99 do not match"), std::string::npos);
}

} // namespace
} // namespace zvo::test
