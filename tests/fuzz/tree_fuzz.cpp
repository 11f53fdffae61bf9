// SPDX-License-Identifier: MIT
// A libFuzzer target for .zvo files. If the reader refuses a file, it must throw an Error{Input} of one line. An
// accepted file must be written again with the same content. Its tree is traced, and each hit must have an index of the
// tree's attributes. ZVO_FUZZ_SEEDS names a folder into which the trees of the tests are written as seeds.
#include "core/base/kernels.h"
#include "core/file/zvo_file.h"
#include "fuzz/require.h"
#include "fuzz/tree_mutator.h"
#include "support/tree_probe.h"
#include "support/tree_samples.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

namespace zvo::test
{

namespace
{

constexpr std::uint64_t kVoxelsMax = 1U << 16U; // larger trees only take more time on the host

std::unique_ptr<vk::HeadlessDevice> g_device; // null: nothing is traced
std::unique_ptr<TreeProbe> g_probe;           // on it

void closeDevice()
{
    g_probe.reset();
    g_device.reset();
}

void writeSeeds(const std::filesystem::path& folder)
{
    for (const TreeSample& sample : treeSamples())
    {
        const Bytes bytes = zvoBytes(sample.tree);
        std::ofstream(folder / sample.name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
}

} // namespace

} // namespace zvo::test

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/)
{
    using namespace zvo::test;
    std::atexit(closeDevice);
    if (const char* const folder = std::getenv("ZVO_FUZZ_SEEDS"))
    {
        writeSeeds(folder);
    }
    if (std::getenv("ZVO_FUZZ_LOAD_ONLY") == nullptr)
    {
        zvo::vk::HeadlessOptions options;
        options.device = "cpu";
        g_device = std::make_unique<zvo::vk::HeadlessDevice>(options, zvo::zvoKernels());
        g_probe = std::make_unique<TreeProbe>(*g_device);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace zvo::test;
    const std::span<const std::byte> input = std::as_bytes(std::span(data, size));
    const std::optional<zvo::ZvoFile> file = readOrRefused([&] { return zvo::readZvo(input, "input.zvo"); });
    if (!file)
    {
        return 0;
    }
    const Bytes again = zvoBytes(file->tree);
    const bool is_plain = file->header.version_minor == 0 &&
                          std::all_of(file->sections.begin(), file->sections.end(),
                                      [](const zvo::ZvoSection& section) {
                                          return section.id <= static_cast<std::uint32_t>(zvo::ZvoSectionId::Emission);
                                      });
    require(!is_plain || std::equal(again.begin(), again.end(), input.begin(), input.end()),
            "a file that would be written with other bytes");
    if (file->tree.voxel_count <= kVoxelsMax)
    {
        requireNoFault(walkFault(file->tree));
    }
    if (g_probe)
    {
        std::mt19937 random(static_cast<std::uint32_t>(file->header.header_checksum));
        requireNoFault(g_probe->traceFault(file->tree, random));
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t size_max,
                                               unsigned int seed);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t size_max,
                                               unsigned int seed)
{
    using namespace zvo::test;
    std::mt19937 random(seed);
    if (random() % 16 == 0)
    {
        return LLVMFuzzerMutate(data, size, size_max); // this leaves checksums wrong
    }
    const Bytes file = mutateTree(std::as_bytes(std::span(data, size)), random, LLVMFuzzerMutate);
    if (file.size() > size_max)
    {
        return LLVMFuzzerMutate(data, size, size_max);
    }
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(file.data());
    std::copy(bytes, bytes + file.size(), data);
    return file.size();
}
