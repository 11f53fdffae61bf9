// SPDX-License-Identifier: MIT
#include "support/errors.h"
#include "vk/kernels.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace
{

using namespace zvo;
using test::device;

std::vector<gpu::uint> runSpecialized(const vk::Specialization& specialization)
{
    vk::BufferOf<gpu::uint> values(device().device(), "values", 100);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("test/specialized", specialization);
            const gpu::FillParams params = {.values = pass.write(values), .count = 100};
            pass.dispatch(100, params);
        });
    return device().download(values);
}

TEST(Kernel, SpecializationConstantsReachTheKernel)
{
    EXPECT_EQ(runSpecialized({16, 5, 1}), std::vector<gpu::uint>(100, 16051));
    EXPECT_EQ(runSpecialized({32, 6, 0}), std::vector<gpu::uint>(100, 32060));
}

TEST(Kernel, ConstantsThatAreNotGivenKeepTheirDefaults)
{
    EXPECT_EQ(runSpecialized({8}), std::vector<gpu::uint>(100, 8070));
    EXPECT_EQ(runSpecialized({}), std::vector<gpu::uint>(100, 1070));
}

TEST(Kernel, ConstantsThatTheKernelLacksAreRefused)
{
    EXPECT_THROW(device().device().kernels().get("test/specialized", {8, 1, 1, 1}), Error);
    EXPECT_THROW(device().device().kernels().get("test/iota", {1}), Error);
}

TEST(Kernel, WorkgroupsBeyondTheDeviceAreRefused)
{
    EXPECT_THROW(device().device().kernels().get("test/specialized", {1u << 20}), Error);
    EXPECT_THROW(device().device().kernels().get("test/specialized", {0}), Error);
    EXPECT_EQ(runSpecialized({8}), std::vector<gpu::uint>(100, 8070)) << "the cache is not damaged";
}

TEST(Kernel, OneChoiceOfConstantsIsOnePipeline)
{
    vk::KernelCache& kernels = device().device().kernels();
    EXPECT_EQ(&kernels.get("test/specialized", {8}), &kernels.get("test/specialized", {8}));
    EXPECT_NE(&kernels.get("test/specialized", {8}), &kernels.get("test/specialized", {16}));
    EXPECT_EQ(kernels.get("test/specialized", {16}).interface.local_size[0], 16u);
}

// The words of an embedded kernel.
std::vector<std::uint32_t> wordsOf(std::string_view name)
{
    const auto kernels = testKernels();
    const auto found = std::ranges::find(kernels, name, &vk::EmbeddedKernel::name);
    return {found->words.begin(), found->words.end()};
}

std::vector<gpu::uint> iotaOn(vk::HeadlessDevice& own)
{
    vk::BufferOf<gpu::uint> values(own.device(), "values", 5);
    own.run([&](vk::FrameGraph& graph) { test::iota(graph, values); });
    return own.download(values);
}

TEST(Kernel, AReplacedKernelRunsFromThenOn)
{
    vk::HeadlessDevice own(test::deviceOptions(), testKernels());
    EXPECT_EQ(iotaOn(own), (std::vector<gpu::uint>{0, 1, 2, 3, 4}));
    const vk::Kernel& kernel = own.device().kernels().get("test/iota");
    own.device().kernels().replace("test/iota", wordsOf("test/reversed"));
    EXPECT_EQ(&own.device().kernels().get("test/iota"), &kernel);
    EXPECT_EQ(iotaOn(own), (std::vector<gpu::uint>{4, 3, 2, 1, 0}));
    own.device().kernels().replace("test/iota", wordsOf("test/iota"));
    own.device().kernels().releaseReplaced();
    EXPECT_EQ(iotaOn(own), (std::vector<gpu::uint>{0, 1, 2, 3, 4}));
}

TEST(Kernel, ReplacingByWhatDoesNotFitChangesNothing)
{
    vk::HeadlessDevice own(test::deviceOptions(), testKernels());
    vk::KernelCache& kernels = own.device().kernels();
    EXPECT_EQ(iotaOn(own).at(4), 4U);
    EXPECT_THROW(kernels.replace("test/nothing", wordsOf("test/iota")), Error);
    EXPECT_THROW(kernels.replace("test/iota", wordsOf("test/scale")), Error) << "other push constants";
    EXPECT_THROW(kernels.replace("test/iota", wordsOf("test/specialized")), Error) << "other workgroups";
    EXPECT_THROW(kernels.replace("test/iota", {1, 2, 3}), Error) << "not a module";
    EXPECT_EQ(iotaOn(own).at(4), 4U);
}

TEST(Kernel, UnknownNamesAreRefused)
{
    const auto get = [] { device().device().kernels().get("no/such_kernel"); };
    test::expectParts(test::messageOf(get, ErrorCode::Other), {"no/such_kernel"});
}

} // namespace
