// SPDX-License-Identifier: MIT
// OBJ, PLY and STL files as other programs write them, beside or against what their formats say.
#include "io/image/image_io.h"
#include "support/errors.h"
#include "support/load_files.h"
#include "support/mesh_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
constexpr const char* kSquareFace = "usemtl m\nf 1/1 2/2 3/3 4/4\n";

void writePng(const TempDir& dir, const std::string& name, std::uint8_t red)
{
    std::filesystem::create_directories((dir.path() / name).parent_path());
    dir.write(name, encodePng(1, 1, std::vector<std::uint8_t>{red, 30, 60, 255}));
}

/// A square whose material m has these lines.
Scene squareOf(const std::string& lines)
{
    const TempDir dir;
    writePng(dir, "t.png", 200);
    dir.write("a.mtl", std::string_view("newmtl m\n" + lines));
    dir.write("a.obj", std::string_view(std::string("mtllib a.mtl\n") + kSquare + kSquareFace));
    return loadIn(dir, "a.obj");
}

float opacityOf(const std::string& lines)
{
    const Scene scene = squareOf("Kd 1 0 0\n" + lines);
    EXPECT_TRUE(scene.warnings.empty()) << lines << scene.warnings.at(0);
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(glm::vec3(material.base_color), glm::vec3(1, 0, 0));
    EXPECT_EQ(material.alpha_mode, material.base_color.a < 1.0F ? AlphaMode::Blend : AlphaMode::Opaque) << lines;
    return material.base_color.a;
}

TEST(MeshExporters, NoExporterMeansThatAMaterialCannotBeSeen)
{
    EXPECT_EQ(opacityOf("Tr 1.000000\n"), 1.0F); // MeshLab
    EXPECT_EQ(opacityOf("Tr 1\nillum 2\n"), 1.0F);
    EXPECT_EQ(opacityOf("Tr 0\n"), 1.0F);
    EXPECT_EQ(opacityOf("d 1\nTr 1\n"), 1.0F);
    EXPECT_EQ(opacityOf("Tr 0.25\n"), 0.75F);
    EXPECT_EQ(opacityOf("Tr 0.75\nd 0.5\n"), 0.5F); // d is the format's
    EXPECT_EQ(opacityOf("d 0.5\nTr 0.75\n"), 0.5F);
    EXPECT_EQ(opacityOf("d -halo 0.5\n"), 0.5F);
    EXPECT_EQ(opacityOf("\td\t-halo  1.0\t\n"), 1.0F);
    EXPECT_EQ(opacityOf("d 7\n"), 1.0F);
}

TEST(MeshExporters, MtlStatementsThatAreNotUnderstoodCostNoModel)
{
    for (const char* line : {"Kd spectral file.rfl 1", "Kd xyz 0.1 0.2 0.3", "Kd", "Kd 1 0", "Kd 1 -1 0", "Kd nan 0 0",
                             "d", "d -halo", "d much", "Tr", "Ke spectral lamp.rfl"})
    {
        const Scene scene = squareOf(std::string(line) + "\n");
        EXPECT_EQ(scene.triangleCount(), 2U) << line;
        EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(1.0F)) << line;
        expectOneLine(scene.warnings, {"a.obj: ", " left out ", ": " + std::string(line)});
    }
    const Scene scene = squareOf("sharpness 60\nTf xyz 1 1 1\nNi\nillum\nPr 0.5\n\nkd 0.5\nunknown words here\n");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.materials.at(0).base_color, glm::vec4(0.5F, 0.5F, 0.5F, 1.0F)) << "one number is all three";
}

