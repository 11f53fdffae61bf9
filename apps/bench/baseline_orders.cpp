// SPDX-License-Identifier: MIT
#include "baseline/node_order.h"
#include "bench/baseline_comparisons.h"
#include "common/report.h"
#include "core/dynamic/dynamic_octree.h"
#include "core/tree/tree_data.h"
#include "io/scene/animated_scene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

using baseline::NodeOrder;

// zvo's octree in some order of nodes, into which objects may be merged.
class OrderedOctree
{
public:
    // geometry: without attributes.
    OrderedOctree(BaselineSubject& subject, const TreeData& geometry, NodeOrder order, const AnimatedScene* animated)
        : m_device(subject.device()), m_animated(animated),
          m_octree(subject.device(), uploadTree(subject.device(), inOrder(geometry, order)), dynamicOptions(subject)),
          m_tracer(subject.device().device())
    {
        if (m_animated != nullptr)
        {
            for (const DynamicObject& object : m_animated->objects)
            {
                m_objects.push_back(
                    m_octree.add(uploadDynamicMesh(m_device, *object.scene, false, 0.0F), poseAt(object, 0.0)));
            }
            updateMs(0.0);
        }
        m_tracer.resize(kBaselineWidth, kBaselineHeight);
        m_rays = std::make_unique<PrimaryRays>(m_device, m_octree.tree(), subject.camera(), m_tracer);
    }

    double raysMs() { return sumMs(m_rays->trace()); }

    // Milliseconds of the update that shows a time of the animated scene.
    double updateMs(double seconds)
    {
        for (std::size_t i = 0; i < m_objects.size(); ++i)
        {
            m_octree.setPose(m_objects[i], poseAt(m_animated->objects[i], seconds));
        }
        std::vector<vk::PassTime> passes;
        do // where room is missing, the update begins anew
        {
            const std::uint64_t frame = m_octree.beginFrame();
            passes = m_device.run([&](vk::FrameGraph& graph) { m_octree.update(graph); });
            m_octree.frameDone(frame, passes);
        } while (m_octree.needsUpdate());
        return sumMs(passes);
    }

private:
    static DynamicOptions dynamicOptions(const BaselineSubject& subject)
    {
        DynamicOptions options;
        options.coverage = subject.options().coverage;
        options.merge = MergeRule::DynamicWins;
        options.attributes = false;
        options.emission_scale = 0.0F;
        return options;
    }

    vk::HeadlessDevice& m_device;
    const AnimatedScene* m_animated;
    DynamicOctree m_octree;
    std::vector<DynamicObjectId> m_objects;
    TreeTracer m_tracer;
    std::unique_ptr<PrimaryRays> m_rays;
};

} // namespace

void compareOrders(BaselineSubject& subject, const AnimatedScene* animated, BaselineRows& rows)
{
    constexpr std::pair<NodeOrder, const char*> kOrders[] = {
        {NodeOrder::Morton, "Morton"}, {NodeOrder::Hilbert, "Hilbert"}, {NodeOrder::Shuffled, "shuffled"}};
    const TreeData geometry = geometryOf(subject);
    const bool moves = animated != nullptr && !animated->objects.empty();
    std::vector<std::unique_ptr<OrderedOctree>> octrees;
    for (const auto& [order, name] : kOrders)
    {
        octrees.push_back(std::make_unique<OrderedOctree>(subject, geometry, order, moves ? animated : nullptr));
    }
    std::vector<std::vector<double>> rays_ms(octrees.size());
    std::vector<std::vector<double>> update_ms(octrees.size());
    for (std::uint32_t turn = 0; turn < kTraceTurns * subject.options().run_count; ++turn)
    {
        for (std::size_t i = 0; i < octrees.size(); ++i)
        {
            const std::size_t place = (i + turn) % octrees.size(); // begins with another one in each turn
            rays_ms[place].push_back(octrees[place]->raysMs());
        }
    }
    for (std::uint32_t turn = 0; moves && turn < kTraceTurns * subject.options().run_count; ++turn)
    {
        const double seconds = frameTime(*animated, turn + 1);
        for (std::size_t i = 0; i < octrees.size(); ++i)
        {
            const std::size_t place = (i + turn) % octrees.size();
            update_ms[place].push_back(octrees[place]->updateMs(seconds));
        }
    }
    for (std::size_t i = 0; i < octrees.size(); ++i)
    {
        rows.orders.push_back({subject.what(), kOrders[i].second, Spread::of(rays_ms[i]),
                               moves ? std::optional(Spread::of(update_ms[i])) : std::nullopt});
    }
}

} // namespace zvo::cli
