// SPDX-License-Identifier: MIT
#include "vk/buffer.h"

#include "support/errors.h"
#include "vk/image.h"
#include "vk/kernels.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

namespace
{

using namespace zvo;
using test::device;

TEST(Buffer, AnEmptyBufferHasNoMemory)
{
    const vk::BufferOf<std::uint32_t> empty(device().device(), "empty", 0);
    EXPECT_EQ(empty.handle(), VkBuffer{});
    EXPECT_EQ(empty.address(), 0u);
    EXPECT_EQ(empty.count(), 0u);
    EXPECT_TRUE(device().download(empty).empty());
}

TEST(Buffer, DestructionReturnsTheMemory)
{
    const std::uint64_t before = device().device().memory().usedBytes();
    {
        const vk::Buffer buffer(device().device(), "short-lived", 1000);
        EXPECT_GE(device().device().memory().usedBytes(), before + 1000);
        EXPECT_NE(buffer.address(), 0u);
        EXPECT_EQ(buffer.address() % 16, 0u);
    }
    EXPECT_EQ(device().device().memory().usedBytes(), before);
}

TEST(Buffer, MovingLeavesAnEmptyBufferBehind)
{
    const std::uint64_t before = device().device().memory().usedBytes();
    {
        vk::Buffer a(device().device(), "a", 1000);
        vk::Buffer b(device().device(), "b", 2000);
        const VkBuffer handle = a.handle();
        b = std::move(a);
        EXPECT_EQ(b.handle(), handle);
        EXPECT_EQ(b.name(), "a");
        EXPECT_EQ(b.bytes(), 1000u);
        EXPECT_EQ(a.handle(), VkBuffer{}); // NOLINT: what is left behind is the point
        EXPECT_EQ(a.bytes(), 0u);
        const vk::Buffer c(std::move(b));
        EXPECT_EQ(c.handle(), handle);
    }
    EXPECT_EQ(device().device().memory().usedBytes(), before);
}

TEST(Buffer, OnlyHostBuffersAreMapped)
{
    const vk::Buffer on_device(device().device(), "device", 64);
    const vk::Buffer upload(device().device(), "upload", 64, vk::MemoryKind::Upload);
    const vk::Buffer readback(device().device(), "readback", 64, vk::MemoryKind::Readback);
    EXPECT_EQ(on_device.mapped(), nullptr);
    EXPECT_NE(upload.mapped(), nullptr);
    EXPECT_NE(readback.mapped(), nullptr);
}

TEST(Buffer, MoreThanTheBudgetIsAMemoryErrorThatNamesTheBuffer)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.memory_budget_bytes = 32 << 20; // staging buffers take a few MiB
    options.overrides.buffer_slack = 0;     // bytes
    vk::HeadlessDevice small(options, testKernels());
    const vk::Buffer half(small.device(), "half", 16 << 20);
    const auto takeAll = [&] { const vk::Buffer whole(small.device(), "whole", 32 << 20); };
    test::expectParts(test::messageOf(takeAll, ErrorCode::Memory), {"whole", "raise the limit, or"});
    const vk::Buffer rest(small.device(), "rest", 8 << 20);
}

TEST(Buffer, MoreThanABufferCanHoldIsAMemoryError)
{
    test::messageOf([] { const vk::Buffer buffer(device().device(), "endless", UINT64_MAX / 2); }, ErrorCode::Memory);
}

TEST(Image, HasAViewAndReturnsItsMemory)
{
    const std::uint64_t before = device().device().memory().usedBytes();
    {
        vk::Image image(device().device(), "picture", 17, 5, VK_FORMAT_R8G8B8A8_UNORM,
                        VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
        EXPECT_NE(image.view(), VkImageView{});
        EXPECT_EQ(image.width(), 17u);
        EXPECT_EQ(image.height(), 5u);
        const vk::Image moved = std::move(image);
        EXPECT_EQ(moved.name(), "picture");
        EXPECT_GT(device().device().memory().usedBytes(), before);
    }
    EXPECT_EQ(device().device().memory().usedBytes(), before);
}

} // namespace
