// SPDX-License-Identifier: MIT
#include "core/scene/main_bounds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace zvo
{

namespace
{

constexpr int kBins = 1024;
constexpr int kCutsMax = 16;
constexpr double kOutlierShare = 0.01; // of the surface

struct Box
{
    glm::dvec3 low;
    glm::dvec3 high;
};

// The surface of a scene along an axis, in bins of equal length over a range.
class Profile
{
public:
    Profile(double low, double high) : m_low(low), m_bin(high > low ? (high - low) / kBins : 1.0) {}

    // Adds a triangle that reaches from low to high.
    void add(double low, double high, double area)
    {
        const int first = binOf(low);
        const int last = binOf(high);
        ++m_begins[first];
        --m_begins[last + 1];
        m_area[(first + last) / 2] += area;
        m_total += area;
    }

    // Cuts off outliers at both ends of the range [low, high].
    void cut(double& low, double& high) const
    {
        std::array<bool, kBins> covered{};
        int depth = 0;
        for (int i = 0; i < kBins; ++i)
        {
            depth += m_begins[i];
            covered[i] = depth > 0;
        }
        // From the heaviest bin on, what is near enough, or heavy enough, belongs to the main part.
        const auto heaviest = static_cast<int>(std::max_element(m_area.begin(), m_area.end()) - m_area.begin());
        int first = heaviest;
        int last = heaviest;
        bool grows = true;
        while (grows)
        {
            grows = false;
            for (const int step : {-1, 1})
            {
                int& end = step < 0 ? first : last;
                const int next = nextCovered(covered, end, step);
                const bool exists = next >= 0 && next < kBins;
                if (exists &&
                    (std::abs(next - end) - 1 <= last - first + 1 || areaBeyond(next, step) >= kOutlierShare * m_total))
                {
                    end = next;
                    grows = true;
                }
            }
        }
        const bool cuts_low = nextCovered(covered, first, -1) >= 0;
        const bool cuts_high = nextCovered(covered, last, 1) < kBins;
        high = cuts_high ? m_low + (last + 1) * m_bin : high;
        low = cuts_low ? m_low + first * m_bin : low;
    }

private:
    [[nodiscard]] int binOf(double x) const
    {
        return static_cast<int>(std::clamp((x - m_low) / m_bin, 0.0, kBins - 1.0));
    }

    static int nextCovered(const std::array<bool, kBins>& covered, int from, int step)
    {
        int i = from + step;
        while (i >= 0 && i < kBins && !covered[i])
        {
            i += step;
        }
        return i;
    }

    [[nodiscard]] double areaBeyond(int from, int step) const
    {
        double area = 0.0;
        for (int i = from; i >= 0 && i < kBins; i += step)
        {
            area += m_area[i];
        }
        return area;
    }

    double m_low;
    double m_bin;
    double m_total = 0.0;
    std::array<double, kBins> m_area{};
    std::array<int, kBins + 1> m_begins{}; // triangles that begin in a bin, less those that end before it
};

// Calls visit(low, high, area) for each finite triangle whose own box has its middle within box.
template <typename Visit> void visitTriangles(const Scene& scene, const Box& box, const Visit& visit)
{
    for (const Instance& instance : scene.instances)
    {
        const Primitive& primitive = scene.primitives.at(instance.primitive);
        for (const glm::uvec3& triangle : primitive.triangles)
        {
            const glm::vec3 a = transformPoint(instance.transform, primitive.positions[triangle.x]);
            const glm::vec3 b = transformPoint(instance.transform, primitive.positions[triangle.y]);
            const glm::vec3 c = transformPoint(instance.transform, primitive.positions[triangle.z]);
            const glm::dvec3 low(glm::min(glm::min(a, b), c));
            const glm::dvec3 high(glm::max(glm::max(a, b), c));
            const glm::dvec3 middle = 0.5 * (low + high);
            const double area = glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
            if (std::isfinite(area) && glm::all(glm::lessThanEqual(box.low, middle)) &&
                glm::all(glm::lessThanEqual(middle, box.high)))
            {
                visit(low, high, area);
            }
        }
    }
}

} // namespace

Bounds mainBounds(const Scene& scene)
{
    Bounds bounds = scene.bounds();
    bool cuts = !bounds.empty();
    for (int i = 0; i < kCutsMax && cuts; ++i)
    {
        Box box = {bounds.min, bounds.max};
        const Box whole = box;
        std::vector<Profile> profiles;
        for (int axis = 0; axis < 3; ++axis)
        {
            profiles.emplace_back(box.low[axis], box.high[axis]);
        }
        visitTriangles(scene, box,
                       [&](const glm::dvec3& low, const glm::dvec3& high, double area)
                       {
                           for (int axis = 0; axis < 3; ++axis)
                           {
                               profiles[axis].add(low[axis], high[axis], area);
                           }
                       });
        for (int axis = 0; axis < 3; ++axis)
        {
            profiles[axis].cut(box.low[axis], box.high[axis]);
        }
        cuts = box.low != whole.low || box.high != whole.high;
        if (cuts)
        {
            bounds = Bounds();
            visitTriangles(scene, box,
                           [&](const glm::dvec3& low, const glm::dvec3& high, double)
                           {
                               bounds.extend(glm::vec3(low));
                               bounds.extend(glm::vec3(high));
                           });
        }
    }
    return bounds;
}

} // namespace zvo
