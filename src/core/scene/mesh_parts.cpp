// SPDX-License-Identifier: MIT
#include "core/scene/mesh_parts.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace zvo
{

namespace
{

std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t i)
{
    while (parents[i] != i)
    {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

// For each vertex, a vertex at the same place: the same one for all that are there.
std::vector<std::uint32_t> weldVertices(const std::vector<glm::vec3>& positions)
{
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    // By bits, which have an order even where positions have none. 0.0 is added, as -0.0 is the same place.
    const auto key = [&](std::uint32_t i)
    {
        const glm::uvec3 bits = glm::floatBitsToUint(positions[i] + 0.0F);
        return std::array{bits.x, bits.y, bits.z};
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
        const bool same = i != 0 && key(order[i]) == key(order[i - 1]);
        welded[order[i]] = same ? welded[order[i - 1]] : order[i];
    }
    return welded;
}

} // namespace

MeshParts partsOf(const Primitive& primitive, bool welded)
{
    std::vector<std::uint32_t> parents;
    if (welded)
    {
        parents = weldVertices(primitive.positions);
    }
    else
    {
        parents.resize(primitive.positions.size());
        std::iota(parents.begin(), parents.end(), 0U);
    }
    for (const glm::uvec3& triangle : primitive.triangles)
    {
        const std::uint32_t root = rootOf(parents, triangle.x);
        parents[rootOf(parents, triangle.y)] = root;
        parents[rootOf(parents, triangle.z)] = root;
    }
    std::vector<std::uint32_t> numbers(parents.size(), kNone);
    MeshParts parts;
    for (const glm::uvec3& triangle : primitive.triangles)
    {
        std::uint32_t& number = numbers[rootOf(parents, triangle.x)];
        number = number == kNone ? parts.count++ : number;
        parts.of_triangle.push_back(number);
    }
    return parts;
}

} // namespace zvo
