// SPDX-License-Identifier: MIT
// Fragments are added to the sums of voxels in several forms, and every form leaves the same bytes.
#include "io/gltf/gltf_loader.h"
#include "runtime/octree_sha256.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/materials_scene.h"
#include "support/param_names.h"
#include "support/same_bytes.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{
namespace
{

using test::device;
using test::sameBytes;

// Those that the device can do; the first one is what all others are compared with.
std::vector<SumForm> formsOf(const vk::Device& device)
{
    std::vector<SumForm> forms(1);
    if (SumForm::on(device).int64)
    {
        forms.push_back({.int64 = true});
    }
    return forms;
}

// All that a build with kept sums leaves.
struct Left
{
    std::string octree;
    std::vector<gpu::VoxelSums> sums;
    std::vector<gpu::EmissionSums> emission_sums;
    std::uint32_t sum_shift = 0;
};

Left build(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, Coverage coverage,
           std::optional<SumForm> form)
{
    const GpuScene uploaded = uploadScene(device, scene, true);
    BuildOptions options = {coverage, true, {}};
    options.keep_sums = true;
    options.sum_form = form;
    const DeviceTree octree = buildOctree(device, uploaded, grid, options).octree;
    return {octreeSha256(device, octree), device.download(octree.sums.sums), device.download(octree.sums.emission_sums),
            octree.sums.sum_shift};
}

// Returns the sums.
Left expectSameBytes(const Scene& scene, const Grid& grid, Coverage coverage)
{
    Left expected;
    for (const SumForm form : formsOf(device().device()))
    {
        SCOPED_TRACE(testing::Message() << "int64 " << form.int64);
        Left left = build(device(), scene, grid, coverage, form);
        EXPECT_TRUE(std::ranges::all_of(left.sums, [](const gpu::VoxelSums& sums) { return sums.zero == 0; }));
        if (expected.octree.empty())
        {
            expected = std::move(left);
            continue;
        }
        EXPECT_EQ(left.octree, expected.octree);
        EXPECT_TRUE(sameBytes(left.sums, expected.sums));
        EXPECT_TRUE(sameBytes(left.emission_sums, expected.emission_sums));
        EXPECT_EQ(left.sum_shift, expected.sum_shift);
    }
    return expected;
}

// count triangles with random corners in cubes of this size, anywhere in [0, extent]^3.
Scene scatteredTriangles(std::size_t count, float size, float extent)
{
    std::mt19937 random(11);
    const auto uniform = [&](float high) { return std::uniform_real_distribution<float>(0.0F, high)(random); };
    const auto point = [&](float high) { return glm::vec3(uniform(high), uniform(high), uniform(high)); };
    std::vector<glm::vec3> corners;
    for (std::size_t i = 0; i < count; ++i)
    {
        const glm::vec3 corner = point(extent - size);
        corners.insert(corners.end(), {corner + point(size), corner + point(size), corner + point(size)});
    }
    return test::triangleSoup(corners);
}

using SumFormsBothCoverages = testing::TestWithParam<Coverage>;

INSTANTIATE_TEST_SUITE_P(Coverages, SumFormsBothCoverages, testing::Values(Coverage::Conservative, Coverage::Thin),
                         test::paramName<Coverage>);

// Builds with sums of mixed voxels alone, which are not kept: by addresses, and as the software device does by default.
void expectMixedSumsGive(const std::string& octree, const Scene& scene, const Grid& grid, Coverage coverage)
{
    static vk::HeadlessDevice by_addresses(
        []
        {
            vk::HeadlessOptions options = test::deviceOptions();
            options.tuning["mixed-sums"] = 1;
            options.tuning[vk::kLoadsName] = static_cast<std::uint32_t>(vk::LoadForm::Addresses);
            return options;
        }(),
        zvoKernels());
    for (vk::HeadlessDevice* const builder : {&by_addresses, &device()})
    {
        const GpuScene uploaded = uploadScene(*builder, scene, true);
        SumForm form = SumForm::on(builder->device());
        form.mixed = true;
        SCOPED_TRACE(testing::Message() << "default " << (builder == &device()));
        BuildOptions options = {coverage, true, {}};
        options.sum_form = form;
        const BuildResult built = buildOctree(*builder, uploaded, grid, options);
        EXPECT_EQ(octreeSha256(*builder, built.octree), octree);
        const auto isResolveMixed = [](const vk::PassTime& pass) { return pass.name == "voxelize/resolve_leaves"; };
        EXPECT_EQ(std::ranges::any_of(built.passes, isResolveMixed), uploaded.emission_scale == 0.0F);
    }
}

// The scene without lights, of which no sums need to be kept.
Scene withoutEmission(Scene scene)
{
    for (Material& material : scene.materials)
    {
        material.emission = glm::vec3(0.0F);
    }
    return scene;
}

TEST_P(SumFormsBothCoverages, OfMixedVoxelsAloneLeaveTheSameBytes)
{
    const auto expectMixedGives = [](const Scene& scene, const Grid& grid)
    {
        const Left left = build(device(), scene, grid, GetParam(), std::nullopt);
        expectMixedSumsGive(left.octree, scene, grid, GetParam());
    };
    const Grid grid = {glm::vec3(-10.0F, 5.0F, 0.25F), 90.0F / 128, 7};
    const Scene materials = test::materialsScene(100.0F, 40);
    expectMixedGives(materials, grid); // emits: all voxels have sums
    expectMixedGives(withoutEmission(materials), grid);
    expectMixedGives(withoutEmission(materials), {grid.origin, grid.voxel_size, 13}); // keys of two words
    // Some share voxels, others do not.
    expectMixedGives(scatteredTriangles(256, 6.0F, 50.0F), {glm::vec3(0.0F), 1.0F, 6});
}

// The passes of a build as the frame graph lists them.
std::string dumpOfBuild(vk::HeadlessDevice& device, const Scene& scene, const Grid& grid, bool keep_sums = false)
{
    const GpuScene uploaded = uploadScene(device, scene, true);
    BuildOptions options;
    options.keep_sums = keep_sums;
    OctreeBuilder builder(device.device(), uploaded, grid, options);
    std::string dump;
    while (!builder.isDone())
    {
        builder.resume(device.run(
            [&](vk::FrameGraph& graph)
            {
                builder.record(graph);
                dump += graph.dump();
            }));
    }
    return dump;
}

TEST(SumForms, OfMixedVoxelsAloneAreForTrianglesThatHaveVoxelsOfTheirOwn)
{
    const auto resolves = [](const std::string& dump) { return dump.find("voxelize/resolve_leaves") != dump.npos; };
    const Scene large = scatteredTriangles(64, 6.0F, 50.0F);
    const Scene dense = test::sphereScene(glm::vec3(32.0F), 30.0F, 160);
    const Grid grid = {glm::vec3(0.0F), 1.0F, 6};
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning["mixed-sums"] = 1; // not on every device
    vk::HeadlessDevice mixed(options, zvoKernels());
    EXPECT_TRUE(resolves(dumpOfBuild(mixed, large, grid)));
    EXPECT_FALSE(resolves(dumpOfBuild(mixed, large, grid, true))) << "sums are kept";
    EXPECT_FALSE(resolves(dumpOfBuild(mixed, dense, grid)));
}

// A pass falls back to addresses where a buffer has no descriptor, which nothing else would tell.
TEST(SumForms, KernelsOfBuildsReachTheirBuffersThroughDescriptors)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning["mixed-sums"] = 1;
    options.tuning[vk::kLoadsName] = static_cast<std::uint32_t>(vk::LoadForm::Descriptors);
    vk::HeadlessDevice bound(options, zvoKernels());
    const Grid grid = {glm::vec3(0.0F), 0.25F, 8};
    const Scene materials = withoutEmission(test::materialsScene(60.0F, 40));
    std::istringstream lines(dumpOfBuild(bound, materials, grid) + dumpOfBuild(bound, materials, grid, true));
    std::set<std::string> names;
    for (std::string line; std::getline(lines, line);)
    {
        std::istringstream words(line);
        std::string pass;
        std::string name;
        words >> pass >> name;
        name = name.substr(0, name.find(':'));
        const auto kernel = std::ranges::find(zvoKernels(), std::string_view(name), &vk::EmbeddedKernel::name);
        if (pass == "pass" && kernel != zvoKernels().end() && !kernel->bound_words.empty())
        {
            names.insert(name);
            EXPECT_NE(line.find("through descriptors"), line.npos) << line;
        }
    }
    const std::string suffix = SumForm::on(bound.device()).int64 ? "_int64" : "";
    EXPECT_EQ(names, (std::set<std::string>{"octree/average", "octree/parents", "voxelize/attributes" + suffix,
                                            "voxelize/bin", "voxelize/bin_large", "voxelize/brick_leaves",
                                            "voxelize/collect_bricks", "voxelize/cover", "voxelize/list_bricks",
                                            "voxelize/resolve", "voxelize/resolve_leaves"}));
}

