// SPDX-License-Identifier: MIT
// A libFuzzer target for scene files, whose format follows from their content. The input is loaded, checked and
// voxelized at 16^3, in a pose if something moves. If the loader refuses a file, it must throw an Error{Input} of one
// line. All other scenes must keep the rules of Scene, and must be voxelized without an error.
#include "core/base/kernels.h"
#include "core/scene/animation.h"
#include "fuzz/gltf_mutator.h"
#include "fuzz/mesh_mutator.h"
#include "fuzz/require.h"
#include "io/image/image_io.h"
#include "io/scene/load_scene.h"
#include "io/scene/scene_part.h"
#include "runtime/trees.h"
#include "support/scene_check.h"
#include "support/temp_dir.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>

namespace zvo::test
{

namespace
{

constexpr std::uint32_t kDepth = 4; // 16^3

// Larger inputs only take more time on the device.
constexpr std::uint64_t kTrianglesMax = 2000;
constexpr std::size_t kInstancesMax = 200;
constexpr std::uint64_t kTexelsMax = 1U << 14U;

/// A folder with the input and a few files to which it may refer.
class Folder
{
public:
    Folder()
    {
        m_dir.write("side.bin", std::string(64, '\1'));
        m_dir.write("side.mtl", std::string("newmtl a\nKd 1 0 0\nmap_Kd side.png\nmap_d side.png\nnewmtl b\nKe 1 2 3\n"
                                            "map_Ke -clamp on side.png\nd 0.5\n"));
        m_dir.write("side.png", encodePng(2, 2, std::vector<std::uint8_t>(16, 200)));
    }

    /// As a name of text with points, which alone are not known by their content.
    std::filesystem::path write(std::span<const std::uint8_t> content) const
    {
        return m_dir.write("input.xyz", content);
    }

private:
    TempDir m_dir;
};

/// The device and folder, which are made once, and destroyed before the driver's static objects.
struct Session
{
    Folder folder;
    std::unique_ptr<vk::HeadlessDevice> device; // null: nothing is voxelized
};

std::unique_ptr<Session> g_session;

std::optional<Scene> loadInput(std::span<const std::uint8_t> input)
{
    return readOrRefused(
        [&]
        {
            const std::filesystem::path path = g_session->folder.write(input);
            const auto size = static_cast<std::uint32_t>(input.size());
            return loadScene(std::span(&path, 1), {.every_animation = true, .point_size = 1 + size % 2});
        });
}

bool isSmall(const Scene& scene)
{
    std::uint64_t texels = 0;
    for (const Image& image : scene.images)
    {
        texels += std::uint64_t{image.width} * image.height;
    }
    return scene.triangleCount() <= kTrianglesMax && scene.instances.size() <= kInstancesMax && texels <= kTexelsMax;
}

void voxelize(vk::HeadlessDevice& device, const Scene& scene, const BuildOptions& options)
{
    const Grid grid = Grid::around(scene.bounds(), kDepth);
    require(std::isfinite(grid.voxel_size) && grid.voxel_size > 0.0F, "a grid without a voxel size");
    const GpuScene gpu_scene = uploadScene(device, scene, options.attributes);
    const BuildResult result = buildOctree(device, gpu_scene, grid, options);
    const std::vector<std::uint64_t> codes = voxelCodes(device, result.octree);
    require(codes.size() == result.octree.voxel_count, "an octree that has other voxels than it counts");
    require(std::is_sorted(codes.begin(), codes.end()), "voxels out of order");
    require(codes.empty() || codes.back() >> (3 * kDepth) == 0, "a voxel outside of the grid");
    std::uint64_t dropped = 0;
    for (const auto& [reason, count] : result.dropped)
    {
        dropped += count;
    }
    require(dropped <= gpu_scene.triangle_count, "more triangles left out than there are");
}

void closeSession()
{
    g_session.reset();
}

} // namespace

} // namespace zvo::test

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/)
{
    using namespace zvo::test;
    g_session = std::make_unique<Session>();
    std::atexit(closeSession);
    if (std::getenv("ZVO_FUZZ_LOAD_ONLY") == nullptr)
    {
        zvo::vk::HeadlessOptions options;
        options.device = "cpu";
        g_session->device = std::make_unique<zvo::vk::HeadlessDevice>(options, zvo::zvoKernels());
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace zvo::test;
    const std::optional<zvo::Scene> scene = loadInput({data, size});
    if (!scene)
    {
        return 0;
    }
    requireNoFault(sceneFault(*scene));
    if (!isSmall(*scene))
    {
        return 0;
    }
    constexpr double kSecondsPerByte = 0.375; // an arbitrary time that depends on the input's size
    const zvo::Scene shown = size % 2 == 0
                                 ? posedScene(*scene, poseAt(*scene, kSecondsPerByte * static_cast<double>(size)))
                                 : atRest(*scene);
    require(shown.triangleCount() == scene->triangleCount(), "a pose that loses triangles");
    if (g_session->device)
    {
        // Some inputs without attributes, some conservative.
        zvo::BuildOptions options;
        options.attributes = size % 4 != 0 || size % 16 == 0;
        options.coverage = size % 8 == 4 ? zvo::Coverage::Conservative : zvo::Coverage::Thin;
        voxelize(*g_session->device, shown, options);
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
    const std::uint32_t choice = random() % 16;
    if (choice == 0)
    {
        return LLVMFuzzerMutate(data, size, size_max); // also breaks headers
    }
    GltfParts parts = GltfParts::split({data, size});
    const bool is_mesh = !parts.binary && !parts.text.starts_with('{');
    const auto mutateBytes = [&](auto& bytes)
    {
        const std::size_t byte_count = bytes.size();
        bytes.resize(byte_count + byte_count / 4 + 16);
        bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), byte_count, bytes.size()));
    };
    if (is_mesh && choice >= 3)
    {
        mutateMesh(parts.text, random);
    }
    else if (choice < 3)
    {
        mutateBytes(parts.text);
    }
    else if (choice < 6 && !parts.bin.empty())
    {
        mutateBytes(parts.bin);
    }
    else if (choice < 8 && !parts.bin.empty())
    {
        mutateBin(parts.bin, random);
    }
    else
    {
        mutateJson(parts.text, random);
    }
    const std::vector<std::uint8_t> file = parts.join();
    if (file.size() > size_max)
    {
        return LLVMFuzzerMutate(data, size, size_max);
    }
    std::copy(file.begin(), file.end(), data);
    return file.size();
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2, std::uint8_t* out,
                                                 std::size_t out_size_max, unsigned int seed);
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2, std::uint8_t* out,
                                                 std::size_t out_size_max, unsigned int seed)
{
    using namespace zvo::test;
    std::mt19937 random(seed);
    GltfParts parts = GltfParts::split({data1, size1});
    GltfParts other = GltfParts::split({data2, size2});
    if (!parts.binary && !parts.text.starts_with('{'))
    {
        crossMesh(parts.text, other.text, random);
    }
    else if (random() % 4 == 0)
    {
        parts.bin = std::move(other.bin);
    }
    else
    {
        crossJson(parts.text, other.text, random);
    }
    const std::vector<std::uint8_t> file = parts.join();
    if (file.size() > out_size_max)
    {
        return 0;
    }
    std::copy(file.begin(), file.end(), out);
    return file.size();
}
