// SPDX-License-Identifier: MIT
#include "io/file/utf16.h"
#include "io/gltf/gltf_builder.h"
#include "io/image/image_io.h"
#include "oracle/voxelizer.h"
#include "support/load_files.h"
#include "support/mesh_files.h"

#include <cmath>
#include <ctime>
#include <filesystem>
#include <gtest/gtest.h>
#include <random>

namespace zvo::test
{

namespace
{

/// The corners of all triangles in sequence.
std::vector<glm::vec3> cornersOf(const Scene& scene)
{
    std::vector<glm::vec3> corners;
    for (const Instance& instance : scene.instances)
    {
        EXPECT_EQ(instance.transform, glm::mat4(1.0F));
        const Primitive& primitive = scene.primitives[instance.primitive];
        for (const glm::uvec3& triangle : primitive.triangles)
        {
            for (int i = 0; i < 3; ++i)
            {
                corners.push_back(primitive.positions[triangle[i]]);
            }
        }
    }
    return corners;
}

std::vector<glm::vec3> cornersOf(const FileMesh& mesh)
{
    std::vector<glm::vec3> corners;
    for (const glm::uvec3& triangle : mesh.triangles)
    {
        for (int i = 0; i < 3; ++i)
        {
            corners.push_back(mesh.positions[triangle[i]]);
        }
    }
    return corners;
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 0.75\n";

TEST(MeshImport, EveryFormatGivesTheSameTriangles)
{
    const FileMesh mesh = bentSheet(9);
    const std::vector<glm::vec3> wanted = cornersOf(mesh);
    EXPECT_EQ(cornersOf(loadText("mesh.obj", asObj(mesh))), wanted);
    EXPECT_EQ(cornersOf(loadText("mesh.ply", asPly(mesh, PlyEncoding::Text))), wanted);
    EXPECT_EQ(cornersOf(loadText("mesh.ply", asPly(mesh, PlyEncoding::LittleEndian))), wanted);
    EXPECT_EQ(cornersOf(loadText("mesh.ply", asPly(mesh, PlyEncoding::BigEndian))), wanted);
    EXPECT_EQ(cornersOf(loadText("mesh.stl", asTextStl(mesh))), wanted);
    EXPECT_EQ(cornersOf(loadText("mesh.stl", asBinaryStl(mesh))), wanted);
}

TEST(MeshImport, WithoutColorsAMeshIsWhite)
{
    const FileMesh mesh = bentSheet(1);
    for (const auto& [name, content] :
         {std::pair("mesh.obj", asObj(mesh)), std::pair("mesh.ply", asPly(mesh, PlyEncoding::Text)),
          std::pair("mesh.stl", asBinaryStl(mesh))})
    {
        const Scene scene = loadText(name, content);
        ASSERT_EQ(scene.materials.size(), 1U) << name;
        EXPECT_EQ(scene.materials[0].base_color, glm::vec4(1.0F)) << name;
        EXPECT_TRUE(scene.primitives.at(0).colors.empty()) << name;
        EXPECT_TRUE(scene.primitives.at(0).normals.empty()) << name;
        EXPECT_TRUE(scene.warnings.empty()) << name;
    }
}

TEST(MeshImport, PlyColorsAreSrgb)
{
    FileMesh mesh = bentSheet(1);
    mesh.colors = {{0, 255, 128}, {10, 20, 30}, {255, 255, 255}, {64, 0, 200}};
    const std::vector<glm::vec3> linear = {
        {0, 1, 0.2158605F}, {0.0030353F, 0.0069954F, 0.0129830F}, {1, 1, 1}, {0.0512695F, 0, 0.5775805F}};
    for (const PlyEncoding encoding : {PlyEncoding::Text, PlyEncoding::LittleEndian})
    {
        const Scene scene = loadText("mesh.ply", asPly(mesh, encoding));
        ASSERT_EQ(scene.primitives.at(0).colors.size(), 4U);
        for (std::size_t i = 0; i < 4; ++i)
        {
            EXPECT_LT(glm::distance(glm::vec3(scene.primitives[0].colors[i]), linear[i]), 1e-5F) << i;
            EXPECT_EQ(scene.primitives[0].colors[i].a, 1.0F);
        }
    }
}

TEST(MeshImport, ObjPolygonsBecomeTriangles)
{
    const Scene scene =
        loadText("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 0\nf 1 2 3 5 4\nf -5 -4 -3\nl 1 2\n");
    EXPECT_EQ(scene.triangleCount(), 4U); // a pentagon and a triangle
    double area = 0;
    const std::vector<glm::vec3> corners = cornersOf(scene);
    for (std::size_t i = 0; i < corners.size(); i += 3)
    {
        area += 0.5 * glm::length(glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]));
    }
    EXPECT_NEAR(area, 1.5 + 0.5, 1e-6);
    expectOneLine(scene.warnings, {"quad.obj: points and lines left out"});
}

TEST(MeshImport, ConcaveFacesCoverTheSameVoxelsInEveryFormat)
{
    const std::string points = "0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n";
    const std::string header = "ply\nformat ascii 1.0\n";
    const std::string vertices = "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    for (int first = 0; first < 6; ++first) // the notch lies on the diagonal
    {
        std::string obj = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf";
        std::string face = "6";
        for (int i = 0; i < 6; ++i)
        {
            obj += fmt::format(" {}", (first + i) % 6 + 1);
            face += fmt::format(" {}", (first + i) % 6);
        }
        for (const Scene& scene :
             {loadText("l.obj", obj + "\n"),
              loadText("l.ply", header + vertices + faces + "end_header\n" + points + face + "\n"),
              loadText("l.ply", header + faces + vertices + "end_header\n" + face + "\n" + points)})
        {
            EXPECT_EQ(scene.triangleCount(), 4U);
            const Grid grid = Grid::around({{0, 0, 0}, {2, 2, 0}}, 6);
            EXPECT_EQ(oracle::voxelize(scene, grid, Coverage::Thin).codes.size(), 3135U);
        }
    }
}

TEST(MeshImport, PlyFacesStayInTheirOrder)
{
    const Scene scene = loadText("faces.ply", "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty "
                                              "float y\nproperty float z\nelement face 6\nproperty list uchar int "
                                              "vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n"
                                              "3 0 1 2\n4 0 1 2 3\n2 0 1\n3 1 4 5\n4 1 4 5 2\n3 5 4 1\n");
    EXPECT_EQ(scene.primitives.at(0).triangles,
              (std::vector<glm::uvec3>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 4, 5}, {1, 5, 2}, {5, 4, 1}}));
}

