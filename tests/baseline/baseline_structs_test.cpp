// SPDX-License-Identifier: MIT
// Structs that the kernels of the thesis and of Crassin and Green share with C++ have the same memory layout.
#include "baseline/baseline_kernels.h"
#include "baseline/crassin_green.h"
#include "baseline/thesis.h"
#include "support/spirv_structs.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace zvo
{
namespace
{

TEST(BaselineStructs, HaveTheSameOffsetsInEveryKernel)
{
    const std::map<std::string, std::map<std::string, std::uint32_t>> host = {
#include "baseline_struct_offsets.inc"
    };
    std::set<std::string> seen;
    for (const vk::EmbeddedKernel& kernel : baseline::allKernels())
    {
        for (const auto& [name, members] : test::structOffsets(kernel.words))
        {
            const auto found = host.find(name);
            if (found != host.end())
            {
                EXPECT_EQ(members, found->second) << name << " in " << kernel.name;
                seen.insert(name);
            }
        }
    }
    EXPECT_EQ(seen.size(), host.size()) << "some struct is in no kernel";
}

} // namespace
} // namespace zvo