TEST(MeshExporters, ObjLinesHaveMoreAndFewerNumbers)
{
    for (const char* corner : {"0 0", "0 0 1", "0 0 1 0 0", "0 0 1 0 0 1", "0 0 1 0 0 1 0 0 # eight", "0 0 red"})
    {
        const bool is_colored = std::string_view(corner).starts_with("0 0 1 0 0");
        const Scene scene = loadText("a.obj", fmt::format("v 0 {0}\nv 1 {0}\nv 0.5 1 {0}\nf 1 2 3\n", corner));
        EXPECT_EQ(scene.triangleCount(), 1U) << corner;
        EXPECT_EQ(scene.primitives.at(0).positions.at(1), glm::vec3(1, 0, 0)) << corner;
        EXPECT_EQ(scene.primitives[0].colors.size(), is_colored ? 3U : 0U) << corner;
        EXPECT_TRUE(scene.warnings.empty()) << corner;
    }
    const Scene scene = loadText("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5\nvt 0.25 0.25 0 1\nvn 0 2\n"
                                          "f 1/1/1 2/2/1 3/2/1\n");
    EXPECT_EQ(scene.primitives.at(0).uvs, (std::vector<glm::vec2>{{0.5F, 1}, {0.25F, 0.75F}, {0.25F, 0.75F}}));
    EXPECT_EQ(scene.primitives[0].normals, std::vector<glm::vec3>(3, {0, 1, 0}));
    EXPECT_TRUE(std::isnan(loadText("a.obj", "v -1.#IND 0 1.#QNAN\nf 1 1 1\n").primitives.at(0).positions.at(0).x));
}

TEST(MeshExporters, ObjLinesGoOnBehindABackslash)
{
    const std::string head =
        "# C:\\not\\this\\\nv 0 0\\\n0\nv 1 \\\n\\\n0 0 \\\n\nv 1 1 0\\\r\nv 0 1 0\no C:\\nor\\this\\\n";
    for (const char* face : {"f 1 2 3\\\n4\n", "f 1 2\\\n3 \\\n4 # a comment\n", "f\\\n1 2 3 4", "fo 1 2 3 4 \\\n"})
    {
        const Scene scene = loadText("a.obj", head + "v 0 1 0\n" + face);
        EXPECT_EQ(scene.triangleCount(), 2U) << face;
        EXPECT_TRUE(scene.warnings.empty()) << face;
    }
}

TEST(MeshExporters, ObjPartsThatAreNotReadAreAWarning)
{
    const std::string square = kSquare;
    expectOneLine(loadText("a.obj", square + "cstype bezier\ndeg 1\ncurv 0 1 1 2\nend\nf 1 2 3\n").warnings,
                  {"free-form curves"});
    expectOneLine(loadText("a.obj", square + "surf 0 1 0 1 1 2 3 4\nsurf 0 1 0 1 1 2 3 4\nf 1 2 3\n").warnings,
                  {"free-form"});
    expectOneLine(loadText("a.obj", square + "p 1\np 2\nl 1 2 3\nf 1 2\nf 1 2 3\n").warnings, {"points and lines"});
    expectOneLine(loadText("a.obj", square + "f 1/9 2/0 3/1\n").warnings, {"texture coordinate that is not there"});
    expectOneLine(loadText("a.obj", square + "f 1//1 2//1 3//\n").warnings, {"normal that is not there"});
    expectOneLine(loadText("a.obj", square + kSquareFace).warnings, {"no material file has the material m"});
    expectOneLine(squareOf("map_Kd -mm 0.5 2 t.png\nKd 1 1 1\n").warnings, {"option -mm of textures"});
    expectOneLine(squareOf("map_Kd -t 1 1 t.png\n").warnings, {"option -t of textures"});
    EXPECT_TRUE(
        loadText("a.obj", square + "s 1\ng a b\nusemap off\nlod 1\nbevel on\nf 1/ 2// 3/1/\n").warnings.empty());
}