TEST(MeshImport, ObjHasTheMaterialsOfItsMtlFile)
{
    const TempDir dir;
    std::filesystem::create_directory(dir.path() / "textures");
    dir.write("textures/bricks.png", encodePng(1, 1, std::vector<std::uint8_t>{10, 20, 30, 255}));
    dir.write("thing.mtl", "newmtl red\nKd 0.75 0.25 0.125\nd 0.5\n\nnewmtl bricks\nKd 0 0 0\n"
                           "map_Kd -clamp on textures\\bricks.png\nnewmtl lamp\nKd 0 0 0\nKe 4 2 1\n"
                           "newmtl leaf\nKd 1 1 1\nmap_Kd textures/bricks.png\nmap_d textures/bricks.png\n");
    dir.write("thing.obj", std::string("mtllib thing.mtl\n") + kTriangle +
                               "vn 0 0 2\nusemtl red\nf 1//1 2//1 3//1\nusemtl bricks\nf 1/1 2/2 3/3\nusemtl lamp\nf 1 "
                               "2 3\nusemtl leaf\nf 1/1 3/3 2/2\n");
    const Scene scene = loadIn(dir, "thing.obj");
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.at(0);
    ASSERT_EQ(scene.primitives.size(), 4U);
    const auto primitiveOf = [&](std::string_view material)
    {
        const auto has = [&](const Primitive& primitive)
        { return scene.materials.at(primitive.material).name == material; };
        return *std::ranges::find_if(scene.primitives, has);
    };
    const auto materialOf = [&](std::string_view name) { return scene.materials.at(primitiveOf(name).material); };
    EXPECT_EQ(materialOf("red").base_color, glm::vec4(0.75F, 0.25F, 0.125F, 0.5F));
    EXPECT_EQ(materialOf("red").alpha_mode, AlphaMode::Blend);
    EXPECT_EQ(primitiveOf("red").normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    EXPECT_EQ(materialOf("bricks").base_color, glm::vec4(1.0F)); // black would hide the texture
    EXPECT_EQ(materialOf("bricks").alpha_mode, AlphaMode::Opaque);
    ASSERT_TRUE(materialOf("bricks").base_color_texture);
    const Texture& texture = scene.textures.at(*materialOf("bricks").base_color_texture);
    EXPECT_EQ(texture.wrap_u, WrapMode::ClampToEdge);
    EXPECT_EQ(scene.images.at(texture.image).rgba, (std::vector<std::uint8_t>{10, 20, 30, 255}));
    EXPECT_EQ(primitiveOf("bricks").uvs, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0.25F}})); // v = 0 at the top
    EXPECT_EQ(materialOf("lamp").emission, glm::vec3(4, 2, 1));
    EXPECT_EQ(materialOf("leaf").alpha_mode, AlphaMode::Mask);
}

