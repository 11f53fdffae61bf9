// SPDX-License-Identifier: MIT
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo
{

/// The corners of a triangle.
using Corners = std::array<glm::dvec3, 3>;

/// A segment that looks for surfaces (core/scene/hulls.h).
struct Probe
{
    glm::dvec3 from{0.0};
    glm::dvec3 way{0.0};
    std::uint32_t candidate = 0; // what it is a probe of
    double nearest = 2.0;        // where it meets something first, in lengths of way; above 1: nowhere
    bool faces = false;          // whether that is a front face

    [[nodiscard]] glm::dvec3 low() const { return glm::min(from, from + way); }
    [[nodiscard]] glm::dvec3 high() const { return glm::max(from, from + way); }
};

/// Where a probe meets a triangle, in lengths of its way; 2 if it does not (T. Moeller, B. Trumbore, Fast, Minimum
/// Storage Ray-Triangle Intersection, 1997).
double meets(const Probe& probe, const Corners& corners);

/// A tree of boxes around probes: each node halves those of the one above it, along the longest axis of their box.
class ProbeTree
{
public:
    /// Reorders the probes. They must outlive the tree, and stay where they are. Cost: probes x log probes.
    explicit ProbeTree(std::vector<Probe>& probes);

    /// Calls visit(probe) once for each probe whose box touches that of the triangle, and for some beside them.
    template <typename Visit> void visitNear(const Corners& corners, const Visit& visit)
    {
        const glm::dvec3 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
        const glm::dvec3 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
        for (std::size_t i = 0; i < m_nodes.size();)
        {
            const Node& node = m_nodes[i];
            const bool touches =
                glm::all(glm::lessThanEqual(low, node.high)) && glm::all(glm::lessThanEqual(node.low, high));
            if (touches && node.count != 0)
            {
                std::for_each(m_probes.begin() + node.first, m_probes.begin() + node.first + node.count, visit);
            }
            i = touches ? i + 1 : node.next;
        }
    }

private:
    struct Node
    {
        glm::dvec3 low{0.0};
        glm::dvec3 high{0.0};
        std::ptrdiff_t first = 0;
        std::ptrdiff_t count = 0; // of a leaf
        std::size_t next = 0;     // the node behind those below this one
    };

    void build(std::size_t first, std::size_t last);

    std::vector<Probe>& m_probes;
    std::vector<Node> m_nodes; // depth first
};

} // namespace zvo