// The squares are at z = 0, 1, 2 ...; those that are listed have a colour.
TEST(MeshExporters, ObjVerticesWithoutColorsAreWhite)
{
    for (const std::vector<bool>& colored :
         {std::vector<bool>{false, true}, {true, false}, {false, true, false}, {true, true}})
    {
        std::string file;
        for (std::size_t z = 0; z < colored.size(); ++z)
        {
            const char* color = colored[z] ? " 1 0 0" : "";
            file += fmt::format("o part{0}\nv 0 0 {0}{1}\nv 1 0 {0}{1}\nv 0 1 {0}{1}\nf -3 -2 -1\n", z, color);
        }
        const Scene scene = loadText("a.obj", file);
        for (std::size_t i = 0; i < 3 * colored.size(); ++i)
        {
            const Primitive& part = scene.primitives.at(0);
            const glm::vec4 color =
                colored[static_cast<std::size_t>(part.positions.at(i).z)] ? glm::vec4(1, 0, 0, 1) : glm::vec4(1.0F);
            EXPECT_EQ(part.colors.at(i), color) << i;
        }
    }
    const Scene scene = loadText("a.obj", "v 0 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nf 3 2 1\n");
    EXPECT_EQ(scene.primitives.at(0).colors, (std::vector<glm::vec4>{{1, 1, 1, 1}, {0, 1, 0, 1}, {1, 1, 1, 1}}));
}

TEST(MeshExporters, FilesAreFoundBesideTheObjBesideTheMtlAndByTheirNameAlone)
{
    const TempDir dir;
    writePng(dir, "maps/beside obj.png", 10);
    writePng(dir, "library/maps/beside_mtl.png", 20);
    writePng(dir, "alone.png", 30);
    writePng(dir, "library/alone2.png", 40);
    dir.write("library/my lib.mtl", std::string_view(""));
    const auto redOf = [&](const std::string& name, const std::string& library)
    {
        dir.write("library/my lib.mtl", std::string_view("newmtl my material \nmap_Kd " + name + "\r\n"));
        dir.write("a.obj",
                  std::string_view("mtllib " + library + "\n" + kSquare + "usemtl  my material\nf 1/1 2/2 3/3\n"));
        const Scene scene = loadIn(dir, "a.obj");
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.at(0);
        return scene.images.empty() ? 0 : int{scene.images[0].rgba.at(0)};
    };
    EXPECT_EQ(redOf("maps/beside obj.png", "library/my lib.mtl"), 10);
    EXPECT_EQ(redOf("maps\\beside_mtl.png", "library\\my lib.mtl"), 20);
    EXPECT_EQ(redOf("C:\\Users\\someone\\alone.png", "library/my lib.mtl"), 30);
    EXPECT_EQ(redOf("/home/someone/alone.png", "./library/my lib.mtl"), 30);
    EXPECT_EQ(redOf("\\\\server\\share\\alone2.png", "library/my lib.mtl"), 40);
    EXPECT_EQ(redOf("-s 2 2 -bm 1 ../../other/alone2.png", "library/my lib.mtl"), 40);
    dir.write("b.mtl", std::string_view("newmtl my material\nmap_Kd alone2.png\n"));
    writePng(dir, "alone2.png", 50);
    EXPECT_EQ(redOf("alone.png", "D:\\models\\b.mtl"), 50);
    EXPECT_EQ(redOf("alone.png", "b.mtl alone.png"), 50) << "the first of several";
    dir.write("a.obj", std::string_view(std::string("mtllib b.mtl absent.mtl\n") + kSquare + kSquareFace));
    expectOneLine(loadIn(dir, "a.obj").warnings, {"b.mtl absent.mtl: there is no such file"});
}