TEST(MeshImport, WhatAnMtlFileNamesWronglyIsAWarning)
{
    const TempDir dir;
    const TempDir outside;
    outside.write("secret.png", encodePng(1, 1, std::vector<std::uint8_t>{1, 2, 3, 4}));
    dir.write("notes.png", std::string_view("no picture"));
    std::filesystem::create_symlink(outside.path() / "secret.png", dir.path() / "link.png");
    dir.write("a.obj", std::string("mtllib a.mtl\n") + kTriangle + "usemtl m\nf 1/1 2/2 3/3\n");
    const std::string up = "../" + outside.path().filename().string() + "/secret.png";
    for (const auto& [name, reason] :
         {std::pair(up, "no such file"), std::pair((outside.path() / "secret.png").string(), "no such file"),
          std::pair(std::string("link.png"), "no such file"), std::pair(std::string("absent.png"), "no such file"),
          std::pair(std::string("."), "no such file"),
          std::pair(std::string("notes.png"), "not a PNG, JPEG, WebP, BMP or TGA")})
    {
        dir.write("a.mtl", "newmtl m\nKd 0 0 0\nmap_Kd " + name + "\n");
        const Scene scene = loadIn(dir, "a.obj");
        EXPECT_EQ(scene.triangleCount(), 1U);
        EXPECT_TRUE(scene.images.empty()) << name;
        EXPECT_FALSE(scene.materials.at(0).base_color_texture) << name;
        EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1.0F)) << "black stands for the texture";
        expectOneLine(scene.warnings, {"a.obj: texture left out: " + name, reason});
    }
}

TEST(MeshImport, MtlFileIsReadOnceHoweverOftenItIsNamed)
{
    const TempDir dir;
    std::string lines;
    for (int i = 0; i < 20000; ++i)
    {
        lines += "mtllib a.mtl\n";
    }
    dir.write("a.mtl", "newmtl m\nKd 0.5 0.25 1\n" + std::string(1U << 20U, '#') + "\n");
    dir.write("b.mtl", std::string_view("newmtl m\nKd 0 0 0\n")); // no line of the scene names it
    dir.write("b.obj", lines + kTriangle + "usemtl m\nf 1 2 3\n");
    const std::clock_t start = std::clock();
    const Scene scene = loadIn(dir, "b.obj");
    EXPECT_LT((std::clock() - start) / CLOCKS_PER_SEC, 5); // otherwise 20 GB are read
    EXPECT_EQ(scene.materials.at(scene.primitives.at(0).material).base_color, glm::vec4(0.5F, 0.25F, 1.0F, 1.0F));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(MeshImport, MtlFilesOutsideOfTheFolderAreLeftOut)
{
    const TempDir dir;
    const TempDir outside;
    outside.write("b.mtl", std::string_view("newmtl m\nKd 1 0 0\n"));
    std::filesystem::create_symlink(outside.path() / "b.mtl", dir.path() / "link.mtl");
    const std::string rest = std::string(kTriangle) + "usemtl m\nf 1 2 3\n";
    for (const std::string& name :
         {"../" + outside.path().filename().string() + "/b.mtl", (outside.path() / "b.mtl").string(),
          "..\\" + outside.path().filename().string() + "\\b.mtl", std::string("link.mtl"), std::string("absent.mtl")})
    {
        dir.write("a.obj", "mtllib " + name + "\n" + rest);
        const Scene scene = loadIn(dir, "a.obj");
        EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1.0F));
        expectOneLine(scene.warnings, {"a.obj: colours left out: " + name + ": there is no such file"});
        expectInputError([&] { loadIn(dir, "a.obj", {.strict = true}); }, {"a.obj: colours left out", name});
    }
}

