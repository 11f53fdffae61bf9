// SPDX-License-Identifier: MIT
// Devices with reduced limits, and passes that a host splits into pieces.
#include "support/errors.h"
#include "vk/kernels.h"

#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace
{

using namespace zvo;
using test::counting;
using test::device;
using test::iota;

std::string refusalOf(const vk::DeviceOverrides& overrides, const vk::TuningValues& tuning = {})
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.overrides = overrides;
    options.tuning = tuning;
    return test::messageOf([&] { const vk::HeadlessDevice refused(options, testKernels()); }, ErrorCode::Device);
}

TEST(DeviceOverrides, OfGroupCountsAreMetByFoldingAndByPieces)
{
    for (const std::uint64_t most_units : {0U, 1U, 5U})
    {
        vk::HeadlessOptions options = test::deviceOptions();
        options.overrides.max_group_counts = {7, 700, 1};
        options.slices.most_units = most_units;
        vk::HeadlessDevice small(options, testKernels());
        EXPECT_EQ(small.device().limits().maxComputeWorkGroupCount[0], 7U);
        for (const std::uint64_t count : {1, 64, 449, 2049, 64 * 1000 + 1})
        {
            vk::BufferOf<gpu::uint> values(small.device(), "values", count);
            small.run([&](vk::FrameGraph& graph) { iota(graph, values); });
            EXPECT_EQ(small.download(values), counting(count)) << count << " in pieces of " << most_units;
        }
        vk::BufferOf<gpu::uint> many(small.device(), "many", 64 * 7 * 700 + 1);
        EXPECT_THROW(small.run([&](vk::FrameGraph& graph) { iota(graph, many); }), Error);
    }
}

TEST(DeviceOverrides, OfBuffersAndAllocationsAreMemoryErrors)
{
    for (const bool of_buffers : {true, false})
    {
        vk::HeadlessOptions options = test::deviceOptions();
        (of_buffers ? options.overrides.max_buffer_bytes : options.overrides.max_allocation_bytes) = 1000;
        vk::HeadlessDevice small(options, testKernels());
        EXPECT_EQ(small.device().report().max_buffer_bytes, 1000U);
        const vk::Buffer fits(small.device(), "fits", 1000);
        const auto takeMore = [&] { const vk::Buffer buffer(small.device(), "the voxels", 1001); };
        test::expectParts(test::messageOf(takeMore, ErrorCode::Memory), {"the voxels"});
    }
}

TEST(DeviceOverrides, NeverRaiseALimit)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.overrides.max_buffer_bytes = UINT64_MAX - 1;
    options.overrides.max_group_counts = {UINT32_MAX - 1, UINT32_MAX - 1, UINT32_MAX - 1};
    vk::HeadlessDevice same(options, testKernels());
    EXPECT_EQ(same.device().report().max_buffer_bytes, device().device().report().max_buffer_bytes);
    EXPECT_EQ(same.device().limits().maxComputeWorkGroupCount[0],
              device().device().limits().maxComputeWorkGroupCount[0]);
}

TEST(DeviceOverrides, WithoutARequiredFeatureTheDeviceIsRefusedByName)
{
    for (const char* feature : {"bufferDeviceAddress", "shaderInt64", "subgroup ballot"})
    {
        vk::DeviceOverrides without;
        without.features = {feature};
        const std::string refusal = refusalOf(without);
        EXPECT_NE(refusal.find(std::string("lacks ") + feature), std::string::npos) << refusal;
    }
}

TEST(DeviceOverrides, WithoutOptionalFeaturesTheDeviceWorks)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.overrides.features = {
        "shaderInt16",         "shaderInt8",    "shaderBufferInt64Atomics", "shaderSubgroupExtendedTypes",
        "subgroupSizeControl", "hostQueryReset"};
    vk::HeadlessDevice poor(options, testKernels());
    const std::vector<std::string>& missing = poor.device().report().missing;
    EXPECT_NE(std::find(missing.begin(), missing.end(), "shaderInt16"), missing.end());
    vk::BufferOf<gpu::uint> values(poor.device(), "values", 100);
    const std::vector<vk::PassTime> times = poor.run([&](vk::FrameGraph& graph) { iota(graph, values); });
    EXPECT_EQ(poor.download(values), counting(100));
    EXPECT_TRUE(times.empty()) << "times come by hostQueryReset";
}

TEST(DeviceOverrides, OfTheTypeAreTaken)
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.overrides.type = "discrete";
    vk::HeadlessDevice other(options, testKernels());
    EXPECT_EQ(other.device().report().type, "discrete");
}

