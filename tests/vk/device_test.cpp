// SPDX-License-Identifier: MIT
// Devices of a host: their requirements, and zvo's behaviour on them.
#include "vk/device.h"

#include "support/device.h"
#include "support/errors.h"
#include "support/failing_vulkan.h"
#include "support/host_device.h"
#include "vk/check.h"
#include "vk/features.h"
#include "vk/instance.h"
#include "vk/kernels.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <set>
#include <string>

namespace
{

using namespace zvo;
using test::device;
using test::messageOf;

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

// A physical device of Vulkan 1.1 that lacks everything that zvo needs.
PFN_vkVoidFunction fakeInstanceProcAddr(VkInstance, const char* name)
{
    const PFN_vkGetPhysicalDeviceProperties properties = [](VkPhysicalDevice, VkPhysicalDeviceProperties* out)
    {
        *out = {};
        std::strcpy(out->deviceName, "Toaster");
        out->apiVersion = VK_API_VERSION_1_1;
        out->deviceType = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    };
    const PFN_vkGetPhysicalDeviceMemoryProperties memory = [](VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* out)
    { *out = {}; };
    const PFN_vkGetPhysicalDeviceQueueFamilyProperties families =
        [](VkPhysicalDevice, std::uint32_t* count, VkQueueFamilyProperties* out)
    {
        *count = 1;
        if (out != nullptr)
        {
            *out = {VK_QUEUE_TRANSFER_BIT, 1, 0, {1, 1, 1}};
        }
    };
    const PFN_vkGetPhysicalDeviceFeatures2 features = [](VkPhysicalDevice, VkPhysicalDeviceFeatures2*) {};
    const PFN_vkGetPhysicalDeviceProperties2 properties2 = [](VkPhysicalDevice, VkPhysicalDeviceProperties2*) {};

    const std::map<std::string, PFN_vkVoidFunction> functions = {
        {"vkGetPhysicalDeviceProperties", reinterpret_cast<PFN_vkVoidFunction>(properties)},
        {"vkGetPhysicalDeviceMemoryProperties", reinterpret_cast<PFN_vkVoidFunction>(memory)},
        {"vkGetPhysicalDeviceQueueFamilyProperties", reinterpret_cast<PFN_vkVoidFunction>(families)},
        {"vkGetPhysicalDeviceFeatures2", reinterpret_cast<PFN_vkVoidFunction>(features)},
        {"vkGetPhysicalDeviceProperties2", reinterpret_cast<PFN_vkVoidFunction>(properties2)},
    };
    const auto found = functions.find(name);
    return found != functions.end() ? found->second : nullptr;
}

TEST(Query, ListsEveryReasonOfADeviceThatLacksEverything)
{
    const auto instance = reinterpret_cast<VkInstance>(std::uintptr_t{8}); // never read
    const auto physical_device = reinterpret_cast<VkPhysicalDevice>(std::uintptr_t{16});
    const vk::DeviceReport report = vk::query(fakeInstanceProcAddr, instance, physical_device, VK_API_VERSION_1_0);
    EXPECT_FALSE(report.usable());
    EXPECT_EQ(report.name, "Toaster");
    EXPECT_EQ(report.type, "other");
    EXPECT_EQ(report.api_version, "1.1.0");
    EXPECT_TRUE(report.present.empty());
    std::string reasons;
    for (const std::string& reason : report.reasons)
    {
        reasons += reason + "\n";
    }
    for (const char* needed :
         {"created for Vulkan 1.0", "supports Vulkan 1.1", "compute queue", "shaderInt64", "bufferDeviceAddress",
          "scalarBlockLayout", "synchronization2", "maintenance4", "subgroup basic", "subgroup arithmetic",
          "subgroup ballot", "subgroup shuffle", "maxPushConstantsSize", "maxComputeWorkGroupInvocations"})
    {
        EXPECT_TRUE(contains(reasons, needed)) << needed << " is not among:\n" << reasons;
    }
}

// The tables of docs/embedding.md, "What a device needs", are the code's own lists.
TEST(Query, ThePageForHostsHasWhatADeviceNeeds)
{
    std::ifstream page(ZVO_SOURCE_DIR "/docs/embedding.md");
    std::set<std::string> rows; // "name value"
    bool is_there = false;
    for (std::string line; std::getline(page, line);)
    {
        is_there = line.starts_with("## ") ? line == "## What a device needs" : is_there;
        std::smatch row;
        if (is_there && std::regex_match(line, row, std::regex(R"(\| `([^`]+)` \| (\w+).*)")))
        {
            rows.insert(row.str(1) + ' ' + row.str(2));
        }
    }
    std::set<std::string> expected;
    for (const vk::Feature& feature : vk::knownFeatures())
    {
        if (feature.use != vk::FeatureUse::Noted)
        {
            const bool is_required = feature.use == vk::FeatureUse::Required;
            expected.insert(std::string(feature.name) + (is_required ? " required" : " optional"));
        }
    }
    const auto instance = reinterpret_cast<VkInstance>(std::uintptr_t{8}); // never read
    const auto physical_device = reinterpret_cast<VkPhysicalDevice>(std::uintptr_t{16});
    for (const std::string& reason :
         vk::query(fakeInstanceProcAddr, instance, physical_device, VK_API_VERSION_1_3).reasons)
    {
        std::smatch limit;
        if (std::regex_match(reason, limit, std::regex(R"((max\S+) is 0, zvo needs (\d+))")))
        {
            expected.insert(limit.str(1) + ' ' + limit.str(2));
        }
    }
    EXPECT_GE(expected.size(), 10U);
    EXPECT_EQ(rows, expected);
}

TEST(Query, DescribesTheDevice)
{
    const vk::DeviceReport& report = device().device().report();
    EXPECT_TRUE(report.usable());
    EXPECT_TRUE(report.type == "cpu" || test::deviceOptions().device != "cpu") << report.type;
    EXPECT_GT(report.subgroup_size, 0u);
    EXPECT_GT(report.memory_bytes, 0u);
    EXPECT_GT(report.timestamp_period_ns, 0.0f);
    EXPECT_NE(std::find(report.present.begin(), report.present.end(), "bufferDeviceAddress"), report.present.end());
}

vk::DeviceReport reportOf(const char* name, const char* type, std::vector<std::string> reasons = {})
{
    vk::DeviceReport report;
    report.name = name;
    report.type = type;
    report.reasons = std::move(reasons);
    return report;
}

TEST(ChooseDevice, TheBestUsableOneIsTheDefault)
{
    const std::vector<vk::DeviceReport> reports = {
        reportOf("llvmpipe", "cpu"), reportOf("Broken", "discrete", {"lacks shaderInt64"}),
        reportOf("Onboard", "integrated"), reportOf("Onboard 2", "integrated")};
    EXPECT_EQ(vk::chooseDevice(reports, "").name, "Onboard");
    EXPECT_EQ(vk::chooseDevice(reports, "cpu").name, "llvmpipe");
    EXPECT_EQ(vk::chooseDevice(reports, "3").name, "Onboard 2");
    EXPECT_EQ(vk::chooseDevice(reports, "BOARD 2").name, "Onboard 2");
}

TEST(ChooseDevice, ARefusalListsEveryDeviceWithEveryReason)
{
    const std::vector<vk::DeviceReport> reports = {
        reportOf("First", "discrete", {"lacks shaderInt64", "lacks maintenance4"}), reportOf("Second", "cpu")};
    for (const char* wanted : {"First", "0", "Third", "7"})
    {
        const std::string message = messageOf([&] { vk::chooseDevice(reports, wanted); }, ErrorCode::Device);
        for (const char* part : {wanted, "First", "lacks shaderInt64", "lacks maintenance4", "Second"})
        {
            EXPECT_TRUE(contains(message, part)) << message;
        }
    }
    EXPECT_TRUE(contains(messageOf([] { vk::chooseDevice({}, ""); }, ErrorCode::Device), "install a driver"));
}

TEST(ResultName, NamesResults)
{
    EXPECT_STREQ(vk::resultName(VK_ERROR_DEVICE_LOST), "VK_ERROR_DEVICE_LOST");
    EXPECT_STREQ(vk::resultName(VK_SUCCESS), "VK_SUCCESS");
}

VkResult fakeCall(VkResult result)
{
    return result;
}

TEST(VkCheck, ThrowsWithResultCallAndPlace)
{
    VK_CHECK(fakeCall(VK_SUCCESS));
    VK_CHECK(fakeCall(VK_NOT_READY));
    const std::string lost = messageOf([] { VK_CHECK(fakeCall(VK_ERROR_DEVICE_LOST)); }, ErrorCode::Other);
    EXPECT_TRUE(contains(lost, "fakeCall failed with VK_ERROR_DEVICE_LOST")) << lost;
    EXPECT_TRUE(contains(lost, "device_test.cpp:")) << lost;
    messageOf([] { VK_CHECK(fakeCall(VK_ERROR_OUT_OF_HOST_MEMORY)); }, ErrorCode::Memory);
    messageOf([] { VK_CHECK(fakeCall(VK_ERROR_OUT_OF_DEVICE_MEMORY)); }, ErrorCode::Memory);
}

// The real driver, with some functions replaced by the test's.
struct Interception
{
    PFN_vkGetInstanceProcAddr real_instance = nullptr;
    PFN_vkGetDeviceProcAddr real_device = nullptr;
    std::string name;
    PFN_vkVoidFunction replacement = nullptr;
};
Interception g_interception;

PFN_vkVoidFunction interceptedDeviceProcAddr(VkDevice vk_device, const char* name)
{
    return g_interception.name == name ? g_interception.replacement : g_interception.real_device(vk_device, name);
}

PFN_vkVoidFunction interceptedInstanceProcAddr(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction real = g_interception.real_instance(instance, name);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    {
        g_interception.real_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
        return reinterpret_cast<PFN_vkVoidFunction>(interceptedDeviceProcAddr);
    }
    return real;
}

// The shared device's handles, with one function replaced.
vk::DeviceHandles intercept(const char* name, PFN_vkVoidFunction replacement)
{
    vk::DeviceHandles handles = device().device().handles();
    g_interception = {handles.get_instance_proc_addr, nullptr, name, replacement};
    handles.get_instance_proc_addr = interceptedInstanceProcAddr;
    handles.functions = nullptr; // these would be those of the shared device
    return handles;
}

TEST(Device, OutOfMemoryInTheDriverIsAMemoryErrorThatNamesTheBuffer)
{
    const PFN_vkAllocateMemory refuse = [](VkDevice, const VkMemoryAllocateInfo*, const VkAllocationCallbacks*,
                                           VkDeviceMemory*) { return VK_ERROR_OUT_OF_DEVICE_MEMORY; };
    vk::Device poor(intercept("vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(refuse)), testKernels());
    for (const std::uint64_t bytes : {100ull, 100ull << 20})
    {
        const std::string message =
            messageOf([&] { const vk::Buffer buffer(poor, "the voxels", bytes); }, ErrorCode::Memory);
        EXPECT_TRUE(contains(message, "the voxels")) << message;
    }
    EXPECT_EQ(poor.memory().usedBytes(), 0u);
}

TEST(Device, AShortDriverGetsSmallerBlocks)
{
    const PFN_vkAllocateMemory stingy = [](VkDevice vk_device, const VkMemoryAllocateInfo* info,
                                           const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory)
    {
        if (info->allocationSize > 1 << 20)
        {
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        return device().device().fn().vkAllocateMemory(vk_device, info, callbacks, memory);
    };
    vk::Device poor(intercept("vkAllocateMemory", reinterpret_cast<PFN_vkVoidFunction>(stingy)), testKernels());
    const vk::Buffer a(poor, "a", 1000);
    const vk::Buffer b(poor, "b", 1000);
    EXPECT_NE(a.address(), b.address());
}

TEST(Device, MissingFunctionsAreNamed)
{
    const std::string message =
        messageOf([] { const vk::Device lacking(intercept("vkCmdPipelineBarrier2", nullptr), testKernels()); },
                  ErrorCode::Device);
    EXPECT_TRUE(contains(message, "vkCmdPipelineBarrier2")) << message;
}

TEST(Device, AQueueFamilyThatDoesNotExistIsRefused)
{
    vk::DeviceHandles handles = device().device().handles();
    handles.queue_family = 99;
    messageOf([&] { const vk::Device refused(handles, testKernels()); }, ErrorCode::Device);
}

TEST(HostDevice, SeesWhatZvoSubmitsAndWaitsForAndNotItsOwn)
{
    test::failCall(UINT64_MAX);
    test::HostOptions options;
    options.zvo_functions = test::failingVulkan();
    test::HostDevice host(options);
    {
        vk::Device guest(host.ownerHandles(), testKernels());
        vk::BufferOf<gpu::uint> values(guest, "values", 1000);
        host.run(
            [&](VkCommandBuffer commands)
            {
                vk::FrameGraph graph(guest, commands);
                test::iota(graph, values);
                graph.fill(values, 3);
            });
        EXPECT_EQ(test::submitOrWaitCount(), 0u);
        EXPECT_EQ(test::callCount("vkCreateBuffer"), 1u);
        vk::CommandContext commands(guest, host.queue());
        commands.begin();
        commands.submit();
        commands.wait();
        EXPECT_EQ(test::submitOrWaitCount(), 2u);
    }
    EXPECT_EQ(test::liveObjects(), std::vector<std::string>());
    test::failCall(UINT64_MAX);
}

// Shows that the layers' silence in all other tests has a meaning.
TEST(Validation, SpeaksWhenABarrierIsMissing)
{
    vk::HeadlessOptions options = test::deviceOptions();
    if (!options.validation)
    {
        GTEST_SKIP() << "needs ZVO_TEST_VALIDATION=1";
    }
    std::atomic<std::uint32_t> messages = 0;
    options.message_counter = &messages;
    vk::HeadlessDevice faulty(options, testKernels());
    const vk::Buffer from(faulty.device(), "from", 64);
    const vk::Buffer to(faulty.device(), "to", 64);
    const auto record = [&](VkCommandBuffer commands)
    {
        const VkBufferCopy region{0, 0, 64};
        faulty.device().fn().vkCmdFillBuffer(commands, from.handle(), 0, 64, 0);
        faulty.device().fn().vkCmdCopyBuffer(commands, from.handle(), to.handle(), 1, &region);
    };
    faulty.run([&](vk::FrameGraph& graph) { graph.record("a fill and a copy of what it writes", {}, record); });
    EXPECT_EQ(messages, 1u);
    EXPECT_EQ(faulty.validationMessageCount(), 1u);
}

TEST(Validation, SpeaksWhenAKernelWritesPastABuffer)
{
    vk::HeadlessOptions options = test::deviceOptions();
    if (!options.gpu_assisted_validation)
    {
        GTEST_SKIP() << "needs ZVO_TEST_VALIDATION=2";
    }
    std::atomic<std::uint32_t> messages = 0;
    options.message_counter = &messages;
    vk::HeadlessDevice faulty(options, testKernels());
    // A buffer in the same block of memory, so that the kernel's write does no harm.
    vk::BufferOf<gpu::uint> values(faulty.device(), "values", 64);
    faulty.run(
        [&](vk::FrameGraph& graph)
        {
            vk::Pass pass = graph.addPass(gpu::test::Iota{});
            const gpu::FillParams params = {.values = pass.write(values), .count = 128};
            pass.dispatch(128, params);
        });
    EXPECT_GT(messages, 0u);
}

} // namespace