TEST(MeshImport, BrokenFilesAreInputErrors)
{
    const auto expectBroken = [](const std::string& name, const std::string& content, const std::string& problem) {
        expectInputError([&] { loadText(name, content); }, {name, problem, "again"});
    };
    const FileMesh mesh = bentSheet(2);
    const std::string ply = asPly(mesh, PlyEncoding::LittleEndian);
    expectBroken("empty.obj", "", "not a valid OBJ file: it has no vertices");
    expectBroken("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
                 "line 4 has a face with the vertex \"9\", but there are 3");
    expectBroken("empty.ply", "", "first line");
    expectBroken("text.ply", "hello", "first line");
    expectBroken("header.ply", ply.substr(0, 60), "header");
    expectBroken("cut.ply", ply.substr(0, ply.size() - 1), "cut short");
    const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const auto plyOf = [&](const std::string& header, const std::string& data)
    { return "ply\nformat ascii 1.0\n" + header + data; };
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    expectBroken("index.ply", plyOf(vertices + faces, points + "3 0 1 3\n"), "vertex 3, but there are 3");
    expectBroken("negative.ply", plyOf(vertices + faces, points + "3 0 1 -1\n"), "vertex -1");
    expectBroken("half.ply", plyOf(vertices + faces, points + "3 0 1 0.5\n"), "vertex 0.5");
    expectBroken("list.ply", plyOf(vertices + faces, points + "-3 0 1 2\n"), "-3 entries");
    expectBroken("nan.ply", plyOf(vertices + faces, points + "nan 0 1 2\n"), "nan entries");
    expectBroken("word.ply", plyOf(vertices + faces, "0 0 zero\n"), "\"zero\" is not a number");
    expectBroken("many.ply", plyOf(vertices + faces, points + "4000000000 0 1 2\n"), "cut short");
    expectBroken("short.ply", plyOf(vertices + faces, points), "cut short");
    const std::string more = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                             "property float nx\nproperty float ny\nproperty float nz\n";
    expectBroken("twice.ply", plyOf(vertices + more + faces, points + "0 0 1 0 0 1\n3 0 1 2\n"), "several lists");
    expectBroken("twice.ply", plyOf(more + vertices + faces, "0 0 1 0 0 1\n" + points + "3 0 1 2\n"), "several lists");
    expectBroken("axis.ply", plyOf("element vertex 1\nproperty float x\nproperty float y\nend_header\n", "0 0\n"),
                 "no x, y and z");
    expectBroken("type.ply", plyOf("element vertex 1\nproperty quad x\nend_header\n", ""), "unknown type");
    expectBroken("count.ply", plyOf("element vertex -1\nend_header\n", ""), "no count");
    expectBroken("format.ply", "ply\nformat morse 1.0\nend_header\n", "morse");
    expectBroken("empty.stl", "", "0 bytes");
    expectBroken("cut.stl", asBinaryStl(mesh).substr(0, 200), "announces 8 facets");
    expectBroken("text.stl", asTextStl(mesh).substr(0, 300), "in line 12");
    const std::string facet = "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    expectBroken("half.stl", facet, "cut short");
    expectBroken("two.stl", facet + "endloop\nendfacet\nendsolid\n", "a facet of 2 vertices in line 6");
    expectBroken("word.stl", facet + "vertex 0 one 0\nendloop\nendfacet\nendsolid\n", "\"one\" in line 6");
    expectBroken("four.stl", facet + "vertex 0 1 0\nvertex 0 1 1\nendloop\n", "more than 3 vertices");
}

