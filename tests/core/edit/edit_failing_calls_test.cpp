// SPDX-License-Identifier: MIT
// Vulkan calls fail, and memory does not suffice, while a brush is used. An error is thrown, what was shown stays, and
// the octree can be used further.
#include "core/base/kernels.h"
#include "support/ballast.h"
#include "support/device.h"
#include "support/dynamic_scenery.h"
#include "support/dynamic_updates.h"
#include "support/edit_model.h"
#include "support/failing_vulkan.h"
#include "support/sweep.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{
namespace
{

using test::Cell;
using test::DynamicScenery;
using test::DynamicSetting;
using test::EditModel;
using test::Item;
using Kind = test::Placement::Kind;

constexpr std::uint64_t kLimitBytes = 512U << 20;
constexpr std::uint64_t kCallsPerKernel = 3; // module, layout and pipeline
constexpr Item kObject = {0, {Kind::Inside, {1, 1, 1}}};

vk::HeadlessOptions limitedOptions()
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.slices.submission_ms = 0;          // the same calls in every run, even on a busy machine
    options.memory_budget_bytes = kLimitBytes; // makes blocks of memory small
    return options;
}

Brush sphere(BrushAction action, const gpu::ivec3& center, std::uint32_t radius)
{
    return {BrushShape::Sphere, action, center, radius, 0x3080F0};
}

// What happens to a frame in which edit() or update() throws.
enum class AfterError
{
    Lose,
    Submit
};

// Lets the call with this number fail, or also later ones.
using Fail = std::function<void(std::uint64_t)>;

// Runs each frame with edits once for every call in it, which then fails, until the frame succeeds. Everything is
// compared with a model.
class Session
{
public:
    Session(vk::HeadlessDevice& device, DynamicScenery& scenery, const DynamicSetting& setting,
            const HistoryBounds& bounds, AfterError after_error, Fail fail)
        : m_device(device), m_scenery(scenery), m_setting(setting), m_after_error(after_error), m_fail(std::move(fail))
    {
        DynamicOptions options = setting.options(scenery.emissionScale());
        options.edits = bounds;
        m_octree = std::make_unique<DynamicOctree>(device, scenery.buildStatic(setting), options);
        m_cells = cells();
        m_line.emplace_back(setting.grid(), m_cells, true);
    }

    [[nodiscard]] std::uint64_t errorCount() const { return m_error_count; }
    [[nodiscard]] const std::set<std::string>& failedFunctions() const { return m_failed_functions; }
    [[nodiscard]] std::size_t undoCount() const { return m_at; }

    void add(const Item& item)
    {
        m_octree->add(m_scenery.object(item.mesh, true), m_scenery.poseOf(item));
        m_items.insert(item);
    }

    // Undoes strokes, then draws one, in the same frame.
    void stroke(const Brush& brush, std::size_t undo_count = 0)
    {
        bool is_done = false;
        do
        {
            frame(
                [&](vk::FrameGraph& graph)
                {
                    for (std::size_t i = 0; i < undo_count; ++i)
                    {
                        m_octree->undoEdit(graph);
                    }
                    mayThrow([&] { is_done = m_octree->edit(graph, brush); });
                });
            m_at -= undo_count;
            undo_count = 0; // once they are undone
            dropForgotten(is_done);
            ASSERT_LT(++m_frame_count, 500U);
        } while (!is_done);
        m_octree->endStroke();
        m_line.resize(m_at + 1, m_line.front());
        m_line.push_back(m_line[m_at]);
        m_line[++m_at].apply(brush, false);
        expectCells(m_line[m_at].cells());
    }

    void move(bool undo)
    {
        frame([&](vk::FrameGraph& graph)
              { EXPECT_TRUE(undo ? m_octree->undoEdit(graph) : m_octree->redoEdit(graph)); });
        m_at += undo ? -1 : 1;
        expectCells(m_line.at(m_at).cells());
    }

    // Updates until dynamic objects are shown.
    void update()
    {
        do
        {
            frame([&](vk::FrameGraph& graph) { mayThrow([&] { m_octree->update(graph); }); });
            ASSERT_LT(++m_frame_count, 500U);
        } while (m_octree->needsUpdate());
        expectCells(m_line[m_at]
                        .merged(m_setting.merge, m_scenery.rebuilt(m_setting, false, m_items)->cells,
                                m_scenery.rebuilt(m_setting, true, m_items)->cells)
                        .cells());
    }

private:
    std::vector<Cell> cells() { return test::cellsOf(m_device, m_octree->tree()); }

    void expectCells(const std::vector<Cell>& expected)
    {
        EXPECT_EQ(test::difference(cells(), expected), "") << "after " << m_failed;
    }

