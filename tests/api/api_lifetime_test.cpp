// SPDX-License-Identifier: MIT
// Lifetimes of zvo's objects: when their memory is freed, and what they do after their frame is lost, or after they
// were taken over or moved from.
#include "api/c_handles.h"
#include "api_scene.h"
#include "core/file/zvo_file.h"
#include "expect_usage.h"
#include "runtime/trees.h"
#include "support/failing_vulkan.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

using test::expectUsage;

constexpr AttributeFormat kFormats[] = {AttributeFormat::None, AttributeFormat::Bytes4, AttributeFormat::Bytes8,
                                        AttributeFormat::Blocks};

const test::HostModel& description()
{
    static const test::HostModel model(test::apiScene());
    return model;
}

TreeBuildInfo buildInfo(AttributeFormat format = AttributeFormat::Bytes8)
{
    return {.grid = test::apiGrid(4), .format = format};
}

// The bytes of a .zvo file.
const std::vector<std::byte>& treeFile()
{
    static const std::vector<std::byte> bytes = []
    {
        vk::HeadlessDevice& device = test::sharedDevice(zvoKernels());
        const DeviceTree octree = test::engineOctree(device, test::apiScene(), test::apiGrid(4));
        std::vector<std::byte> result;
        writeZvo(downloadTree(device, octree),
                 [&](std::span<const std::byte> more) { result.insert(result.end(), more.begin(), more.end()); });
        return result;
    }();
    return bytes;
}

// Records a frame, calls meanwhile(), and only then submits it: the device still uses what is dropped in meanwhile().
void frameUnderWay(test::EmbeddingHost& host, const std::function<void(Recorder&)>& record,
                   const std::function<void()>& meanwhile)
{
    VkCommandBuffer commands = host.device.begin();
    {
        Recorder recorder(host.context, commands, ++host.last_frame);
        record(recorder);
    }
    meanwhile();
    host.device.submit(commands);
    host.device.wait();
}

// Records the steps of a job up to one, in which the job is dropped. Returns false if it has no step with that number.
template <typename Job> bool dropInStep(test::EmbeddingHost& host, std::unique_ptr<Job> job, int step)
{
    for (int i = 0; i < step; ++i)
    {
        host.frame([&](Recorder& recorder) { job->record(recorder); });
    }
    if (job->isDone())
    {
        return false;
    }
    frameUnderWay(
        host, [&](Recorder& recorder) { job->record(recorder); },
        [&]
        {
            const std::uint64_t used = host.context.memory().used;
            job.reset();
            EXPECT_EQ(host.context.memory().used, used) << "in step " << step;
        });
    return true;
}

bool dropBuild(test::EmbeddingHost& host, const Model& model, const TreeBuildInfo& info, int step)
{
    return dropInStep(host, std::make_unique<TreeBuild>(host.context, model, info), step);
}

bool dropCompression(test::EmbeddingHost& host, const Model& model, const TreeBuildInfo& info, int step)
{
    return dropInStep(host, std::make_unique<TreeCompression>(host.context, host.build(model, info)), step);
}

TEST(ApiLifetime, ABuildMayGoInEachOfItsSteps)
{
    test::EmbeddingHost host;
    const Model model = host.upload(description().info());
    const std::uint64_t used = host.context.memory().used;
    for (const AttributeFormat format : kFormats)
    {
        int step = 0;
        for (; dropBuild(host, model, buildInfo(format), step); ++step)
        {
            host.context.frameDone(host.last_frame);
            EXPECT_EQ(host.context.memory().used, used) << "in step " << step;
        }
        EXPECT_GE(step, isPacked(format) ? 4 : 3);
    }
}

TEST(ApiLifetime, ACompressionMayGoInEachOfItsSteps)
{
    test::EmbeddingHost host;
    const Model model = host.upload(description().info());
    const std::uint64_t used = host.context.memory().used;
    for (const AttributeFormat format : kFormats)
    {
        TreeBuildInfo info = buildInfo(format);
        info.keep_sums = format == AttributeFormat::Bytes8;
        int step = 0;
        for (; dropCompression(host, model, info, step); ++step)
        {
            host.context.frameDone(host.last_frame);
            EXPECT_EQ(host.context.memory().used, used) << "in step " << step;
        }
        EXPECT_GE(step, 3);
    }
}

