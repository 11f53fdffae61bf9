// SPDX-License-Identifier: MIT
#include "support/sweep.h"

#include <gtest/gtest.h>

namespace zvo::test
{

void expectFramesSwept(const std::set<std::string>& failed, std::uint64_t error_count)
{
    const Sweep sweep;
    EXPECT_GT(error_count, sweep.share(500));
    EXPECT_GT(failed.size(), 5U);
    for (const char* function :
         {"vkAllocateMemory", "vkBeginCommandBuffer", "vkBindBufferMemory", "vkCreateBuffer",
          "vkCreateComputePipelines", "vkCreatePipelineLayout", "vkCreateShaderModule", "vkEndCommandBuffer",
          "vkGetQueryPoolResults", "vkQueueSubmit2", "vkResetCommandPool", "vkResetFences", "vkWaitForFences"})
    {
        EXPECT_TRUE(failed.contains(function) || !sweep.isFull()) << function;
    }
}

} // namespace zvo::test