    // Drops the entries that the octree dropped for room or for a lost frame. A dab has added one.
    void dropForgotten(bool is_done)
    {
        const std::size_t kept = m_octree->edits().undoCount() - (is_done ? 1 : 0);
        ASSERT_LE(kept, m_at);
        m_line.erase(m_line.begin(), m_line.begin() + static_cast<std::ptrdiff_t>(m_at - kept));
        m_at = kept;
    }

    void mayThrow(const std::function<void()>& call)
    {
        if (m_after_error == AfterError::Lose)
        {
            call();
            return;
        }
        try
        {
            call();
        }
        catch (const Error& error)
        {
            noteError(error);
        }
    }

    void noteError(const Error& error)
    {
        EXPECT_NE(test::failedFunction(), "") << error.what();
        m_failed_functions.insert(test::failedFunction());
        ++m_error_count;
        m_has_failed = true;
    }

    void frame(const std::function<void(vk::FrameGraph&)>& record)
    {
        std::vector<std::vector<Cell>> seen; // after lost frames that had run
        for (std::uint64_t number = m_sweep.first();; number += m_sweep.step())
        {
            const std::vector<vk::Buffer> full = test::freeMemoryTaken(m_device);
            const std::size_t undo_count = m_octree->edits().undoCount();
            const std::uint64_t frame = m_octree->beginFrame();
            bool is_lost = false;
            m_has_failed = false;
            m_fail(number);
            try
            {
                m_device.run(
                    [&](vk::FrameGraph& graph)
                    {
                        record(graph);
                        if (!test::failedFunction().empty() &&
                            !m_has_failed) // the frame went on with another memory type
                        {
                            throw Error(ErrorCode::Other, "the frame is lost");
                        }
                    });
            }
            catch (const Error& error)
            {
                noteError(error);
                is_lost = true;
            }
            m_failed = test::failedFunction();
            const std::uint64_t
                kernel_count = // kernels that were made stay, so the next attempt makes no calls for them
                test::callCount("vkCreateComputePipelines") - (m_failed == "vkCreateComputePipelines" ? 1 : 0);
            test::failCall(UINT64_MAX);
            if (is_lost)
            {
                m_octree->frameLost();
                EXPECT_EQ(m_octree->edits().undoCount(), undo_count);
            }
            else
            {
                m_octree->frameDone(frame);
                if (!m_has_failed)
                {
                    break;
                }
            }
            number -= kCallsPerKernel * kernel_count;
            if (!seen.empty() || (is_lost && (m_failed == "vkWaitForFences" || m_failed == "vkGetQueryPoolResults")))
            {
                seen.push_back(cells());
            }
            else
            {
                expectCells(m_cells);
            }
        }
        const std::vector<Cell> before = std::exchange(m_cells, cells());
        for (const std::vector<Cell>& one : seen)
        {
            EXPECT_TRUE(one == before || one == m_cells) << test::difference(one, before);
        }
    }

    vk::HeadlessDevice& m_device;
    DynamicScenery& m_scenery;
    DynamicSetting m_setting;
    AfterError m_after_error;
    Fail m_fail;
    test::Sweep m_sweep;
    std::unique_ptr<DynamicOctree> m_octree;
    std::multiset<Item> m_items;
    std::vector<Cell> m_cells; // shown now
    std::vector<EditModel> m_line;
    std::size_t m_at = 0;
    std::string m_failed;
    bool m_has_failed = false; // in this frame
    std::set<std::string> m_failed_functions;
    std::uint64_t m_error_count = 0;
    std::uint32_t m_frame_count = 0;
};

void play(Session& session, bool loses)
{
    session.stroke(sphere(BrushAction::Carve, {10, 8, 6}, 2));
    session.stroke(sphere(BrushAction::Fill, {4, 5, 6}, 1));
    session.stroke(sphere(BrushAction::Paint, {9, 9, 9}, 5)); // larger than the room so far
    if (loses && session.undoCount() > 1) // if a frame with an error were submitted, undo would happen twice
    {
        session.stroke(sphere(BrushAction::Fill, {8, 3, 6}, 3), 2);
    }
    session.add(kObject);
    session.update();
    session.stroke(sphere(BrushAction::Carve, {8, 8, 8}, 6));
    session.update();
    if (session.undoCount() != 0)
    {
        session.move(true);
        session.update();
        session.move(false);
        session.update();
    }
}