TEST(SubgroupSizes, AreTakenOrRefused)
{
    const vk::DeviceReport& report = device().device().report();
    const std::string refusal = refusalOf({}, {{vk::kSubgroupSizeName, 3}});
    EXPECT_NE(refusal.find("subgroups of 3"), std::string::npos) << refusal;
    for (std::uint32_t size = report.min_subgroup_size; size != 0 && size <= report.max_subgroup_size; size *= 2)
    {
        vk::HeadlessOptions options = test::deviceOptions();
        options.tuning = {{vk::kSubgroupSizeName, size}};
        vk::HeadlessDevice chosen(options, testKernels());
        EXPECT_EQ(chosen.device().report().subgroup_size, size);
        vk::BufferOf<gpu::uint> values(chosen.device(), "values", 1000);
        chosen.run([&](vk::FrameGraph& graph) { iota(graph, values); });
        EXPECT_EQ(chosen.download(values), counting(1000));
    }
}

TEST(SubgroupSizes, AreThirtyTwoWhereTheDriverWouldTakeMore)
{
    vk::DeviceReport report;
    const auto sizeWith = [&](std::uint32_t usual, std::uint32_t least, std::uint32_t most)
    {
        report.subgroup_size = usual;
        report.min_subgroup_size = least;
        report.max_subgroup_size = most;
        return vk::usualSubgroupSize(report);
    };
    EXPECT_EQ(sizeWith(64, 32, 64), 32U);
    EXPECT_EQ(sizeWith(64, 64, 64), 0U);
    EXPECT_EQ(sizeWith(64, 0, 0), 0U) << "kernels cannot ask";
    EXPECT_EQ(sizeWith(32, 32, 32), 0U);
    EXPECT_EQ(sizeWith(32, 8, 32), 0U);
    EXPECT_EQ(sizeWith(8, 4, 8), 0U);
}

/// A host that records pieces of so many units into one command buffer, and cannot wait.
class PieceByPiece : public vk::Slicer
{
public:
    explicit PieceByPiece(std::uint64_t units) : m_units(units) {}

    std::uint64_t admit(std::uint64_t, std::uint64_t units) override { return std::min(units, m_units); }
    bool admitUnseen(std::uint64_t, std::uint64_t) override { return false; }
    void learnCount(std::uint64_t, std::uint64_t, std::uint64_t) override {}
    vk::Buffer* readback() override { return nullptr; }
    VkCommandBuffer next() override { return VK_NULL_HANDLE; }

private:
    std::uint64_t m_units;
};

TEST(Slicer, PiecesInOneCommandBufferNeverMoveLaterDispatches)
{
    PieceByPiece slicer(3);
    vk::BufferOf<gpu::uint> values(device().device(), "values", 64 * 10 + 5);
    vk::BufferOf<gpu::uint> indirect(device().device(), "indirect", 64 * 4);
    vk::BufferOf<gpu::uint> small(device().device(), "small", 64 * 3);
    vk::BufferOf<gpu::DispatchArgs> args(device().device(), "args", 1);
    const auto record = [&](vk::FrameGraph& graph)
    {
        graph.fill(indirect, 7);
        graph.fill(small, 7);
        {
            vk::Pass pass = graph.addPass(gpu::test::WriteArgs{});
            const gpu::WriteArgsParams params = {.args = pass.write(args), .groups = 4};
            pass.dispatch(1, params);
        }
        iota(graph, values); // pieces at bases 0, 3, 6 and 9
        iota(graph, small);  // one piece, whole
        iota(graph, values);
        vk::Pass pass = graph.addPass(gpu::test::Iota{});
        const gpu::FillParams params = {.values = pass.write(indirect), .count = 64 * 4};
        pass.dispatchIndirect(args, 0, params, 4);
    };
    device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::FrameGraph pieces(graph.device(), graph.commands(), nullptr, &slicer);
            record(pieces);
        });
    EXPECT_EQ(device().download(values), counting(values.count()));
    EXPECT_EQ(device().download(small), counting(small.count()));
    EXPECT_EQ(device().download(indirect), counting(indirect.count()));
}

TEST(Slicer, FillsAndCopiesGoInPieces)
{
    PieceByPiece slicer(1); // 64 KiB
    constexpr std::uint32_t kCount = 50'001;
    vk::BufferOf<gpu::uint> a(device().device(), "a", kCount);
    vk::BufferOf<gpu::uint> b(device().device(), "b", kCount);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::FrameGraph pieces(graph.device(), graph.commands(), nullptr, &slicer);
            iota(pieces, a);
            pieces.fill(b, 9, 3, 40'000);
            pieces.fill(b, 1, 0, 3);
            pieces.fill(b, 1, 40'003);
        });
    std::vector<gpu::uint> expected(kCount, 1);
    std::fill(expected.begin() + 3, expected.begin() + 40'003, 9);
    EXPECT_EQ(device().download(b), expected);
    device().run(
        [&](vk::FrameGraph& graph)
        {
            vk::FrameGraph pieces(graph.device(), graph.commands(), nullptr, &slicer);
            pieces.copy(a, 4, b, 8, 4 * 49'750);
        });
    std::iota(expected.begin() + 2, expected.begin() + 2 + 49'750, 1U);
    EXPECT_EQ(device().download(b), expected);
}

} // namespace
