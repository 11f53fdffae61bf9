// SPDX-License-Identifier: MIT
// Dynamic models and brushes, as a host uses them.
#include "api_scene.h"

#include <gtest/gtest.h>

namespace zvo
{

namespace
{

class ApiDynamic : public testing::Test
{
protected:
    // A picture of everything built as one model, which a dynamic tree must equal.
    std::vector<std::uint32_t> rebuilt(float x)
    {
        Scene scene = test::apiScene();
        Scene moving = test::sphereScene(glm::vec3(0), 2.0F, 9);
        for (Instance& instance : moving.instances)
        {
            instance.transform[3] = {x, 5, 5, 1};
        }
        scene.append(std::move(moving));
        const test::HostModel model(scene);
        const Tree tree = m_host.build(m_host.upload(model.info()), {.grid = test::apiGrid()});
        return m_host.picture(tree, test::apiCamera());
    }

    Tree fixedTree(bool as_dag)
    {
        const test::HostModel model(test::apiScene());
        const Model uploaded = m_host.upload(model.info());
        m_scale = uploaded.emissionScale();
        Tree tree = m_host.build(uploaded, {.grid = test::apiGrid(), .keep_sums = true});
        return as_dag ? m_host.compress(std::move(tree)) : std::move(tree);
    }

    Model ball()
    {
        const test::HostModel model(test::sphereScene(glm::vec3(0), 2.0F, 9));
        ModelInfo info = model.info();
        info.emission_scale = m_scale;
        return m_host.upload(info);
    }

    DynamicTree dynamicTree(Tree&& fixed, std::size_t history_entries = 8)
    {
        DynamicTreeInfo info;
        info.merge = MergeRule::Average;
        info.history_entries = history_entries;
        info.emission_scale = m_scale;
        return m_host.make<DynamicTree>(std::move(fixed), info);
    }

    test::EmbeddingHost m_host;
    float m_scale = 0;
};

TEST_F(ApiDynamic, EqualsARebuildAndUndoEqualsBefore)
{
    for (const bool as_dag : {false, true})
    {
        DynamicTree tree = dynamicTree(fixedTree(as_dag));
        const std::uint64_t address = tree.address();
        const auto still = m_host.picture(tree, test::apiCamera());
        const Model model = ball();
        const DynamicObjectId object = m_host.add(tree, model, test::movedBy(2, 5, 5));
        std::vector<std::vector<std::uint32_t>> pictures = {still};
        for (const float x : {2.0F, 4.5F, 8.25F})
        {
            tree.setTransform(object, test::movedBy(x, 5, 5));
            m_host.update(tree);
            pictures.push_back(m_host.picture(tree, test::apiCamera()));
            EXPECT_EQ(pictures.back(), rebuilt(x)) << x << (as_dag ? " above a DAG" : " above an octree");
        }
        const std::vector<UpdateStats> stats = tree.takeUpdates();
        ASSERT_GE(stats.size(), 3U);
        EXPECT_FALSE(stats.back().failed);
        EXPECT_GT(stats.back().moving_count, 100U);
        for (const std::size_t step : {2U, 1U})
        {
            m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.undo(recorder)); });
            EXPECT_EQ(m_host.picture(tree, test::apiCamera()), pictures[step]);
        }
        m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.redo(recorder)); });
        EXPECT_EQ(m_host.picture(tree, test::apiCamera()), pictures[2]);
        tree.removeObject(object);
        m_host.update(tree);
        EXPECT_EQ(m_host.picture(tree, test::apiCamera()), still);
        EXPECT_EQ(tree.address(), address);
        EXPECT_THROW(tree.setTransform(object, kIdentity), Error);
    }
}

// A ball that carves goes by. The voxels that it takes come back.
TEST_F(ApiDynamic, ObjectsThatCarveLeaveNoTrace)
{
    DynamicTree tree = dynamicTree(fixedTree(false));
    const auto before = m_host.picture(tree, test::apiCamera());
    const Model model = ball();
    const Mat4 large = {3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 0, 5, 5, 5, 1};
    DynamicObjectId object = 0;
    m_host.frame([&](Recorder& recorder)
                 { object = tree.addObject(recorder, model, large, {.carves = true, .fill = Fill::Solid}); });
    m_host.update(tree);
    EXPECT_NE(m_host.picture(tree, test::apiCamera()), before);
    EXPECT_EQ(tree.takeUpdates().back().moving_count, 0U);
    tree.setTransform(object, test::movedBy(4.5, 50, 5));
    m_host.update(tree);
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), before);
}

TEST_F(ApiDynamic, BrushesChangeWhatStandsAndAreUndone)
{
    DynamicTree tree = dynamicTree(fixedTree(false));
    const auto before = m_host.picture(tree, test::apiCamera());
    const BrushInfo brush = {.action = BrushAction::Fill, .center = {44, 44, 44}, .radius = 9, .color = 0x2080ff};
    m_host.edit(tree, brush);
    tree.endStroke();
    const auto after = m_host.picture(tree, test::apiCamera());
    EXPECT_NE(after, before);
    m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.undoEdit(recorder)); });
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), before);
    m_host.frame([&](Recorder& recorder) { EXPECT_FALSE(tree.undoEdit(recorder)); });
    m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.redoEdit(recorder)); });
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), after);
}