TEST(ApiLifetime, WhatACompressionTookOverGoesWithItsFrame)
{
    test::EmbeddingHost host;
    const Model model = host.upload(description().info());
    const std::uint64_t used = host.context.memory().used;
    EXPECT_TRUE(dropCompression(host, model, buildInfo(), 0));
    const std::uint64_t frame = host.last_frame;
    frameUnderWay(
        host, [](Recorder&) {}, [] {});
    host.context.frameDone(frame); // but not the next one
    EXPECT_EQ(host.context.memory().used, used);
    host.context.frameDone(host.last_frame);
    EXPECT_EQ(host.context.memory().used, used);
}

// Makes jobs, one before each of its steps.
template <typename Job, typename Make>
std::vector<std::unique_ptr<Job>> jobsInEachStep(test::EmbeddingHost& host, const Make& make)
{
    std::vector<std::unique_ptr<Job>> jobs;
    for (std::size_t step = 0;; ++step)
    {
        std::unique_ptr<Job> job = make();
        for (std::size_t i = 0; i < step; ++i)
        {
            host.frame([&](Recorder& recorder) { job->record(recorder); });
        }
        if (job->isDone())
        {
            return jobs;
        }
        jobs.push_back(std::move(job));
    }
}

TEST(ApiLifetime, AContextMayGoWithoutALastFrameDone)
{
    test::failCall(UINT64_MAX);
    test::HostOptions options;
    options.zvo_functions = test::failingVulkan();
    {
        test::EmbeddingHost host(options);
        const TreeBuildInfo info = buildInfo(AttributeFormat::Bytes4);
        std::optional<Model> model = host.upload(description().info());
        const DynamicTreeInfo dynamic_info = {.emission_scale = model->emissionScale()};
        Tree fixed = host.build(*model, buildInfo());
        std::optional<DynamicTree> dynamic;
        std::optional<Tracer> tracer;
        tracer.emplace(host.context, host.kWidth, host.kHeight, VK_FORMAT_R8G8B8A8_UNORM);
        test::TargetImage image(host.device, VK_FORMAT_R8G8B8A8_UNORM, host.kWidth, host.kHeight);
        auto builds =
            jobsInEachStep<TreeBuild>(host, [&] { return std::make_unique<TreeBuild>(host.context, *model, info); });
        auto compressions = jobsInEachStep<TreeCompression>(
            host, [&] { return std::make_unique<TreeCompression>(host.context, host.build(*model, info)); });
        EXPECT_GE(builds.size(), 4U);
        EXPECT_GE(compressions.size(), 3U);
        VkCommandBuffer commands = host.device.begin();
        {
            Recorder recorder(host.context, commands, ++host.last_frame);
            for (const auto& build : builds)
            {
                build->record(recorder);
            }
            for (const auto& compression : compressions)
            {
                compression->record(recorder);
            }
            image.beginCopies(commands);
            dynamic.emplace(recorder, std::move(fixed), dynamic_info);
            dynamic->addObject(recorder, *model, test::movedBy(1, 0, 0));
            dynamic->update(recorder);
            tracer->trace(recorder, *dynamic, test::apiCamera(), {}, image.target());
            image.read(commands);
        }
        host.device.submit(commands);
        host.device.wait();
        builds.clear();
        compressions.clear();
        dynamic.reset();
        tracer.reset();
        model.reset();
    }
    EXPECT_EQ(test::liveObjects(), std::vector<std::string>());
}

// Makes a job whose source is lost with its frame. With records, the job's first step is recorded in that frame, too.
template <typename Job, typename Make>
void expectNoJobWithoutSource(test::EmbeddingHost& host, const Make& make, bool records, const std::string& word)
{
    std::unique_ptr<Job> job;
    host.lostFrame(
        [&](Recorder& recorder)
        {
            job = make(recorder);
            if (records)
            {
                EXPECT_TRUE(job->record(recorder));
            }
        });
    EXPECT_TRUE(job->isBroken());
    for (int tries = 0; tries < 2; ++tries)
    {
        host.frame([&](Recorder& recorder) { expectUsage([&] { job->record(recorder); }, word); });
        expectUsage([&] { (void)job->isDone(); }, word);
        expectUsage([&] { (void)job->take(); }, word);
        EXPECT_TRUE(job->isBroken());
    }
    job.reset();
    EXPECT_EQ(host.context.memory().used, 0U);
}

