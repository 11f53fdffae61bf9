// SPDX-License-Identifier: MIT
// Pictures of static models, as a host makes them.
#include "api_scene.h"
#include "core/file/zvo_file.h"
#include "runtime/trees.h"
#include "support/engine_device.h"
#include "support/errors.h"

#include <gtest/gtest.h>

#include <future>
#include <set>

namespace zvo
{

namespace
{

using test::device;

TEST(ApiPicture, AllViewsAreThoseOfTheEngineOfOctreesAndDags)
{
    test::EmbeddingHost host;
    const test::HostModel model(test::apiScene());
    const Model uploaded = host.upload(model.info());
    EXPECT_EQ(uploaded.triangleCount(), test::apiScene().triangleCount());
    Tree octree = host.build(uploaded, {.grid = test::apiGrid()});
    const DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid());
    EXPECT_EQ(octree.info().voxel_count, expected.voxel_count);
    EXPECT_EQ(octree.info().node_count, expected.node_count);
    EXPECT_EQ(octree.info().bytes, expected.geometryBytes() + expected.attributeBytes());
    std::set<std::vector<std::uint32_t>> different;
    for (std::uint32_t view = 0; view <= static_cast<std::uint32_t>(View::Origin); ++view)
    {
        const std::vector<std::uint32_t> picture =
            host.picture(octree, test::apiCamera(), {.view = static_cast<View>(view)});
        EXPECT_EQ(picture, test::pictureOf(device(), expected, static_cast<View>(view))) << view;
        different.insert(picture);
    }
    EXPECT_GE(different.size(), 8U); // all hits have the voxels' level

