// SPDX-License-Identifier: MIT
// The table of docs/input.md, "What each kind of file can hold", with a tiny file for each of its cells.
#include "core/base/read_file.h"
#include "core/file/zvo_file.h"
#include "io/image/image_io.h"
#include "io/voxel/vox_chunks.h"
#include "io/voxel/vox_file.h"
#include "support/load_files.h"
#include "support/tree_samples.h"
#include "support/zvo_parts.h"
#include "zvo/error.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <variant>

namespace zvo::test
{

namespace
{

/// What stands behind the members of a primitive's attributes, of the primitive, of its node, and of the document.
std::string gltf(const std::string& attributes = "", const std::string& primitive = "", const std::string& node = "",
                 const std::string& rest = "")
{
    constexpr const char* kAccessor = R"({"bufferView":0,"componentType":5126,)";
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:;base64,)" + std::string(48, 'A') +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[)" + kAccessor +
           R"("count":3,"type":"VEC3"},)" + kAccessor + R"("count":1,"type":"SCALAR","min":[0],"max":[0]},)" +
           kAccessor + R"("count":1,"type":"VEC3"},)" + kAccessor + R"("count":3,"type":"VEC2"}],)" +
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0)" + attributes + "}" + primitive +
           R"(}]}],"nodes":[{"mesh":0)" + node + "}]" + rest + "}";
}

std::string gltfMaterial(const std::string& members)
{
    return gltf(R"(,"TEXCOORD_0":3)", R"(,"material":0)", "",
                R"(,"images":[{"uri":"a.png"}],"textures":[{"source":0}],"materials":[{)" + members + "}]");
}

constexpr const char* kMtl = "newmtl red\nKd 1 0 0\nnewmtl lamp\nKe 1 0 0\nnewmtl glass\nd 0.5\nnewmtl bricks\n"
                             "map_Kd a.png\nnewmtl tin\nPm 1\nPr 0.1\n";

std::string obj(const std::string& before_face = "", const std::string& face = "f 1/1 2/1 3/1\n")
{
    return "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\n" + before_face + face;
}

/// Properties of vertices, and a vertex's values; those of the face, and its values; more elements, and their values.
std::string ply(const std::string& vertex = "", const std::string& values = "", const std::string& face = "",
                const std::string& of_face = "3 0 1 2", const std::string& more = "", const std::string& data = "")
{
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + vertex +
           "element face 1\nproperty list uchar int vertex_indices\n" + face + more + "end_header\n0 0 0 " + values +
           "\n1 0 0 " + values + "\n0 1 0 " + values + "\n1 1 0 " + values + "\n" + of_face + "\n" + data;
}

std::string plyElement(const std::string& name, const std::string& property)
{
    return ply("", "", "", "3 0 1 2", "element " + name + " 1\nproperty int " + property + "\n", "1\n");
}

std::string stl(const std::string& name = "", const std::string& normal = "0 0 0", const std::string& more = "")
{
    return "solid " + name + "\nfacet normal " + normal + "\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n" +
           more + "endloop\nendfacet\nendsolid\n";
}

std::string binaryStl(const std::string& head, const std::string& bits)
{
    const std::string file = asBinaryStl({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}}});
    return head + file.substr(head.size(), file.size() - head.size() - 2) + bits;
}

std::string voxOf(const std::string& more)
{
    return vox::voxFile(vox::model(1, 1, 1, std::string("\0\0\0\1", 4)) + more);
}

std::string voxMaterial(const vox::Entries& entries)
{
    return voxOf(vox::chunk("MATL", vox::number(1) + vox::dictionary(entries)));
}

