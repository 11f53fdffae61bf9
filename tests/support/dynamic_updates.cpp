// SPDX-License-Identifier: MIT
#include "support/dynamic_updates.h"

#include <stdexcept>

namespace zvo::test
{

UpdateReport updateAll(vk::HeadlessDevice& device, DynamicOctree& octree)
{
    for (int attempt = 0; attempt < 64; ++attempt)
    {
        const std::uint64_t frame = octree.beginFrame();
        device.run([&](vk::FrameGraph& graph) { octree.update(graph); });
        const std::vector<UpdateReport> reports = octree.frameDone(frame);
        if (!octree.needsUpdate())
        {
            return reports.empty() ? UpdateReport{} : reports.back();
        }
    }
    throw std::runtime_error("no update succeeded");
}

bool undo(vk::HeadlessDevice& device, DynamicOctree& octree)
{
    const std::uint64_t frame = octree.beginFrame();
    bool shown = false;
    device.run([&](vk::FrameGraph& graph) { shown = octree.undo(graph); });
    octree.frameDone(frame);
    return shown;
}

bool redo(vk::HeadlessDevice& device, DynamicOctree& octree)
{
    const std::uint64_t frame = octree.beginFrame();
    bool shown = false;
    device.run([&](vk::FrameGraph& graph) { shown = octree.redo(graph); });
    octree.frameDone(frame);
    return shown;
}

} // namespace zvo::test
