// SPDX-License-Identifier: MIT
#include "vk/kernel_declaration.h"

#include "vk/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

/// The kernels that the headers below tests/kernels declare.
std::vector<vk::KernelDeclaration> testKernelDeclarations();

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

TEST(KernelDeclaration, ConstantsReachTheKernelByName)
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

TEST(KernelDeclaration, OfTheTestsAreThoseOfTheirModules)
{
    EXPECT_EQ(vk::differences(testKernelDeclarations(), testKernels()), std::vector<std::string>{});
}

// The differences reported after wrong has changed the declaration of a kernel.
template <typename Kernel, typename Wrong> std::vector<std::string> differencesOnceWrong(const Wrong& wrong)
{
    std::vector<vk::KernelDeclaration> declarations = testKernelDeclarations();
    wrong(*std::ranges::find(declarations, Kernel::kName, &vk::KernelDeclaration::name));
    return vk::differences(declarations, testKernels());
}

TEST(KernelDeclaration, WrongConstantsAreFound)
{
    using Lines = std::vector<std::string>;
    EXPECT_EQ(
        differencesOnceWrong<Specialized>([](auto& kernel) { std::swap(kernel.constants[1], kernel.constants[2]); }),
        (Lines{"test/specialized is declared with layout(constant_id = 1) bool kFlag = 0; its shader has "
               "layout(constant_id = 1) uint kValue = 7",
               "test/specialized is declared with layout(constant_id = 2) uint kValue = 7; its shader has "
               "layout(constant_id = 2) bool kFlag = 0"}));
    EXPECT_EQ(differencesOnceWrong<Specialized>([](auto& kernel) { kernel.constants.pop_back(); }),
              (Lines{"test/specialized is declared with no other constant; its shader has "
                     "layout(constant_id = 2) bool kFlag = 0"}));
    EXPECT_EQ(differencesOnceWrong<gpu::test::Iota>(
                  [](auto& kernel) {
                      kernel.constants = {{"x", true, false, 1}};
                  }),
              (Lines{"test/iota is declared with layout(constant_id = 0) bool kX = 1; its shader has "
                     "no other constant"}));
    EXPECT_EQ(differencesOnceWrong<Specialized>([](auto& kernel) { kernel.constants[1].name = "values"; }).size(), 1U);
    EXPECT_EQ(differencesOnceWrong<Specialized>([](auto& kernel) { kernel.constants[1].is_signed = true; }).size(), 1U);
    EXPECT_EQ(differencesOnceWrong<Specialized>([](auto& kernel) { kernel.constants[1].value = 8; }).size(), 1U);
}

TEST(KernelDeclaration, WrongParametersAreFound)
{
    const auto found = differencesOnceWrong<gpu::test::Scale>([](auto& kernel) { kernel.params_name = "FillParams"; });
    EXPECT_EQ(found, std::vector<std::string>{"test/scale is declared to take FillParams of 24 bytes; its shader takes "
                                              "CopyParams of 24"});
    EXPECT_EQ(differencesOnceWrong<gpu::test::Scale>([](auto& kernel) { kernel.params_bytes += 8; }).size(), 1U);
    EXPECT_EQ(differencesOnceWrong<gpu::test::NoParams>([](auto& kernel) { kernel.params_name = "P"; }).size(), 1U);
}

TEST(KernelDeclaration, KernelsWithoutModuleAndModulesWithoutDeclarationAreFound)
{
    EXPECT_EQ(differencesOnceWrong<gpu::test::Scale>([](auto& kernel) { kernel.name = "test/scales"; }),
              (std::vector<std::string>{"test/scales is declared, but no shader has that name",
                                        "test/scale has no declaration: put GPU_KERNEL beside its parameters"}));
    EXPECT_EQ(differencesOnceWrong<gpu::test::Race>([](auto& kernel) { kernel.name = "test/iota"; }).size(), 2U);
}

} // namespace
} // namespace zvo