TEST(ApiLifetime, AJobEndsWhereItsSourceIsLost)
{
    test::EmbeddingHost host;
    for (const bool records : {false, true})
    {
        expectNoJobWithoutSource<TreeBuild>(
            host,
            [&](Recorder& recorder)
            {
                const Model model(recorder, description().info());
                return std::make_unique<TreeBuild>(host.context, model, buildInfo());
            },
            records, "model was lost with its frame");
        expectNoJobWithoutSource<TreeCompression>(
            host,
            [&](Recorder& recorder)
            {
                Tree tree(recorder, std::span<const std::byte>(treeFile()));
                return std::make_unique<TreeCompression>(host.context, std::move(tree));
            },
            records, "octree was lost with its frame");
    }
    const Model model = host.upload(description().info());
    EXPECT_GT(host.build(model, buildInfo()).info().voxel_count, 0U);
}

TEST(ApiLifetime, AJobResumesWhereOnlyItsStepIsLost)
{
    test::EmbeddingHost host;
    VkCommandBuffer commands = host.device.begin();
    std::optional<Model> model;
    {
        Recorder recorder(host.context, commands, ++host.last_frame);
        model.emplace(recorder, description().info());
    }
    host.device.submit(commands);
    TreeBuild build(host.context, *model, buildInfo());
    host.lostFrame([&](Recorder& recorder) { build.record(recorder); });
    EXPECT_FALSE(build.isBroken());
    host.device.wait();
    host.context.frameDone(host.last_frame);
    host.finish(build);
    EXPECT_GT(build.take().info().voxel_count, 0U);
}

class ApiFrames : public testing::Test
{
protected:
    // A host that times passes and whose functions can fail.
    static test::HostOptions options()
    {
        test::failCall(UINT64_MAX);
        test::HostOptions result;
        result.zvo_functions = test::failingVulkan();
        result.optional.pass_times = true;
        return result;
    }

    test::EmbeddingHost m_host{options(), [](ContextInfo& info) { info.timed_passes_per_frame = 300; }};
};

TEST_F(ApiFrames, TimesThatCannotBeReadHoldNothingUp)
{
    if (m_host.context.report().timestamp_period_ns == 0)
    {
        GTEST_SKIP() << "the device has no timestamps";
    }
    const Model model = m_host.upload(description().info());
    for (const VkResult result : {VK_NOT_READY, VK_ERROR_DEVICE_LOST})
    {
        const std::uint64_t used = m_host.context.memory().used;
        TreeBuild build(m_host.context, model, buildInfo());
        auto other = std::make_unique<TreeBuild>(m_host.context, model, buildInfo());
        const auto record = [&](Recorder& recorder)
        {
            build.record(recorder);
            other->record(recorder);
        };
        frameUnderWay(m_host, record, [] {});
        frameUnderWay(
            m_host, [&](Recorder& recorder) { other->record(recorder); }, [&] { other.reset(); });
        const std::size_t time_count = m_host.context.passTimes().size();
        test::failCall(0, result);
        try
        {
            m_host.context.frameDone(m_host.last_frame);
            EXPECT_EQ(result, VK_NOT_READY);
        }
        catch (const Error& error)
        {
            EXPECT_EQ(result, VK_ERROR_DEVICE_LOST) << error.what();
            EXPECT_EQ(error.code(), ErrorCode::Other) << error.what();
        }
        EXPECT_EQ(test::failedFunction(), "vkGetQueryPoolResults");
        test::failCall(UINT64_MAX);
        EXPECT_EQ(m_host.context.passTimes().size(),
                  time_count); // times of an older frame, as the second one has no passes
        EXPECT_FALSE(build.isDone());
        EXPECT_GT(m_host.finish(build), 0U);
        EXPECT_FALSE(m_host.context.passTimes().empty());
        (void)build.take();
        EXPECT_EQ(m_host.context.memory().used, used);
    }
}