TEST_P(SumFormsBothCoverages, OfMixedVoxelsWithTooManyFragmentsLeaveTheSameBytes)
{
    Scene scene = scatteredTriangles(70000, 0.5F, 0.75F);
    const Scene others = scatteredTriangles(20, 3.0F, 15.0F);
    for (const glm::vec3& position : others.primitives[0].positions)
    {
        scene.primitives[0].positions.push_back(position + 1.0F);
    }
    const auto first = static_cast<std::uint32_t>(scene.primitives[0].positions.size() - 60);
    for (std::uint32_t i = 0; i < 60; i += 3)
    {
        scene.primitives[0].triangles.emplace_back(first + i, first + i + 1, first + i + 2);
    }
    const Grid grid = {glm::vec3(0.0F), 1.0F, 4};
    const Left left = build(device(), scene, grid, GetParam(), std::nullopt);
    if (GetParam() == Coverage::Conservative) // thin coverage leaves some out
    {
        EXPECT_EQ(left.sum_shift, 1U);
    }
    expectMixedSumsGive(left.octree, scene, grid, GetParam());
}

TEST_P(SumFormsBothCoverages, OfAllMaterialsLeaveTheSameBytes)
{
    const Scene scene = test::materialsScene(100.0F, 40);
    expectSameBytes(scene, {glm::vec3(-10.0F, 5.0F, 0.25F), 90.0F / 128, 7}, GetParam());
    expectSameBytes(scene, {glm::vec3(-10.0F, 5.0F, 0.25F), 90.0F / 128, 13}, GetParam()); // keys of two words
}

