// SPDX-License-Identifier: MIT
// Uploads and readbacks that are part of a frame.
#include "support/device.h"
#include "vk/deletion_queue.h"
#include "vk/kernels.h"
#include "vk/readback.h"
#include "vk/recorded_uploads.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <numeric>
#include <span>
#include <vector>

namespace zvo::vk
{

namespace
{

using test::device;

std::vector<gpu::uint> countedFrom(gpu::uint first, std::size_t count)
{
    std::vector<gpu::uint> values(count);
    std::iota(values.begin(), values.end(), first);
    return values;
}

TEST(RecordedUploads, ArriveWithTheFrameInTheirOrder)
{
    DeletionQueue deletion_queue;
    RecordedUploads uploads(device().device(), deletion_queue);
    const std::vector<gpu::uint> values = countedFrom(5, 1000);
    BufferOf<gpu::uint> buffer = uploads.makeBuffer("values", std::span(values));
    const std::vector<gpu::uint> others = countedFrom(7000, 10);
    uploads.upload(buffer, std::span(others), 990);
    BufferOf<gpu::uint> copy(device().device(), "copy", 1000);
    const std::uint64_t used = device().device().memory().usedBytes();
    deletion_queue.beginFrame(1);
    device().run(
        [&](FrameGraph& graph)
        {
            uploads.attach(&graph);
            uploads.perform(
                [&](FrameGraph& g, DeletionQueue& later)
                {
                    EXPECT_EQ(&later, &deletion_queue);
                    g.copy(buffer, 0, copy, 0, copy.bytes());
                });
            EXPECT_EQ(device().device().memory().usedBytes(), used); // staging memory stays until the frame is done
            uploads.attach(nullptr);
        });
    deletion_queue.frameDone(1);
    EXPECT_LE(device().device().memory().usedBytes(), used - 1010 * sizeof(gpu::uint));
    std::vector<gpu::uint> expected = values;
    std::copy(others.begin(), others.end(), expected.begin() + 990);
    EXPECT_EQ(device().download(copy), expected);
}

TEST(RecordedUploads, WhatIsDiscardedIsNotRecorded)
{
    DeletionQueue deletion_queue;
    RecordedUploads uploads(device().device(), deletion_queue);
    BufferOf<gpu::uint> kept = device().makeBuffer<gpu::uint>("kept", std::span<const gpu::uint>(countedFrom(1, 4)));
    const std::uint64_t used = device().device().memory().usedBytes();
    uploads.upload(kept, std::span<const gpu::uint>(countedFrom(100, 4)));
    {
        const BufferOf<gpu::uint> gone = uploads.makeBuffer("gone", std::span<const gpu::uint>(countedFrom(9, 4)));
        uploads.discard();
    }
    EXPECT_EQ(device().device().memory().usedBytes(), used);
    device().run(
        [&](FrameGraph& graph)
        {
            uploads.attach(&graph);
            uploads.flush();
            EXPECT_EQ(graph.passCount(), 0U);
            uploads.attach(nullptr);
        });
    EXPECT_EQ(device().download(kept), countedFrom(1, 4));
}

TEST(RecordedUploads, RefuseWhatDoesNotFit)
{
    DeletionQueue deletion_queue;
    RecordedUploads uploads(device().device(), deletion_queue);
    BufferOf<gpu::uint> buffer(device().device(), "small", 4);
    EXPECT_THROW(uploads.upload(buffer, std::span<const gpu::uint>(countedFrom(0, 4)), 1), Error);
    EXPECT_THROW(uploads.upload(buffer, std::span<const gpu::uint>(countedFrom(0, 1)), UINT64_MAX / 8), Error);
    uploads.upload(buffer, std::span<const gpu::uint>(), 4); // an empty upload at the end
}

TEST(Readback, HoldsPartsOfSeveralBuffers)
{
    const auto a = device().makeBuffer<gpu::uint>("a", std::span<const gpu::uint>(countedFrom(10, 5)));
    const auto b = device().makeBuffer<gpu::uint>("b", std::span<const gpu::uint>(countedFrom(20, 9)));
    Readback readback(device().device(), 64);
    for (int turn = 0; turn < 2; ++turn)
    {
        readback.clear();
        std::uint64_t of_a = 0;
        std::uint64_t of_b = 0;
        device().run(
            [&](FrameGraph& graph)
            {
                of_a = readback.copy(graph, a, 1, 3); // 12 bytes of 16
                of_b = readback.copy(graph, b, 2, 7);
                graph.releaseToHost();
            });
        const auto values_a = readback.at<gpu::uint>(of_a, 3);
        const auto values_b = readback.at<gpu::uint>(of_b, 7);
        EXPECT_EQ(std::vector(values_a.begin(), values_a.end()), countedFrom(11, 3));
        EXPECT_EQ(std::vector(values_b.begin(), values_b.end()), countedFrom(22, 7));
    }
    device().run([&](FrameGraph& graph)
                 { EXPECT_THROW(readback.copy(graph, b, 0, 9), Error) << "44 bytes are taken"; });
}

// The number of a frame that was lost may come again.
TEST(DeletionQueue, TellsWhichFramesAreDone)
{
    DeletionQueue deletion_queue;
    deletion_queue.beginFrame(0);
    EXPECT_FALSE(deletion_queue.isDone(0));
    deletion_queue.beginFrame(1);
    deletion_queue.frameDone(1);
    EXPECT_TRUE(deletion_queue.isDone(0));
    EXPECT_TRUE(deletion_queue.isDone(1));
    deletion_queue.beginFrame(1);
    EXPECT_TRUE(deletion_queue.isDone(0));
    EXPECT_FALSE(deletion_queue.isDone(1));
    deletion_queue.frameDone(UINT64_MAX);
    deletion_queue.beginFrame(2);
    EXPECT_FALSE(deletion_queue.isDone(2));
}

} // namespace

} // namespace zvo::vk
