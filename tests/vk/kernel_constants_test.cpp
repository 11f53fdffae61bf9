// SPDX-License-Identifier: MIT
#include "vk/kernels.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace zvo
{

namespace
{

using gpu::test::Specialized;

// Concepts that tell which declarations compile.
template <typename Value>
concept ValueTakes = requires(Value value)
{
    Specialized{.value = value};
};
template <typename Value>
concept FlagTakes = requires(Value value)
{
    Specialized{.flag = value};
};
template <typename Kernel>
concept HasMisspeltConstant = requires
{
    Kernel{.valeu = 1U};
};
template <typename Kernel>
concept HasFourConstants = requires
{
    Kernel{1U, 2U, false, 4U};
};
template <typename Params>
concept ScaleTakes = requires(vk::Pass<gpu::test::Scale>& pass, const Params& params)
{
    pass.dispatch(1, params);
};

struct AsLargeAsCopyParams
{
    gpu::ConstPtr<gpu::uint> source;
    gpu::Ptr<gpu::uint> destination;
    gpu::uint count;
    gpu::uint factor;
};

static_assert(ValueTakes<std::uint32_t> && !ValueTakes<bool> && !ValueTakes<int> && !ValueTakes<float>);
static_assert(FlagTakes<bool> && !FlagTakes<std::uint32_t> && !FlagTakes<int>);
static_assert(!HasMisspeltConstant<Specialized> && !HasFourConstants<Specialized>);
static_assert(sizeof(AsLargeAsCopyParams) == sizeof(gpu::CopyParams));
static_assert(ScaleTakes<gpu::CopyParams> && !ScaleTakes<AsLargeAsCopyParams> && !ScaleTakes<gpu::FillParams>);

TEST(KernelConstants, ReachTheKernelByName)
{
    vk::HeadlessDevice& device = test::device();
    const auto run = [&](const Specialized& kernel)
    {
        test::Words values(device.device(), "values", 100);
        device.run(
            [&](vk::FrameGraph& graph)
            {
                vk::Pass pass = graph.addPass(kernel);
                pass.dispatch(100, {.values = pass.write(values), .count = 100});
            });
        return device.download(values);
    };
    EXPECT_EQ(run({.local_size_x = 16U, .value = 5U, .flag = true}), std::vector<gpu::uint>(100, 16051));
    EXPECT_EQ(run({.flag = true}), std::vector<gpu::uint>(100, 1071)) << "the others keep their default values";
}

} // namespace

} // namespace zvo
