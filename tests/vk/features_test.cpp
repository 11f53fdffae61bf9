// SPDX-License-Identifier: MIT
// Features that zvo adds to those of a host, and messages about features that are not enabled.
#include "support/errors.h"
#include "support/host_device.h"
#include "vk/kernels.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <set>

namespace
{

using namespace zvo;

template <typename Struct> Struct typed(VkStructureType type)
{
    Struct structure{};
    structure.sType = type;
    return structure;
}

/// One struct of each type that a host may chain.
struct Structs
{
    VkPhysicalDeviceFeatures enabled{};
    VkPhysicalDeviceFeatures2 core = typed<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    VkPhysicalDeviceVulkan11Features vulkan11 =
        typed<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
    VkPhysicalDeviceVulkan12Features vulkan12 =
        typed<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
    VkPhysicalDeviceVulkan13Features vulkan13 =
        typed<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    VkPhysicalDeviceMultiviewFeatures multiview =
        typed<VkPhysicalDeviceMultiviewFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES);
    VkPhysicalDeviceBufferDeviceAddressFeatures address = typed<VkPhysicalDeviceBufferDeviceAddressFeatures>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES);
    VkPhysicalDeviceScalarBlockLayoutFeatures scalar = typed<VkPhysicalDeviceScalarBlockLayoutFeatures>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES);
    VkPhysicalDeviceTimelineSemaphoreFeatures timeline =
        typed<VkPhysicalDeviceTimelineSemaphoreFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES);
    VkPhysicalDeviceHostQueryResetFeatures query_reset =
        typed<VkPhysicalDeviceHostQueryResetFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_HOST_QUERY_RESET_FEATURES);
    VkPhysicalDeviceSynchronization2Features synchronization2 =
        typed<VkPhysicalDeviceSynchronization2Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES);
    VkPhysicalDeviceMaintenance4Features maintenance4 =
        typed<VkPhysicalDeviceMaintenance4Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES);
    VkPhysicalDeviceDynamicRenderingFeatures rendering =
        typed<VkPhysicalDeviceDynamicRenderingFeatures>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES);
    VkPhysicalDeviceSubgroupSizeControlFeatures subgroups = typed<VkPhysicalDeviceSubgroupSizeControlFeatures>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_SIZE_CONTROL_FEATURES);
    VkPhysicalDeviceShaderAtomicInt64Features atomics = typed<VkPhysicalDeviceShaderAtomicInt64Features>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES);
    VkPhysicalDeviceCustomBorderColorFeaturesEXT border = typed<VkPhysicalDeviceCustomBorderColorFeaturesEXT>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_FEATURES_EXT);
    VkDevicePrivateDataCreateInfo private_data =
        typed<VkDevicePrivateDataCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_PRIVATE_DATA_CREATE_INFO);
};

/// Appends a struct to the chain.
template <typename Struct> void append(VkDeviceCreateInfo& info, Struct& structure)
{
    const void** end = &info.pNext;
    while (*end != nullptr)
    {
        end = const_cast<const void**>(
            reinterpret_cast<void**>(&static_cast<VkBaseOutStructure*>(const_cast<void*>(*end))->pNext));
    }
    *end = &structure;
}

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
std::string bytesOf(const VkDeviceCreateInfo& info, const Structs& structs)
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
        static const Structs types;
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
    static const Structs types;
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

const std::set<std::string> kRequired = {"shaderInt64", "bufferDeviceAddress", "scalarBlockLayout", "synchronization2",
                                         "maintenance4"};

