// SPDX-License-Identifier: MIT
// Features that zvo adds to those of a host.
#include "vk/feature_structs.h"
#include "zvo/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::append;
using test::FeatureStructs;
using test::kRequiredFeatures;
using test::typed;

std::vector<const VkBaseInStructure*> chainOf(const VkDeviceCreateInfo& info)
{
    std::vector<const VkBaseInStructure*> chain;
    for (const auto* link = static_cast<const VkBaseInStructure*>(info.pNext); link != nullptr; link = link->pNext)
    {
        chain.push_back(link);
    }
    return chain;
}

/// The bytes of everything that patchFeatures could change.
std::string bytesOf(const VkDeviceCreateInfo& info, const FeatureStructs& structs)
{
    std::string bytes(sizeof(info) + sizeof(structs), '\0');
    std::memcpy(bytes.data(), &info, sizeof(info));
    std::memcpy(bytes.data() + sizeof(info), static_cast<const void*>(&structs), sizeof(structs));
    return bytes;
}

/// The features that a chain enables, of those that zvo may need, read independently.
std::set<std::string> featuresOf(const VkDeviceCreateInfo& info)
{
    std::set<std::string> names;
    const auto note = [&](VkBool32 enabled, const char* name)
    {
        if (enabled == VK_TRUE)
        {
            names.insert(name);
        }
    };
    if (info.pEnabledFeatures != nullptr)
    {
        note(info.pEnabledFeatures->shaderInt64, "shaderInt64");
    }
    for (const VkBaseInStructure* link : chainOf(info))
    {
        const auto as = [&]<typename Struct>(const Struct*) { return reinterpret_cast<const Struct*>(link); };
        static const FeatureStructs types;
        if (link->sType == types.core.sType)
        {
            note(as(&types.core)->features.shaderInt64, "shaderInt64");
        }
        else if (link->sType == types.vulkan12.sType)
        {
            note(as(&types.vulkan12)->bufferDeviceAddress, "bufferDeviceAddress");
            note(as(&types.vulkan12)->scalarBlockLayout, "scalarBlockLayout");
            note(as(&types.vulkan12)->hostQueryReset, "hostQueryReset");
            note(as(&types.vulkan12)->shaderBufferInt64Atomics, "shaderBufferInt64Atomics");
        }
        else if (link->sType == types.vulkan13.sType)
        {
            note(as(&types.vulkan13)->synchronization2, "synchronization2");
            note(as(&types.vulkan13)->maintenance4, "maintenance4");
            note(as(&types.vulkan13)->subgroupSizeControl, "subgroupSizeControl");
        }
        else
        {
            const std::map<VkStructureType, std::pair<VkBool32, const char*>> singles = {
                {types.address.sType, {as(&types.address)->bufferDeviceAddress, "bufferDeviceAddress"}},
                {types.scalar.sType, {as(&types.scalar)->scalarBlockLayout, "scalarBlockLayout"}},
                {types.query_reset.sType, {as(&types.query_reset)->hostQueryReset, "hostQueryReset"}},
                {types.synchronization2.sType, {as(&types.synchronization2)->synchronization2, "synchronization2"}},
                {types.maintenance4.sType, {as(&types.maintenance4)->maintenance4, "maintenance4"}},
                {types.subgroups.sType, {as(&types.subgroups)->subgroupSizeControl, "subgroupSizeControl"}},
                {types.atomics.sType, {as(&types.atomics)->shaderBufferInt64Atomics, "shaderBufferInt64Atomics"}},
            };
            const auto found = singles.find(link->sType);
            if (found != singles.end())
            {
                note(found->second.first, found->second.second);
            }
        }
    }
    return names;
}

/// Whether Vulkan allows the chain: VUID-VkDeviceCreateInfo-pNext-00373, -02829, -02830, -06532 and sType-unique, for
/// the structs of this test.
bool isLegal(const VkDeviceCreateInfo& info)
{
    static const FeatureStructs types;
    std::set<VkStructureType> present;
    for (const VkBaseInStructure* link : chainOf(info))
    {
        if (!present.insert(link->sType).second)
        {
            return false;
        }
    }
    const auto has = [&](VkStructureType type) { return present.count(type) != 0; };
    const bool singles12 = has(types.address.sType) || has(types.scalar.sType) || has(types.timeline.sType) ||
                           has(types.query_reset.sType) || has(types.atomics.sType);
    const bool singles13 = has(types.synchronization2.sType) || has(types.maintenance4.sType) ||
                           has(types.rendering.sType) || has(types.subgroups.sType);
    return !(info.pEnabledFeatures != nullptr && has(types.core.sType)) &&
           !(has(types.vulkan11.sType) && has(types.multiview.sType)) && !(has(types.vulkan12.sType) && singles12) &&
           !(has(types.vulkan13.sType) && singles13);
}

