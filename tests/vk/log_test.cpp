// SPDX-License-Identifier: MIT
// Messages to a host.
#include "support/host_device.h"
#include "support/temp_dir.h"
#include "vk/kernels.h"
#include "vk/log_file.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace zvo;

struct Log
{
    static void add(void* user, LogSeverity severity, const char* message)
    {
        static_cast<Log*>(user)->messages.emplace_back(severity, message);
    }

    [[nodiscard]] std::ptrdiff_t count(LogSeverity severity, const std::string& part) const
    {
        return std::count_if(messages.begin(), messages.end(),
                             [&](const auto& message)
                             { return message.first == severity && message.second.find(part) != std::string::npos; });
    }

    std::vector<std::pair<LogSeverity, std::string>> messages;
};

test::HostOptions listening(Log& log)
{
    test::HostOptions options;
    options.log = {Log::add, &log};
    return options;
}

TEST(Log, KernelsAreNamedWhenTheyAreCompiledAndOnlyThen)
{
    Log log;
    test::HostDevice host(listening(log));
    vk::Device device(host.handles(), testKernels());
    EXPECT_EQ(log.count(LogSeverity::Debug, "kernel"), 0);
    device.kernels().get("test/iota");
    device.kernels().get("test/iota");
    EXPECT_EQ(log.count(LogSeverity::Debug, "kernel test/iota: compiled in "), 1);
    EXPECT_EQ(log.count(LogSeverity::Debug, "kernel"), 1);
}

TEST(Log, MemoryIsToldOfByWhatItIsFor)
{
    Log log;
    test::HostDevice host(listening(log));
    {
        vk::Device device(host.handles(), testKernels());
        {
            const vk::Buffer big(device, "the big one", 100 << 20);
            EXPECT_EQ(log.count(LogSeverity::Debug, "took 104857600 bytes"), 1);
            EXPECT_EQ(log.count(LogSeverity::Debug, "for the big one"), 1);
            EXPECT_EQ(log.count(LogSeverity::Debug, "returned"), 0);
        }
        EXPECT_EQ(log.count(LogSeverity::Debug, "returned 104857600 bytes, 0 bytes in all"), 1);
        const vk::Buffer a(device, "a", 100);
        const vk::Buffer b(device, "b", 100);
    }
    EXPECT_EQ(log.count(LogSeverity::Debug, "took"), 2) << "small ones share a block";
    EXPECT_EQ(log.count(LogSeverity::Debug, "returned"), 2);
}

TEST(Log, WhatTheBudgetRefusesIsAWarning)
{
    Log log;
    test::HostOptions options = listening(log);
    options.memory_budget_bytes = 1 << 20;
    test::HostDevice host(options);
    vk::Device device(host.handles(), testKernels());
    EXPECT_THROW(vk::Buffer(device, "the voxels", 2 << 20), Error);
    EXPECT_THROW(device.memory().require(3 << 20, "the scene"), Error);
    EXPECT_EQ(log.count(LogSeverity::Warning, "2097152 bytes for the voxels exceed"), 1);
    EXPECT_EQ(log.count(LogSeverity::Warning, "3145728 bytes for the scene exceed"), 1);
}

TEST(Log, WhatTheDeviceGoesWithoutIsSaidOnce)
{
    for (const bool times : {false, true})
    {
        Log log;
        test::HostOptions options = listening(log);
        options.optional.pass_times = times;
        test::HostDevice host(options);
        const vk::Device device(host.handles(), testKernels());
        EXPECT_EQ(log.count(LogSeverity::Info, "hostQueryReset"), times ? 0 : 1);
        EXPECT_EQ(log.count(LogSeverity::Info, ""), times ? 0 : 1);
    }
}

TEST(Log, AFileGetsEachMessageAsALine)
{
    const test::TempDir folder;
    const std::string path = folder.path() / "log";
    for (int i = 0; i < 2; ++i)
    {
        test::HostOptions options;
        options.log = vk::logToFile(path.c_str());
        test::HostDevice host(options);
        vk::Device device(host.handles(), testKernels());
        device.kernels().get("test/iota");
    }
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
    {
        lines.push_back(line);
    }
    ASSERT_EQ(lines.size(), 4U); // two of each device
    EXPECT_EQ(lines.front(), "info: hostQueryReset is not enabled: passes are not timed");
    EXPECT_TRUE(lines.back().starts_with("debug: kernel test/iota: compiled in "));
}

TEST(Log, WithoutAFileThereIsNoLog)
{
    EXPECT_EQ(vk::logToFile(nullptr).function, nullptr);
    EXPECT_EQ(vk::logToFile("").function, nullptr);
}

TEST(Log, AListenerThatThrowsChangesNothing)
{
    int call_count = 0;
    test::HostOptions options;
    options.log.user = &call_count;
    options.log.function = [](void* count, LogSeverity, const char*)
    {
        ++*static_cast<int*>(count);
        throw Error(ErrorCode::Other, "no paper");
    };
    test::HostDevice host(options);
    vk::Device device(host.handles(), testKernels());
    vk::BufferOf<gpu::uint> values(device, "values", 100);
    vk::BufferOf<gpu::uint> scaled(device, "scaled", 100, vk::MemoryKind::Readback);
    host.run(
        [&](VkCommandBuffer commands)
        {
            vk::FrameGraph graph(device, commands);
            test::iota(graph, values);
            test::scale(graph, values, scaled, 3);
            graph.releaseToHost();
        });
    EXPECT_GT(call_count, 0);
    for (std::uint32_t i = 0; i < 100; ++i)
    {
        ASSERT_EQ(scaled.mappedData()[i], 3 * i);
    }
}

} // namespace