TEST(MeshExporters, MtlTexturesAreScaledAndMoved)
{
    const auto uvsOf = [](const std::string& lines)
    {
        const Scene scene = squareOf(lines);
        EXPECT_TRUE(scene.warnings.empty()) << lines;
        EXPECT_FALSE(scene.textures.empty()) << lines;
        return scene.primitives.at(0);
    };
    const auto square = [](float left, float bottom, float right, float top) // v = 0 at the top
    {
        return std::vector<glm::vec2>{{left, 1 - bottom}, {right, 1 - bottom}, {right, 1 - top}, {left, 1 - top}};
    };
    EXPECT_EQ(uvsOf("map_Kd t.png\n").uvs, square(0, 0, 1, 1));
    EXPECT_EQ(uvsOf("map_Kd -o 0.5 0 0 t.png\n").uvs, square(0.5F, 0, 1.5F, 1));
    EXPECT_EQ(uvsOf("map_Kd -s 10 10 10 t.png\n").uvs, square(0, 0, 10, 10));
    EXPECT_EQ(uvsOf("map_Kd -s 4 t.png\n").uvs, square(0, 0, 4, 1));
    EXPECT_EQ(uvsOf("map_Kd -blendu on -s 2 4 -clamp on -o 0.25 -0.5 -imfchan m t.png\n").uvs,
              square(0.25F, -0.5F, 2.25F, 3.5F));
    const Primitive both = uvsOf("Ke 1 1 1\nmap_Kd -s 2 2 2 t.png\nmap_Ke t.png\n");
    EXPECT_EQ(both.uvs, square(0, 0, 2, 2));
    EXPECT_EQ(both.emission_uvs, square(0, 0, 1, 1));
    const Primitive emission = uvsOf("Kd 1 1 1\nmap_Ke -o 0 0.5 t.png\n");
    EXPECT_EQ(emission.uvs, square(0, 0.5F, 1, 1.5F));
    EXPECT_TRUE(emission.emission_uvs.empty());
    EXPECT_EQ(squareOf("map_Ke t.png\n").materials.at(0).emission, glm::vec3(1.0F)) << "no Ke: the picture's";
}

constexpr const char* kPlyHead = "ply\nformat ascii 1.0\ncomment VCGLIB generated\n";
constexpr const char* kPlyVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kPlyFaces = "element face 2\nproperty list uchar int vertex_indices\n";
constexpr const char* kPlyPoints = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(MeshExporters, PlyFacesHaveColors)
{
    const std::string head = std::string(kPlyHead) + kPlyVertices + kPlyFaces;
    const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const std::string triangles = "3 0 1 2 255 0 0{0}\n3 0 2 3 0 255 0{0}\n";
    for (const auto& [alpha, value] : {std::pair("", ""), std::pair("property uchar alpha\n", " 255")})
    {
        const Scene scene = loadText("a.ply", head + rgb + alpha + "end_header\n" + kPlyPoints +
                                                  fmt::format(fmt::runtime(triangles), value));
        const Primitive& mesh = scene.primitives.at(0);
        EXPECT_EQ(mesh.positions.size(), 6U);
        EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}}));
        EXPECT_EQ(mesh.colors.at(0), glm::vec4(1, 0, 0, 1));
        EXPECT_EQ(mesh.colors.at(5), glm::vec4(0, 1, 0, 1));
        EXPECT_TRUE(scene.warnings.empty());
    }
    // Single precision, before the corners, and a face of more of them.
    const Scene first = loadText("a.ply", std::string(kPlyHead) + kPlyVertices +
                                              "element face 1\nproperty float r\nproperty float g\nproperty float b\n"
                                              "property list uchar int vertex_index\nend_header\n" +
                                              kPlyPoints + "0 0 1 4 0 1 2 3\n");
    EXPECT_EQ(first.triangleCount(), 2U);
    EXPECT_EQ(first.primitives.at(0).colors, std::vector<glm::vec4>(4, {0, 0, 1, 1}));
    // Vertices have colours, too.
    const Scene both = loadText("a.ply", std::string(kPlyHead) + kPlyVertices + rgb + kPlyFaces + rgb + "end_header\n" +
                                             "0 0 0 255 255 255\n1 0 0 255 255 255\n1 1 0 255 255 255\n0 1 0 0 0 0\n" +
                                             fmt::format(fmt::runtime(triangles), ""));
    EXPECT_EQ(both.primitives.at(0).colors.at(3), glm::vec4(0, 0, 0, 1));
    expectOneLine(both.warnings, {"a.ply: colours of faces left out"});
}