// A wrapper that makes the VkDeviceCreateInfo later gets what the host would have put into it.
TEST(PatchFeatures, AChainAndCoreFeaturesAreEnough)
{
    for (const bool has_core : {true, false})
    {
        FeatureStructs structs;
        structs.enabled.geometryShader = VK_TRUE;
        structs.vulkan13.dynamicRendering = VK_TRUE;
        const void* chain = &structs.vulkan13;
        FeatureStorage storage;
        patchFeatures(chain, storage, has_core ? &structs.enabled : nullptr, {.pass_times = true});
        VkDeviceCreateInfo info{};
        info.pNext = chain;
        info.pEnabledFeatures = has_core ? &structs.enabled : nullptr;
        EXPECT_TRUE(isLegal(info));
        std::set<std::string> expected = kRequiredFeatures;
        expected.insert("hostQueryReset");
        EXPECT_EQ(featuresOf(info), expected);
        EXPECT_EQ(structs.enabled.geometryShader, VkBool32{VK_TRUE});
        EXPECT_EQ(structs.vulkan13.dynamicRendering, VkBool32{VK_TRUE});
    }
}

/// Tests every subset of the structs that Vulkan allows.
TEST(PatchFeatures, EveryMixOfStructsIsCompleted)
{
    constexpr std::uint32_t kStructCount = 14;
    std::uint32_t legal_count = 0;
    for (std::uint32_t subset = 0; subset < 1u << kStructCount; ++subset)
    {
        FeatureStructs structs;
        VkDeviceCreateInfo info{};
        std::uint32_t bit = 0;
        const auto with = [&] { return (subset >> bit++ & 1u) != 0; };
        const auto maybe = [&](auto& structure)
        {
            if (with())
            {
                append(info, structure);
            }
        };
        structs.enabled.robustBufferAccess = VK_TRUE;
        structs.vulkan12.timelineSemaphore = VK_TRUE;
        structs.timeline.timelineSemaphore = VK_TRUE;
        if (with())
        {
            info.pEnabledFeatures = &structs.enabled;
        }
        maybe(structs.core);
        maybe(structs.vulkan11);
        maybe(structs.multiview);
        maybe(structs.address);
        maybe(structs.vulkan12);
        maybe(structs.private_data);
        maybe(structs.scalar);
        maybe(structs.timeline);
        maybe(structs.query_reset);
        maybe(structs.synchronization2);
        maybe(structs.vulkan13);
        maybe(structs.maintenance4);
        maybe(structs.rendering);
        ASSERT_EQ(bit, kStructCount);

        if (!isLegal(info))
        {
            continue;
        }
        ++legal_count;
        const std::vector<const VkBaseInStructure*> before = chainOf(info);
        FeatureStorage storage;
        patchFeatures(info, storage);
        ASSERT_TRUE(isLegal(info)) << subset;
        ASSERT_EQ(featuresOf(info), kRequiredFeatures) << subset;
        const std::vector<const VkBaseInStructure*> after = chainOf(info);
        ASSERT_GE(after.size(), before.size());
        ASSERT_TRUE(std::equal(before.rbegin(), before.rend(), after.rbegin())) << "the host's structs were moved";
        ASSERT_EQ(structs.enabled.shaderInt64, VK_FALSE) << "what pEnabledFeatures points to is the host's";
        ASSERT_TRUE(info.pEnabledFeatures == nullptr || info.pEnabledFeatures->robustBufferAccess == VK_TRUE);
        ASSERT_EQ(structs.vulkan12.timelineSemaphore, VK_TRUE);
        ASSERT_EQ(structs.vulkan12.drawIndirectCount, VK_FALSE);

        const std::string bytes_after = bytesOf(info, structs);
        patchFeatures(info, storage);
        FeatureStorage other;
        patchFeatures(info, other);
        ASSERT_EQ(chainOf(info), after) << "once more added more: " << subset;
        ASSERT_EQ(bytesOf(info, structs), bytes_after);
    }
    EXPECT_GT(legal_count, 100u);
}

TEST(PatchFeatures, WhatIsEnabledAlreadyMayBeConstant)
{
    static const VkPhysicalDeviceFeatures enabled = []
    {
        VkPhysicalDeviceFeatures features{};
        features.shaderInt64 = VK_TRUE;
        return features;
    }();
    VkDeviceCreateInfo info{};
    info.pEnabledFeatures = &enabled;
    FeatureStorage storage;
    patchFeatures(info, storage);
    EXPECT_EQ(info.pEnabledFeatures, &enabled);
    EXPECT_EQ(featuresOf(info), kRequiredFeatures);
}

TEST(PatchFeatures, OptionalFeaturesAreAddedWhereAsked)
{
    for (const bool whole : {false, true})
    {
        FeatureStructs structs;
        VkDeviceCreateInfo info{};
        if (whole)
        {
            append(info, structs.vulkan12);
            append(info, structs.vulkan13);
        }
        FeatureStorage storage;
        patchFeatures(info, storage, {true, false});
        std::set<std::string> expected = kRequiredFeatures;
        expected.insert("hostQueryReset");
        EXPECT_EQ(featuresOf(info), expected);
        patchFeatures(info, storage, {true, true});
        expected.insert("subgroupSizeControl");
        EXPECT_EQ(featuresOf(info), expected);
        patchFeatures(info, storage, {true, true, true});
        expected.insert("shaderBufferInt64Atomics");
        EXPECT_EQ(featuresOf(info), expected);
        EXPECT_TRUE(isLegal(info));
    }
}

} // namespace

} // namespace zvo
