// SPDX-License-Identifier: MIT
#include "vk/kernels.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using namespace zvo;

std::span<const std::uint32_t> words(std::string_view name)
{
    for (const vk::EmbeddedKernel& kernel : testKernels())
    {
        if (kernel.name == name)
        {
            return kernel.words;
        }
    }
    ADD_FAILURE() << "no kernel " << name;
    return {};
}

TEST(ReflectKernel, ReadsLocalSizes)
{
    using Size = std::array<std::uint32_t, 3>;
    EXPECT_EQ(vk::reflectKernel(words("test/iota")).local_size, (Size{64, 1, 1}));
    EXPECT_EQ(vk::reflectKernel(words("test/layout")).local_size, (Size{4, 2, 3}));
    EXPECT_EQ(vk::reflectKernel(words("test/no_params")).local_size, (Size{8, 8, 1}));
}

TEST(ReflectKernel, ReadsWhichLocalSizesAreSpecialized)
{
    constexpr std::uint32_t kNot = vk::KernelInterface::kNotSpecialized;
    using Ids = std::array<std::uint32_t, 3>;
    EXPECT_EQ(vk::reflectKernel(words("test/specialized")).local_size_ids, (Ids{0, kNot, kNot}));
    EXPECT_EQ(vk::reflectKernel(words("test/iota")).local_size_ids, (Ids{kNot, kNot, kNot}));
}

TEST(ReflectKernel, PushConstantsAreAsLargeAsTheStructInCpp)
{
    EXPECT_EQ(vk::reflectKernel(words("test/iota")).push_constant_bytes, sizeof(gpu::FillParams));
    EXPECT_EQ(vk::reflectKernel(words("test/scale")).push_constant_bytes, sizeof(gpu::CopyParams));
    EXPECT_EQ(vk::reflectKernel(words("test/layout")).push_constant_bytes, sizeof(gpu::LayoutParams));
    EXPECT_EQ(vk::reflectKernel(words("test/no_params")).push_constant_bytes, 0u);
}

TEST(ReflectKernel, ReadsSpecializationConstants)
{
    const std::vector<vk::ModuleConstant> expected = {{0, "kLocalSizeX", vk::ConstantType::Uint, 1},
                                                      {1, "kValue", vk::ConstantType::Uint, 7},
                                                      {2, "kFlag", vk::ConstantType::Bool, 0}};
    EXPECT_EQ(vk::reflectKernel(words("test/specialized")).constants, expected);
    EXPECT_TRUE(vk::reflectKernel(words("test/iota")).constants.empty());
}

TEST(ReflectKernel, WordsThatAreNotSpirvAreRefused)
{
    EXPECT_THROW(vk::reflectKernel({}), Error);
    const std::vector<std::uint32_t> zeros(100);
    EXPECT_THROW(vk::reflectKernel(zeros), Error);
}

// Reads every prefix of a module, and the module with each of its words changed in turn.
void readDamaged(std::span<const std::uint32_t> good)
{
    for (std::size_t length = 0; length < good.size(); ++length)
    {
        try
        {
            vk::reflectKernel(good.first(length));
        }
        catch (const Error&)
        {
        }
    }
    std::vector<std::uint32_t> damaged(good.begin(), good.end());
    for (std::uint32_t& word : damaged)
    {
        for (const std::uint32_t value : {0u, ~0u, word ^ 1u, word + 0x10000u, 17u})
        {
            const std::uint32_t kept = std::exchange(word, value);
            try
            {
                vk::reflectKernel(damaged);
            }
            catch (const Error&)
            {
            }
            word = kept;
        }
    }
}

TEST(ReflectKernel, DamagedModulesAreRefusedOrReadButNeverCrash)
{
    readDamaged(words("test/layout"));
    readDamaged(std::ranges::find(testKernels(), "test/bound", &vk::EmbeddedKernel::name)->bound_words);
}

} // namespace