TEST_F(ApiFrames, AFrameThatIsBeingRecordedIsNotDone)
{
    const Model model = m_host.upload(description().info());
    TreeBuild build(m_host.context, model, buildInfo());
    m_host.frame(
        [&](Recorder& recorder)
        {
            build.record(recorder);
            for (const std::uint64_t frame : {m_host.last_frame + 1, m_host.last_frame + 2})
            {
                expectUsage([&] { m_host.context.frameDone(frame); }, "its Recorder is still there");
            }
            m_host.context.frameDone(m_host.last_frame);
        });
    EXPECT_GT(m_host.finish(build), 0U);
}

TEST_F(ApiFrames, AFrameThatIsDoneIsNotBegunAgain)
{
    m_host.last_frame = 99;
    m_host.frame([](Recorder&) {});
    VkCommandBuffer commands = m_host.device.begin();
    expectUsage([&] { const Recorder recorder(m_host.context, commands, 100); }, "frame 100 is done; ");
    {
        const Recorder recorder(m_host.context, commands, 102);
    }
    expectUsage([&] { const Recorder again(m_host.context, commands, 100); }, "frame 100 is done; ");
    expectUsage([&] { const Recorder recorder(m_host.context, commands, 101); }, "frame 101 was begun after 102");
    m_host.device.submit(commands);
    m_host.device.wait();
    m_host.context.frameDone(102);
}

TEST(ApiLifetime, WhatIsLostTellsNothing)
{
    const std::string lost = "lost with its frame";
    test::EmbeddingHost host;
    const Model present = host.upload(description().info());
    Tree fixed = host.build(present, buildInfo());
    std::optional<Model> model;
    std::optional<Tree> tree;
    std::optional<DynamicTree> dynamic;
    host.lostFrame(
        [&](Recorder& recorder)
        {
            model.emplace(recorder, description().info());
            tree.emplace(recorder, std::span<const std::byte>(treeFile()));
            dynamic.emplace(recorder, std::move(fixed), DynamicTreeInfo{.emission_scale = present.emissionScale()});
            EXPECT_NE(tree->address(), 0U); // used in the frame in which it is made
            EXPECT_NE(dynamic->address(), 0U);
        });
    expectUsage([&] { (void)model->triangleCount(); }, "model was " + lost);
    expectUsage([&] { (void)model->emissionScale(); }, "model was " + lost);
    expectUsage([&] { (void)model->gridAround(4); }, "model was " + lost);
    expectUsage([&] { (void)tree->info(); }, "tree was " + lost);
    expectUsage([&] { (void)tree->address(); }, "tree was " + lost);
    expectUsage([&] { TreeBuild(host.context, *model, buildInfo()); }, "model was " + lost);
    expectUsage([&] { TreeCompression(host.context, std::move(*tree)); }, "tree was " + lost);
    expectUsage([&] { (void)dynamic->info(); }, "dynamic tree was " + lost);
    expectUsage([&] { (void)dynamic->address(); }, "dynamic tree was " + lost);
    expectUsage([&] { (void)dynamic->needsUpdate(); }, "dynamic tree was " + lost);
    expectUsage([&] { (void)dynamic->takeUpdates(); }, "dynamic tree was " + lost);
    expectUsage([&] { dynamic->endStroke(); }, "dynamic tree was " + lost);
    EXPECT_GT(present.triangleCount(), 0U);
    EXPECT_GT(present.gridAround(4).voxel_size, 0.0F);
}