// A filled ball is added and taken away: difference and union of what rays see, and undo.
TEST_F(ApiDynamic, StampsAddAndTakeTheVoxelsOfAnOctree)
{
    DynamicTree tree = dynamicTree(fixedTree(false));
    const Tree solid = m_host.build(ball(), {.grid = {{-2.5F, -2.5F, -2.5F}, 0.16F, 5}, .fill = Fill::Solid});
    const auto before = m_host.picture(tree, test::apiCamera());
    const std::array<std::int32_t, 3> offset = {29, 33, 38};
    const auto stamp = [&](const std::array<std::int32_t, 3>& at, BrushAction action)
    {
        m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.stamp(recorder, solid, at, action)); });
        tree.endStroke();
        return m_host.picture(tree, test::apiCamera());
    };
    const auto filled = stamp(offset, BrushAction::Fill);
    EXPECT_NE(filled, before);
    EXPECT_EQ(stamp(offset, BrushAction::Fill), filled);
    EXPECT_EQ(stamp({INT32_MAX, 0, INT32_MIN}, BrushAction::Carve), filled);
    const auto carved = stamp(offset, BrushAction::Carve);
    EXPECT_NE(carved, filled);
    EXPECT_EQ(stamp(offset, BrushAction::Carve), carved);
    m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.undoEdit(recorder)); });
    m_host.frame([&](Recorder& recorder) { EXPECT_TRUE(tree.undoEdit(recorder)); });
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), filled);
    m_host.frame([&](Recorder& recorder)
                 { EXPECT_THROW(tree.stamp(recorder, solid, offset, BrushAction::Paint), Error); });
    const Tree large = m_host.build(ball(), {.grid = {{-2.5F, -2.5F, -2.5F}, 0.02F, 8}});
    m_host.frame([&](Recorder& recorder)
                 { EXPECT_THROW(tree.stamp(recorder, large, offset, BrushAction::Carve), Error); });
}

// What is inside of a ball is what its surface encloses.
TEST_F(ApiDynamic, AlgebraMakesTreesOfOthers)
{
    TreeBuildInfo info = {.grid = {{-2.5F, -2.5F, -2.5F}, 0.16F, 5}};
    const Tree shell = m_host.build(ball(), info);
    info.fill = Fill::Solid;
    const Tree solid = m_host.build(ball(), info);
    const auto made = [&](const Tree& tree, const Tree* other, const TreeAlgebraInfo& what)
    {
        std::optional<TreeAlgebra> job;
        m_host.frame([&](Recorder& recorder) { job.emplace(recorder, tree, other, what); });
        m_host.finish(*job);
        return job->take();
    };
    const auto isWithin = [&](const Tree& inner, const Tree& outer)
    { return made(inner, &outer, {.operation = TreeOperation::Subtract}).info().voxel_count == 0; };
    const std::uint64_t surface = shell.info().voxel_count;
    const Tree enclosed = made(shell, nullptr, {.operation = TreeOperation::Enclose});
    EXPECT_TRUE(isWithin(enclosed, solid) && isWithin(solid, enclosed));
    EXPECT_FALSE(isWithin(solid, shell));
    const Tree united = made(shell, &solid, {.operation = TreeOperation::Unite});
    EXPECT_TRUE(isWithin(united, solid) && isWithin(solid, united));
    EXPECT_EQ(made(shell, &solid, {.operation = TreeOperation::Intersect}).info().voxel_count, surface);
    TreeAlgebraInfo keep = {.operation = TreeOperation::Keep, .corners = true, .largest = 1};
    EXPECT_EQ(made(shell, nullptr, keep).info().voxel_count, surface);
    keep.largest = 0;
    keep.least_voxels = surface + 1;
    EXPECT_EQ(made(shell, nullptr, keep).info().voxel_count, 0U);
    const Tree wide = made(solid, nullptr, {.operation = TreeOperation::Dilate, .voxels = 2});
    EXPECT_TRUE(isWithin(solid, wide) && !isWithin(wide, solid));
    const Tree again = made(wide, nullptr, {.operation = TreeOperation::Erode, .voxels = 2});
    EXPECT_TRUE(isWithin(solid, again) && isWithin(again, wide) && !isWithin(wide, again));
    const auto refused = [&](const Tree& tree, const Tree* other, TreeOperation operation)
    {
        m_host.frame([&](Recorder& recorder)
                     { EXPECT_THROW(TreeAlgebra(recorder, tree, other, {.operation = operation}), Error); });
    };
    refused(shell, nullptr, TreeOperation::Unite);
    refused(shell, &solid, TreeOperation::Erode);
    refused(shell, &solid, static_cast<TreeOperation>(7));
    info.grid.voxel_size = 0.17F;
    const Tree elsewhere = m_host.build(ball(), info);
    refused(shell, &elsewhere, TreeOperation::Unite);
    const Tree dag = m_host.compress(m_host.build(ball(), {.grid = shell.info().grid}));
    refused(dag, nullptr, TreeOperation::Dilate);
}

