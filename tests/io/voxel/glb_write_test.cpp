// SPDX-License-Identifier: MIT
// Meshes of voxels, read without the loader. They have each face between a voxel and an empty cell once, and no others.
#include "io/voxel/glb_write.h"

#include "core/base/morton.h"
#include "core/tree/tree_build.h"
#include "io/gltf/gltf_loader.h"
#include "support/temp_dir.h"
#include "support/tree_samples.h"
#include "written_bytes.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>

namespace zvo::test
{
namespace
{

template <typename T> T at(const std::string& bytes, std::size_t offset)
{
    T value{};
    EXPECT_LE(offset + sizeof(T), bytes.size());
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

using Face = std::tuple<int, int, int, int, int>; // axis, direction, and the cell

// The faces of voxels towards empty cells, with colours.
std::map<Face, std::uint32_t> expectedFaces(const TreeData& tree)
{
    std::map<std::array<int, 3>, std::uint32_t> voxels;
    std::size_t number = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     const glm::ivec3 cell(cellOfCode(code));
                     voxels[{cell.x, cell.y, cell.z}] =
                         tree.hasAttributes() ? tree.voxelAttribute(number).color & 0xffffffU : 0xcbcbcbU;
                     ++number;
                 });
    std::map<Face, std::uint32_t> faces;
    for (const auto& [cell, color] : voxels)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            for (const int direction : {-1, 1})
            {
                std::array<int, 3> neighbor = cell;
                neighbor[static_cast<std::size_t>(axis)] += direction;
                if (!voxels.contains(neighbor))
                {
                    faces[{axis, direction, cell[0], cell[1], cell[2]}] = color;
                }
            }
        }
    }
    return faces;
}

int encodedSrgb(std::uint16_t linear)
{
    const double value = linear / 65535.0;
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255 * encoded));
}

void expectFaces(const TreeData& tree, const std::string& name)
{
    const std::string file = writtenBytes(writeGlb, tree);
    ASSERT_EQ(at<std::uint32_t>(file, 8), file.size()) << name;
    const auto json_bytes = at<std::uint32_t>(file, 12);
    const nlohmann::json document = nlohmann::json::parse(file.substr(20, json_bytes));
    const std::size_t binary = 20 + json_bytes + 8;
    const std::uint32_t index_count = document["bufferViews"][2]["byteLength"].get<std::uint32_t>() / 4;
    const std::size_t colors = binary + document["bufferViews"][1]["byteOffset"].get<std::size_t>();
    const std::size_t indices = binary + document["bufferViews"][2]["byteOffset"].get<std::size_t>();
    std::vector<std::uint32_t> first_vertex; // [indices] of the accessor: those of one material after the other
    std::uint32_t vertex_count = 0;
    for (const nlohmann::json& primitive : document["meshes"][0]["primitives"])
    {
        const std::size_t count = document["accessors"][primitive["indices"].get<std::size_t>()]["count"];
        first_vertex.insert(first_vertex.end(), count, vertex_count);
        vertex_count +=
            document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"].get<std::uint32_t>();
    }
    const auto vertexOf = [&](std::uint32_t i)
    { return first_vertex.at(i) + at<std::uint32_t>(file, indices + 4 * i); };
    std::map<Face, std::uint32_t> left = expectedFaces(tree);
    for (std::uint32_t i = 0; i < index_count; i += 6)
    {
        std::array<glm::vec3, 3> corner{};
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            corner[k] = at<glm::vec3>(file, binary + 12 * vertexOf(i + k));
        }
        const auto opposite = at<glm::vec3>(file, binary + 12 * vertexOf(i + 5));
        const glm::vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const int axis = normal.x != 0 ? 0 : normal.y != 0 ? 1 : 2;
        const int direction = normal[axis] > 0 ? 1 : -1;
        const glm::vec3 low = glm::min(glm::min(corner[0], corner[1]), glm::min(corner[2], opposite));
        const glm::vec3 high = glm::max(glm::max(corner[0], corner[1]), glm::max(corner[2], opposite));
        ASSERT_EQ(low[axis], high[axis]);
        const std::uint32_t vertex = vertexOf(i);
        std::uint32_t color = 0;
        for (std::uint32_t channel = 0; channel < 3; ++channel)
        {
            color |= static_cast<std::uint32_t>(encodedSrgb(at<std::uint16_t>(file, colors + 8 * vertex + 2 * channel)))
                     << (8 * channel);
        }
        glm::ivec3 first(low);
        glm::ivec3 end(high);
        first[axis] -= direction == 1 ? 1 : 0;
        end[axis] = first[axis] + 1;
        for (int z = first.z; z < end.z; ++z)
        {
            for (int y = first.y; y < end.y; ++y)
            {
                for (int x = first.x; x < end.x; ++x)
                {
                    const auto face = left.find({axis, direction, x, y, z});
                    ASSERT_NE(face, left.end()) << name;
                    ASSERT_EQ(face->second, color) << name;
                    left.erase(face);
                }
            }
        }
    }
    EXPECT_TRUE(left.empty()) << name << ": " << left.size() << " faces are missing";
}

