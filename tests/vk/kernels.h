// SPDX-License-Identifier: MIT
#pragma once

#include "kernels/test/params.h"
#include "support/device.h"
#include "vk/frame_graph.h"

#include <cstdint>
#include <numeric>
#include <vector>

namespace zvo
{

/// The kernels below tests/kernels.
std::span<const vk::EmbeddedKernel> testKernels();

} // namespace zvo

namespace zvo::test
{

inline vk::HeadlessDevice& device()
{
    return sharedDevice(testKernels());
}

using Words = vk::BufferOf<gpu::uint>;

inline constexpr std::uint64_t kMiB = 1 << 20;

/// 0, 1, 2 and so on.
inline std::vector<gpu::uint> counting(std::uint64_t count)
{
    std::vector<gpu::uint> values(count);
    std::iota(values.begin(), values.end(), 0U);
    return values;
}

/// Records the pass that sets values to 0, 1, 2 and so on.
inline void iota(vk::FrameGraph& graph, Words& values)
{
    vk::Pass pass = graph.addPass(gpu::test::Iota{});
    const gpu::FillParams params = {.values = pass.write(values), .count = static_cast<gpu::uint>(values.count())};
    pass.dispatch(values.count(), params);
}

/// Records the pass that sets destination to source times factor.
inline void scale(vk::FrameGraph& graph, const Words& source, Words& destination, gpu::uint factor)
{
    vk::Pass pass = graph.addPass(gpu::test::Scale{});
    const gpu::CopyParams params = {
        .source = pass.read(source),
        .destination = pass.write(destination),
        .count = static_cast<gpu::uint>(source.count()),
        .factor = factor,
    };
    pass.dispatch(source.count(), params);
}

} // namespace zvo::test
