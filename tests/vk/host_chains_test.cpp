// SPDX-License-Identifier: MIT
// Devices of hosts that enable features of their own: the layers accept what zvo adds to them, and zvo runs on them.
#include "support/host_device.h"
#include "vk/expect_works.h"
#include "vk/feature_structs.h"
#include "vk/kernels.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <ostream>

namespace zvo
{

namespace
{

using test::append;
using test::expectThatItWorks;
using test::FeatureStructs;

/// A way in which hosts enable their own features.
struct HostChain
{
    const char* name;
    std::function<void(VkDeviceCreateInfo&, FeatureStructs&)> make;
    const char* extension = nullptr;
};

/// GoogleTest prints parameters with it; otherwise it would print bytes.
void PrintTo(const HostChain& chain, std::ostream* out)
{
    *out << chain.name;
}

const HostChain kHostChains[] = {
    {"Nothing", [](VkDeviceCreateInfo&, FeatureStructs&) {}},
    {"EnabledFeatures",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         structs.enabled.robustBufferAccess = VK_TRUE;
         info.pEnabledFeatures = &structs.enabled;
     }},
    {"Features2",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         structs.core.features.geometryShader = VK_TRUE;
         append(info, structs.core);
     }},
    {"Vulkan12",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         structs.vulkan12.timelineSemaphore = VK_TRUE;
         append(info, structs.vulkan12);
     }},
    {"EveryVersion",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         append(info, structs.vulkan13);
         append(info, structs.vulkan12);
         append(info, structs.vulkan11);
         append(info, structs.core);
     }},
    {"Vulkan13AndEnabledFeatures",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         structs.vulkan13.dynamicRendering = VK_TRUE;
         append(info, structs.vulkan13);
         info.pEnabledFeatures = &structs.enabled;
     }},
    {"SingleStructsThatZvoNeeds",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         structs.scalar.scalarBlockLayout = VK_TRUE;
         append(info, structs.scalar);
         append(info, structs.address);
         append(info, structs.synchronization2);
     }},
    {"SingleStructsOfOthers",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         structs.timeline.timelineSemaphore = VK_TRUE;
         structs.rendering.dynamicRendering = VK_TRUE;
         append(info, structs.timeline);
         append(info, structs.rendering);
         append(info, structs.multiview);
     }},
    {"Vulkan12BesideSingleStructsOf13",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         append(info, structs.vulkan12);
         append(info, structs.maintenance4);
         append(info, structs.core);
     }},
    {"Vulkan13BesideSingleStructsOf12",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         append(info, structs.query_reset);
         append(info, structs.vulkan13);
         append(info, structs.address);
     }},
    {"StructsThatZvoDoesNotKnow",
     [](VkDeviceCreateInfo& info, FeatureStructs& structs)
     {
         structs.border.customBorderColors = VK_TRUE;
         append(info, structs.private_data);
         append(info, structs.vulkan12);
         append(info, structs.border);
         append(info, structs.vulkan13);
     },
     "VK_EXT_custom_border_color"},
    // If zvo added a Vulkan12Features, it would have to enable this extension's feature there.
    {"AnExtensionThatVulkan12Decides", [](VkDeviceCreateInfo&, FeatureStructs&) {}, "VK_KHR_draw_indirect_count"},
};

using HostChains = testing::TestWithParam<HostChain>;

INSTANTIATE_TEST_SUITE_P(PatchFeatures, HostChains, testing::ValuesIn(kHostChains),
                         [](const auto& chain) { return chain.param.name; });

TEST_P(HostChains, MakeADeviceThatTheLayersAcceptAndZvoRunsOn)
{
    FeatureStructs structs;
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
    FeatureStructs structs;
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

} // namespace

} // namespace zvo