TEST(GlbWrite, HasEachFaceOnceInItsColor)
{
    for (const TreeSample& sample : treeSamples())
    {
        if (sample.tree.voxel_count != 0)
        {
            expectFaces(sample.tree, sample.name);
        }
    }
}

TEST(GlbWrite, AFullGridIsSixRectangles)
{
    for (const TreeSample& sample : treeSamples())
    {
        if (sample.name == "full_8")
        {
            const std::string file = writtenBytes(writeGlb, sample.tree);
            const nlohmann::json document = nlohmann::json::parse(file.substr(20, at<std::uint32_t>(file, 12)));
            EXPECT_EQ(document["accessors"][2]["count"], 36);
        }
    }
}

TEST(GlbWrite, LightIsThatOfMaterials)
{
    const std::vector<glm::vec3> emission = {{0, 0, 0}, {1, 0.5F, 0}, {1, 0.5F, 0}, {0, 0, 40}};
    TreeData tree = octreeOfVoxels({glm::vec3(0.0F), 1.0F, 2}, std::vector<std::uint64_t>{0, 1, 8, 63});
    addColors(tree, std::vector<std::uint32_t>{255, 255, 255, 0});
    addEmission(tree, emission);
    const TempDir dir;
    const Scene scene = loadGltf(dir.write("lit.glb", writtenBytes(writeGlb, tree)));
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.instances.size(), 3U);
    const auto lightAt = [&](const glm::vec3& place)
    {
        for (const Primitive& primitive : scene.primitives)
        {
            for (const glm::uvec3& triangle : primitive.triangles)
            {
                if (primitive.positions[triangle.x] == place || primitive.positions[triangle.y] == place ||
                    primitive.positions[triangle.z] == place)
                {
                    return scene.materials.at(primitive.material).emission;
                }
            }
        }
        return glm::vec3(-1.0F);
    };
    EXPECT_EQ(lightAt({0, 0, 0}), emission[0]);
    EXPECT_LT(glm::distance(lightAt({3, 0, 0}), emission[1]), 0.05F) << "of two voxels";
    EXPECT_LT(glm::distance(lightAt({4, 4, 4}), emission[3]), 0.1F);
    const std::string dark = writtenBytes(writeGlb, treeSample("full_8"));
    EXPECT_EQ(dark.find("emissive"), std::string::npos);
}

TEST(GlbWrite, TheLoaderFindsTheVoxelsInWorldSpace)
{
    const TempDir dir;
    for (const TreeSample& sample : treeSamples())
    {
        const Scene scene = loadGltf(dir.write(sample.name + ".glb", writtenBytes(writeGlb, sample.tree)));
        const std::optional<CellBox> box = voxelBox(sample.tree);
        ASSERT_EQ(scene.triangleCount() != 0, box.has_value()) << sample.name;
        if (box)
        {
            const Grid& grid = sample.tree.grid;
            const Bounds bounds = scene.bounds();
            for (int i = 0; i < 3; ++i)
            {
                EXPECT_NEAR(bounds.min[i], grid.origin[i] + grid.voxel_size * static_cast<float>(box->min[i]), 1e-5F);
                EXPECT_NEAR(bounds.max[i], grid.origin[i] + grid.voxel_size * static_cast<float>(box->max[i]), 1e-5F);
            }
        }
    }
}

} // namespace
} // namespace zvo::test
