// SPDX-License-Identifier: MIT
// Devices whose host allocates device memory for zvo, or host memory for the driver, when allocations fail.
#include "support/errors.h"
#include "support/host_allocator.h"
#include "support/host_memory.h"
#include "vk/image.h"
#include "vk/kernels.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <set>
#include <string>

namespace
{

using namespace zvo;
using test::kMiB;
using test::messageOf;

/// Makes everything that zvo makes on a device: small and big buffers of each kind, an image, kernels; and runs these.
void work(test::HostDevice& host, vk::Device& device)
{
    constexpr std::uint32_t kCount = 3000;
    vk::BufferOf<gpu::uint> values(device, "values", kCount);
    vk::BufferOf<gpu::uint> upload(device, "upload", kCount, vk::MemoryKind::Upload);
    vk::BufferOf<gpu::uint> copies(device, "copies", 40 * kMiB / sizeof(gpu::uint));
    vk::BufferOf<gpu::uint> result(device, "result", kCount, vk::MemoryKind::Readback);
    vk::BufferOf<gpu::uint> scaled(device, "scaled", kCount, vk::MemoryKind::Readback);
    const vk::Image image(device, "image", 33, 17, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_STORAGE_BIT);
    for (std::uint32_t i = 0; i < kCount; ++i)
    {
        upload.mappedData()[i] = 7 * i;
    }
    const auto record = [&](VkCommandBuffer commands)
    {
        vk::FrameGraph graph(device, commands);
        test::iota(graph, values);
        graph.copy(upload, 0, copies, 20 * kMiB, upload.bytes());
        graph.copy(copies, 20 * kMiB, result, 0, result.bytes());
        test::scale(graph, values, scaled, 5);
        graph.releaseToHost();
    };
    // If recording fails, nothing is submitted.
    VkCommandBuffer commands = host.begin();
    record(commands);
    host.submit(commands);
    host.wait();
    for (std::uint32_t i = 0; i < kCount; ++i)
    {
        ASSERT_EQ(result.mappedData()[i], 7 * i);
        ASSERT_EQ(scaled.mappedData()[i], 5 * i);
    }
}

/// A host that allocates device memory for zvo.
struct MemoryHost
{
    explicit MemoryHost(std::uint64_t budget_bytes = UINT64_MAX)
    {
        test::HostOptions options;
        options.memory = memory.callbacks();
        options.memory_budget_bytes = budget_bytes;
        host.emplace(options);
        memory.attach(*host);
    }

    test::HostMemory memory;
    std::optional<test::HostDevice> host;
};

TEST(MemoryCallbacks, ServeBlocksAndBigBuffersAndGetThemBack)
{
    for (const std::uint64_t budget : {UINT64_MAX, std::uint64_t{200} << 20})
    {
        MemoryHost world(budget);
        {
            vk::Device device(world.host->ownerHandles(), testKernels());
            work(*world.host, device);
            work(*world.host, device);
            const vk::Buffer big(device, "a big buffer", 70 * kMiB + 4);
            const vk::Buffer small(device, "a small buffer", 100);
            const std::vector<std::string> names = world.memory.liveNames();
            EXPECT_EQ(std::count(names.begin(), names.end(), "a big buffer"), 1);
            EXPECT_EQ(std::count(names.begin(), names.end(), "a small buffer"), 0) << "small ones share a block";
            EXPECT_EQ(device.memory().heldBytes(), world.memory.liveBytes());
        }
        EXPECT_EQ(world.memory.liveCount(), 0u);
    }
}

TEST(MemoryCallbacks, AreCountedAgainstTheBudget)
{
    MemoryHost world(10 * kMiB);
    vk::Device device(world.host->ownerHandles(), testKernels());
    const vk::Buffer most(device, "most", 9 * kMiB);
    const std::uint64_t requests = world.memory.requestCount();
    messageOf([&] { const vk::Buffer more(device, "more", 2 * kMiB); }, ErrorCode::Memory);
    EXPECT_EQ(world.memory.requestCount(), requests) << "what the budget refuses, the host is not asked for";
    EXPECT_LE(world.memory.liveBytes(), 10 * kMiB);
}

TEST(MemoryCallbacks, WhatIsTooMuchWithWholeGranulesIsOverTheBudget)
{
    constexpr std::uint64_t kBytes = 40 * kMiB + 4; // requests to hosts are for whole granules of more than 4 bytes
    MemoryHost world(kBytes);
    vk::Device device(world.host->ownerHandles(), testKernels());
    const std::string message = messageOf([&] { const vk::Buffer most(device, "most", kBytes); }, ErrorCode::Memory);
    EXPECT_NE(message.find("but the limit is"), std::string::npos) << message;
    EXPECT_EQ(message.find("close other programs"), std::string::npos) << message;
}

TEST(MemoryCallbacks, RangesInABlockAreAlignedAsAddressesAre)
{
    MemoryHost world;
    vk::Device device(world.host->ownerHandles(), testKernels());
    std::vector<vk::Buffer> buffers;
    for (std::uint64_t bytes : {4u, 20u, 4096u, 12u})
    {
        const vk::Buffer& buffer = buffers.emplace_back(device, "buffer", bytes, vk::MemoryKind::Upload);
        EXPECT_EQ(buffer.address() % 16, 0u);
        std::fill_n(static_cast<std::uint8_t*>(buffer.mapped()), bytes, std::uint8_t{1});
    }
    vk::MemoryAllocator& memory = device.memory();
    const VkMemoryRequirements requirements{1000, 1 << 16, ~0u};
    const vk::MemoryBlock block = memory.allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, "aligned");
    EXPECT_NE(block.offset, 0u);
    EXPECT_EQ(block.offset % requirements.alignment, 0u) << "of the VkDeviceMemory, not of the block";
    memory.release(block);
}