TEST_P(SumFormsBothCoverages, OfADenseMeshLeaveTheSameBytes)
{
    const Scene scene = test::sphereScene(glm::vec3(32.0F), 30.0F, 160);
    const Left left = expectSameBytes(scene, {glm::vec3(0.0F), 1.0F, 6}, GetParam());
    const auto crowded = [](const gpu::VoxelSums& sums) { return sums.fragments > 8; };
    EXPECT_GT(std::ranges::count_if(left.sums, crowded), 100);
    if (const auto path = test::findScene("bunny.glb"))
    {
        const Scene bunny = loadGltf(*path);
        expectSameBytes(bunny, Grid::around(bunny.bounds(), 7), GetParam());
    }
}

// Sums that would carry into the next word if normals were added with their signs.
TEST_P(SumFormsBothCoverages, OfAsManyFragmentsAsFitAndMoreLeaveTheSameBytes)
{
    for (const std::size_t count : {65535U, 65536U, 131072U, 140000U})
    {
        SCOPED_TRACE(count);
        Scene scene = scatteredTriangles(count, 0.5F, 0.75F);
        scene.materials[0].base_color = {1.0F, 0.5F, 0.0F, 1.0F};
        const Left left = expectSameBytes(scene, {glm::vec3(0.0F), 1.0F, 2}, GetParam());
        ASSERT_EQ(left.sums.size(), 1U);
        if (GetParam() == Coverage::Conservative) // thin coverage leaves some out
        {
            EXPECT_EQ(left.sum_shift, count < 65536 ? 0U : (count < 131072 ? 1U : 2U));
            EXPECT_EQ(left.sums[0].fragments, count);
        }
    }
}

