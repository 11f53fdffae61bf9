// SPDX-License-Identifier: MIT
// Trees too large for the indices of kernels are refused.
#include "core/tree/tree_limits.h"

#include "core/tree/tree_data.h"
#include "support/engine_device.h"
#include "support/tree_samples.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace zvo
{
namespace
{

std::optional<ErrorCode> refusal(std::uint64_t nodes, std::uint64_t attributes)
{
    try
    {
        requireIndexable(nodes, attributes);
    }
    catch (const Error& error)
    {
        return error.code();
    }
    return std::nullopt;
}

TEST(TreeLimits, AreThoseOfSignedIndices)
{
    EXPECT_EQ(2 * kNodesMax, std::uint64_t{gpu::kLeafWords}) << "numbers of words have no flag";
    EXPECT_EQ(kIndicesMax - 1, std::uint64_t{INT32_MAX});
    EXPECT_EQ(refusal(0, 0), std::nullopt);
    EXPECT_EQ(refusal(kNodesMax, kIndicesMax), std::nullopt);
    EXPECT_EQ(refusal(kNodesMax + 1, 0), ErrorCode::Memory);
    EXPECT_EQ(refusal(1, kIndicesMax + 1), ErrorCode::Memory);
}

TEST(TreeLimits, HoldForTreesThatAreUploaded)
{
    for (const test::TreeSample& sample : test::treeSamples())
    {
        TreeData tree = sample.tree;
        tree.voxel_count = static_cast<std::uint32_t>(kIndicesMax + 1);
        if (!tree.hasAttributes())
        {
            EXPECT_NO_THROW((void)uploadTree(test::device(), tree))
                << sample.name << ": nothing is stored for its voxels";
            continue;
        }
        try
        {
            (void)uploadTree(test::device(), tree);
            ADD_FAILURE() << sample.name;
        }
        catch (const Error& error)
        {
            EXPECT_EQ(error.code(), ErrorCode::Memory);
            EXPECT_NE(std::string(error.what()).find("2147483649"), std::string::npos) << error.what();
        }
    }
}

} // namespace
} // namespace zvo