TEST(MemoryCallbacks, AShortHostGetsSmallerBlocks)
{
    MemoryHost world;
    world.memory.setLargest(kMiB);
    vk::Device device(world.host->ownerHandles(), testKernels());
    const vk::Buffer a(device, "a", 1000);
    const vk::Buffer b(device, "b", 1000);
    EXPECT_NE(a.address(), b.address());
    EXPECT_LE(world.memory.liveBytes(), kMiB);
    const std::string message = messageOf([&] { const vk::Buffer c(device, "c", 2 * kMiB); }, ErrorCode::Memory);
    EXPECT_NE(message.find("for c"), std::string::npos) << message;
}

TEST(MemoryCallbacks, EveryRequestMayFail)
{
    // If one request fails, a smaller block or another memory type may do. If all later ones fail, nothing does.
    for (const std::uint64_t count : {std::uint64_t{1}, UINT64_MAX})
    {
        MemoryHost world;
        std::uint64_t failures = 0;
        bool failed = true;
        for (std::uint64_t number = 0; failed; ++number)
        {
            vk::Device device(world.host->ownerHandles(), testKernels()); // it has no blocks yet
            world.memory.failRequests(number, count,
                                      number % 2 == 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_OUT_OF_HOST_MEMORY);
            bool thrown = false;
            try
            {
                work(*world.host, device);
            }
            catch (const Error& error)
            {
                EXPECT_EQ(error.code(), ErrorCode::Memory) << error.what();
                thrown = true;
                ++failures;
            }
            failed = world.memory.requestCount() > number;
            // On devices with memory of their own, later requests may do with other blocks that there are.
            const bool must_throw = number == 0 || device.report().type == "cpu" ? failed : thrown;
            EXPECT_TRUE(count == 1 || thrown == must_throw);
            EXPECT_TRUE(failed || !thrown);
            EXPECT_EQ(device.memory().usedBytes(), 0u);
            EXPECT_EQ(device.memory().heldBytes(), world.memory.liveBytes());
            world.memory.failRequests(UINT64_MAX);
            work(*world.host, device);
        }
        EXPECT_EQ(world.memory.liveCount(), 0u);
        EXPECT_TRUE(count == 1 || failures > 1);
    }
}

TEST(MemoryCallbacks, AFailureOfAnotherKindIsNamed)
{
    MemoryHost world;
    vk::Device device(world.host->ownerHandles(), testKernels());
    world.memory.failRequests(0, 1, VK_ERROR_UNKNOWN);
    const std::string message = messageOf([&] { const vk::Buffer a(device, "a", 100); }, ErrorCode::Other);
    EXPECT_NE(message.find("MemoryCallbacks::allocate failed with VK_ERROR_UNKNOWN"), std::string::npos) << message;
    EXPECT_EQ(device.memory().usedBytes(), 0u);
    EXPECT_EQ(device.memory().heldBytes(), 0u);
}

