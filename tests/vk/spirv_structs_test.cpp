// SPDX-License-Identifier: MIT
#include "support/spirv_structs.h"

#include "vk/kernels.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>

namespace
{

using namespace zvo;

TEST(SpirvStructs, OffsetsAreThoseOfCpp)
{
    for (const vk::EmbeddedKernel& kernel : testKernels())
    {
        if (kernel.name != "test/layout")
        {
            continue;
        }
        const auto structs = test::structOffsets(kernel.words);
        const std::map<std::string, std::uint32_t> expected = {
            {"position", offsetof(gpu::Sample, position)}, {"id", offsetof(gpu::Sample, id)},
            {"pair", offsetof(gpu::Sample, pair)},         {"transform", offsetof(gpu::Sample, transform)},
            {"address", offsetof(gpu::Sample, address)},   {"list", offsetof(gpu::Sample, list)},
        };
        EXPECT_EQ(structs.at("Sample"), expected);
        EXPECT_EQ(structs.at("LayoutParams").at("tail"), offsetof(gpu::LayoutParams, tail));
        return;
    }
    FAIL() << "the kernel is missing";
}

TEST(SpirvStructs, WordsThatAreNotSpirvAreRefused)
{
    EXPECT_THROW(test::structOffsets({}), std::runtime_error);
}

} // namespace
