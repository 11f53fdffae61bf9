// SPDX-License-Identifier: MIT
#include "trace.h"

#include "core/query/query_list.h"

#include <algorithm>
#include <limits>

namespace zvo::python
{

namespace
{

constexpr std::size_t kAtOnce = std::size_t{1} << 20; // rays

std::vector<QueryAnswer> answersOf(vk::HeadlessDevice& device, const DeviceTree& tree, std::span<const RayQuery> rays)
{
    const QueryList list = rays;
    QueryBuffers buffers(device, list, tree.grid);
    device.run([&](vk::FrameGraph& graph) { answerQueries(graph, tree, buffers); });
    std::vector<QueryAnswer> answers(rays.size());
    readAnswers(QueriedTree(tree), list, 0, device.download(buffers.hits), device.download(buffers.looks), answers);
    return answers;
}

void append(Hits& hits, const QueryAnswer& answer)
{
    const bool found = answer.state == QueryState::Found;
    hits.state.push_back(static_cast<std::uint8_t>(answer.state));
    hits.t.push_back(found ? answer.t : std::numeric_limits<float>::infinity());
    hits.face.push_back(static_cast<std::int8_t>(found ? static_cast<int>(answer.face) : -1));
    for (std::uint32_t axis = 0; axis < 3; ++axis)
    {
        hits.voxel.push_back(found ? static_cast<std::int32_t>(answer.cell[axis]) : -1);
        hits.normal.push_back(answer.normal[axis]);
        hits.color.push_back(static_cast<std::uint8_t>(answer.color >> 8 * axis));
    }
}

} // namespace

Hits trace(const Tree& tree, std::span<const glm::vec3> origins, std::span<const glm::vec3> directions, float t_min,
           float t_max)
{
    Hits hits;
    std::vector<RayQuery> rays;
    for (std::size_t first = 0; first < origins.size(); first += kAtOnce)
    {
        const std::size_t end = std::min(origins.size(), first + kAtOnce);
        rays.clear();
        for (std::size_t i = first; i < end; ++i)
        {
            const glm::vec3& origin = origins[i];
            const glm::vec3& direction = directions[i];
            rays.push_back({{origin.x, origin.y, origin.z}, t_min, {direction.x, direction.y, direction.z}, t_max});
        }
        const std::vector<QueryAnswer> answers =
            tree.session().use([&](vk::HeadlessDevice& device) { return answersOf(device, tree.device(), rays); });
        std::ranges::for_each(answers, [&](const QueryAnswer& answer) { append(hits, answer); });
    }
    return hits;
}

} // namespace zvo::python
