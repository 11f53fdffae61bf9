// SPDX-License-Identifier: MIT
// Structs that C++ and GLSL share lie in memory alike.
#include "attributes/attributes.h"
#include "core/kernels.h"
#include "deform/deform.h"
#include "edit/compact.h"
#include "edit/edit.h"
#include "octree/octree.h"
#include "present/present.h"
#include "support/spirv_structs.h"
#include "svdag/svdag.h"
#include "trace/trace.h"
#include "update/update.h"
#include "voxelize/voxelize.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace zvo
{
namespace
{

using Offsets = std::map<std::string, std::uint32_t>;

const std::map<std::string, Offsets>& hostOffsets()
{
    static const std::map<std::string, Offsets> offsets = {
#include "shared_struct_offsets.inc"
    };
    return offsets;
}

TEST(SharedStructs, HaveTheSameOffsetsInEveryKernel)
{
    std::set<std::string> seen;
    for (const vk::EmbeddedKernel& kernel : zvoKernels())
    {
        for (const auto& [name, members] : test::structOffsets(kernel.words))
        {
            const auto host = hostOffsets().find(name);
            if (host == hostOffsets().end()) // the kernel's own, or a buffer block around a shared one
            {
                continue;
            }
            EXPECT_EQ(members, host->second) << name << " in " << kernel.name;
            seen.insert(name);
        }
    }
    for (const auto& [name, members] : hostOffsets())
    {
        EXPECT_TRUE(seen.contains(name)) << name << " is in no kernel: take it out of the shared headers";
    }
}

} // namespace
} // namespace zvo
