// SPDX-License-Identifier: MIT
#include "support/errors.h"
#include "support/temp_dir.h"
#include "vk/kernels.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numeric>

namespace
{

using namespace zvo;
using test::counting;
using test::device;

vk::BufferOf<gpu::uint> iota(vk::HeadlessDevice& target, std::uint64_t count)
{
    vk::BufferOf<gpu::uint> values(target.device(), "values", count);
    target.run([&](vk::FrameGraph& graph) { test::iota(graph, values); });
    return values;
}

TEST(Headless, KernelsRunAtAwkwardSizes)
{
    for (const std::uint64_t count : {0, 1, 27, 64, 2049, 231917})
    {
        const vk::BufferOf<gpu::uint> values = iota(device(), count);
        EXPECT_EQ(device().download(values), counting(count)) << count;
    }
}

TEST(Headless, MoreGroupsThanOneDimensionHoldsAreFolded)
{
    const std::uint32_t max_x = device().device().limits().maxComputeWorkGroupCount[0];
    if (max_x > 1u << 20)
    {
        GTEST_SKIP() << "a device that needs no folding";
    }
    const std::uint64_t count = std::uint64_t{max_x} * 64 + 65;
    const vk::BufferOf<gpu::uint> values = iota(device(), count);
    EXPECT_EQ(device().download(values), counting(count));
}

TEST(Headless, UploadAndDownloadKeepBytesAtOddOffsets)
{
    vk::BufferOf<std::uint8_t> buffer(device().device(), "bytes", 1001);
    std::vector<std::uint8_t> expected(1001, 0);
    device().upload<std::uint8_t>(buffer, expected);
    const std::vector<std::uint8_t> part = {1, 2, 3, 4, 5, 6, 7};
    device().upload<std::uint8_t>(buffer, part, 13);
    std::copy(part.begin(), part.end(), expected.begin() + 13);
    EXPECT_EQ(device().download(buffer), expected);
    EXPECT_EQ(device().download(buffer, 14, 3), (std::vector<std::uint8_t>{2, 3, 4}));
    EXPECT_EQ(device().download(buffer, 1000), std::vector<std::uint8_t>{0});
    EXPECT_TRUE(device().download(buffer, 1001).empty());
}

TEST(Headless, TransfersLongerThanTheStagingBufferGoInTurns)
{
    std::vector<std::uint32_t> values(10'000'019);
    std::uint32_t state = 1;
    for (std::uint32_t& value : values)
    {
        state = state * 1664525u + 1013904223u;
        value = state;
    }
    const vk::BufferOf<std::uint32_t> buffer = device().makeBuffer<std::uint32_t>("long", values);
    EXPECT_EQ(device().download(buffer), values);
}

TEST(Headless, TransfersOutsideTheBufferAreRefused)
{
    vk::BufferOf<std::uint32_t> buffer(device().device(), "short", 4);
    const std::vector<std::uint32_t> values(5);
    EXPECT_THROW(device().upload<std::uint32_t>(buffer, values), Error);
    EXPECT_THROW(device().upload<std::uint32_t>(buffer, std::span(values).first(4), 1), Error);
    EXPECT_THROW(device().download(buffer, 5), Error);
}

TEST(Headless, ARunThatThrowsLeavesTheDeviceUsable)
{
    EXPECT_THROW(device().run([](vk::FrameGraph&) { throw Error(ErrorCode::Input, "while recording"); }), Error);
    EXPECT_EQ(device().download(iota(device(), 27)), counting(27));
}

// Another picture is drawn while something long is made.
TEST(Headless, PausesBetweenSubmissionsCanSubmit)
{
    constexpr std::uint64_t kCount = 1 << 16;
    constexpr double kSoonMs = 1e-3;
    int pauses = 0;
    std::vector<vk::BufferOf<gpu::uint>> between;
    std::vector<vk::Submission> submissions;
    vk::BufferOf<gpu::uint> made;
    device().withPauses(
        [&]
        {
            ++pauses;
            auto& values = between.emplace_back(device().device(), "between", 77);
            submissions.push_back(device().submit([&](vk::FrameGraph& graph) { test::iota(graph, values); }));
        },
        kSoonMs, [&] { made = iota(device(), kCount); });
    EXPECT_GE(pauses, 2);
    const int so_far = pauses;
    EXPECT_EQ(device().download(made), counting(kCount));
    EXPECT_EQ(pauses, so_far) << "outside of withPauses";
    for (vk::Submission& submission : submissions)
    {
        submission.wait();
    }
    for (const vk::BufferOf<gpu::uint>& values : between)
    {
        EXPECT_EQ(device().download(values), counting(77));
    }
}

TEST(Headless, PausesCanRun)
{
    int pauses = 0;
    vk::BufferOf<gpu::uint> made;
    device().withPauses(
        [&]
        {
            ++pauses;
            EXPECT_EQ(device().download(iota(device(), 300)), counting(300));
        },
        1e-3, [&] { made = iota(device(), 1 << 15); });
    EXPECT_GE(pauses, 2);
    EXPECT_EQ(device().download(made), counting(1 << 15));
}

TEST(Headless, APauseEndsTheWorkByThrowing)
{
    for (const int last : {1, 2})
    {
        int pauses = 0;
        const auto pause = [&]
        {
            if (++pauses == last)
            {
                throw Error(ErrorCode::Input, "enough");
            }
        };
        EXPECT_THROW(device().withPauses(pause, 1e-3, [&] { iota(device(), 1 << 16); }), Error);
        EXPECT_EQ(pauses, last);
        EXPECT_EQ(device().download(iota(device(), 27)), counting(27));
        EXPECT_EQ(pauses, last);
    }
}

TEST(Headless, TwoDevicesWorkInOneProcess)
{
    vk::HeadlessDevice other(test::deviceOptions(), testKernels());
    const vk::BufferOf<gpu::uint> here = iota(device(), 100);
    const vk::BufferOf<gpu::uint> there = iota(other, 200);
    EXPECT_EQ(device().download(here), counting(100));
    EXPECT_EQ(other.download(there), counting(200));
}

TEST(Headless, AnUnknownDeviceIsRefusedWithAListOfAll)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.device = "no such device";
    const std::string message =
        test::messageOf([&] { const vk::HeadlessDevice refused(options, testKernels()); }, ErrorCode::Device);
    test::expectParts(message, {"no such device"});
    for (const vk::DeviceReport& report : vk::queryAllDevices())
    {
        test::expectParts(message, {report.name.c_str()});
    }
}