std::string zvoOf(const std::string& sample)
{
    const Bytes bytes = zvoBytes(treeSample(sample));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A file that holds something; the first of an extension holds no more than that.
struct HoldingFile
{
    const char* what;
    const char* extension;
    std::string content;
};

std::vector<HoldingFile> holdingFiles()
{
    using namespace vox;
    const std::string moves = chunk("nTRN", number(0) + dictionary({}) + number(1) + number(-1) + number(0) +
                                                number(2) + dictionary({{"_f", "0"}}) + dictionary({{"_f", "9"}}));
    const std::string rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    const std::string points = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n0 0 0\n";
    const std::string animation = R"(,"animations":[{"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,)"
                                  R"("target":{"node":0,"path":"translation"}}]}])";
    const std::string camera = R"(,"cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}])";
    const std::string shown = "random_3_with_attributes"; // emission, too
    constexpr const char* kColors = "colours of vertices, points, voxels";
    return {
        {"triangles", "gltf", gltf()},
        {"triangles", "obj", obj()},
        {"triangles", "ply", ply()},
        {"triangles", "stl", stl()},
        {"polygons", "obj", obj("", "f 1 2 4 3\n")},
        {"polygons", "ply", ply("", "", "", "4 0 1 3 2")},
        {"polygons", "stl", stl("", "0 0 0", "vertex 1 1 0\n")},
        {"points", "gltf", gltf("", R"(,"mode":0)")},
        {"points", "obj", obj("", "p 1\n")},
        {"points", "ply", points},
        {"points", "xyz", "0 0 0\n"},
        {"lines", "gltf", gltf("", R"(,"mode":1)")},
        {"lines", "obj", obj("l 1 2\n")},
        {"lines", "ply", plyElement("edge", "vertex1")},
        {"curves", "obj", obj("cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nend\n")},
        {"voxels", "vox", voxOf("")},
        {"voxels", "zvo", zvoOf("random_3")},
        {"normals", "gltf", gltf(R"(,"NORMAL":0)")},
        {"normals", "obj", obj("vn 0 0 1\n", "f 1//1 2//1 3//1\n")},
        {"normals", "ply", ply("property float nx\nproperty float ny\nproperty float nz\n", "0 0 1")},
        {"normals", "stl", stl("", "0 0 1")},
        {"normals", "xyz", "0 0 0 0 0 -1\n"},
        {"normals", "zvo", zvoOf(shown)},
        {kColors, "gltf", gltf(R"(,"COLOR_0":0)")},
        {kColors, "obj", obj("v 0 0 1 1 0 0\n")},
        {kColors, "ply", ply(rgb, "255 0 0")},
        {kColors, "xyz", "0 0 0 255 0 0\n"},
        {kColors, "vox", voxOf(chunk("RGBA", std::string(1024, '\x7f')))},
        {kColors, "zvo", zvoOf(shown)},
        {"colours of faces", "ply", ply("", "", rgb, "3 0 1 2 255 0 0")},
        {"colours of faces", "stl", binaryStl("", "\x1f\x80")},
        {"colours of materials", "gltf", gltfMaterial(R"("pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]})")},
        {"colours of materials", "obj", obj("usemtl red\n")},
        {"colours of materials", "ply", plyElement("material", "diffuse_red")},
        {"colours of materials", "stl", binaryStl("MATERIAL=\xff\x01\x01\xff", "\x01\x01")},
        {"textures", "gltf", gltfMaterial(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})")},
        {"textures", "obj", obj("usemtl bricks\n")},
        {"textures", "ply", ply("property float s\nproperty float t\ncomment TextureFile a.png\n", "0 0")},
        {"emission", "gltf", gltfMaterial(R"("emissiveFactor":[1,0,0])")},
        {"emission", "obj", obj("usemtl lamp\n")},
        {"emission", "vox", voxMaterial({{"_type", "_emit"}, {"_emit", "1"}})},
        {"emission", "zvo", zvoOf(shown)},
        {"alpha", "gltf", gltfMaterial(R"("alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0]})")},
        {"alpha", "obj", obj("usemtl glass\n")},
        {"alpha", "ply", ply(rgb + "property uchar alpha\n", "255 0 0 9")},
        {"alpha", "vox", voxMaterial({{"_type", "_glass"}, {"_trans", "0.5"}})},
        {"metals", "gltf", gltfMaterial(R"("pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.1})")},
        {"metals", "obj", obj("usemtl tin\n")},
        {"metals", "vox", voxMaterial({{"_type", "_metal"}, {"_rough", "0.1"}})},
        {"names of materials", "gltf", gltfMaterial(R"("name":"red")")},
        {"names of materials", "obj", obj("usemtl red\n")},
        {"names of parts", "gltf", gltf("", "", R"(,"name":"part")")},
        {"names of parts", "obj", obj("o part\n")},
        {"names of parts", "stl", stl("part")},
        {"names of parts", "vox", voxOf(transform(0, 1, {}, {{"_name", "part"}}) + shape(1, 0))},
        {"hierarchy", "gltf", gltf("", "", R"(,"children":[1]},{)")},
        {"hierarchy", "obj", obj("g part whole\n")},
        {"hierarchy", "vox",
         voxOf(transform(0, 1, {}) + group(1, {2, 3}) + transform(2, 4, {{"_t", "5 0 0"}}) + transform(3, 5, {}) +
               shape(4, 0) + shape(5, 0))},
        {"animation", "gltf", gltf("", "", "", animation)},
        {"animation", "vox", voxOf(moves + shape(1, 0))},
        {"cameras", "gltf", gltf("", "", R"(,"camera":0)", camera)},
        {"cameras", "ply", plyElement("camera", "view_px")},
        {"cameras", "vox", voxOf(chunk("rCAM", number(0) + dictionary({{"_mode", "pers"}})))},
    };
}

/// What a reader made of a file: rows of the table.
using Things = std::set<std::string>;

