// SPDX-License-Identifier: MIT
// Kernels in their bound form, which reaches buffers through descriptors (lib/bound.glsl).
#include "vk/kernels.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace
{

using namespace zvo;
using gpu::kBoundMark;
using test::Words;

vk::HeadlessOptions optionsWith(vk::LoadForm loads)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.tuning[vk::kLoadsName] = static_cast<std::uint32_t>(loads);
    return options;
}

const vk::EmbeddedKernel& embedded(std::string_view name)
{
    return *std::ranges::find(testKernels(), name, &vk::EmbeddedKernel::name);
}

// Records destination = source * factor, of the elements from `first` on.
void bound(vk::FrameGraph& graph, const Words& source, Words& destination, gpu::uint factor, gpu::uint first = 0)
{
    vk::Pass pass = graph.addPass(gpu::test::Bound{});
    gpu::CopyParams params = {.source = pass.read(source),
                              .destination = pass.write(destination),
                              .count = static_cast<gpu::uint>(source.count()) - first,
                              .factor = factor};
    params.source.address += first * sizeof(gpu::uint);
    pass.dispatch(params.count, params);
}

// Element 2 of 0, 1, 2 and so on after bound() with factor 1.
gpu::uint thirdOf(vk::HeadlessDevice& device, gpu::uint first = 0)
{
    Words source(device.device(), "source", 40);
    Words destination(device.device(), "destination", 40);
    device.run(
        [&](vk::FrameGraph& graph)
        {
            test::iota(graph, source);
            bound(graph, source, destination, 1, first);
        });
    return device.download(destination).at(2);
}

TEST(BoundForm, ItsDescriptorsStandForParameters)
{
    const vk::KernelInterface interface = vk::reflectKernel(embedded("test/bound").bound_words);
    EXPECT_EQ(interface.bindings, (std::vector<vk::ModuleBinding>{
                                      {.binding = 0, .texel_words = 1, .name = "source", .address_offset = 0}}));
    EXPECT_TRUE(vk::reflectKernel(embedded("test/bound").words).bindings.empty());
    EXPECT_TRUE(embedded("test/scale").bound_words.empty());
}

TEST(BoundForm, SuitsSoftwareDevices)
{
    DeviceReport report;
    report.type = "cpu";
    report.driver = "llvmpipe Mesa 22.3.6 (LLVM 15.0.6)";
    EXPECT_EQ(vk::usualLoadForm(report), vk::LoadForm::Descriptors);
    report.driver = "llvmpipe Mesa 25.0.7-2 (LLVM 15.0.6)";
    EXPECT_EQ(vk::usualLoadForm(report), vk::LoadForm::Atomics);
    report.driver = "another one";
    EXPECT_EQ(vk::usualLoadForm(report), vk::LoadForm::Atomics);
    report.type = "discrete";
    EXPECT_EQ(vk::usualLoadForm(report), vk::LoadForm::Addresses);
}

TEST(BoundForm, OfAtomicsAloneLeavesTexelsToOthers)
{
    vk::HeadlessDevice device(optionsWith(vk::LoadForm::Atomics), testKernels());
    EXPECT_EQ(thirdOf(device), 2U);
    EXPECT_EQ(device.device().kernels().usualForm("test/bound"), vk::KernelForm::Addressed);
    EXPECT_EQ(device.device().kernels().usualForm("test/insert_bricks"), vk::KernelForm::Bound);
}

// A buffer whose address is in a table on the device.
TEST(BoundForm, FindsBuffersByTheNamesThatThePassGivesThem)
{
    for (const vk::LoadForm loads : {vk::LoadForm::Addresses, vk::LoadForm::Descriptors})
    {
        vk::HeadlessDevice device(optionsWith(loads), testKernels());
        const std::vector<gpu::uvec3> values = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
        const vk::BufferOf<gpu::uvec3> triples = device.makeBuffer("triples", std::span(values));
        const gpu::ReachedTable table = {{triples.address()}};
        const vk::BufferOf<gpu::ReachedTable> tables = device.makeBuffer("table", std::span(&table, 1));
        Words sums(device.device(), "sums", values.size());
        device.run(
            [&](vk::FrameGraph& graph)
            {
                vk::Pass pass = graph.addPass(gpu::test::Reached{});
                pass.reach("triples", triples);
                pass.dispatch(values.size(), {pass.read(tables), pass.write(sums), 3, 0});
            });
        const gpu::uint mark = loads == vk::LoadForm::Descriptors ? kBoundMark : 0;
        EXPECT_EQ(device.download(sums), (std::vector<gpu::uint>{6 + mark, 15 + mark, 24 + mark}));
    }
}