/// Tests every subset of the structs, legal or not.
TEST(PatchFeatures, EveryMixOfStructsIsCompletedOrRefusedAsAWhole)
{
    constexpr std::uint32_t kStructCount = 14;
    std::uint32_t refused = 0;
    for (std::uint32_t subset = 0; subset < 1u << kStructCount; ++subset)
    {
        Structs structs;
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

        const bool legal = isLegal(info);
        const std::vector<const VkBaseInStructure*> before = chainOf(info);
        const std::string bytes_before = bytesOf(info, structs);
        FeatureStorage storage;
        const std::vector<std::string> reasons = patchFeatures(info, storage);
        ASSERT_EQ(reasons.empty(), legal) << subset;
        if (!legal)
        {
            ++refused;
            ASSERT_EQ(bytesOf(info, structs), bytes_before) << "a refused chain was changed: " << subset;
            continue;
        }
        ASSERT_TRUE(isLegal(info)) << subset;
        ASSERT_EQ(featuresOf(info), kRequired) << subset;
        const std::vector<const VkBaseInStructure*> after = chainOf(info);
        ASSERT_GE(after.size(), before.size());
        ASSERT_TRUE(std::equal(before.rbegin(), before.rend(), after.rbegin())) << "the host's structs were moved";
        ASSERT_EQ(structs.enabled.shaderInt64, VK_FALSE) << "what pEnabledFeatures points to is the host's";
        ASSERT_TRUE(info.pEnabledFeatures == nullptr || info.pEnabledFeatures->robustBufferAccess == VK_TRUE);
        ASSERT_EQ(structs.vulkan12.timelineSemaphore, VK_TRUE);
        ASSERT_EQ(structs.vulkan12.drawIndirectCount, VK_FALSE);

        const std::string bytes_after = bytesOf(info, structs);
        ASSERT_TRUE(patchFeatures(info, storage).empty());
        FeatureStorage other;
        ASSERT_TRUE(patchFeatures(info, other).empty());
        ASSERT_EQ(chainOf(info), after) << "once more added more: " << subset;
        ASSERT_EQ(bytesOf(info, structs), bytes_after);
    }
    EXPECT_GT(refused, 0u);
    EXPECT_LT(refused, 1u << kStructCount);
}

TEST(PatchFeatures, ReasonsNameWhatDoesNotGoTogether)
{
    const auto reasonsOf = [](const std::function<void(VkDeviceCreateInfo&, Structs&)>& make)
    {
        Structs structs;
        VkDeviceCreateInfo info{};
        make(info, structs);
        FeatureStorage storage;
        std::string text;
        for (const std::string& reason : patchFeatures(info, storage))
        {
            text += reason + "\n";
        }
        return text;
    };
    const std::string several = reasonsOf(
        [](VkDeviceCreateInfo& info, Structs& structs)
        {
            info.pEnabledFeatures = &structs.enabled;
            append(info, structs.core);
            append(info, structs.vulkan12);
            append(info, structs.timeline);
            append(info, structs.vulkan13);
            append(info, structs.rendering);
        });
    for (const char* part : {"pEnabledFeatures", "VkPhysicalDeviceFeatures2",
                             "VkPhysicalDeviceTimelineSemaphoreFeatures", "VkPhysicalDeviceVulkan12Features",
                             "VkPhysicalDeviceDynamicRenderingFeatures", "VkPhysicalDeviceVulkan13Features"})
    {
        EXPECT_NE(several.find(part), std::string::npos) << part << " is not in\n" << several;
    }
    EXPECT_EQ(several.find("Multiview"), std::string::npos) << several;

    auto again = typed<VkPhysicalDeviceScalarBlockLayoutFeatures>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES);
    const std::string twice = reasonsOf(
        [&](VkDeviceCreateInfo& info, Structs& structs)
        {
            append(info, structs.scalar);
            append(info, again);
        });
    EXPECT_NE(twice.find("VkPhysicalDeviceScalarBlockLayoutFeatures more than once"), std::string::npos) << twice;

    const std::string addresses = reasonsOf(
        [](VkDeviceCreateInfo& info, Structs&)
        {
            static const char* const extension = "VK_EXT_buffer_device_address";
            info.enabledExtensionCount = 1;
            info.ppEnabledExtensionNames = &extension;
        });
    EXPECT_NE(addresses.find("VK_EXT_buffer_device_address"), std::string::npos) << addresses;
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
    EXPECT_TRUE(patchFeatures(info, storage).empty());
    EXPECT_EQ(info.pEnabledFeatures, &enabled);
    EXPECT_EQ(featuresOf(info), kRequired);
}

