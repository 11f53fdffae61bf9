// SPDX-License-Identifier: MIT
// Vulkan calls fail while dynamic objects are added, moved and shown. An error is thrown, what was shown stays, and the
// octree can be used further.
#include "core/base/kernels.h"
#include "core/dynamic/dynamic_octree.h"
#include "support/ballast.h"
#include "support/device.h"
#include "support/dynamic_scenery.h"
#include "support/failing_vulkan.h"
#include "support/sweep.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
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
using test::Item;
using Kind = test::Placement::Kind;

constexpr Item kRigid = {0, {Kind::Inside, {1, 1, 1}}};
constexpr Item kApart = {0, {Kind::Mirrored, {2, 0, 2}}};
constexpr Item kBent = {4, {Kind::Turned, {0, 2, 1}}, 3};

vk::HeadlessOptions options()
{
    vk::HeadlessOptions options = test::deviceOptions();
    options.get_instance_proc_addr = test::failingVulkan();
    options.slices.submission_ms = 0;         // the same calls in every run, even on a busy machine
    options.memory_budget_bytes = 512U << 20; // makes blocks of memory small
    return options;
}

// Runs each frame of an octree once for every call in it, which then fails, until the frame succeeds. Everything is
// compared with octrees that are made anew.
class Session
{
public:
    // fail: test::failCall or failAllFrom.
    Session(vk::HeadlessDevice& device, DynamicScenery& scenery, const DynamicSetting& setting,
            const std::function<void(std::uint64_t)>& fail)
        : m_device(device), m_scenery(scenery), m_setting(setting), m_fail(fail)
    {
        const DynamicOptions options = setting.options(scenery.emissionScale());
        m_octree = std::make_unique<DynamicOctree>(device, scenery.buildStatic(setting), options);
        m_cells = cells();
        m_entries = {{{}, m_cells}};
    }

    DynamicObjectId add(const Item& item)
    {
        const std::shared_ptr<const DynamicMesh> mesh = m_scenery.object(item.mesh, true);
        DynamicObjectId id = 0;
        for (std::uint64_t number = m_sweep.first();
             !succeeds(number, [&] { id = m_octree->add(mesh, m_scenery.poseOf(item)); }); number += m_sweep.step())
        {
            expectCells(m_cells);
        }
        m_items[id] = item;
        return id;
    }

    void setPose(DynamicObjectId object, const Item& item)
    {
        m_octree->setPose(object, m_scenery.poseOf(item));
        m_items[object] = item;
    }

    void remove(DynamicObjectId object)
    {
        m_octree->remove(object);
        m_items.erase(object);
    }

    // Updates until everything is shown.
    void update()
    {
        do
        {
            frame([&](vk::FrameGraph& graph) { m_octree->update(graph); });
            ASSERT_LT(++m_frame_count, 500U);
        } while (m_octree->needsUpdate());
        std::multiset<Item> items;
        for (const auto& [id, item] : m_items)
        {
            items.insert(item);
        }
        expectCells(m_scenery.rebuilt(m_setting, true, items)->cells);
        m_entries.resize(m_current + 1);
        m_entries.push_back({m_items, m_cells});
        ++m_current;
        while (m_octree->history().undoCount() < m_current && m_current > 1) // dropped for lack of memory
        {
            m_entries.erase(m_entries.begin() + 1);
            --m_current;
        }
        EXPECT_EQ(m_octree->history().undoCount(), m_current);
    }

    void undo()
    {
        frame([&](vk::FrameGraph& graph) { EXPECT_TRUE(m_octree->undo(graph)); });
        show(m_current - 1);
    }

    void redo()
    {
        frame([&](vk::FrameGraph& graph) { EXPECT_TRUE(m_octree->redo(graph)); });
        show(m_current + 1);
    }

    [[nodiscard]] std::size_t undoCount() const { return m_current; }
    [[nodiscard]] std::uint64_t errorCount() const { return m_error_count; }
    [[nodiscard]] const std::set<std::string>& failedFunctions() const { return m_failed_functions; }

private:
    struct Entry
    {
        std::map<DynamicObjectId, Item> items;
        std::vector<Cell> cells;
    };

    std::vector<Cell> cells() { return test::cellsOf(m_device, m_octree->tree()); }

    void expectCells(const std::vector<Cell>& expected)
    {
        EXPECT_EQ(test::difference(cells(), expected), "") << "after " << m_failed;
    }