TEST(BoundForm, NeedsTheNamesOfAllItsBuffers)
{
    vk::HeadlessDevice device(optionsWith(vk::LoadForm::Descriptors), testKernels());
    vk::BufferOf<gpu::ReachedTable> tables(device.device(), "table", 1);
    Words sums(device.device(), "sums", 3);
    const auto record = [&](vk::FrameGraph& graph)
    {
        vk::Pass pass = graph.addPass(gpu::test::Reached{});
        pass.dispatch(3, {pass.read(tables), pass.write(sums), 3, 0});
    };
    EXPECT_THROW(device.run(record), Error);
}

TEST(BoundForm, RunsWhereDescriptorsAreChosen)
{
    vk::HeadlessDevice with(optionsWith(vk::LoadForm::Descriptors), testKernels());
    EXPECT_EQ(thirdOf(with), 2 + kBoundMark);
    vk::HeadlessDevice without(optionsWith(vk::LoadForm::Addresses), testKernels());
    EXPECT_EQ(thirdOf(without), 2U);
}

TEST(BoundForm, DoesNotRunWhereAnAddressIsNotABuffers)
{
    vk::HeadlessDevice device(optionsWith(vk::LoadForm::Descriptors), testKernels());
    EXPECT_EQ(thirdOf(device, 5), 7U) << "inside of the buffer";
    EXPECT_EQ(thirdOf(device), 2 + kBoundMark);
}

TEST(BoundForm, DoesNotRunWhereABufferIsTooLargeForDescriptors)
{
    vk::HeadlessOptions options = optionsWith(vk::LoadForm::Descriptors);
    options.overrides.max_texel_elements = 40;
    vk::HeadlessDevice enough(options, testKernels());
    EXPECT_EQ(thirdOf(enough), 2 + kBoundMark);
    options.overrides.max_texel_elements = 39;
    vk::HeadlessDevice few(options, testKernels());
    EXPECT_EQ(thirdOf(few), 2U);
}

TEST(BoundForm, IsNotUsedOnceItsKernelIsReplaced)
{
    vk::HeadlessDevice device(optionsWith(vk::LoadForm::Descriptors), testKernels());
    EXPECT_EQ(thirdOf(device), 2 + kBoundMark);
    const std::span<const std::uint32_t> words = embedded("test/scale").words;
    device.device().kernels().replace("test/bound", {words.begin(), words.end()});
    EXPECT_EQ(thirdOf(device), 2U);
}

// More sets than a pool of descriptors has, then the same number again in place of those that have gone.
TEST(BoundForm, EveryBufferHasItsOwnDescriptors)
{
    vk::HeadlessDevice device(optionsWith(vk::LoadForm::Descriptors), testKernels());
    constexpr gpu::uint kCount = 150;
    for (gpu::uint round = 0; round < 2; ++round)
    {
        std::vector<Words> sources;
        std::vector<Words> destinations;
        for (gpu::uint i = 0; i < kCount; ++i)
        {
            sources.emplace_back(device.device(), "source", 8 + i);
            destinations.emplace_back(device.device(), "destination", 8 + i);
        }
        device.run(
            [&](vk::FrameGraph& graph)
            {
                for (gpu::uint i = 0; i < kCount; ++i)
                {
                    graph.fill(sources[i], 10 * round + i);
                    bound(graph, sources[i], destinations[i], 1);
                }
            });
        for (gpu::uint i = 0; i < kCount; ++i)
        {
            ASSERT_EQ(device.download(destinations[i]).back(), 10 * round + i + kBoundMark);
        }
    }
}

} // namespace
