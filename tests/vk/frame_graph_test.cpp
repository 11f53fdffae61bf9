// SPDX-License-Identifier: MIT
#include "vk/kernels.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <numeric>

namespace
{

using namespace zvo;
using test::device;
using test::iota;
using test::scale;
using test::Words;

TEST(FoldGroups, CoversAllGroupsWithLittleWaste)
{
    using Groups = std::array<std::uint64_t, 2>;
    EXPECT_EQ(vk::foldGroups(0, 65535), (Groups{0, 1}));
    EXPECT_EQ(vk::foldGroups(1, 65535), (Groups{1, 1}));
    EXPECT_EQ(vk::foldGroups(65535, 65535), (Groups{65535, 1}));
    EXPECT_EQ(vk::foldGroups(65536, 65535), (Groups{32768, 2}));
    for (std::uint64_t groups = 1; groups < 1000; ++groups)
    {
        const auto [x, y] = vk::foldGroups(groups, 7);
        EXPECT_LE(x, 7u);
        EXPECT_GE(x * y, groups);
        EXPECT_LT(x * y, groups + y);
    }
}

TEST(FrameGraph, PassesSeeWhatEarlierPassesWrote)
{
    Words a(device().device(), "a", 2049);
    Words b(device().device(), "b", 2049);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            iota(graph, a);
            scale(graph, a, b, 3);
            scale(graph, b, a, 5);
            graph.copy(a, 0, b, 4, 2048 * 4);
            graph.fill(b, 7, 0, 1);
        });
    const std::vector<gpu::uint> values = device().download(b);
    EXPECT_EQ(values[0], 7u);
    for (gpu::uint i = 1; i < values.size(); ++i)
    {
        ASSERT_EQ(values[i], (i - 1) * 15);
    }
}

TEST(FrameGraph, IndirectDispatchRunsAsManyGroupsAsAPassWrote)
{
    Words values(device().device(), "values", 1000);
    vk::BufferOf<gpu::DispatchArgs> args(device().device(), "args", 1);
    for (const gpu::uint groups : {0u, 1u, 3u})
    {
        device().run(
            [&](vk::FrameGraph& graph)
            {
                graph.fill(values, 0);
                vk::Pass size = graph.addPass(gpu::test::WriteArgs{});
                const gpu::WriteArgsParams size_params = {.args = size.write(args), .groups = groups};
                size.dispatch(1, size_params);
                vk::Pass pass = graph.addPass(gpu::test::Iota{});
                const gpu::FillParams params = {.values = pass.write(values), .count = 1000};
                pass.dispatchIndirect(args, 0, params);
            });
        const std::vector<gpu::uint> result = device().download(values);
        for (gpu::uint i = 0; i < result.size(); ++i)
        {
            ASSERT_EQ(result[i], i < groups * 64 ? i : 0) << groups;
        }
    }
}

TEST(FrameGraph, DumpShowsPassesResourcesAndBarriers)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.slices.submission_ms = 0; // one submission, even on a slow device
    vk::HeadlessDevice whole(options, testKernels());
    Words a(whole.device(), "a", 100);
    Words b(whole.device(), "b", 100);
    Words empty(whole.device(), "empty", 0);
    vk::BufferOf<gpu::DispatchArgs> args(whole.device(), "args", 2);
    std::string dump;
    whole.run(
        [&](vk::FrameGraph& graph)
        {
            graph.fill(args, 1);
            iota(graph, a);
            scale(graph, a, b, 2);
            iota(graph, empty);
            vk::Pass pass = graph.addPass(gpu::test::Iota{});
            const gpu::FillParams params = {.values = pass.readWrite(a), .count = 64};
            pass.dispatchIndirect(args, 1, params);
            graph.copy(a, 0, b, 0, 8);
            graph.releaseToHost();
            dump = graph.dump();
        });
    EXPECT_EQ(dump, "pass fill args: 24 bytes; copies to args\n"
                    "pass test/iota: 100 threads in 2 x 1 groups of 64; writes a\n"
                    "barrier compute -> compute\n"
                    "pass test/scale: 100 threads in 4 x 1 groups of 32; reads a; writes b\n"
                    "pass test/iota: 0 threads, left out\n"
                    "barrier compute|transfer -> compute|indirect\n"
                    "pass test/iota: indirect; reads and writes a; dispatched by args\n"
                    "barrier compute -> transfer\n"
                    "pass copy a to b: 8 bytes; copies from a; copies to b\n"
                    "barrier compute|transfer -> host\n");
}

