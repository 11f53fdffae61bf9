// SPDX-License-Identifier: MIT
#include "support/dynamic_updates.h"

#include <stdexcept>

namespace zvo::test
{

std::vector<UpdateReport> runFrame(vk::HeadlessDevice& device, DynamicOctree& octree,
                                   const std::function<void(vk::FrameGraph&)>& record)
{
    const std::uint64_t frame = octree.beginFrame();
    return octree.frameDone(frame, device.run(record));
}

UpdateReport updateAll(vk::HeadlessDevice& device, DynamicOctree& octree)
{
    for (int attempt = 0; attempt < 64; ++attempt)
    {
        const std::vector<UpdateReport> reports =
            runFrame(device, octree, [&](vk::FrameGraph& graph) { octree.update(graph); });
        if (!octree.needsUpdate())
        {
            return reports.empty() ? UpdateReport{} : reports.back();
        }
    }
    throw std::runtime_error("no update succeeded");
}

bool undo(vk::HeadlessDevice& device, DynamicOctree& octree)
{
    bool shown = false;
    runFrame(device, octree, [&](vk::FrameGraph& graph) { shown = octree.undo(graph); });
    return shown;
}

bool redo(vk::HeadlessDevice& device, DynamicOctree& octree)
{
    bool shown = false;
    runFrame(device, octree, [&](vk::FrameGraph& graph) { shown = octree.redo(graph); });
    return shown;
}

} // namespace zvo::test