TEST(EditFailingCalls, AnyOneOfAFrameIsAnErrorAndTheOctreeGoesOn)
{
    test::failCall(UINT64_MAX);
    test::countNames(false);
    std::set<std::string> failed;
    std::uint64_t error_count = 0;
    for (const AfterError after_error : {AfterError::Lose, AfterError::Submit})
    {
        SCOPED_TRACE(after_error == AfterError::Lose ? "lost" : "submitted");
        {
            vk::HeadlessOptions options = limitedOptions();
            options.get_instance_proc_addr = test::failingVulkan();
            vk::HeadlessDevice device(options, zvoKernels());
            const std::uint64_t used_before = device.device().memory().usedBytes();
            for (const std::uint64_t bytes_max : {UINT64_MAX, std::uint64_t{0}})
            {
                SCOPED_TRACE(bytes_max);
                const bool fails_on = bytes_max == 0 && after_error == AfterError::Lose;
                DynamicScenery scenery(device, true);
                Session session(device, scenery, {.depth = 4, .compressed = bytes_max == 0},
                                {.entries_max = 8, .bytes_max = bytes_max}, after_error,
                                [&](std::uint64_t number)
                                {
                                    fails_on ? test::failAllFrom(number, VK_ERROR_DEVICE_LOST)
                                             : test::failCall(number, VK_ERROR_OUT_OF_DEVICE_MEMORY);
                                });
                play(session, after_error == AfterError::Lose);
                failed.insert(session.failedFunctions().begin(), session.failedFunctions().end());
                error_count += session.errorCount();
            }
            EXPECT_EQ(device.device().memory().usedBytes(), used_before);
        }
        EXPECT_TRUE(test::liveObjects().empty()) << test::liveObjects().front();
    }
    test::countNames(true);
    test::expectFramesSwept(failed, error_count);
}

// Memory is less than a stroke needs; every allocation fails in turn, and the frame is lost or submitted.
TEST(EditFailingCalls, WithoutMemoryWhatWasShownStaysShown)
{
    vk::HeadlessDevice limited(limitedOptions(), zvoKernels());
    DynamicScenery scenery(limited, true);
    const DynamicSetting setting = {.depth = 6};
    std::set<std::string> needs;
    std::size_t success_count = 0;
    std::size_t number = 0;
    for (std::uint64_t room = 4096; room < 32U << 20; room += room / 4)
    {
        SCOPED_TRACE(room);
        DynamicOctree octree(limited, scenery.buildStatic(setting), setting.options(scenery.emissionScale()));
        const auto cells = [&] { return test::cellsOf(limited, octree.tree()); };
        EditModel model(setting.grid(), cells(), true);
        const bool loses = number++ % 2 != 0;
        const auto stroke = [&](const Brush& brush)
        {
            const std::uint64_t frame = octree.beginFrame();
            std::string failure;
            limited.run(
                [&](vk::FrameGraph& graph)
                {
                    try
                    {
                        EXPECT_TRUE(octree.edit(graph, brush));
                    }
                    catch (const Error& error)
                    {
                        EXPECT_EQ(error.code(), ErrorCode::Memory);
                        failure = error.what();
                    }
                });
            loses && !failure.empty() ? octree.frameLost() : void(octree.frameDone(frame));
            octree.endStroke();
            if (failure.empty())
            {
                model.apply(brush, false);
            }
            return failure;
        };
        EXPECT_EQ(stroke(sphere(BrushAction::Carve, {20, 16, 12}, 2)), "");
        std::optional<vk::Buffer> left(std::in_place, limited.device(), "room", room);
        auto rest = test::ballast(limited, 0);
        left.reset();
        for (int i = 0; i < 3; ++i)
        {
            const std::string failure = stroke(sphere(BrushAction::Fill, {20, 6 * i, 12}, 3 + 6 * i));
            if (!failure.empty())
            {
                EXPECT_NE(failure.find("but the limit is 536870912: raise the limit"), std::string::npos) << failure;
                needs.insert(failure.substr(0, failure.find(" needs ")));
            }
            success_count += failure.empty() ? 1 : 0;
        }
        rest.clear();
        EXPECT_EQ(test::difference(cells(), model.cells()), "");
        EXPECT_EQ(stroke(sphere(BrushAction::Carve, {16, 16, 16}, 9)), "");
        EXPECT_EQ(test::difference(cells(), model.cells()), "");
        for (std::size_t undo_count = octree.edits().undoCount(); undo_count-- > 0;)
        {
            test::runFrame(limited, octree, [&](vk::FrameGraph& graph) { EXPECT_TRUE(octree.undoEdit(graph)); });
        }
        EXPECT_EQ(test::difference(cells(), scenery.rebuilt(setting, true, {})->cells), "");
    }
    EXPECT_TRUE(needs.contains("room for overlays"));
    EXPECT_TRUE(needs.contains("making room for edits"));
    EXPECT_GT(success_count, 10U);
}

} // namespace
} // namespace zvo