TEST(Headless, DevicesAreFoundByIndexAndByPartOfTheName)
{
    const std::vector<vk::DeviceReport> reports = vk::queryAllDevices();
    for (std::size_t i = 0; i < reports.size(); ++i)
    {
        if (reports[i].type != "cpu" || !reports[i].usable())
        {
            continue;
        }
        vk::HeadlessOptions options = test::deviceOptions();
        options.device = std::to_string(i);
        EXPECT_EQ(vk::HeadlessDevice(options, {}).device().report().name, reports[i].name);
        options.device = reports[i].name.substr(0, 4);
        options.device[0] = 'L';
        options.device[1] = 'L';
        EXPECT_EQ(vk::HeadlessDevice(options, {}).device().report().name, reports[i].name);
    }
    vk::HeadlessOptions options = test::deviceOptions();
    options.device = "99";
    EXPECT_THROW(vk::HeadlessDevice(options, {}), Error);
}

TEST(Headless, PipelineCacheFileIsWrittenAndReadAgain)
{
    const test::TempDir folder;
    vk::HeadlessOptions options = test::deviceOptions();
    options.pipeline_cache_path = folder.path() / "below" / "pipelines.bin";
    for (int round = 0; round < 2; ++round)
    {
        vk::HeadlessDevice cached(options, testKernels());
        EXPECT_EQ(cached.download(iota(cached, 27)), counting(27));
    }
    EXPECT_TRUE(std::filesystem::exists(options.pipeline_cache_path));
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path() / "below"))
    {
        ++files;
    }
    EXPECT_EQ(files, 1u) << "a temporary file stayed behind";
}

TEST(Headless, PipelineCacheSurvivesADamagedFile)
{
    const test::TempDir folder;
    vk::HeadlessOptions options = test::deviceOptions();
    options.pipeline_cache_path = folder.path() / "pipelines.bin";
    {
        vk::HeadlessDevice cached(options, testKernels());
        iota(cached, 1);
    }
    std::ifstream file(options.pipeline_cache_path, std::ios::binary);
    const std::string good(std::istreambuf_iterator<char>(file), {});
    ASSERT_GT(good.size(), 24u);
    std::string flipped = good;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    for (const std::string& contents :
         {std::string(), std::string("garbage"), std::string(5000, '\xff'), good.substr(0, good.size() - 1), flipped})
    {
        std::ofstream(options.pipeline_cache_path, std::ios::binary) << contents;
        vk::HeadlessDevice cached(options, testKernels());
        EXPECT_EQ(cached.download(iota(cached, 27)), counting(27));
    }
}

TEST(Headless, APipelineCacheThatCannotBeWrittenIsNoError)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.pipeline_cache_path = "/proc/no/such/folder/pipelines.bin";
    vk::HeadlessDevice cached(options, testKernels());
    EXPECT_EQ(cached.download(iota(cached, 27)), counting(27));
}

} // namespace
