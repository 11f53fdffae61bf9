// SPDX-License-Identifier: MIT
// A libFuzzer target: the bytes of a .zvo file. What the reader refuses must give an Error{Input} of one line; what it
// accepts must be written as it was read, and is traced: each hit must have a number that the tree's attributes have.
// ZVO_FUZZ_SEEDS names a folder that gets the trees of the tests as seeds.
#include "core/camera.h"
#include "core/kernels.h"
#include "core/trace.h"
#include "core/tree_stats.h"
#include "core/tree_view.h"
#include "core/zvo_file.h"
#include "fuzz/tree_mutator.h"
#include "support/tree_samples.h"
#include "zvo/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

// libFuzzer's own mutation, for custom mutators.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t size_max);

namespace zvo::test
{

namespace
{

constexpr std::uint64_t kVoxelsMax = 1U << 16U; // what has more only takes time on the host
constexpr std::uint32_t kPictureEdge = 16;      // pixels
constexpr std::uint32_t kRayCount = 64;

void require(bool condition, const char* what)
{
    if (!condition)
    {
        std::fprintf(stderr, "tree_fuzz: %s\n", what);
        std::abort();
    }
}

std::unique_ptr<vk::HeadlessDevice> g_device; // none: nothing is traced

void closeDevice()
{
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

std::optional<ZvoFile> readInput(std::span<const std::byte> input)
{
    try
    {
        return readZvo(input, "input.zvo");
    }
    catch (const Error& error)
    {
        const std::string message = error.what();
        require(error.code() == ErrorCode::Input, "an error of the reader that does not blame the input");
        require(message.find_first_of("\n\r\t") == std::string::npos, "a message of more than one line");
        return std::nullopt;
    }
}

void checkVoxels(const TreeData& tree)
{
    std::uint64_t count = 0;
    std::uint64_t next = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     require(code >= next && code >> (3 * tree.grid.depth) == 0, "voxels out of order or outside");
                     next = code + 1;
                     ++count;
                 });
    require(count == tree.voxel_count, "other voxels than are counted");
    const TreeStats stats = treeStats(tree);
    require(stats.binary_unique_count <= stats.binary_node_count, "more different nodes than nodes");
}

std::vector<gpu::Ray> someRays(std::mt19937& random)
{
    std::uniform_real_distribution<float> position(0.5F, 2.5F);
    std::uniform_real_distribution<float> direction(-1.0F, 1.0F);
    std::vector<gpu::Ray> rays(kRayCount);
    for (gpu::Ray& ray : rays)
    {
        ray.origin = {position(random), position(random), position(random)};
        ray.t_min = 0.0F;
        ray.inverse_direction = 1.0F / glm::vec3(direction(random), direction(random), direction(random));
        ray.t_max = INFINITY;
    }
    return rays;
}

void trace(vk::HeadlessDevice& device, const TreeView& view, const TreeData& tree, std::mt19937& random)
{
    TraceOptions options;
    options.occlusion_rays = random() % 2;
    options.detail_pixels = random() % 3 == 0 ? 4.0F : 0.0F;
    const Bounds all = {tree.grid.origin,
                        tree.grid.origin + tree.grid.voxel_size * static_cast<float>(tree.grid.resolution())};
    const TraceCamera camera = traceCamera(ViewCamera::framing(all, 1.0), tree.grid, kPictureEdge);
    BeamGrid beam(device.device());
    TraceBuffers buffers(device.device(), kPictureEdge, kPictureEdge);
    const std::vector<gpu::Ray> rays = someRays(random);
    const vk::BufferOf<gpu::Ray> ray_buffer = device.makeBuffer("rays", std::span(rays));
    vk::BufferOf<gpu::Hit> hits(device.device(), "hits", rays.size());
    vk::BufferOf<gpu::DispatchArgs> rounds(device.device(), "rounds", gpu::kTraceRoundsMax);
    vk::BufferOf<gpu::TraceStatus> status(device.device(), "status", 1);
    device.run(
        [&](vk::FrameGraph& graph)
        {
            buildBeam(graph, view, beam);
            zvo::trace(graph, view, beam, camera, options, buffers);
            graph.fill(status, 0);
            traceRays(graph, view, ray_buffer, hits, rounds, status, TraceOptions());
        });
    require(device.download(status).front().capped_rays == 0, "a ray that does not end");
    for (const gpu::Hit& hit : device.download(hits))
    {
        require(hit.index == gpu::kHitMiss || hit.index < tree.voxel_count || !tree.hasAttributes(),
                "a hit on a voxel that is not there");
    }
    static_cast<void>(device.download(buffers.image));
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
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace zvo::test;
    const std::span<const std::byte> input = std::as_bytes(std::span(data, size));
    const std::optional<zvo::ZvoFile> file = readInput(input);
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
        checkVoxels(file->tree);
    }
    if (g_device)
    {
        std::mt19937 random(static_cast<std::uint32_t>(file->header.header_checksum));
        const zvo::DeviceTree tree = uploadTree(*g_device, file->tree);
        std::visit([&](const auto& on_device) { trace(*g_device, on_device, file->tree, random); }, tree);
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
        return LLVMFuzzerMutate(data, size, size_max); // checksums are wrong then
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