TEST(PatchFeatures, OptionalFeaturesAreAddedWhereAsked)
{
    for (const bool whole : {false, true})
    {
        Structs structs;
        VkDeviceCreateInfo info{};
        if (whole)
        {
            append(info, structs.vulkan12);
            append(info, structs.vulkan13);
        }
        FeatureStorage storage;
        EXPECT_TRUE(patchFeatures(info, storage, {true, false}).empty());
        std::set<std::string> expected = kRequired;
        expected.insert("hostQueryReset");
        EXPECT_EQ(featuresOf(info), expected);
        EXPECT_TRUE(patchFeatures(info, storage, {true, true}).empty());
        expected.insert("subgroupSizeControl");
        EXPECT_EQ(featuresOf(info), expected);
        EXPECT_TRUE(patchFeatures(info, storage, {true, true, true}).empty());
        expected.insert("shaderBufferInt64Atomics");
        EXPECT_EQ(featuresOf(info), expected);
        EXPECT_TRUE(isLegal(info));
    }
}

/// A way in which hosts enable their own features.
struct HostChain
{
    const char* name;
    std::function<void(VkDeviceCreateInfo&, Structs&)> make;
    const char* extension = nullptr;
};

/// GoogleTest prints parameters with it; otherwise it would print bytes.
void PrintTo(const HostChain& chain, std::ostream* out)
{
    *out << chain.name;
}

const HostChain kHostChains[] = {
    {"Nothing", [](VkDeviceCreateInfo&, Structs&) {}},
    {"EnabledFeatures",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         structs.enabled.robustBufferAccess = VK_TRUE;
         info.pEnabledFeatures = &structs.enabled;
     }},
    {"Features2",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         structs.core.features.geometryShader = VK_TRUE;
         append(info, structs.core);
     }},
    {"Vulkan12",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         structs.vulkan12.timelineSemaphore = VK_TRUE;
         append(info, structs.vulkan12);
     }},
    {"EveryVersion",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         append(info, structs.vulkan13);
         append(info, structs.vulkan12);
         append(info, structs.vulkan11);
         append(info, structs.core);
     }},
    {"Vulkan13AndEnabledFeatures",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         structs.vulkan13.dynamicRendering = VK_TRUE;
         append(info, structs.vulkan13);
         info.pEnabledFeatures = &structs.enabled;
     }},
    {"SingleStructsThatZvoNeeds",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         structs.scalar.scalarBlockLayout = VK_TRUE;
         append(info, structs.scalar);
         append(info, structs.address);
         append(info, structs.synchronization2);
     }},
    {"SingleStructsOfOthers",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         structs.timeline.timelineSemaphore = VK_TRUE;
         structs.rendering.dynamicRendering = VK_TRUE;
         append(info, structs.timeline);
         append(info, structs.rendering);
         append(info, structs.multiview);
     }},
    {"Vulkan12BesideSingleStructsOf13",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         append(info, structs.vulkan12);
         append(info, structs.maintenance4);
         append(info, structs.core);
     }},
    {"Vulkan13BesideSingleStructsOf12",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         append(info, structs.query_reset);
         append(info, structs.vulkan13);
         append(info, structs.address);
     }},
    {"StructsThatZvoDoesNotKnow",
     [](VkDeviceCreateInfo& info, Structs& structs)
     {
         structs.border.customBorderColors = VK_TRUE;
         append(info, structs.private_data);
         append(info, structs.vulkan12);
         append(info, structs.border);
         append(info, structs.vulkan13);
     },
     "VK_EXT_custom_border_color"},
    // If zvo added a Vulkan12Features, it would have to enable this extension's feature there.
    {"AnExtensionThatVulkan12Decides", [](VkDeviceCreateInfo&, Structs&) {}, "VK_KHR_draw_indirect_count"},
};

class HostChains : public testing::TestWithParam<HostChain>
{
};

INSTANTIATE_TEST_SUITE_P(PatchFeatures, HostChains, testing::ValuesIn(kHostChains),
                         [](const auto& chain) { return chain.param.name; });

