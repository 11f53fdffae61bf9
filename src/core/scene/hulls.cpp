// SPDX-License-Identifier: MIT
#include "core/scene/hulls.h"

#include "core/scene/mesh_parts.h"
#include "core/scene/probe_tree.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace zvo
{

namespace
{

// A hull is probed at up to so many triangles.
constexpr std::size_t kProbesMax = 32;
// How far a probe looks, in diagonals of the hull's box.
constexpr double kReach = 0.05;
// The volume of a surface that is inside out, at least: in volumes of the cube that has its area.
constexpr double kVolumeMin = 0.02;

Corners cornersOf(const Primitive& primitive, const glm::uvec3& triangle)
{
    return {glm::dvec3(primitive.positions[triangle.x]), glm::dvec3(primitive.positions[triangle.y]),
            glm::dvec3(primitive.positions[triangle.z])};
}

// The volume that triangles enclose, positive where their front faces look outwards, and their area. Both count six
// fold and twofold.
struct Extent
{
    double volume6 = 0.0;
    double area2 = 0.0;

    void add(const Corners& corners, const glm::dvec3& centre)
    {
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        volume6 += glm::dot(corners[0] - centre, normal);
        area2 += glm::length(normal);
    }

    [[nodiscard]] bool isInsideOut() const { return volume6 / 6.0 < -kVolumeMin * std::pow(area2 / 12.0, 1.5); }
};

bool isInsideOut(const Primitive& primitive)
{
    if (primitive.triangles.empty())
    {
        return false;
    }
    const glm::dvec3 centre(primitive.positions[primitive.triangles.front().x]);
    Extent extent;
    for (const glm::uvec3& triangle : primitive.triangles)
    {
        extent.add(cornersOf(primitive, triangle), centre);
    }
    return extent.isInsideOut();
}

// A part of a primitive that is inside out.
struct Candidate
{
    std::uint32_t primitive = 0;
    std::uint32_t part = 0;
    std::size_t probe_count = 0;
    std::size_t facing_count = 0; // probes that meet the front of something
};

// Finds the inverted hulls of a scene.
class HullFinder
{
public:
    explicit HullFinder(const Scene& scene)
        : m_scene(scene), m_instances(scene.primitives.size()), m_parts(scene.primitives.size())
    {
        for (const Instance& instance : scene.instances)
        {
            m_instances[instance.primitive].push_back(&instance);
        }
    }

    // For each primitive, which of its triangles belong to hulls; empty: none.
    std::vector<std::vector<bool>> find()
    {
        findCandidates();
        std::vector<std::vector<bool>> found(m_scene.primitives.size());
        if (m_candidates.empty())
        {
            return found;
        }
        probe();
        for (const Candidate& candidate : m_candidates)
        {
            if (4 * candidate.facing_count >= 3 * candidate.probe_count && candidate.probe_count != 0)
            {
                const std::vector<std::uint32_t>& parts = m_parts[candidate.primitive].of_triangle;
                std::vector<bool>& triangles = found[candidate.primitive];
                triangles.resize(parts.size());
                for (std::size_t i = 0; i < parts.size(); ++i)
                {
                    triangles[i] = triangles[i] || parts[i] == candidate.part;
                }
                ++m_hull_count;
            }
        }
        return found;
    }

    [[nodiscard]] std::uint64_t hullCount() const { return m_hull_count; }

private:
    void findCandidates()
    {
        for (std::uint32_t i = 0; i < m_scene.primitives.size(); ++i)
        {
            const Primitive& primitive = m_scene.primitives[i];
            if (!m_instances[i].empty() && !m_scene.materials[primitive.material].double_sided &&
                isInsideOut(primitive))
            {
                addCandidates(i);
            }
        }
    }

    void addCandidates(std::uint32_t number)
    {
        const Primitive& primitive = m_scene.primitives[number];
        m_parts[number] = partsOf(primitive);
        const MeshParts& parts = m_parts[number];
        struct Part
        {
            Extent extent;
            glm::dvec3 centre{0.0};
            glm::dvec3 low{0.0};
            glm::dvec3 high{0.0};
            std::vector<std::uint32_t> triangles;
        };
        std::vector<Part> all(parts.count);
        for (std::uint32_t i = 0; i < primitive.triangles.size(); ++i)
        {
            Part& part = all[parts.of_triangle[i]];
            const Corners corners = cornersOf(primitive, primitive.triangles[i]);
            if (part.triangles.empty())
            {
                part.centre = part.low = part.high = corners[0];
            }
            for (const glm::dvec3& corner : corners)
            {
                part.low = glm::min(part.low, corner);
                part.high = glm::max(part.high, corner);
            }
            part.extent.add(corners, part.centre);
            part.triangles.push_back(i);
        }
        for (std::uint32_t i = 0; i < parts.count; ++i)
        {
            if (all[i].extent.isInsideOut())
            {
                m_candidates.push_back({.primitive = number, .part = i});
                addProbes(primitive, all[i].triangles, all[i].high - all[i].low);
            }
        }
    }

    // Spreads probes of the last candidate over its triangles and the primitive's instances.
    void addProbes(const Primitive& primitive, const std::vector<std::uint32_t>& triangles, const glm::dvec3& size)
    {
        Candidate& candidate = m_candidates.back();
        const std::vector<const Instance*>& instances = m_instances[candidate.primitive];
        const std::size_t count = std::min(triangles.size(), kProbesMax);
        for (std::size_t i = 0; i < count; ++i)
        {
            const Instance& instance = *instances[i * instances.size() / count];
            const Corners corners =
                placed(instance, primitive.positions, primitive.triangles[triangles[i * triangles.size() / count]]);
            const glm::dvec3 normal = frontNormal(instance, corners);
            const double length = glm::length(normal);
            if (length > 0.0 && std::isfinite(length))
            {
                const double reach = kReach * glm::length(glm::dmat3(instance.transform) * size);
                Probe probe;
                probe.from = (corners[0] + corners[1] + corners[2]) / 3.0;
                probe.way = reach / length * normal;
                probe.candidate = static_cast<std::uint32_t>(m_candidates.size() - 1);
                m_probes.push_back(probe);
                ++candidate.probe_count;
            }
        }
    }

    static Corners placed(const Instance& instance, const std::vector<glm::vec3>& positions, const glm::uvec3& triangle)
    {
        const auto at = [&](std::uint32_t i) { return glm::dvec3(transformPoint(instance.transform, positions[i])); };
        return {at(triangle.x), at(triangle.y), at(triangle.z)};
    }

    // Towards the side from which a triangle is seen. A transform that mirrors turns no surface inside out.
    static glm::dvec3 frontNormal(const Instance& instance, const Corners& corners)
    {
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        return glm::determinant(glm::dmat3(instance.transform)) < 0.0 ? -normal : normal;
    }

    // Finds what each probe meets first, other than the surface that it begins on.
    void probe()
    {
        ProbeTree tree(m_probes);
        for (const Instance& instance : m_scene.instances)
        {
            const Primitive& primitive = m_scene.primitives[instance.primitive];
            const bool double_sided = m_scene.materials[primitive.material].double_sided;
            const std::vector<std::uint32_t>& parts = m_parts[instance.primitive].of_triangle;
            for (std::size_t i = 0; i < primitive.triangles.size(); ++i)
            {
                const Corners corners = placed(instance, primitive.positions, primitive.triangles[i]);
                tree.visitNear(corners,
                               [&](Probe& probe)
                               {
                                   const Candidate& own = m_candidates[probe.candidate];
                                   const bool is_own =
                                       own.primitive == instance.primitive && !parts.empty() && parts[i] == own.part;
                                   const double t = is_own ? probe.nearest : meets(probe, corners);
                                   if (t < probe.nearest)
                                   {
                                       probe.nearest = t;
                                       probe.faces =
                                           double_sided || glm::dot(frontNormal(instance, corners), probe.way) < 0.0;
                                   }
                               });
            }
        }
        for (const Probe& probe : m_probes)
        {
            m_candidates[probe.candidate].facing_count += probe.faces ? 1 : 0;
        }
    }

    const Scene& m_scene;
    std::vector<std::vector<const Instance*>> m_instances; // by primitive
    std::vector<MeshParts> m_parts;                        // by primitive; of those with candidates
    std::vector<Candidate> m_candidates;
    std::vector<Probe> m_probes;
    std::uint64_t m_hull_count = 0;
};

} // namespace

LeftOutHulls leaveOutHulls(Scene& scene)
{
    HullFinder finder(scene);
    const std::vector<std::vector<bool>> hulls = finder.find();
    LeftOutHulls left_out;
    left_out.hull_count = finder.hullCount();
    if (left_out.hull_count == 0)
    {
        return left_out;
    }
    for (std::size_t i = 0; i < hulls.size(); ++i)
    {
        Primitive& primitive = scene.primitives[i];
        if (hulls[i].empty())
        {
            continue;
        }
        std::vector<glm::uvec3> kept;
        for (std::size_t k = 0; k < primitive.triangles.size(); ++k)
        {
            if (!hulls[i][k])
            {
                kept.push_back(primitive.triangles[k]);
            }
        }
        left_out.triangle_count += primitive.triangles.size() - kept.size();
        primitive.triangles = std::move(kept);
        const std::string& name = scene.materials[primitive.material].name;
        if (std::find(left_out.materials.begin(), left_out.materials.end(), name) == left_out.materials.end())
        {
            left_out.materials.push_back(name);
        }
    }
    std::erase_if(
        scene.instances, [&](const Instance& instance)
        { return !hulls[instance.primitive].empty() && scene.primitives[instance.primitive].triangles.empty(); });
    return left_out;
}

} // namespace zvo