TEST(MemoryCallbacks, WhatCannotBeIsRefusedAndReturned)
{
    const std::pair<void (*)(MemoryRange&), const char*> faults[] = {
        {[](MemoryRange& range) { ++range.offset; }, "an offset of"},
        {[](MemoryRange& range) { range.mapped = nullptr; }, "not mapped"},
    };
    for (const auto& fault : faults)
    {
        MemoryHost world;
        vk::Device device(world.host->ownerHandles(), testKernels());
        world.memory.setSpoiler(fault.first);
        for (const std::uint64_t bytes : {100ull, 100ull << 20})
        {
            const std::string message =
                messageOf([&] { const vk::Buffer a(device, "a", bytes, vk::MemoryKind::Upload); }, ErrorCode::Usage);
            EXPECT_NE(message.find(fault.second), std::string::npos) << message;
            EXPECT_EQ(world.memory.liveCount(), 0u);
            EXPECT_EQ(device.memory().heldBytes(), 0u);
        }
        world.memory.setSpoiler(nullptr);
        work(*world.host, device);
    }
}

TEST(MemoryCallbacks, NeedBothFunctions)
{
    MemoryHost world;
    vk::DeviceHandles handles = world.host->ownerHandles();
    handles.memory.release = nullptr;
    const std::string message = messageOf([&] { const vk::Device device(handles, testKernels()); }, ErrorCode::Usage);
    EXPECT_NE(message.find("release"), std::string::npos) << message;
}

/// Makes everything that zvo makes on a device, and runs nothing.
void create(vk::Device& device)
{
    const vk::Buffer small(device, "small", 1000);
    const vk::Buffer big(device, "big", 40 * kMiB);
    const vk::Buffer upload(device, "upload", 1000, vk::MemoryKind::Upload);
    const vk::Image image(device, "image", 33, 17, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_STORAGE_BIT);
    const vk::TimerPool timers(device, 16);
    device.kernels().get("test/iota");
    device.kernels().get("test/scale");
}

/// A host with an allocator for the driver's host memory, which only zvo's objects use. lavapipe (Mesa 22.3.6) does not
/// support one in vkCreateDevice: vkCreatePipelineLayout, which uses the device's allocator, crashes when that fails,
/// and vkQueueSubmit frees memory that was not allocated by it (of pipelines, which vkDestroyPipeline leaves to the
/// next submission).
struct AllocatorHost
{
    AllocatorHost()
    {
        test::HostOptions options;
        options.optional.pass_times = true;
        options.allocation_callbacks = allocator.callbacks();
        host.emplace(options);
    }

    test::HostAllocator allocator;
    std::optional<test::HostDevice> host;
};

TEST(AllocationCallbacks, AreUsedForEverythingAndGetEverythingBack)
{
    AllocatorHost world;
    {
        vk::Device device(world.host->ownerHandles(), testKernels());
        create(device);
        EXPECT_GT(world.allocator.callCount(), 5u);
        work(*world.host, device);
        vk::CommandContext commands(device, world.host->queue());
        commands.begin();
        commands.submit();
        commands.wait();
    }
    EXPECT_EQ(world.allocator.liveCount(), 0u);
}

TEST(AllocationCallbacks, EveryAllocationMayFail)
{
    AllocatorHost world;
    std::set<std::string> failures; // functions that reported failures
    bool failed = true;
    for (std::uint64_t number = 0; failed; ++number)
    {
        {
            world.allocator.failCall(number);
            std::optional<vk::Device> device;
            try
            {
                device.emplace(world.host->ownerHandles(), testKernels());
                create(*device);
                const vk::CommandContext commands(*device, world.host->queue());
            }
            catch (const Error& error)
            {
                EXPECT_EQ(error.code(), ErrorCode::Memory) << number << ": " << error.what();
                const std::string message = error.what();
                failures.insert(message.substr(0, message.find(' ')));
            }
            failed = world.allocator.hasFailed();
            world.allocator.failCall(UINT64_MAX);
            ASSERT_TRUE(device.has_value());
            EXPECT_EQ(device->memory().usedBytes(), 0u);
            create(*device);
            work(*world.host, *device);
        }
        EXPECT_EQ(world.allocator.liveCount(), 0u) << "of allocation " << number;
    }
    for (const char* call : {"vkCreateBuffer", "vkCreateCommandPool", "vkCreateFence", "vkCreateImage",
                             "vkCreateImageView", "vkCreateQueryPool", "vkCreateShaderModule"})
    {
        EXPECT_EQ(failures.count(call), 1u) << call << " takes no memory of the host's, or its failure goes unseen";
    }
}

} // namespace
