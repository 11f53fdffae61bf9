// SPDX-License-Identifier: MIT
#include "support/trace_octrees.h"

#include "oracle/morton.h"
#include "support/tree_samples.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace zvo::test
{

namespace
{

Codes sorted(Codes codes)
{
    std::sort(codes.begin(), codes.end());
    codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    return codes;
}

} // namespace

Codes codesWhere(std::uint32_t depth, const std::function<bool(const glm::uvec3&)>& inside)
{
    Codes codes;
    for (std::uint64_t code = 0; code < std::uint64_t{1} << (3 * depth); ++code)
    {
        if (inside(oracle::mortonDecode(code)))
        {
            codes.push_back(code);
        }
    }
    return codes;
}

Codes randomCodes(std::uint32_t depth, std::uint32_t count, std::mt19937& random)
{
    const std::uint64_t end = std::uint64_t{1} << (3 * depth);
    std::uniform_int_distribution<std::uint64_t> anywhere(0, end - 1);
    std::uniform_int_distribution<std::uint64_t> nearby(0, 63);
    Codes codes;
    std::uint64_t last = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        last = i % 2 == 0 ? anywhere(random) : (last ^ nearby(random)) % end;
        codes.push_back(last);
    }
    return sorted(std::move(codes));
}

Codes sphereShell(std::uint32_t depth, double radius)
{
    const double center = 0.5 * std::ldexp(1.0, static_cast<int>(depth));
    return codesWhere(depth,
                      [&](const glm::uvec3& voxel)
                      {
                          const double distance = glm::length(glm::dvec3(voxel) + 0.5 - center);
                          return std::abs(distance - radius) <= 0.5;
                      });
}

Codes spongeCodes(std::uint32_t depth)
{
    return codesWhere(depth,
                      [](const glm::uvec3& voxel)
                      {
                          bool solid = true;
                          for (glm::uvec3 v = voxel; v != glm::uvec3(0U); v /= 4U)
                          {
                              int in_middle = 0;
                              for (int axis = 0; axis < 3; ++axis)
                              {
                                  in_middle += v[axis] % 4 == 1 || v[axis] % 4 == 2 ? 1 : 0;
                              }
                              solid = solid && in_middle < 2;
                          }
                          return solid;
                      });
}

DeviceTree octreeOf(vk::HeadlessDevice& device, std::span<const std::uint64_t> codes, std::uint32_t depth)
{
    return uploadTree(device, octreeOf(codes, depth));
}

void addAttributes(vk::HeadlessDevice& device, DeviceTree& octree)
{
    TreeData host; // of which addAttributes() needs only the counts
    host.voxel_count = octree.voxel_count;
    host.nodes.resize(octree.node_count);
    addAttributes(host);
    octree.voxel_attributes = device.makeBuffer<gpu::Attribute>("voxel attributes", host.voxel_attributes);
    octree.node_attributes = device.makeBuffer<gpu::Attribute>("node attributes", host.node_attributes);
    octree.emission_words = device.makeBuffer<gpu::uvec2>("emission words", host.emission_words);
    octree.emission = device.makeBuffer<gpu::uint>("emission", host.emission);
}

std::vector<CodeSet> codeSets()
{
    std::mt19937 random(31);
    return {
        {1, {0, 5}},
        {2, randomCodes(2, 20, random)},
        {3, codesWhere(3, [](const glm::uvec3&) { return true; })},
        {5, codesWhere(5, [](const glm::uvec3& voxel) { return (voxel.x + voxel.y + voxel.z) % 2 == 0; })},
        {6, sphereShell(6, 24.0)},
        {7, randomCodes(7, 3000, random)},
        {8, spongeCodes(8)},
        {11, randomCodes(11, 20000, random)},
    };
}

} // namespace zvo::test
