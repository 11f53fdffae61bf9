// SPDX-License-Identifier: MIT
// Files with single bytes changed and correct checksums: they are refused or hold a valid tree.
#include "core/file/zvo_file.h"
#include "core/tree/device_tree.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/dags.h"
#include "support/engine_device.h"
#include "support/scenes.h"
#include "support/sweep.h"
#include "support/tree_probe.h"
#include "support/tree_samples.h"
#include "support/zvo_parts.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <optional>
#include <random>
#include <string>

namespace zvo::test
{
namespace
{

constexpr std::size_t kChangeCount = 10000; // in the body

// The project's atrium as a DAG at 128^3 with attributes in blocks, which has all kinds of sections.
const TreeData& atrium()
{
    static const TreeData tree = []
    {
        const Scene scene = loadGltf(ownScene("atrium.glb"));
        const GpuScene gpu_scene = uploadScene(device(), scene, true);
        DeviceTree octree = buildOctree(device(), gpu_scene, Grid::around(scene.bounds(), 7), {}).octree;
        DeviceTree dag = compress(device(), std::move(octree)).dag;
        packTree(device(), AttributeFormat::Blocks, dag);
        return downloadTree(device(), dag);
    }();
    return tree;
}

// The tree, or nothing if the file was refused with a reason.
std::optional<TreeData> readOrRefused(std::span<const std::byte> file)
{
    try
    {
        return readZvo(file, "a.zvo").tree;
    }
    catch (const Error& error)
    {
        const std::string message = error.what();
        EXPECT_EQ(error.code(), ErrorCode::Input) << message;
        EXPECT_TRUE(message.starts_with("a.zvo: ") && message.size() > 20) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return std::nullopt;
    }
}

// Changes a byte of a file until it is destroyed.
class ByteChange
{
public:
    ByteChange(Bytes& file, std::size_t at, unsigned change) : m_byte(file[at]), m_before(file[at])
    {
        m_byte ^= static_cast<std::byte>(change);
    }
    ~ByteChange() { m_byte = m_before; }
    ByteChange(const ByteChange&) = delete;
    ByteChange& operator=(const ByteChange&) = delete;

private:
    std::byte& m_byte;
    std::byte m_before;
};

// Length of header and table, behind which the body begins.
std::size_t headBytes(const ZvoFile& file)
{
    return sizeof(ZvoHeader) + file.sections.size() * sizeof(ZvoSection);
}

struct BodyChange
{
    std::size_t at;
    unsigned change;
};

// Half of the changes are anywhere, half in a random section, because some sections are small. A sample of them, unless
// the sweep is full.
std::vector<BodyChange> bodyChanges(const ZvoFile& file)
{
    Sweep sweep;
    const std::uint64_t first = sweep.first();
    std::mt19937_64 random(20);
    std::vector<BodyChange> changes;
    for (std::size_t i = 0; i < kChangeCount; ++i)
    {
        const ZvoSection& section = file.sections[random() % file.sections.size()];
        const std::size_t head = headBytes(file);
        const std::size_t at =
            i % 2 == 0 ? head + random() % (file.header.file_bytes - head) : section.offset + random() % section.bytes;
        const auto change = static_cast<unsigned>(1 + random() % 255);
        if (i % sweep.step() == first)
        {
            changes.push_back({at, change});
        }
    }
    return changes;
}

// The id of the section that has the byte; 0 between sections.
std::uint32_t sectionAt(const ZvoFile& file, std::size_t at)
{
    for (const ZvoSection& section : file.sections)
    {
        if (at >= section.offset && at - section.offset < section.bytes)
        {
            return section.id;
        }
    }
    return 0;
}

// The part of the tree that may differ after a change of the header byte at this offset (docs/file-format.md) with
// correct checksums. "": none, for the minor version and checksums; "never": the change must be refused.
std::string headerPartAt(std::size_t at)
{
    const bool is_ignored = (at >= 14 && at < 16) || (at >= 112 && at < 128);
    return is_ignored            ? ""
           : at >= 40 && at < 52 ? "origin"
           : at >= 52 && at < 56 ? "voxel size"
           : at == 56            ? "depth"
           : at >= 60 && at < 64 ? "emission scale"
                                 : "never";
}

TEST(ZvoChanges, OfTheHeaderWithItsChecksumsAreRefusedOrMeanWhatTheySay)
{
    for (const char* const name : {"random_3_with_attributes", "random_3_with_attributes_block_dag"})
    {
        const TreeData sound = treeSample(name);
        Bytes file = zvoBytes(sound);
        const Bytes before = file;
        const std::size_t head = headBytes(readZvo(file, "a.zvo"));
        std::map<std::string, int> accepted_counts;
        for (std::size_t at = 0; at < head; ++at)
        {
            for (unsigned change = 1; change < 256; ++change)
            {
                const ByteChange changed(file, at, change);
                fixHeadChecksums(file);
                const std::optional<TreeData> tree = readOrRefused(file);
                if (tree)
                {
                    const std::string part = headerPartAt(at);
                    ASSERT_EQ(treeDifference(*tree, sound), part) << "byte " << at << " ^ " << change;
                    ASSERT_EQ(part == "depth" ? walkFault(*tree) : "", "");
                    ++accepted_counts[part];
                }
                std::copy_n(before.begin(), sizeof(ZvoHeader), file.begin());
            }
        }
        EXPECT_EQ(accepted_counts[""], 255 * 18); // all changes of ignored bytes
        EXPECT_GT(accepted_counts["origin"], 255 * 11);
        EXPECT_EQ(accepted_counts["depth"], 1);
        EXPECT_GT(accepted_counts["voxel size"], 255);
        EXPECT_GT(accepted_counts["emission scale"], 255);
    }
}

// Expects that tree is a valid DAG, by the oracle.
void expectSoundDag(const TreeData& tree)
{
    const DeviceTree uploaded = uploadTree(device(), tree);
    const oracle::DagContents contents = dagContentsOf(device(), uploaded);
    EXPECT_EQ(contents.violations, std::vector<std::string>{});
    ASSERT_EQ(contents.voxels.size(), tree.voxel_count);
    for (std::size_t i = 0; i < contents.voxels.size(); ++i)
    {
        ASSERT_EQ(contents.voxels[i].rank, i);
    }
}

TEST(ZvoChanges, OfTheBodyWithItsChecksumsAreRefusedOrSoundTrees)
{
    constexpr std::size_t kTraceEach = 32; // every 32nd of the changes that keep the nodes
    constexpr std::size_t kExpandEach = 8;
    // The parts that a change of a byte may affect, by section. Other nodes and entries may have the same numbers and
    // sizes.
    const std::map<std::uint32_t, std::string> parts = {
        {2, "nodes"},    {3, "lists"}, {6, "packed voxel attributes"}, {7, "packed node attributes"},
        {9, "emission"}, {10, "nodes"}};
    Bytes file = zvoBytes(atrium());
    const Bytes before = file;
    const ZvoFile sound = readZvo(file, "a.zvo");
    TreeProbe probe(device());
    std::mt19937 random(21);
    std::map<std::uint32_t, std::size_t> accepted_counts;
    for (const BodyChange& body : bodyChanges(sound))
    {
        const std::uint32_t section = sectionAt(sound, body.at);
        const ByteChange changed(file, body.at, body.change);
        fixChecksums(file);
        const std::optional<TreeData> tree = readOrRefused(file);
        std::copy_n(before.begin(), headBytes(sound), file.begin());
        if (!tree)
        {
            continue;
        }
        ASSERT_TRUE(parts.contains(section)) << "byte " << body.at << " ^ " << body.change;
        ASSERT_EQ(treeDifference(*tree, atrium()), parts.at(section));
        const std::size_t number = accepted_counts[section]++;
        const bool is_other_shape = section < 6 || section == 10;
        if (is_other_shape || number % kTraceEach == 0)
        {
            ASSERT_EQ(walkFault(*tree), "");
            ASSERT_EQ(probe.traceFault(*tree, random), "");
        }
        if (is_other_shape && number % kExpandEach == 0)
        {
            expectSoundDag(*tree);
        }
    }
    EXPECT_GT(accepted_counts.size(), 2U);
    for (const auto& [section, part] : parts)
    {
        EXPECT_TRUE(accepted_counts.contains(section) || !Sweep().isFull()) << part;
    }
}

} // namespace
} // namespace zvo::test
