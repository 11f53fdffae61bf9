// SPDX-License-Identifier: MIT
// What hosts declare of their devices, and messages about features that are not enabled.
#include "support/errors.h"
#include "support/host_device.h"
#include "vk/expect_works.h"
#include "vk/feature_structs.h"
#include "vk/kernels.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

namespace zvo
{

namespace
{

using test::expectThatItWorks;
using test::FeatureStructs;
using test::kRequiredFeatures;

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
    for (const std::string& feature : kRequiredFeatures)
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
    for (const std::string& left_out : kRequiredFeatures)
    {
        FeatureStructs structs;
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
        for (const std::string& feature : kRequiredFeatures)
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
    auto structs = std::make_unique<FeatureStructs>();
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
    *structs = FeatureStructs{}; // overwritten, in case zvo has kept a pointer
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
        query(handles.get_instance_proc_addr, handles.instance, handles.physical_device, handles.instance_api_version)
            .max_subgroup_size;
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

} // namespace zvo