TEST(SumForms, NormalsOfAllSignsFitTheBiasedSums)
{
    // Triangles in one plane, all with the same normal, along each axis and against it.
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const bool turned : {false, true})
        {
            std::vector<glm::vec3> corners = {glm::vec3(0.25F), glm::vec3(0.25F), glm::vec3(0.25F)};
            corners[turned ? 2 : 1][(axis + 1) % 3] = 0.75F;
            corners[turned ? 1 : 2][(axis + 2) % 3] = 0.75F;
            std::vector<glm::vec3> all;
            for (int i = 0; i < 65535; ++i)
            {
                all.insert(all.end(), corners.begin(), corners.end());
            }
            const Left left = expectSameBytes(test::triangleSoup(all), {glm::vec3(0.0F), 1.0F, 2}, Coverage::Thin);
            ASSERT_EQ(left.sums.size(), 1U);
            ASSERT_EQ(left.sums[0].fragments, 65535U);
            const gpu::uint sums[] = {left.sums[0].normal_x, left.sums[0].normal_y, left.sums[0].normal_z};
            for (int i = 0; i < 3; ++i)
            {
                const gpu::uint value = i != axis ? 32768 : (turned ? 1 : 65535);
                EXPECT_EQ(sums[i], 65535U * value);
            }
        }
    }
}

TEST(SumForms, BiasLeavesNoShiftedNormalNegative)
{
    for (gpu::uint shift = 0; shift <= 16; ++shift)
    {
        const auto bias = static_cast<int>(gpu::normalBias(shift));
        EXPECT_GE((-32767 >> shift) + bias, 0);
        const std::uint64_t most = static_cast<std::uint64_t>((32767 >> shift) + bias);
        EXPECT_LE(most * ((std::uint64_t{gpu::kFragmentsMax + 1} << shift) - 1), UINT32_MAX) << shift;
    }
}

TEST(SumForms, DevicesWithoutLongAtomicsDoWithoutThem)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.overrides.features = {"shaderBufferInt64Atomics"};
    vk::HeadlessDevice poor(options, zvoKernels());
    EXPECT_FALSE(SumForm::on(poor.device()).int64);
    const Scene scene = test::materialsScene(100.0F, 5);
    const Grid grid = {glm::vec3(0.0F), 100.0F / 64, 6};
    const Left left = build(poor, scene, grid, Coverage::Thin, std::nullopt);
    const Left expected = build(device(), scene, grid, Coverage::Thin, std::nullopt);
    EXPECT_EQ(left.octree, expected.octree);
    EXPECT_TRUE(sameBytes(left.sums, expected.sums));
}

TEST(SumForms, FollowTheDevice)
{
    for (const char* type : {"cpu", "discrete", "integrated", "virtual", "other"})
    {
        vk::HeadlessOptions options = test::deviceOptions();
        options.overrides.type = type;
        vk::HeadlessDevice device(options, zvoKernels());
        EXPECT_TRUE(SumForm::on(device.device()).mixed);
        EXPECT_EQ(SumForm::on(device.device()).int64, device.device().isEnabled("shaderBufferInt64Atomics"));
    }
}

} // namespace
} // namespace zvo
