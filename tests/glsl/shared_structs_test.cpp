// SPDX-License-Identifier: MIT
// Structs that C++ and GLSL share have the same memory layout.
#include "algebra/algebra.h"
#include "attributes/attributes.h"
#include "core/base/kernels.h"
#include "deform/deform.h"
#include "denoise/denoise.h"
#include "distance/distance.h"
#include "edit/compact.h"
#include "edit/edit.h"
#include "glsl/host_kernels.h"
#include "light/environment.h"
#include "light/light_tree.h"
#include "light/outside.h"
#include "octree/octree.h"
#include "path/path.h"
#include "present/present.h"
#include "query/query.h"
#include "radiance/cached_faces.h"
#include "radiance/radiance.h"
#include "shared/tree_table.h"
#include "support/spirv_structs.h"
#include "svdag/svdag.h"
#include "trace/beam.h"
#include "trace/light.h"
#include "trace/node_paths.h"
#include "trace/trace.h"
#include "update/update.h"
#include "voxelize/bricks.h"
#include "voxelize/voxelize.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

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

constexpr std::string_view kHostPrefix = "zvo_"; // prefix of names in hosts' shaders

// Compares the structs of the kernels with those of C++, and notes which were seen.
void expectHostOffsets(std::span<const vk::EmbeddedKernel> kernels, std::string_view prefix,
                       std::set<std::string>& seen)
{
    for (const vk::EmbeddedKernel& kernel : kernels)
    {
        for (const auto& [name, members] : test::structOffsets(kernel.words))
        {
            const auto host =
                name.starts_with(prefix) ? hostOffsets().find(name.substr(prefix.size())) : hostOffsets().end();
            if (host == hostOffsets().end()) // a struct of the kernel's own, or a buffer block around a shared one
            {
                continue;
            }
            EXPECT_EQ(members, host->second) << name << " in " << kernel.name;
            seen.insert(host->first);
        }
    }
}

TEST(SharedStructs, HaveTheSameOffsetsInEveryKernel)
{
    std::set<std::string> seen;
    expectHostOffsets(zvoKernels(), "", seen);
    expectHostOffsets(hostKernels(), kHostPrefix, seen);
    for (const auto& [name, members] : hostOffsets())
    {
        EXPECT_TRUE(seen.contains(name)) << name << " is in no kernel: take it out of the shared headers";
    }
    EXPECT_TRUE(seen.contains("TreeTable"));
}

} // namespace
} // namespace zvo