/// Runs kernels with 64-bit addresses and scalar layout on target, in a host's command buffer.
void expectThatItWorks(test::HostDevice& host, vk::Device& target)
{
    constexpr std::uint32_t kCount = 1000;
    const vk::BufferOf<gpu::uint> result(target, "result", kCount, vk::MemoryKind::Readback);
    vk::BufferOf<gpu::uint> values(target, "values", kCount);
    vk::BufferOf<gpu::uint> copies(target, "copies", kCount);
    host.run(
        [&](VkCommandBuffer commands)
        {
            vk::FrameGraph graph(target, commands);
            test::iota(graph, values);
            test::scale(graph, values, copies, 3);
            graph.copy(copies, 0, const_cast<vk::BufferOf<gpu::uint>&>(result), 0, copies.bytes());
            graph.releaseToHost();
        });
    for (std::uint32_t i = 0; i < kCount; ++i)
    {
        ASSERT_EQ(result.mappedData()[i], 3 * i);
    }
}

TEST_P(HostChains, MakeADeviceThatTheLayersAcceptAndZvoRunsOn)
{
    Structs structs;
    test::HostOptions options;
    options.validation = test::hasValidationLayer();
    options.optional.pass_times = true;
    options.prepare = [&](VkDeviceCreateInfo& info) { GetParam().make(info, structs); };
    if (GetParam().extension != nullptr)
    {
        options.device_extensions = {GetParam().extension};
    }
    test::HostDevice host(options);
    {
        vk::Device device(host.handles(), testKernels());
        EXPECT_TRUE(device.isEnabled("hostQueryReset"));
        EXPECT_FALSE(device.isEnabled("subgroupSizeControl"));
        expectThatItWorks(host, device);
        vk::Device guest(device.handles(), testKernels()); // the handles that a device returns are a valid declaration
        expectThatItWorks(host, guest);
    }
    EXPECT_EQ(host.messageCount(), 0u);
}

/// Shows that the layers' silence above has a meaning.
TEST(HostDevice, ValidationSpeaksOfAForbiddenMix)
{
    if (!test::hasValidationLayer())
    {
        GTEST_SKIP() << "needs the validation layer";
    }
    Structs structs;
    std::atomic<std::uint32_t> messages = 0;
    test::HostOptions options;
    options.validation = true;
    options.message_counter = &messages;
    options.patch = false;
    options.prepare = [&](VkDeviceCreateInfo& info)
    {
        append(info, structs.vulkan12);
        append(info, structs.scalar);
    };
    const test::HostDevice host(options);
    EXPECT_GT(host.messageCount(), 0u);
    EXPECT_EQ(messages, host.messageCount());
}

std::string refusalOf(const vk::DeviceHandles& handles, ErrorCode expected = ErrorCode::Device)
{
    return test::messageOf([&] { const vk::Device device(handles, testKernels()); }, expected);
}

TEST(Declaration, EveryRequiredFeatureThatIsNotEnabledIsNamed)
{
    test::HostOptions options;
    options.patch = false;
    const test::HostDevice bare(options);
    const std::string refusal = refusalOf(bare.handles());
    for (const std::string& feature : kRequired)
    {
        EXPECT_NE(refusal.find(feature), std::string::npos) << feature << " is not in: " << refusal;
    }
    EXPECT_NE(refusal.find("patchFeatures"), std::string::npos) << refusal;
    for (const char* other :
         {"hostQueryReset", "timelineSemaphore", "subgroupSizeControl", "shaderInt16", "shaderBufferInt64Atomics"})
    {
        EXPECT_EQ(refusal.find(other), std::string::npos) << refusal;
    }
}

TEST(Declaration, OneFeatureThatIsNotDeclaredIsNamedAlone)
{
    const test::HostDevice host;
    for (const std::string& left_out : kRequired)
    {
        Structs structs;
        structs.enabled.shaderInt64 = left_out != "shaderInt64";
        structs.vulkan12.bufferDeviceAddress = left_out != "bufferDeviceAddress";
        structs.vulkan12.scalarBlockLayout = left_out != "scalarBlockLayout";
        structs.vulkan13.synchronization2 = left_out != "synchronization2";
        structs.vulkan13.maintenance4 = left_out != "maintenance4";
        structs.vulkan12.pNext = &structs.vulkan13;
        vk::DeviceHandles handles = host.handles();
        handles.enabled_features = &structs.vulkan12;
        handles.enabled_core_features = &structs.enabled;
        const std::string refusal = refusalOf(handles);
        for (const std::string& feature : kRequired)
        {
            EXPECT_EQ(refusal.find("without " + feature + " (") != std::string::npos, feature == left_out) << refusal;
        }
    }
}