TEST(MeshImport, PlyStripsStartAnewAndUnknownElementsAreSkipped)
{
    const Scene scene =
        loadText("strips.ply",
                 "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement camera 1\nproperty float view\n"
                 "property list uchar short knots\nelement nothing 4000000000\nelement vertex 6\nproperty float x\n"
                 "property float y\nproperty float quality\nproperty float z\nelement tristrips 1\nproperty list "
                 "int int vertex_indices\nend_header\n45 2 7 8\n0 0 9 0\n0 1 9 0\n1 0 9 0\n1 1 9 0\n2 0 9 0\n2 1 "
                 "9 0\n8 0 1 2 3 -1 3 4 5\n");
    EXPECT_EQ(scene.primitives.at(0).triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}}));
    EXPECT_EQ(scene.primitives[0].positions[5], glm::vec3(2, 1, 0));
}

TEST(MeshImport, PlyHeadersOfOldExportersAreTaken)
{
    // Blender wrote its comment without the keyword until 2008, and types by their sizes until 2007.
    const std::string header = "ply \r\nformat ascii 1.0\r\nCreated by Blender3D 242 - www.blender.org, source file: "
                               "a.blend\r\nelement vertex 3 \r\nproperty float32 x\r\nproperty float32 y\r\nproperty "
                               "float32 z\r\nproperty float32 s\r\nproperty float32 t\r\nproperty uint8 red\r\n"
                               "property uint8 green\r\nproperty uint8 blue\r\nelement face 1\r\nproperty list uint8 "
                               "uint32 vertex_indices\r\nend_header\r\n";
    const std::string data = "0 0 0 0 0 255 0 0\r\n1 0 0 1 0 255 0 0\r\n0 1 0 0 1 255 0 0\r\n3 0 1 2\r\n";
    const TempDir dir;
    const std::filesystem::path path = dir.write("old.ply", std::string_view(header + data));
    const Scene scene = loadScene(std::span(&path, 1));
    EXPECT_EQ(cornersOf(scene), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.primitives.at(0).colors, std::vector<glm::vec4>(3, {1, 0, 0, 1}));
    expectOneLine(scene.warnings, {"old.ply: lines of the header without a keyword of PLY left out (\"Created "
                                   "by Blender3D 242"});
    expectInputError([&] { return loadScene(std::span(&path, 1), {.strict = true}); },
                     {"old.ply", "Created by Blender3D"});
}

/// text in UTF-16, with or without its mark.
std::string inUtf16(const std::string& text, bool is_big_endian, bool has_mark)
{
    std::string wide = !has_mark ? "" : is_big_endian ? "\xFE\xFF" : "\xFF\xFE";
    for (const char character : text)
    {
        wide += is_big_endian ? std::string{'\0', character} : std::string{character, '\0'};
    }
    return wide;
}