TEST(ApiLifetime, WhatWasMovedFromIsEmpty)
{
    const std::string empty = "taken over or moved from";
    test::EmbeddingHost host;
    const Model model = host.upload(description().info());
    Tree tree = host.build(model, buildInfo());
    Tracer tracer(host.context, host.kWidth, host.kHeight, VK_FORMAT_R8G8B8A8_UNORM);
    const Tracer other_tracer(std::move(tracer));
    test::TargetImage image(host.device, VK_FORMAT_R8G8B8A8_UNORM, host.kWidth, host.kHeight);
    TreeBuild build(host.context, model, buildInfo());
    TreeBuild other_build(std::move(build));
    std::optional<DynamicTree> dynamic;
    host.frame(
        [&](Recorder& recorder)
        {
            const auto trace = [&](auto& of) { tracer.trace(recorder, of, test::apiCamera(), {}, image.target()); };
            expectUsage([&] { trace(std::as_const(tree)); }, "tracer was " + empty);
            expectUsage([&] { build.record(recorder); }, "build was " + empty);
            dynamic.emplace(recorder, std::move(tree), DynamicTreeInfo{.emission_scale = model.emissionScale()});
            expectUsage([&] { trace(*dynamic); }, "tracer was " + empty);
        });
    expectUsage([&] { (void)build.isDone(); }, "build was " + empty);
    expectUsage([&] { (void)build.isBroken(); }, "build was " + empty);
    expectUsage([&] { (void)build.take(); }, "build was " + empty);
    expectUsage([&] { (void)build.dropped(); }, "build was " + empty);
    expectUsage([&] { (void)tree.info(); }, "tree was " + empty); // the dynamic tree took it over
    expectUsage([&] { (void)tree.address(); }, "tree was " + empty);
    expectUsage([&] { TreeCompression(host.context, std::move(tree)); }, "tree was " + empty);

    host.finish(other_build);
    Tree octree = other_build.take();
    TreeCompression compression(host.context, std::move(octree));
    expectUsage([&] { (void)octree.info(); }, "tree was " + empty);
    const TreeCompression other_compression(std::move(compression));
    host.frame([&](Recorder& recorder)
               { expectUsage([&] { compression.record(recorder); }, "compression was " + empty); });
    expectUsage([&] { (void)compression.isDone(); }, "compression was " + empty);
    expectUsage([&] { (void)compression.isBroken(); }, "compression was " + empty);
    expectUsage([&] { (void)compression.take(); }, "compression was " + empty);

    DynamicTree other(std::move(*dynamic));
    expectUsage([&] { (void)dynamic->info(); }, "dynamic tree was " + empty);
    expectUsage([&] { (void)dynamic->address(); }, "dynamic tree was " + empty);
    expectUsage([&] { (void)dynamic->needsUpdate(); }, "dynamic tree was " + empty);
    expectUsage([&] { (void)dynamic->takeUpdates(); }, "dynamic tree was " + empty);
    expectUsage([&] { dynamic->setTransform(0, kIdentity); }, "dynamic tree was " + empty);
    expectUsage([&] { dynamic->removeObject(0); }, "dynamic tree was " + empty);
    expectUsage([&] { dynamic->endStroke(); }, "dynamic tree was " + empty);
    expectUsage([&] { host.picture(*dynamic, test::apiCamera()); }, "dynamic tree was " + empty);
    host.frame(
        [&](Recorder& recorder)
        {
            expectUsage([&] { dynamic->addObject(recorder, model, kIdentity); }, "dynamic tree was " + empty);
            expectUsage([&] { dynamic->update(recorder); }, "dynamic tree was " + empty);
            expectUsage([&] { dynamic->undo(recorder); }, "dynamic tree was " + empty);
            expectUsage([&] { dynamic->edit(recorder, {.radius = 1}); }, "dynamic tree was " + empty);
            expectUsage([&] { dynamic->undoEdit(recorder); }, "dynamic tree was " + empty);
        });
    EXPECT_NE(other.address(), 0U);
}

TEST(ApiLifetime, AnEmptyTreeIsAnErrorInC)
{
    test::EmbeddingHost host;
    const Model model = host.upload(description().info());
    ZvoTree handle{host.build(model, buildInfo())};
    const Tree taken = std::move(handle.object);
    ZvoTreeInfo info = ZVO_TREE_INFO_INIT;
    std::uint64_t address = 0;
    EXPECT_EQ(zvoTreeInfo(&handle, &info), ZVO_ERROR_USAGE);
    EXPECT_NE(std::string(zvoLastError()).find("taken over"), std::string::npos) << zvoLastError();
    EXPECT_EQ(zvoTreeAddress(&handle, &address), ZVO_ERROR_USAGE);
    EXPECT_EQ(address, 0U);
}

} // namespace

} // namespace zvo