TEST(MeshExporters, PlyTexturesAreThoseOfTheirComments)
{
    const TempDir dir;
    writePng(dir, "first one.png", 10);
    writePng(dir, "second.png", 20);
    const auto load = [&](const std::string& content)
    {
        dir.write("a.ply", std::string_view(content));
        return loadIn(dir, "a.ply");
    };
    const auto redOf = [](const Scene& scene, std::size_t primitive)
    {
        const Material& material = scene.materials.at(scene.primitives.at(primitive).material);
        return scene.images.at(scene.textures.at(material.base_color_texture.value()).image).rgba.at(0);
    };
    const std::string one = std::string(kPlyHead) + "comment TextureFile first one.png\n";
    const std::string wedges = "property list uchar float texcoord\n";
    const std::string faces = "3 0 1 2 6 0 0 1 0 1 1{}\n3 0 2 3 6 0 0 1 1 0 0.75{}\n";
    const Scene corners = load(one + kPlyVertices + kPlyFaces + wedges + "end_header\n" + kPlyPoints +
                               fmt::format(fmt::runtime(faces), "", ""));
    EXPECT_TRUE(corners.warnings.empty());
    EXPECT_EQ(corners.primitives.at(0).uvs,
              (std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0.25F}}));
    EXPECT_EQ(redOf(corners, 0), 10);

    const Scene two =
        load(one + "comment TextureFile C:\\maps\\second.png\n" + kPlyVertices + kPlyFaces + wedges +
             "property int texnumber\nend_header\n" + kPlyPoints + fmt::format(fmt::runtime(faces), " 1", " 0"));
    EXPECT_TRUE(two.warnings.empty());
    ASSERT_EQ(two.primitives.size(), 2U);
    EXPECT_EQ(redOf(two, 0), 10);
    EXPECT_EQ(two.primitives[0].positions.at(2), glm::vec3(0, 1, 0)) << "the second face";
    EXPECT_EQ(redOf(two, 1), 20);

    for (const auto& [u, v] : {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v")})
    {
        const Scene scene =
            load(one + kPlyVertices + fmt::format("property float {}\nproperty float {}\n", u, v) + kPlyFaces +
                 "end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n");
        EXPECT_TRUE(scene.warnings.empty());
        EXPECT_EQ(scene.primitives.at(0).uvs, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
        EXPECT_EQ(redOf(scene, 0), 10);
    }

    const std::string plain =
        std::string(kPlyVertices) + kPlyFaces + "end_header\n" + kPlyPoints + "3 0 1 2\n3 0 2 3\n";
    expectOneLine(load(one + plain).warnings, {"first one.png: there are no texture coordinates"});
    expectOneLine(load(one + kPlyVertices + kPlyFaces + wedges + "end_header\n" + kPlyPoints +
                       "3 0 1 2 4 0 0 1 0\n3 0 2 3 6 0 0 1 1 0 0.75\n")
                      .warnings,
                  {"texture coordinates of faces left out"});
    expectOneLine(load(std::string(kPlyHead) + "comment TextureFile gone.png\n" + kPlyVertices + kPlyFaces + wedges +
                       "end_header\n" + kPlyPoints + fmt::format(fmt::runtime(faces), "", ""))
                      .warnings,
                  {"gone.png: there is no such file"});
    expectOneLine(load(std::string(kPlyHead) + kPlyVertices +
                       "element edge 1\nproperty int vertex1\nproperty int vertex2\n" + kPlyFaces + "end_header\n" +
                       kPlyPoints + "0 1\n3 0 1 2\n3 0 2 3\n")
                      .warnings,
                  {"elements left out", "edge"});
}

TEST(MeshExporters, TextStlIsKnownByItsContent)
{
    const FileMesh mesh = bentSheet(3);
    const std::string text = asTextStl(mesh);
    std::string capitals = text;
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
    std::string apart = text;
    for (const char* word : {"endloop", "endfacet", "endsolid"})
    {
        for (std::size_t at = apart.find(word); at != std::string::npos; at = apart.find(word))
        {
            apart.insert(at + 3, " ");
        }
    }
    const std::string unnamed = text.substr(text.find('\n') + 1);
    for (const std::string& content : {text, capitals, apart, "\n \r\n" + text, "\xEF\xBB\xBF" + text,
                                       "\xEF\xBB\xBF\n\n" + capitals, "  " + text, unnamed})
    {
        for (const char* name : {"a.stl", "a.STL", "no extension"})
        {
            const Scene scene = loadText(name, content);
            EXPECT_EQ(scene.triangleCount(), mesh.triangles.size()) << content.substr(0, 20);
            EXPECT_TRUE(scene.primitives.at(0).colors.empty());
        }
    }
    std::string binary = asBinaryStl(mesh) + "bytes behind the facets";
    binary.replace(0, 12, "solid binary");
    EXPECT_EQ(loadText("a.stl", binary).triangleCount(), mesh.triangles.size()) << "its first word means nothing";
}

TEST(MeshExporters, StlFacetsHaveColorsOfBothConventions)
{
    constexpr std::uint16_t kOwn = 1U << 15U;
    constexpr std::uint16_t kHighestChannel = 31U << 10U;
    constexpr std::uint16_t kLowestChannel = 31;
    const glm::vec4 red(1, 0, 0, 1);
    const glm::vec4 blue(0, 0, 1, 1);
    const glm::vec4 green(0, 1, 0, 1); // of all
    const glm::vec4 white(1.0F);
    const auto colorsOf = [](std::string_view head, std::initializer_list<std::uint16_t> facets)
    {
        std::string file(head);
        file.resize(80, ' ');
        appendBytes(file, static_cast<std::uint32_t>(facets.size()));
        for (const std::uint16_t facet : facets)
        {
            for (const int value : {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0})
            {
                appendBytes(file, static_cast<float>(value));
            }
            appendBytes(file, facet);
        }
        std::vector<glm::vec4> colors;
        const Scene scene = loadText("a.stl", file);
        EXPECT_TRUE(scene.warnings.empty());
        for (std::size_t i = 0; i < scene.primitives.at(0).colors.size(); i += 3)
        {
            EXPECT_EQ(scene.primitives[0].colors[i], scene.primitives[0].colors.at(i + 2));
            colors.push_back(scene.primitives[0].colors[i]);
        }
        return colors;
    };
    using Colors = std::vector<glm::vec4>;
    EXPECT_EQ(colorsOf("VisCAM", {kOwn | kHighestChannel, kOwn | kLowestChannel, kLowestChannel}),
              (Colors{red, blue, white}));
    EXPECT_EQ(colorsOf("no colours", {kHighestChannel, 0, 7}), Colors());
    const std::string_view magics("COLOR=\0\xFF\0\xFF,MATERIAL=\0\xFF\0\xFF", 24);
    EXPECT_EQ(colorsOf(magics, {kHighestChannel, kLowestChannel, kOwn, kOwn | kHighestChannel}),
              (Colors{blue, red, green, green}));
    EXPECT_EQ(colorsOf("Magics " + std::string(magics), {0, 0}), (Colors{green, green})) << "none has its own";
    EXPECT_EQ(colorsOf(magics, {kOwn | kLowestChannel, kOwn | kHighestChannel}), (Colors{red, blue})) << "MeshLab";
    EXPECT_EQ(colorsOf(magics, {kOwn, kOwn}), (Colors{green, green}));
    EXPECT_EQ(colorsOf({"COLOR=\0\xFF\0\xFF,MATERIAL=\1", 21}, {kLowestChannel}), (Colors{red})) << "no warning";
    const glm::vec4 grey = colorsOf("", {static_cast<std::uint16_t>(kOwn | (16U << 10U) | (16U << 5U) | 16U)}).at(0);
    EXPECT_NEAR(grey.g, 0.2288, 0.001) << "16 of 31 is sRGB 0.516";
}

} // namespace

} // namespace zvo::test