TEST(FrameGraph, APassWithoutDispatchRecordsNothing)
{
    Words a(device().device(), "a", 100);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            graph.addPass(gpu::test::Iota{}).write(a);
            EXPECT_EQ(graph.dump(), "");
        });
}

TEST(FrameGraph, ParametersOfAnotherSizeAreRefused)
{
    Words a(device().device(), "a", 100);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass("test/iota");
            pass.write(a);
            EXPECT_THROW(pass.dispatch(1, gpu::CopyParams{}), Error);
            EXPECT_THROW(graph.addPass("test/no_params").dispatch(1, 1u), Error);
        });
}

TEST(FrameGraph, APassIsDispatchedOnce)
{
    Words a(device().device(), "a", 100);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::Pass pass = graph.addPass(gpu::test::Iota{});
            const gpu::FillParams params = {.values = pass.write(a), .count = 100};
            pass.dispatch(100, params);
            EXPECT_THROW(pass.dispatch(100, params), Error);
            EXPECT_THROW(pass.read(a), Error);
        });
}

TEST(FrameGraph, RangesOutsideABufferAreRefused)
{
    Words a(device().device(), "a", 100);
    Words b(device().device(), "b", 10);
    vk::BufferOf<gpu::DispatchArgs> args(device().device(), "args", 1);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            EXPECT_THROW(graph.copy(a, 0, b, 0, 41), Error);
            EXPECT_THROW(graph.copy(a, UINT64_MAX - 1, b, 0, 4), Error);
            EXPECT_THROW(graph.copy(a, 0, a, 10, 20), Error) << "it overlaps itself";
            EXPECT_THROW(graph.fill(b, 0, 8, 3), Error);
            EXPECT_THROW(graph.fill(b, 0, 11), Error);
            vk::Pass pass = graph.addPass(gpu::test::Iota{});
            const gpu::FillParams params = {.values = pass.write(a), .count = 100};
            EXPECT_THROW(pass.dispatchIndirect(args, 1, params), Error);
            EXPECT_THROW(graph.addPass(gpu::test::Iota{}).dispatch(std::uint64_t{1} << 33, params), Error);
        });
}

TEST(FrameGraph, UpdatesWriteWhatTheHostHadWhenTheyWereRecorded)
{
    for (const std::uint64_t count : {1, 27, 64, 2049, 16384, 16385, 231917})
    {
        Words a(device().device(), "a", count + 2);
        Words b(device().device(), "b", count + 2);
        std::vector<gpu::uint> values(count);
        for (std::size_t i = 0; i < count; ++i)
        {
            values[i] = static_cast<gpu::uint>(i * 2654435761u);
        }
        const std::vector<gpu::uint> expected = values;
        device().run(
            [&](vk::FrameGraph& graph)
            {
                graph.fill(a, 7);
                graph.update(a, 1, values);
                std::fill(values.begin(), values.end(), 0);
                scale(graph, a, b, 3);
                graph.update(a, 0, std::span<const gpu::uint>());
            });
        const std::vector<gpu::uint> written = device().download(a);
        const std::vector<gpu::uint> seen = device().download(b);
        ASSERT_EQ(written.front(), 7u) << count;
        ASSERT_EQ(written.back(), 7u) << count;
        for (std::size_t i = 0; i < count; ++i)
        {
            ASSERT_EQ(written[i + 1], expected[i]) << count << " " << i;
            ASSERT_EQ(seen[i + 1], 3 * expected[i]) << count << " " << i;
        }
    }
}