    const std::vector<std::uint32_t> lit = host.picture(octree, test::apiCamera());
    TreeCompression compression(host.context, std::move(octree));
    EXPECT_GE(host.finish(compression), 3U);
    const Tree dag = compression.take();
    EXPECT_EQ(dag.info().structure, TreeStructure::Svdag);
    EXPECT_LT(dag.info().node_count, expected.node_count);
    EXPECT_EQ(host.picture(dag, test::apiCamera()), lit);
}

TEST(ApiPicture, EveryFormatOfAttributesIsBuiltAndTraced)
{
    test::EmbeddingHost host;
    const test::HostModel model(test::apiScene());
    const Model uploaded = host.upload(model.info());
    std::uint64_t bytes = UINT64_MAX;
    for (const AttributeFormat format :
         {AttributeFormat::Bytes8, AttributeFormat::Bytes4, AttributeFormat::Blocks, AttributeFormat::None})
    {
        const Tree tree = host.build(uploaded, {.grid = test::apiGrid(), .format = format});
        EXPECT_EQ(tree.info().format, format);
        EXPECT_LT(tree.info().bytes, bytes);
        bytes = tree.info().bytes;
        DeviceTree expected = test::engineOctree(device(), test::apiScene(), test::apiGrid());
        packTree(device(), format, expected);
        if (format == AttributeFormat::None)
        {
            expected.voxel_attributes = {};
            expected.node_attributes = {};
            expected.emission_words = {};
            expected.emission = {};
        }
        EXPECT_EQ(host.picture(tree, test::apiCamera()), test::pictureOf(device(), expected, View::Color));
    }
}

TEST(ApiPicture, ATreeFromAFileIsTheTree)
{
    test::EmbeddingHost host;
    const DeviceTree octree = test::engineOctree(device(), test::apiScene(), test::apiGrid());
    std::vector<std::byte> bytes;
    writeZvo(downloadTree(device(), octree),
             [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    const Tree tree = host.make<Tree>(std::span<const std::byte>(bytes));
    EXPECT_EQ(host.picture(tree, test::apiCamera()), test::pictureOf(device(), octree, View::Color));
    bytes[200] ^= std::byte{1};
    const auto readBroken = [&] { (void)host.make<Tree>(std::span<const std::byte>(bytes)); };
    (void)test::messageOf(readBroken, ErrorCode::Input);
}

TEST(ApiPicture, AnEmptyModelGivesAnEmptyTreeAndABackground)
{
    test::EmbeddingHost host;
    const Model model = host.upload({});
    Tree tree = host.build(model, {.grid = test::apiGrid()});
    EXPECT_EQ(tree.info().voxel_count, 0U);
    const auto background = host.picture(tree, test::apiCamera(), {.view = View::Albedo});
    EXPECT_EQ(std::set<std::uint32_t>(background.begin(), background.end()).size(), 1U);
    const Tree dag = host.compress(std::move(tree));
    EXPECT_EQ(host.picture(dag, test::apiCamera(), {.view = View::Albedo}), background);
}

TEST(ApiPicture, WithoutOptionalFeaturesItIsTheSame)
{
    std::vector<std::vector<std::uint32_t>> pictures;
    for (const bool optional : {true, false})
    {
        test::HostOptions options;
        options.optional = {optional, optional, optional};
        options.debug_utils = optional;
        options.validation = options.validation && optional;
        test::EmbeddingHost host(options, [&](ContextInfo& info) { info.timed_passes_per_frame = optional ? 200 : 0; });
        const test::HostModel model(test::apiScene());
        const Tree tree = host.build(host.upload(model.info()), {.grid = test::apiGrid()});
        pictures.push_back(host.picture(tree, test::apiCamera()));
        EXPECT_EQ(host.context.passTimes().empty(), !optional);
    }
    EXPECT_EQ(pictures[0], pictures[1]);
}

TEST(ApiPicture, SubgroupsOfAnySizeGiveTheSame)
{
    const vk::DeviceReport& report = device().device().report();
    if (report.min_subgroup_size == 0)
    {
        GTEST_SKIP() << "the device's subgroups have one size";
    }
    std::set<std::vector<std::uint32_t>> pictures;
    for (std::uint32_t size = report.min_subgroup_size; size <= report.max_subgroup_size; size *= 2)
    {
        test::HostOptions options;
        options.optional.subgroup_sizes = true;
        test::EmbeddingHost host(options, [&](ContextInfo& info) { info.subgroup_size = size; });
        const test::HostModel model(test::apiScene());
        const Tree tree = host.build(host.upload(model.info()), {.grid = test::apiGrid()});
        pictures.insert(host.picture(tree, test::apiCamera()));
    }
    EXPECT_EQ(pictures.size(), 1U);
    test::HostOptions without;
    without.optional.subgroup_sizes = false;
    const auto begin = [&]
    { test::EmbeddingHost host(without, [&](ContextInfo& info) { info.subgroup_size = report.min_subgroup_size; }); };
    test::expectParts(test::messageOf(begin, ErrorCode::Device), {"subgroupSizeControl"});
}

TEST(ApiPicture, TwoContextsDoNotKnowOfEachOther)
{
    test::EmbeddingHost one;
    auto two = std::make_unique<test::EmbeddingHost>();
    const test::HostModel model(test::apiScene());
    const Model of_one = one.upload(model.info());
    const Model of_two = two->upload(model.info());
    TreeBuild build_one(one.context, of_one, {.grid = test::apiGrid()});
    TreeBuild build_two(two->context, of_two, {.grid = test::apiGrid()});
    while (!build_one.isDone() || !build_two.isDone()) // in turns
    {
        one.frame([&](Recorder& recorder) { build_one.record(recorder); });
        two->frame([&](Recorder& recorder) { build_two.record(recorder); });
    }
    const Tree tree_one = build_one.take();
    std::vector<std::uint32_t> picture;
    {
        const Tree tree_two = build_two.take();
        picture = two->picture(tree_two, test::apiCamera());
        EXPECT_THROW(one.picture(tree_two, test::apiCamera()), Error);
    }
    EXPECT_EQ(one.picture(tree_one, test::apiCamera()), picture);
}

TEST(ApiPicture, TwoThreadsMayUseTwoContexts)
{
    const Scene scene = test::apiScene(); // made before, on this thread
    const auto pictureOf = [&scene]
    {
        test::EmbeddingHost host;
        const test::HostModel model(scene);
        const Tree tree = host.build(host.upload(model.info()), {.grid = test::apiGrid()});
        return host.picture(tree, test::apiCamera());
    };
    auto other = std::async(std::launch::async, pictureOf);
    const std::vector<std::uint32_t> picture = pictureOf();
    EXPECT_EQ(other.get(), picture);
}

TEST(ApiPicture, DepthIsWhereTheVoxelsAre)
{
    test::EmbeddingHost host;
    const test::HostModel model(test::boxScene(glm::vec3(2), glm::vec3(6)));
    const Tree tree = host.build(host.upload(model.info()), {.grid = test::apiGrid()});
    Tracer tracer(host.context, host.kWidth, host.kHeight, VK_FORMAT_R8G8B8A8_UNORM);
    test::TargetImage color(host.device, VK_FORMAT_R8G8B8A8_UNORM, host.kWidth, host.kHeight);
    test::TargetImage depth(host.device, VK_FORMAT_D32_SFLOAT, host.kWidth, host.kHeight);
    // The camera looks straight down on the box, whose voxels end at y = 6.25. Depth is the height above that, over 20.
    CameraInfo camera;
    camera.position = {4, 16.25, 4};
    camera.forward = {0, -1, 0};
    camera.up = {0, 0, 1};
    camera.orthographic = true;
    camera.half_height = 1;
    DepthTarget target{depth.target(), {}, 1.0F};
    target.view_projection = {1, 0, 0, 0, 0, 1, -1.0 / 20, 0, 0, 0, 0, 0, 0, 0, 16.25 / 20, 1};
    host.frame(
        [&](Recorder& recorder, VkCommandBuffer commands)
        {
            color.beginCopies(commands);
            depth.beginCopies(commands);
            tracer.trace(recorder, tree, camera, {}, color.target(), &target);
            depth.read(commands);
        });
    for (const std::uint32_t word : depth.words())
    {
        ASSERT_NEAR(std::bit_cast<float>(word), 0.5F, 1e-5F);
    }
}

} // namespace

} // namespace zvo
