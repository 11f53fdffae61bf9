// SPDX-License-Identifier: MIT
#pragma once

#include "support/dynamic_scenery.h"
#include "support/dynamic_updates.h"

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace zvo::test
{

/// A dynamic octree of the scenery. Each update, undo and redo takes a frame, which is waited for.
class DynamicWorld
{
public:
    DynamicWorld(vk::HeadlessDevice& device, const DynamicSetting& setting,
                 const HistoryBounds& history = {16, UINT64_MAX})
        : m_device(device), m_setting(setting), m_scenery(device, true)
    {
        DynamicOptions options = setting.options(m_scenery.emissionScale());
        options.history = history;
        m_octree = std::make_unique<DynamicOctree>(device, m_scenery.buildStatic(setting), options);
    }

    [[nodiscard]] DynamicOctree& octree() { return *m_octree; }
    [[nodiscard]] DynamicScenery& scenery() { return m_scenery; }
    [[nodiscard]] const DynamicSetting& setting() const { return m_setting; }

    DynamicObjectId add(const Item& item)
    {
        return m_octree->add(m_scenery.object(item.mesh, true), m_scenery.poseOf(item));
    }
    void setPose(DynamicObjectId object, const Item& item) { m_octree->setPose(object, m_scenery.poseOf(item)); }

    UpdateReport update() { return updateAll(m_device, *m_octree); }
    [[nodiscard]] bool undo() { return test::undo(m_device, *m_octree); }
    [[nodiscard]] bool redo() { return test::redo(m_device, *m_octree); }

    /// The cells that are shown.
    [[nodiscard]] std::vector<Cell> shown() { return cellsOf(m_device, m_octree->tree()); }

    /// The octree of these objects and the static part, made anew.
    [[nodiscard]] std::shared_ptr<const Rebuilt> rebuilt(const std::multiset<Item>& items)
    {
        return m_scenery.rebuilt(m_setting, true, items);
    }

    /// How the cells that are shown differ from others, or from those of a rebuild; empty where they do not.
    [[nodiscard]] std::string differenceFrom(const std::vector<Cell>& cells) { return difference(shown(), cells); }
    [[nodiscard]] std::string differenceFromRebuilt(const std::multiset<Item>& items)
    {
        return differenceFrom(rebuilt(items)->cells);
    }

private:
    vk::HeadlessDevice& m_device;
    DynamicSetting m_setting;
    DynamicScenery m_scenery;
    std::unique_ptr<DynamicOctree> m_octree;
};

} // namespace zvo::test
