// SPDX-License-Identifier: MIT
#include "support/trace_octrees.h"

#include "oracle/morton.h"
#include "oracle/octree_check.h"

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
    const oracle::ReferenceOctree reference = oracle::referenceOctree(codes, depth);
    DeviceTree octree;
    octree.grid.depth = depth;
    octree.node_count = static_cast<std::uint32_t>(reference.nodes.size());
    octree.voxel_count = static_cast<std::uint32_t>(codes.size());
    for (const oracle::NodeRange& range : reference.levels)
    {
        octree.levels.push_back({range.first_node, range.node_count});
    }
    octree.nodes = device.makeBuffer("nodes", std::span(reference.nodes));
    return octree;
}

void addAttributes(vk::HeadlessDevice& device, DeviceTree& octree)
{
    std::mt19937 random(octree.voxel_count);
    std::vector<gpu::Attribute> attributes(octree.voxel_count);
    std::vector<gpu::uvec2> words((octree.voxel_count + 31) / 32, gpu::uvec2(0));
    std::vector<gpu::uint> emission;
    for (std::uint32_t i = 0; i < octree.voxel_count; ++i)
    {
        const bool emissive = random() % 7 == 0;
        attributes[i] = {static_cast<gpu::uint>(random() & 0xFFFFFF) | (emissive ? gpu::kAttributeEmissive << 24 : 0),
                         random() % 8 == 0 ? gpu::kNoNormal : static_cast<gpu::uint>(random())};
        if (i % 32 == 0)
        {
            words[i / 32].y = static_cast<gpu::uint>(emission.size());
        }
        if (emissive)
        {
            words[i / 32].x |= 1U << (i % 32);
            emission.push_back(static_cast<gpu::uint>(random() % (1U << 27)) | 16U << 27);
        }
    }
    octree.voxel_attributes = device.makeBuffer("voxel attributes", std::span<const gpu::Attribute>(attributes));
    octree.emission_words = device.makeBuffer("emission words", std::span<const gpu::uvec2>(words));
    octree.emission = device.makeBuffer("emission", std::span<const gpu::uint>(emission));
    attributes.resize(octree.node_count);
    for (gpu::Attribute& attribute : attributes)
    {
        attribute = {static_cast<gpu::uint>(random() & 0xFFFFFF), static_cast<gpu::uint>(random())};
    }
    octree.node_attributes = device.makeBuffer("node attributes", std::span<const gpu::Attribute>(attributes));
}

} // namespace zvo::test