TEST(MeshImport, ObjAndMtlFilesMayBeUtf16)
{
    const std::string obj = std::string("mtllib a.mtl\n") + kTriangle + "usemtl m\nf 1 2 3\n";
    const std::string mtl = "newmtl m\nKd 0.5 0.25 1\n";
    const auto expectTriangle = [](const std::string& obj_file, const std::string& mtl_file)
    {
        const TempDir dir;
        dir.write("a.obj", std::string_view(obj_file));
        dir.write("a.mtl", std::string_view(mtl_file));
        const Scene scene = loadIn(dir, "a.obj");
        EXPECT_EQ(cornersOf(scene), (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
        EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(0.5F, 0.25F, 1.0F, 1.0F));
        EXPECT_TRUE(scene.warnings.empty());
    };
    for (const bool is_big_endian : {false, true})
    {
        for (const bool has_mark : {false, true})
        {
            expectTriangle(inUtf16(obj, is_big_endian, has_mark), inUtf16(mtl, is_big_endian, has_mark));
            expectTriangle(obj, inUtf16(mtl, is_big_endian, has_mark));
        }
    }
    expectTriangle("\xEF\xBB\xBF" + obj, "\xEF\xBB\xBF" + mtl);
}

TEST(MeshImport, Utf16OfAllPlanesBecomesUtf8)
{
    const auto utf8 = [](std::vector<std::uint8_t> bytes)
    {
        const std::vector<std::uint8_t> text = asUtf8(bytes).value();
        return std::string(text.begin(), text.end());
    };
    EXPECT_EQ(utf8({0xFE, 0xFF, 0, 'a', 0, 0xE4, 0x20, 0xAC, 0xD8, 0x3D, 0xDE, 0}),
              "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
    EXPECT_EQ(utf8({0xFF, 0xFE, 0x3D, 0xD8, 'a', 0, 0, 0xDE, 0x3D, 0xD8, 'b'}),
              "\xEF\xBF\xBD"
              "a"
              "\xEF\xBF\xBD"
              "\xEF\xBF\xBD"); // surrogates alone; half a character at the end
    EXPECT_FALSE(asUtf8(std::vector<std::uint8_t>{'v', ' '}));
    EXPECT_FALSE(asUtf8(std::vector<std::uint8_t>{}));
    EXPECT_FALSE(asUtf8(std::vector<std::uint8_t>{0, 0}));
}

TEST(MeshImport, PlyVerticesWithoutFacesArePoints)
{
    const Scene scene = loadText("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty "
                                              "double y\nproperty double z\nend_header\n+0.5 1e3 -2\n");
    EXPECT_EQ(scene.primitives.at(0).positions, (std::vector<glm::vec3>{{0.5F, 1000, -2}}));
    EXPECT_TRUE(scene.primitives[0].is_points);
    EXPECT_EQ(scene.primitives[0].triangles, (std::vector<glm::uvec3>{{0, 0, 0}}));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(MeshImport, TextCoordinatesAreRoundedOnce)
{
    // Just above the middle between 1 and the next number. Rounding by way of double precision would round it down.
    const std::string above = "1.000000059604644775390626";
    const std::string text = "solid a\nfacet normal 0 0 0\nouter loop\nvertex " + above +
                             " 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    EXPECT_EQ(loadText("a.stl", text).primitives.at(0).positions[0].x, std::nextafter(1.0F, 2.0F));
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
                            "float z\nend_header\n" +
                            above + " 0 0\n";
    EXPECT_EQ(loadText("a.ply", ply).primitives.at(0).positions[0].x, std::nextafter(1.0F, 2.0F));
}

TEST(MeshImport, TextCoordinatesBeyondSinglePrecisionAreZeroOrInfinite)
{
    const Scene scene = loadText("a.stl", "solid a\nfacet normal 0 0 0\nouter loop\nvertex 1e-60 -1e60 0\n"
                                          "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
    EXPECT_EQ(scene.primitives.at(0).positions[0], glm::vec3(0, -INFINITY, 0));
}

TEST(MeshImport, DamagedBytesGiveASceneOrAnInputError)
{
    FileMesh mesh = bentSheet(3);
    mesh.colors.assign(mesh.positions.size(), {1, 2, 3});
    std::mt19937 random(17); // NOLINT: the same damage on every run
    for (const auto& [name, content] :
         {std::pair("mesh.obj", asObj(mesh)), std::pair("mesh.ply", asPly(mesh, PlyEncoding::Text)),
          std::pair("mesh.ply", asPly(mesh, PlyEncoding::LittleEndian)), std::pair("mesh.stl", asTextStl(mesh)),
          std::pair("mesh.stl", asBinaryStl(mesh))})
    {
        const TempDir dir;
        for (int i = 0; i < 200; ++i)
        {
            std::string damaged = content;
            for (std::size_t k = 0; k <= random() % 3; ++k)
            {
                damaged[random() % damaged.size()] = static_cast<char>(random());
            }
            damaged.resize(damaged.size() - (random() % 4 == 0 ? random() % damaged.size() : 0));
            dir.write(name, damaged);
            loadsOrIsRefused([&dir, &file = name] { EXPECT_LE(loadIn(dir, file).triangleCount(), 10000U); });
        }
    }
}

} // namespace

} // namespace zvo::test