TEST_F(ApiDynamic, ALostFrameTakesNothingAlong)
{
    DynamicTree tree = dynamicTree(fixedTree(false));
    const Model model = ball();
    const DynamicObjectId object = m_host.add(tree, model, test::movedBy(2, 5, 5));
    m_host.update(tree);
    const auto before = m_host.picture(tree, test::apiCamera());
    tree.setTransform(object, test::movedBy(8.25F, 5, 5));
    m_host.lostFrame([&](Recorder& recorder) { tree.update(recorder); });
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), before);
    EXPECT_TRUE(tree.needsUpdate());
    m_host.update(tree);
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), rebuilt(8.25F));
}

TEST_F(ApiDynamic, AnObjectOfALostFrameIsLostAlone)
{
    DynamicTree tree = dynamicTree(fixedTree(false));
    const Model model = ball();
    m_host.update(tree);
    const auto before = m_host.picture(tree, test::apiCamera());
    DynamicObjectId lost = 0;
    DynamicObjectId removed = 0;
    m_host.lostFrame(
        [&](Recorder& recorder)
        {
            lost = tree.addObject(recorder, model, test::movedBy(2, 5, 5));
            removed = tree.addObject(recorder, model, test::movedBy(3, 5, 5));
            tree.update(recorder);
            tree.removeObject(removed);
        });
    m_host.update(tree);
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), before);
    EXPECT_THROW(tree.setTransform(lost, test::movedBy(4, 5, 5)), Error);
    EXPECT_THROW(tree.removeObject(lost), Error);
    EXPECT_THROW(tree.removeObject(removed), Error);

    const DynamicObjectId object = m_host.add(tree, model, test::movedBy(2, 5, 5));
    m_host.lostFrame([&](Recorder& recorder) { tree.update(recorder); }); // the object was made in an earlier frame
    tree.setTransform(object, test::movedBy(8.25F, 5, 5));
    m_host.update(tree);
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), rebuilt(8.25F));
}

TEST_F(ApiDynamic, WhatWasMadeInALostFrameIsLost)
{
    const test::HostModel description(test::apiScene());
    std::optional<Model> lost;
    m_host.lostFrame([&](Recorder& recorder) { lost.emplace(recorder, description.info()); });
    EXPECT_THROW(m_host.build(*lost, {.grid = test::apiGrid()}), Error);

    const Model model = m_host.upload(description.info());
    TreeBuild build(m_host.context, model, {.grid = test::apiGrid()});
    std::uint32_t steps = 0;
    for (; !build.isDone(); ++steps) // each step is lost once
    {
        m_host.lostFrame([&](Recorder& recorder) { build.record(recorder); });
        m_host.frame([&](Recorder& recorder) { build.record(recorder); });
    }
    EXPECT_GE(steps, 4U);
    Tree tree = build.take();
    const Tree other = m_host.build(model, {.grid = test::apiGrid()});
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), m_host.picture(other, test::apiCamera()));

    std::optional<DynamicTree> dynamic;
    m_host.lostFrame(
        [&](Recorder& recorder)
        { dynamic.emplace(recorder, std::move(tree), DynamicTreeInfo{.emission_scale = model.emissionScale()}); });
    EXPECT_THROW(m_host.picture(*dynamic, test::apiCamera()), Error);
}

TEST_F(ApiDynamic, FramesInFlightKeepWhatTheyUse)
{
    DynamicTree tree = dynamicTree(fixedTree(false), 1);
    const Model model = ball();
    const DynamicObjectId object = m_host.add(tree, model, test::movedBy(2, 5, 5));
    Tracer tracer(m_host.context, m_host.kWidth, m_host.kHeight, VK_FORMAT_R8G8B8A8_UNORM);
    test::TargetImage image(m_host.device, VK_FORMAT_R8G8B8A8_UNORM, m_host.kWidth, m_host.kHeight);
    std::uint64_t frame = m_host.last_frame;
    for (int i = 0; i < 12; ++i) // two are under way at a time
    {
        VkCommandBuffer commands = m_host.device.begin();
        {
            Recorder recorder(m_host.context, commands, ++frame);
            tree.setTransform(object, test::movedBy(2.0F + 0.5F * static_cast<float>(i), 5, 5));
            tree.update(recorder);
            image.beginCopies(commands);
            tracer.trace(recorder, tree, test::apiCamera(), {}, image.target());
            image.read(commands);
        }
        m_host.device.submit(commands);
        if (i % 2 == 1)
        {
            m_host.device.wait();
            m_host.context.frameDone(frame);
        }
    }
    m_host.last_frame = frame;
    m_host.update(tree);
    EXPECT_EQ(m_host.picture(tree, test::apiCamera()), rebuilt(7.5F));
}

} // namespace

} // namespace zvo
