// SPDX-License-Identifier: MIT
#include "support/lit_voxels.h"

#include "oracle/morton.h"
#include "support/octree_access.h"
#include "support/trace_octrees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace zvo::test
{

namespace
{

// RGB9E5 of multiples of 2^-8 below 2.
gpu::uint encodeEmission(const glm::vec3& emission)
{
    const glm::uvec3 mantissa(emission * 256.0F);
    EXPECT_EQ(glm::vec3(mantissa) / 256.0F, emission);
    EXPECT_TRUE(glm::all(glm::lessThan(mantissa, glm::uvec3(512))));
    return mantissa.x | (mantissa.y << 9) | (mantissa.z << 18) | (16U << 27);
}

bool emits(const LitVoxel& voxel)
{
    return voxel.emission != glm::vec3(0.0F);
}

// For each node, the mean of the colours below it, and whether a voxel there emits.
std::vector<gpu::Attribute> nodeAttributes(const DeviceTree& tree, std::span<const gpu::Node> nodes,
                                           std::span<const LitVoxel> voxels)
{
    struct Sum
    {
        glm::dvec3 linear{0.0};
        double count = 0.0;
        bool emits = false;
    };
    std::vector<Sum> sums(nodes.size());
    std::vector<gpu::Attribute> attributes(nodes.size());
    for (std::size_t number = nodes.size(); number-- > 0;)
    {
        const gpu::Node& node = nodes[number];
        const bool is_leaf = number >= tree.levels.back().first_node;
        const std::size_t count = static_cast<std::size_t>(std::popcount(node.mask_lo) + std::popcount(node.mask_hi));
        const std::size_t first = node.mask_lo != 0 ? node.base_lo : node.base_hi;
        Sum& sum = sums[number];
        for (std::size_t i = first; i < first + count; ++i)
        {
            const Sum below = is_leaf ? Sum{albedoOf(voxels[i]), 1.0, emits(voxels[i])} : sums[i];
            sum = {sum.linear + below.linear, sum.count + below.count, sum.emits || below.emits};
        }
        attributes[number].color = sum.emits ? gpu::kAttributeEmissive << 24 : 0;
        for (int i = 0; i < 3; ++i)
        {
            const double mean = sum.linear[i] / std::max(sum.count, 1.0);
            const double code = mean <= 0.0031308 ? 12.92 * mean : 1.055 * std::pow(mean, 1.0 / 2.4) - 0.055;
            attributes[number].color |= static_cast<gpu::uint>(std::lround(255.0 * code)) << (8 * i);
        }
    }
    return attributes;
}

} // namespace

LitVoxel whiteVoxel()
{
    return {{}, glm::uvec3(255), glm::vec3(0.0F)};
}

glm::dvec3 albedoOf(const LitVoxel& voxel)
{
    glm::dvec3 linear;
    for (int i = 0; i < 3; ++i)
    {
        const double code = voxel.color[i] / 255.0;
        linear[i] = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    }
    return linear;
}

void addBox(std::vector<LitVoxel>& voxels, const glm::uvec3& low, const glm::uvec3& high, const LitVoxel& voxel)
{
    for (std::uint32_t z = low.z; z < high.z; ++z)
    {
        for (std::uint32_t y = low.y; y < high.y; ++y)
        {
            for (std::uint32_t x = low.x; x < high.x; ++x)
            {
                voxels.push_back(voxel);
                voxels.back().cell = {x, y, z};
            }
        }
    }
}

DeviceTree litTree(vk::HeadlessDevice& device, std::vector<LitVoxel> voxels, std::uint32_t depth, bool of_nodes)
{
    const auto code = [](const LitVoxel& voxel) { return oracle::mortonEncode(voxel.cell); };
    std::ranges::sort(voxels, {}, code);
    Codes codes(voxels.size());
    std::ranges::transform(voxels, codes.begin(), code);
    DeviceTree tree = octreeOf(device, codes, depth);
    std::vector<gpu::Attribute> attributes(voxels.size());
    std::vector<gpu::uvec2> words((voxels.size() + 31) / 32, gpu::uvec2(0));
    std::vector<gpu::uint> emission;
    for (std::size_t i = 0; i < voxels.size(); ++i)
    {
        const LitVoxel& voxel = voxels[i];
        attributes[i].color = voxel.color.r | (voxel.color.g << 8) | (voxel.color.b << 16) |
                              (emits(voxel) ? gpu::kAttributeEmissive << 24 : 0);
        if (i % 32 == 0)
        {
            words[i / 32].y = static_cast<gpu::uint>(emission.size());
        }
        if (emits(voxel))
        {
            words[i / 32].x |= 1U << (i % 32);
            emission.push_back(encodeEmission(voxel.emission));
        }
    }
    tree.voxel_attributes = device.makeBuffer("voxel attributes", std::span<const gpu::Attribute>(attributes));
    if (!emission.empty())
    {
        tree.emission_words = device.makeBuffer("emission words", std::span<const gpu::uvec2>(words));
        tree.emission = device.makeBuffer("emission", std::span<const gpu::uint>(emission));
    }
    if (of_nodes)
    {
        const std::vector<gpu::Attribute> attributes_of_nodes = nodeAttributes(tree, octreeNodes(device, tree), voxels);
        tree.node_attributes =
            device.makeBuffer("node attributes", std::span<const gpu::Attribute>(attributes_of_nodes));
    }
    return tree;
}

void setNormals(vk::HeadlessDevice& device, DeviceTree& tree, std::span<const gpu::uint> codes)
{
    std::vector<gpu::Attribute> attributes = device.download(tree.voxel_attributes);
    for (std::size_t i = 0; i < attributes.size(); ++i)
    {
        attributes[i].normal = codes[i % codes.size()];
    }
    tree.voxel_attributes = device.makeBuffer("voxel attributes", std::span<const gpu::Attribute>(attributes));
}

std::vector<LitVoxel> roomOf(const LitVoxel& wall, std::uint32_t edge, std::uint32_t thickness)
{
    std::vector<LitVoxel> voxels;
    addBox(voxels, glm::uvec3(0), glm::uvec3(edge), wall);
    std::erase_if(voxels,
                  [&](const LitVoxel& v)
                  {
                      return glm::all(glm::greaterThanEqual(v.cell, glm::uvec3(thickness))) &&
                             glm::all(glm::lessThan(v.cell, glm::uvec3(edge - thickness)));
                  });
    return voxels;
}

} // namespace zvo::test
