// SPDX-License-Identifier: MIT
#pragma once

#include "support/host_device.h"
#include "vk/kernels.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace zvo::test
{

/// Runs kernels with 64-bit addresses and scalar layout on target, in a host's command buffer.
inline void expectThatItWorks(HostDevice& host, vk::Device& target)
{
    constexpr std::uint32_t kCount = 1000;
    const vk::BufferOf<gpu::uint> result(target, "result", kCount, vk::MemoryKind::Readback);
    vk::BufferOf<gpu::uint> values(target, "values", kCount);
    vk::BufferOf<gpu::uint> copies(target, "copies", kCount);
    host.run(
        [&](VkCommandBuffer commands)
        {
            vk::FrameGraph graph(target, commands);
            iota(graph, values);
            scale(graph, values, copies, 3);
            graph.copy(copies, 0, const_cast<vk::BufferOf<gpu::uint>&>(result), 0, copies.bytes());
            graph.releaseToHost();
        });
    for (std::uint32_t i = 0; i < kCount; ++i)
    {
        ASSERT_EQ(result.mappedData()[i], 3 * i);
    }
}

} // namespace zvo::test