TEST(Declaration, AnInstanceForAnOlderVulkanIsRefused)
{
    const test::HostDevice host;
    vk::DeviceHandles handles = host.handles();
    handles.instance_api_version = VK_API_VERSION_1_2;
    EXPECT_NE(refusalOf(handles).find("Vulkan 1.2, zvo needs 1.3"), std::string::npos) << refusalOf(handles);
    handles.instance_api_version = 0; // unknown; Vulkan treats it as 1.0
    EXPECT_NE(refusalOf(handles).find("Vulkan 1.0, zvo needs 1.3"), std::string::npos) << refusalOf(handles);
}

TEST(Declaration, HandlesThatAreNullAreNamed)
{
    const std::string nothing = refusalOf({}, ErrorCode::Usage);
    for (const char* handle : {"vkGetInstanceProcAddr", "VkInstance", "VkPhysicalDevice", "VkDevice"})
    {
        EXPECT_NE(nothing.find(std::string("no ") + handle), std::string::npos) << nothing;
    }
    const test::HostDevice host;
    vk::DeviceHandles handles = host.handles();
    handles.device = VK_NULL_HANDLE;
    EXPECT_EQ(refusalOf(handles, ErrorCode::Usage).find("VkInstance"), std::string::npos);
}

TEST(Declaration, WhatItPointsToMayGoOnceTheDeviceIsMade)
{
    test::HostDevice host;
    auto structs = std::make_unique<Structs>();
    structs->core.features.shaderInt64 = VK_TRUE;
    structs->core.pNext = &structs->vulkan12;
    structs->vulkan12.bufferDeviceAddress = VK_TRUE;
    structs->vulkan12.scalarBlockLayout = VK_TRUE;
    structs->vulkan12.pNext = &structs->vulkan13;
    structs->vulkan13.synchronization2 = VK_TRUE;
    structs->vulkan13.maintenance4 = VK_TRUE;
    vk::DeviceHandles handles = host.handles();
    handles.enabled_features = &structs->core;
    vk::Device device(handles, testKernels());
    *structs = Structs{}; // overwritten, in case zvo has kept a pointer
    structs.reset();
    EXPECT_FALSE(device.isEnabled("hostQueryReset"));
    vk::Device guest(device.handles(), testKernels());
    expectThatItWorks(host, guest);
}

TEST(Declaration, ASubgroupSizeNeedsItsFeature)
{
    test::HostOptions options;
    const test::HostDevice without(options);
    vk::DeviceHandles handles = without.handles();
    const std::uint32_t size =
        query(handles.get_instance_proc_addr, handles.instance, handles.physical_device).max_subgroup_size;
    handles.tuning = {{vk::kSubgroupSizeName, size}};
    if (size == 0)
    {
        GTEST_SKIP() << "the device's subgroups have one size";
    }
    EXPECT_NE(refusalOf(handles).find("without subgroupSizeControl"), std::string::npos);
    options.optional.subgroup_sizes = true;
    test::HostDevice host(options);
    handles = host.handles();
    handles.tuning = {{vk::kSubgroupSizeName, size}};
    vk::Device device(handles, testKernels());
    expectThatItWorks(host, device);
}

TEST(Declaration, WithoutTimesOfPassesEverythingElseWorks)
{
    test::HostDevice host;
    vk::Device device(host.handles(), testKernels());
    vk::TimerPool timers(device, 16);
    vk::BufferOf<gpu::uint> values(device, "values", 100);
    host.run(
        [&](VkCommandBuffer commands)
        {
            vk::FrameGraph graph(device, commands, &timers);
            test::iota(graph, values);
        });
    EXPECT_TRUE(timers.collect().empty());
    expectThatItWorks(host, device);
}

TEST(Declaration, NamesAreGivenOnlyWhereTheInstanceHasDebugUtils)
{
    for (const bool debug_utils : {false, true})
    {
        test::HostOptions options;
        options.validation = false;
        options.debug_utils = debug_utils;
        test::HostDevice host(options);
        vk::Device device(host.handles(), testKernels());
        EXPECT_EQ(device.hasDebugUtils(), debug_utils);
        expectThatItWorks(host, device);
    }
}

} // namespace