    void show(std::size_t step)
    {
        m_current = step;
        m_items = m_entries.at(step).items;
        expectCells(m_entries.at(step).cells);
    }

    // Calls call() while the Vulkan call with this number fails. Returns whether it succeeded.
    bool succeeds(std::uint64_t number, const std::function<void()>& call)
    {
        const std::vector<vk::Buffer> full = test::freeMemoryTaken(m_device);
        m_fail(number);
        bool result = true;
        try
        {
            call();
        }
        catch (const Error& error)
        {
            EXPECT_NE(test::failedFunction(), "") << error.what();
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            m_failed_functions.insert(test::failedFunction());
            ++m_error_count;
            result = false;
        }
        m_failed = test::failedFunction();
        test::failCall(UINT64_MAX);
        return result;
    }

    void frame(const std::function<void(vk::FrameGraph&)>& record)
    {
        std::vector<std::vector<Cell>> seen; // after frames that failed when they had run
        bool has_restarted = false;
        for (std::uint64_t number = m_sweep.first();; number += m_sweep.step())
        {
            const RootHistory& history = m_octree->history();
            const auto counts = std::pair(history.undoCount(), history.redoCount());
            const std::uint64_t frame = m_octree->beginFrame();
            if (succeeds(number, [&] { m_device.run(record); }))
            {
                m_octree->frameDone(frame);
                if (m_failed.empty() || !m_octree->needsUpdate())
                {
                    break;
                }
                expectCells(m_cells); // the update waits for memory
                continue;
            }
            m_octree->frameLost();
            if (!has_restarted && m_failed == "vkCreateShaderModule") // other things were made, which are kept: fewer
            {                                                         // calls come before this
                has_restarted = true;
                number = 0;
            }
            EXPECT_EQ(std::pair(history.undoCount(), history.redoCount()), counts);
            if (!seen.empty() || m_failed == "vkWaitForFences" || m_failed == "vkGetQueryPoolResults")
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
            EXPECT_TRUE(one == before || one == m_cells);
        }
    }

    vk::HeadlessDevice& m_device;
    DynamicScenery& m_scenery;
    DynamicSetting m_setting;
    std::function<void(std::uint64_t)> m_fail;
    test::Sweep m_sweep;
    std::unique_ptr<DynamicOctree> m_octree;
    std::map<DynamicObjectId, Item> m_items;
    std::vector<Cell> m_cells; // shown now
    std::vector<Entry> m_entries;
    std::size_t m_current = 0; // index in m_steps
    std::string m_failed;
    std::set<std::string> m_failed_functions;
    std::uint64_t m_error_count = 0;
    std::uint32_t m_frame_count = 0;
};

void play(Session& session)
{
    const DynamicObjectId rigid = session.add(kRigid);
    session.update();
    const DynamicObjectId bent = session.add(kBent);
    session.setPose(rigid, kApart);
    session.update();
    session.undo();
    session.undo();
    session.redo();
    session.redo();
    session.remove(bent);
    session.update();
    session.setPose(rigid, kRigid);
    session.update();
    session.remove(rigid);
    session.update(); // shows the static octree
    while (session.undoCount() != 0)
    {
        session.undo();
    }
}

TEST(DynamicFailingCalls, AnyOneOfAFrameIsAnErrorAndTheOctreeGoesOn)
{
    test::failCall(UINT64_MAX);
    test::countNames(false);
    std::set<std::string> failed;
    std::uint64_t error_count = 0;
    {
        vk::HeadlessDevice device(options(), zvoKernels());
        const std::uint64_t used_before = device.device().memory().usedBytes();
        for (const bool fails_on : {false, true})
        {
            SCOPED_TRACE(fails_on);
            const auto fail = [&](std::uint64_t number) {
                fails_on ? test::failAllFrom(number, VK_ERROR_DEVICE_LOST)
                         : test::failCall(number, VK_ERROR_OUT_OF_DEVICE_MEMORY);
            };
            DynamicScenery scenery(device, true);
            Session session(device, scenery, {.depth = 4, .minimal_capacities = true}, fail);
            play(session);
            failed.insert(session.failedFunctions().begin(), session.failedFunctions().end());
            error_count += session.errorCount();
        }
        EXPECT_EQ(device.device().memory().usedBytes(), used_before);
    }
    EXPECT_TRUE(test::liveObjects().empty()) << test::liveObjects().front();
    test::countNames(true);
    test::expectFramesSwept(failed, error_count);
}

} // namespace
} // namespace zvo