TEST(FrameGraph, UpdatesAreTransferWritesToHazards)
{
    Words a(device().device(), "a", 100);
    Words b(device().device(), "b", 100);
    const std::vector<gpu::uint> values(64, 5);
    std::string dump;
    device().run(
        [&](vk::FrameGraph& graph)
        {
            iota(graph, a);
            graph.update(a, 2, values);
            graph.update(b, 40, std::as_bytes(std::span(values)));
            scale(graph, a, b, 2);
            dump = graph.dump();
        });
    EXPECT_EQ(dump, "pass test/iota: 100 threads in 2 x 1 groups of 64; writes a\n"
                    "barrier compute -> transfer\n"
                    "pass update a: 256 bytes; copies to a\n"
                    "pass update b: 256 bytes; copies to b\n"
                    "barrier transfer -> compute\n"
                    "pass test/scale: 100 threads in 4 x 1 groups of 32; reads a; writes b\n");
}

TEST(FrameGraph, UpdatesSpreadOverSubmissions)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.slices.most_units = 2;
    vk::HeadlessDevice sliced(options, testKernels());
    std::vector<gpu::uint> values(5 * 16384 - 1); // pieces of 64 KiB
    std::iota(values.begin(), values.end(), 1U);
    Words a(sliced.device(), "a", values.size() + 1);
    sliced.run([&](vk::FrameGraph& graph) { graph.update(a, 1, values); });
    EXPECT_EQ(sliced.submissionCount(), 3u);
    EXPECT_EQ(sliced.download(a, 1), values);
}

TEST(FrameGraph, UpdatesOutsideABufferOrOfPartsOfWordsAreRefused)
{
    Words a(device().device(), "a", 100);
    const std::vector<gpu::uint> values(10, 5);
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    device().run(
        [&](vk::FrameGraph& graph)
        {
            EXPECT_THROW(graph.update(a, 91, values), Error);
            EXPECT_THROW(graph.update(a, UINT64_MAX - 3, bytes), Error);
            EXPECT_THROW(graph.update(a, 2, bytes), Error);
            EXPECT_THROW(graph.update(a, 4, bytes.first(6)), Error);
            EXPECT_EQ(graph.dump(), "");
        });
}

TEST(FrameGraph, CommandsOfTheCallersOwnAreAPassAmongOthers)
{
    Words a(device().device(), "a", 100);
    Words b(device().device(), "b", 100);
    std::string dump;
    const std::vector<vk::PassTime> passes = device().run(
        [&](vk::FrameGraph& graph)
        {
            iota(graph, a);
            graph.record("own copy", {vk::CopyUse::read(a), vk::CopyUse::write(b)},
                         [&](VkCommandBuffer commands)
                         {
                             const VkBufferCopy region = {0, 0, a.bytes()};
                             device().device().fn().vkCmdCopyBuffer(commands, a.handle(), b.handle(), 1, &region);
                         });
            scale(graph, b, a, 2);
            dump = graph.dump();
        });
    EXPECT_EQ(dump, "pass test/iota: 100 threads in 2 x 1 groups of 64; writes a\n"
                    "barrier compute -> transfer\n"
                    "pass own copy: commands; copies from a; copies to b\n"
                    "barrier transfer -> compute\n"
                    "pass test/scale: 100 threads in 4 x 1 groups of 32; reads b; writes a\n");
    ASSERT_EQ(passes.size(), 3U);
    EXPECT_EQ(passes[1].name, "own copy");
    EXPECT_EQ(device().download(a).at(99), 198U);
}

TEST(FrameGraph, CopiesWithinOneBufferWork)
{
    Words a(device().device(), "a", 100);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            iota(graph, a);
            graph.copy(a, 0, a, 200, 200);
        });
    const std::vector<gpu::uint> values = device().download(a);
    for (gpu::uint i = 0; i < 100; ++i)
    {
        ASSERT_EQ(values[i], i % 50);
    }
}

} // namespace