Things thingsIn(const Scene& scene)
{
    Things things;
    const auto add = [&things](const char* thing, bool is_there) { is_there ? void(things.insert(thing)) : void(); };
    for (const Primitive& primitive : scene.primitives)
    {
        things.insert(primitive.is_points ? "points" : "triangles");
        add("polygons", primitive.triangles.size() == 2);
        add("normals", !primitive.normals.empty());
        add("colours of vertices, points, voxels", !primitive.colors.empty());
        add("colours of faces", !primitive.colors.empty());
        add("alpha", !primitive.colors.empty() && primitive.colors[0].a < 1.0F);
    }
    for (const Material& material : scene.materials)
    {
        add("colours of materials", material.base_color.g == 0.0F);
        add("textures", material.base_color_texture.has_value());
        add("emission", material.emission.r > 0.0F);
        add("alpha", material.base_color.a < 1.0F);
        add("names of materials", material.name == "red");
    }
    for (const Node& node : scene.nodes)
    {
        add("names of parts", node.name == "part");
        add("hierarchy", node.parent != kNone);
    }
    add("animation", !scene.animations.empty());
    add("cameras", !scene.cameras.empty());
    return things;
}

Things thingsIn(std::size_t voxel_count, bool has_normals, bool has_colors, bool emits)
{
    Things things = {"voxels"};
    things.insert(voxel_count == 2 ? "hierarchy" : "voxels");
    things.insert(has_normals ? "normals" : "voxels");
    things.insert(has_colors ? "colours of vertices, points, voxels" : "voxels");
    things.insert(emits ? "emission" : "voxels");
    return things;
}

/// What a file holds after loading, or what became of it else.
std::variant<Things, std::string> outcomeOf(const TempDir& dir, const HoldingFile& file)
{
    const std::string name = std::string("a.") + file.extension;
    const std::filesystem::path path = dir.write(name, std::string_view(file.content));
    try
    {
        if (name == "a.zvo")
        {
            const TreeData tree = readZvo(path).tree;
            const bool has_attributes = tree.hasAttributes();
            return thingsIn(tree.voxel_count, has_attributes, has_attributes, !tree.emission.empty());
        }
        const bool is_vox = name == "a.vox";
        const VoxVoxels voxels = is_vox ? readVox(readFile(path), path) : VoxVoxels();
        const Scene scene = is_vox ? Scene() : loadIn(dir, name);
        if (!voxels.warnings.empty() || !scene.warnings.empty())
        {
            return "warned";
        }
        constexpr std::uint32_t kWhite = 0xffffff; // of the usual palette
        return is_vox ? thingsIn(voxels.codes.size(), false, voxels.colors[0] != kWhite, !voxels.emission.empty())
                      : thingsIn(scene);
    }
    catch (const Error& error)
    {
        EXPECT_EQ(error.code(), ErrorCode::Input) << error.what();
        return "refused";
    }
}

std::vector<std::string> cellsOf(const std::string& line)
{
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');)
    {
        cells.push_back(cell.substr(1, cell.size() - 2));
    }
    return cells;
}

TEST(InputTable, SaysWhatBecomesOfATinyFileForEachCell)
{
    const TempDir dir;
    dir.write("a.mtl", std::string_view(kMtl));
    dir.write("a.png", encodePng(1, 1, std::vector<std::uint8_t>{1, 2, 3, 255}));
    const std::map<std::string, std::string> extensions = {{"glTF", "gltf"}, {"OBJ", "obj"},  {"PLY", "ply"},
                                                           {"STL", "stl"},   {"text", "xyz"}, {".vox", "vox"},
                                                           {".zvo", "zvo"}};
    std::map<std::pair<std::string, std::string>, std::string> found;
    std::map<std::string, Things> bases; // of extensions
    for (const HoldingFile& file : holdingFiles())
    {
        const auto outcome = outcomeOf(dir, file);
        const auto* const things = std::get_if<Things>(&outcome);
        const bool is_read = things != nullptr && things->contains(file.what);
        found[{file.what, file.extension}] = things == nullptr ? std::get<std::string>(outcome)
                                             : is_read         ? "read"
                                                               : "no effect";
        const auto [base, is_new] = bases.try_emplace(file.extension, things == nullptr ? Things() : *things);
        EXPECT_TRUE(is_new ? is_read : !base->second.contains(file.what)) << file.what << ", " << file.extension;
    }
    std::ifstream page(ZVO_SOURCE_DIR "/docs/input.md");
    std::string line;
    while (std::getline(page, line) && !line.starts_with("| | glTF | OBJ |"))
    {
    }
    const std::vector<std::string> titles = cellsOf(line);
    ASSERT_EQ(titles.size(), 1 + extensions.size());
    std::size_t cell_count = 0;
    for (std::getline(page, line); std::getline(page, line) && line.starts_with('|');)
    {
        const std::vector<std::string> cells = cellsOf(line);
        ASSERT_EQ(cells.size(), titles.size()) << line;
        for (std::size_t i = 1; i < titles.size(); ++i)
        {
            const auto outcome = found.find({cells[0], extensions.at(titles[i])});
            EXPECT_EQ(cells[i], outcome == found.end() ? "-" : outcome->second) << cells[0] << ", " << titles[i];
            cell_count += outcome == found.end() ? 0 : 1;
        }
    }
    EXPECT_EQ(cell_count, found.size()) << "the page lacks a row";
}

} // namespace

} // namespace zvo::test
