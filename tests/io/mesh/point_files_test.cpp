// SPDX-License-Identifier: MIT
// Files without faces, which hold clouds of points.
#include "core/base/srgb.h"
#include "support/errors.h"
#include "support/load_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace zvo::test
{

namespace
{

using Vectors = std::vector<glm::vec3>;

/// The only primitive of a cloud, which was read without a warning.
Primitive cloudOf(const std::string& name, const std::string& content)
{
    Scene scene = loadText(name, content);
    EXPECT_TRUE(scene.warnings.empty()) << content;
    EXPECT_EQ(scene.primitives.size(), 1U);
    EXPECT_TRUE(scene.primitives.at(0).is_points);
    EXPECT_EQ(scene.triangleCount(), scene.primitives[0].positions.size());
    return std::move(scene.primitives[0]);
}

/// The colours of a cloud in 8-bit sRGB codes.
Vectors codesOf(const Primitive& cloud)
{
    Vectors codes;
    for (const glm::vec4& color : cloud.colors)
    {
        const auto code = [](float linear) { return std::round(255.0 * linearToSrgb(static_cast<double>(linear))); };
        codes.emplace_back(code(color.r), code(color.g), code(color.b));
    }
    return codes;
}

TEST(PointFiles, TextHasAPointALine)
{
    const Vectors points = {{1, 2, 3}, {-4, 5.5F, 6e2F}};
    for (const char* text :
         {"1 2 3\n-4 5.5 6e2\n", "# a cloud\r\n\r\n1,2,3\r\n-4, 5.5, 6e2 # the last\r\n", "2\n1\t2\t3\n-4\t5.5\t6e2",
          "X;Y;Z\n1;2;3\n-4;5.5;6e2\n", "\xEF\xBB\xBF//X Y Z\n1 2 3\n-4 5.5 6e2"})
    {
        const Primitive cloud = cloudOf("a.xyz", text);
        EXPECT_EQ(cloud.positions, points) << text;
        EXPECT_TRUE(cloud.colors.empty() && cloud.normals.empty());
    }
    for (const char* name : {"a.pts", "a.txt", "a.asc", "A.CSV"})
    {
        EXPECT_EQ(cloudOf(name, "1 2 3\n-4 5.5 600\n").positions, points);
    }
}

TEST(PointFiles, ColumnsAreToldApartByTheirNumbers)
{
    const Vectors colors = {{255, 0, 51}, {102, 1, 0}};
    const Vectors normals = {{0, 0, -1}, {0.6F, 0.8F, 0}};
    for (const char* text : {"0 0 0 255 0 51\n1 0 0 102 1 0\n", "2\n0 0 0 -2047 255 0 51\n1 0 0 9 102 1 0\n",
                             "0 0 0 1 0 0.2\n1 0 0 0.4 0.00392156862 0\n"})
    {
        const Primitive cloud = cloudOf("a.pts", text);
        EXPECT_EQ(codesOf(cloud), colors) << text;
        EXPECT_TRUE(cloud.normals.empty()) << text;
    }
    for (const char* text : {"0 0 0 0 0 -1\n1 0 0 .6 .8 0\n", "0 0 0 0 0 -2\n1 0 0 3 4 0\n"})
    {
        const Primitive cloud = cloudOf("a.xyz", text);
        EXPECT_EQ(cloud.normals, normals) << text;
        EXPECT_TRUE(cloud.colors.empty()) << text;
    }
    EXPECT_EQ(cloudOf("a.xyz", "0 0 0 1 0 0\n1 0 0 .6 .8 0\n").normals, (Vectors{{1, 0, 0}, {0.6F, 0.8F, 0}}));
    for (const char* text :
         {"0 0 0 255 0 51 0 0 -1\n1 0 0 102 1 0 .6 .8 0\n", "0 0 0 0 0 -1 255 0 51\n1 0 0 .6 .8 0 102 1 0\n",
          "0 0 0 7 255 0 51 0 0 -1\n1 0 0 8 102 1 0 .6 .8 0\n"})
    {
        const Primitive cloud = cloudOf("a.xyz", text);
        EXPECT_EQ(codesOf(cloud), colors) << text;
        EXPECT_EQ(cloud.normals, normals) << text;
    }
}

TEST(PointFiles, IntensitiesBecomeGreys)
{
    const Primitive cloud = cloudOf("a.pts", "3\n0 0 0 -50\n1 0 0 50\n2 0 0 -30\n");
    EXPECT_EQ(codesOf(cloud), (Vectors{{0, 0, 0}, {255, 255, 255}, {51, 51, 51}}));
    EXPECT_EQ(codesOf(cloudOf("a.pts", "0 0 0 5\n1 0 0 5\n")), (Vectors{{255, 255, 255}, {255, 255, 255}}));
}

TEST(PointFiles, TextThatIsNoCloudIsRefused)
{
    const auto expectRefused = [](const std::string& text, std::initializer_list<std::string> parts)
    { expectParts(messageOf([&] { loadText("a.xyz", text); }, ErrorCode::Input), parts); };
    expectRefused("0 0 0\n1 2\n", {"a.xyz", "line 2 has 2 numbers", "expected 3 numbers"});
    expectRefused("0 0 0\n1 2 x\n", {"line 2 has words"});
    expectRefused("0 0 0 1 2\n", {"line 1 has 5 numbers", "x y z [intensity]"});
    expectRefused("0 0 0 1 2 3 4 5 6 7 8 9\n", {"12 numbers"});
    expectRefused("to do\n", {"has no points"});
    expectRefused("3\nwater\nO 0 0 0\nH 0 1 0\n", {"has no points"});
}

TEST(PointFiles, ObjAndPlyVerticesWithoutFacesArePoints)
{
    const Primitive obj = cloudOf("a.obj", "v 0 0 0 1 0 0\nv 1 2 3\np 1 2\n");
    EXPECT_EQ(obj.positions, (Vectors{{0, 0, 0}, {1, 2, 3}}));
    EXPECT_EQ(codesOf(obj), (Vectors{{255, 0, 0}, {255, 255, 255}}));
    const Primitive ply =
        cloudOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                         "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                         "element face 0\nproperty list uchar int vertex_indices\nend_header\n"
                         "0 0 0 0 0 2 255 0 0\n1 2 3 0 -1 0 0 51 0\n");
    EXPECT_EQ(ply.positions, obj.positions);
    EXPECT_EQ(ply.normals, (Vectors{{0, 0, 1}, {0, -1, 0}}));
    EXPECT_EQ(codesOf(ply), (Vectors{{255, 0, 0}, {0, 51, 0}}));
}

TEST(PointFiles, PointSizeMakesInstancesForTheVoxelsOfACube)
{
    const TempDir dir;
    dir.write("a.xyz", std::string_view("0 0 0\n1 1 1\n"));
    const Scene scene = loadIn(dir, "a.xyz", {.point_size = 3});
    ASSERT_EQ(scene.instances.size(), 27U);
    EXPECT_EQ(scene.instances.front().point_shift, glm::ivec3(-2));
    EXPECT_EQ(scene.instances.back().point_shift, glm::ivec3(2));
    EXPECT_EQ(loadIn(dir, "a.xyz", {.point_size = 2}).instances.back().point_shift, glm::ivec3(1));
}

} // namespace

} // namespace zvo::test
