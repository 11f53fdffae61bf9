// SPDX-License-Identifier: MIT
#include "core/scene/probe_tree.h"

#include <glm/geometric.hpp>

namespace zvo
{

namespace
{

constexpr std::size_t kLeafProbes = 4;

} // namespace

double meets(const Probe& probe, const Corners& corners)
{
    constexpr double kMiss = 2.0;
    const glm::dvec3 u = corners[1] - corners[0];
    const glm::dvec3 v = corners[2] - corners[0];
    const glm::dvec3 p = glm::cross(probe.way, v);
    const double determinant = glm::dot(u, p);
    if (determinant == 0.0)
    {
        return kMiss;
    }
    const glm::dvec3 s = probe.from - corners[0];
    const double a = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, u);
    const double b = glm::dot(probe.way, q) / determinant;
    const double t = glm::dot(v, q) / determinant;
    return a >= 0.0 && b >= 0.0 && a + b <= 1.0 && t >= 0.0 && t <= 1.0 ? t : kMiss;
}

ProbeTree::ProbeTree(std::vector<Probe>& probes) : m_probes(probes)
{
    if (!m_probes.empty())
    {
        build(0, m_probes.size());
    }
}

void ProbeTree::build(std::size_t first, std::size_t last)
{
    const std::size_t number = m_nodes.size();
    Node node;
    node.low = m_probes[first].low();
    node.high = m_probes[first].high();
    for (std::size_t i = first + 1; i < last; ++i)
    {
        node.low = glm::min(node.low, m_probes[i].low());
        node.high = glm::max(node.high, m_probes[i].high());
    }
    node.first = static_cast<std::ptrdiff_t>(first);
    const bool is_leaf = last - first <= kLeafProbes;
    node.count = is_leaf ? static_cast<std::ptrdiff_t>(last - first) : 0;
    m_nodes.push_back(node);
    if (!is_leaf)
    {
        const glm::dvec3 size = node.high - node.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        const std::size_t middle = (first + last) / 2;
        const auto at = [&](std::size_t i) { return m_probes.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(first), at(middle), at(last),
                         [axis](const Probe& a, const Probe& b) { return a.from[axis] < b.from[axis]; });
        build(first, middle);
        build(middle, last);
    }
    m_nodes[number].next = m_nodes.size();
}

} // namespace zvo
