// SPDX-License-Identifier: MIT
// Malicious files: none reads outside of the document's folder, unpacks without end or exhausts the stack.
// gltf_errors_test.cpp has ordinary mistakes.
#include "core/base/read_file.h"
#include "core/scene/scene_size.h"
#include "gltf_builder.h"
#include "io/gltf/gltf_document.h"
#include "io/gltf/gltf_loader.h"
#include "io/image/image_io.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace zvo::test
{

namespace
{

/// A triangle with indices, texture coordinates and an image.
GltfBuilder texturedTriangle()
{
    GltfBuilder builder = triangleDocument();
    const std::vector<std::uint8_t> png = encodePng(4, 4, std::vector<std::uint8_t>(64, 9));
    json& primitive = builder.document["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    builder.add("images", {{"bufferView", builder.addView(png.data(), png.size())}});
    builder.add("textures", {{"source", 0}});
    builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    primitive["indices"] = builder.addAccessor<std::uint16_t>("SCALAR", kU16, 3, {0, 1, 2});
    primitive["attributes"]["TEXCOORD_0"] = builder.addAccessor<float>("VEC2", kF32, 3, {0, 0, 1, 0, 0, 1});
    return builder;
}

TEST(GltfBadInput, FilesMayBeCutOrHaveABitFlippedAnywhere)
{
    loadCutAndFlipped(texturedTriangle());
}

/// A folder with a document, and a buffer outside that would fit it.
class GltfFolder : public testing::Test
{
protected:
    GltfFolder() { std::filesystem::create_directories(folder() / "sub"); }

    [[nodiscard]] std::filesystem::path folder() const { return m_dir.path() / "folder"; }

    void writeBuffer(const std::string& name) const { m_dir.write(name, triangleDocument().bin); }

    /// Writes the triangle with its buffer at that URI.
    [[nodiscard]] std::filesystem::path writeDocument(const std::string& uri) const
    {
        GltfBuilder builder = triangleDocument();
        builder.document["buffers"] = json::array({{{"byteLength", builder.bin.size()}, {"uri", uri}}});
        return m_dir.write("folder/scene.gltf", builder.document.dump());
    }

    void expectRefused(const std::string& uri, const std::string& part) const
    {
        const auto path = writeDocument(uri);
        expectInputError([&] { loadGltf(path); }, {"scene.gltf", "buffers[0].uri", part});
    }

    TempDir m_dir;
};

TEST_F(GltfFolder, UrisMayNotLeaveIt)
{
    writeBuffer("outside.bin");
    const std::string absolute = (m_dir.path() / "outside.bin").string();
    for (const std::string& uri :
         {std::string("../outside.bin"), std::string("%2e%2e/outside.bin"), std::string("%2E%2e%2Foutside.bin"),
          std::string("sub/../../outside.bin"), std::string("./.././outside.bin"),
          std::string("../folder/../outside.bin"), absolute, "/" + absolute})
    {
        SCOPED_TRACE(uri);
        expectRefused(uri, "leaves the document's folder");
    }
    expectRefused("..", "leaves the document's folder");
    expectRefused("../folder-that-is-not-there/a.bin", "leaves the document's folder");
}

TEST_F(GltfFolder, LinksMayNotLeaveIt)
{
    writeBuffer("outside.bin");
    std::filesystem::create_symlink(m_dir.path() / "outside.bin", folder() / "link.bin");
    std::filesystem::create_directory_symlink(m_dir.path(), folder() / "up");
    expectRefused("link.bin", "leaves the document's folder");
    expectRefused("up/outside.bin", "leaves the document's folder");
    std::filesystem::create_symlink("loop", folder() / "loop");
    expectRefused("loop", "buffers[0].uri");
}

TEST_F(GltfFolder, PlacesBelowItAreFine)
{
    writeBuffer("folder/sub/inside.bin");
    std::filesystem::create_symlink("sub/inside.bin", folder() / "link.bin");
    std::filesystem::create_directory_symlink(folder(), m_dir.path() / "way_in");
    for (const char* uri : {"sub/inside.bin", "link.bin", "./sub/../sub/inside.bin", "../folder/sub/inside.bin"})
    {
        SCOPED_TRACE(uri);
        static_cast<void>(writeDocument(uri));
        EXPECT_EQ(loadGltf(m_dir.path() / "way_in" / "scene.gltf").triangleCount(), 1U);
    }
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder());
    EXPECT_EQ(loadGltf("scene.gltf").triangleCount(), 1U);
    std::filesystem::current_path(before);
}

TEST_F(GltfFolder, OddNamesAreRefused)
{
    writeBuffer("outside.bin");
    writeBuffer("folder/inside.bin");
    expectRefused("..\\outside.bin", "no such file");
    expectRefused("inside.bin%00.png", "zero byte");
    expectRefused("file://inside.bin", "download it");
    expectRefused("sub", "Is a directory");
    expectRefused(std::string(5000, 'a'), "buffers[0].uri");
    expectRefused("/dev/zero", "leaves the document's folder");
}

TEST_F(GltfFolder, PipesAreRefusedAndNotWaitedFor)
{
    ASSERT_EQ(mkfifo((folder() / "pipe").c_str(), S_IRUSR | S_IWUSR), 0);
    expectRefused("pipe", "not a file");
}

TEST_F(GltfFolder, ImagesMayNotLeaveItEither)
{
    m_dir.write("outside.png", encodePng(1, 1, std::vector<std::uint8_t>(4, 9)));
    GltfBuilder builder = texturedTriangle();
    builder.document["images"][0] = {{"uri", "../outside.png"}};
    const auto path = m_dir.write("folder/scene.glb", builder.glb());
    const Scene scene = loadGltf(path);
    EXPECT_TRUE(scene.images.empty());
    expectOneLine(scene.warnings, {"images[0].uri is ../outside.png, which leaves the document's folder"});
}

TEST_F(GltfFolder, ManyBuffersMayLieInOneFileThatIsReadOnce)
{
    writeBuffer("folder/inside.bin");
    GltfBuilder builder = triangleDocument();
    const std::size_t size = builder.bin.size();
    for (int i = 0; i < 100; ++i)
    {
        builder.add("buffers", {{"byteLength", size}, {"uri", i % 2 == 0 ? "inside.bin" : "./sub/../inside.bin"}});
    }
    const auto path = m_dir.write("folder/scene.gltf", builder.document.dump());
    const GltfDocument document = openGltf(path, readFile(path));
    EXPECT_EQ(document.buffers.size(), 100U);
    EXPECT_EQ(document.storage.size(), 2U); // the document and the file
    EXPECT_EQ(loadGltf(path).triangleCount(), 1U);
}

TEST(GltfBadInput, MalformedDataUrisAreRefused)
{
    for (const char* uri : {"data:", "data:;base64", "data:;base64,A", "data:;base64,AA=A", "data:;base64,\u00e4\u00f6",
                            "data:;base64,AAAA AAAA"})
    {
        GltfBuilder builder = triangleDocument();
        builder.document["buffers"] = json::array({{{"byteLength", 36}, {"uri", uri}}});
        SCOPED_TRACE(uri);
        expectInputError(builder, {"buffers[0].uri is not a valid data URI"});
    }
}

TEST(GltfBadInput, InstancesAreCountedBeforeTheyAreMade)
{
    GltfBuilder builder = triangleDocument();
    json& primitives = builder.document["meshes"][0]["primitives"];
    constexpr std::size_t kEach = 4097; // its square is just above the limit
    static_assert(kEach * kEach > kInstancesMax && (kEach - 1) * (kEach - 1) <= kInstancesMax);
    primitives = std::vector<json>(kEach, primitives[0]);
    builder.document["nodes"] = std::vector<json>(kEach, json{{"mesh", 0}});
    expectInputError(builder, {"16785409 primitives", "split the file"});
}

TEST(GltfBadInput, TrianglesAreCountedBeforeTheyAreRead)
{
    GltfBuilder builder = triangleDocument();
    constexpr std::size_t kTriangles = 1 << 16;
    builder.document["meshes"][0]["primitives"][0]["indices"] =
        builder.addAccessor<std::uint8_t>("SCALAR", kU8, 3 * kTriangles, std::vector<std::uint8_t>(3 * kTriangles));
    builder.document["nodes"] = std::vector<json>((1U << 16U) + 1, json{{"mesh", 0}});
    expectInputError(builder, {"e+09 triangles", "split the file"});
}

TEST(GltfBadInput, MeshesThatShareOneBufferMayNotFillTheMemory)
{
    constexpr std::size_t kVertices = 1 << 16;
    constexpr std::size_t kPrimitiveBytes = kVertices * 16; // 12 for each vertex, 12 for each triangle
    GltfBuilder builder;
    const json primitive = {{"attributes", {{"POSITION", builder.addPositions(std::vector<float>(3 * kVertices))}}}};
    builder.add("nodes", {{"mesh", 0}});
    builder.add("meshes", {{"primitives", std::vector<json>(sceneBytesMax() / kPrimitiveBytes + 1, primitive)}});
    expectInputError(builder, {"half of this machine's memory"});
}

TEST(GltfBadInput, AbsurdCountsAreRefused)
{
    for (const std::uint64_t count : {1ULL << 31U, 1ULL << 60U, ~0ULL, ~0ULL / 12, ~0ULL / 12 + 2})
    {
        SCOPED_TRACE(count);
        GltfBuilder builder = triangleDocument();
        builder.document["accessors"][0]["count"] = count;
        expectInputError(builder, {"accessors[0]", std::to_string(count)});
        builder.document["accessors"][0].erase("bufferView");
        expectInputError(builder, {"scene.glb"});
        builder = triangleDocument();
        builder.document["buffers"] = json::array({{{"byteLength", count}}});
        expectInputError(builder, {"buffers[0] needs"});
        builder = triangleDocument();
        builder.document["bufferViews"][0]["byteStride"] = count; // one that is not from 4 to 252 in steps of 4
        expectInputError(builder, {"scene.glb"});
    }
}

TEST(GltfBadInput, LongChainsOfNodesNeedNoStack)
{
    constexpr int kNodes = 50000;
    GltfBuilder builder = triangleDocument();
    builder.document["nodes"] = json::array();
    for (int i = 0; i < kNodes; ++i)
    {
        builder.add("nodes", {{"translation", {1, 0, 0}}, {"children", {i + 1}}});
    }
    builder.add("nodes", {{"mesh", 0}});
    EXPECT_EQ(builder.load().instances.at(0).transform[3], glm::vec4(kNodes, 0, 0, 1));

    for (const int again : {0, kNodes / 2}) // a cycle of all nodes, and one of some
    {
        builder.document["nodes"][kNodes]["children"] = {again};
        const Scene scene = builder.load();
        EXPECT_EQ(scene.instances.at(0).transform[3], glm::vec4(kNodes, 0, 0, 1));
        EXPECT_EQ(scene.warnings.size(), 1U);
    }
}

TEST(GltfBadInput, NestingUpToTheLimitNeedsLittleStack)
{
    // Extras and extensions of every kind of object may be nested.
    json nest = 1;
    for (int depth = 0; depth < 240; ++depth)
    {
        nest = depth % 2 == 0 ? json{{"a", nest}} : json::array({nest});
    }
    GltfBuilder builder = texturedTriangle();
    builder.add("samplers", json::object());
    builder.add("scenes", {{"nodes", {0}}});
    builder.add("cameras",
                {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 0}}}});
    for (const char* array : {"nodes", "meshes", "materials", "textures", "images", "samplers", "scenes", "cameras",
                              "accessors", "bufferViews"})
    {
        builder.document[array][0]["extras"] = nest;
        builder.document[array][0]["extensions"]["EXT_of_nobody"] = nest;
    }
    builder.document["asset"]["extras"] = nest;
    EXPECT_EQ(builder.load().triangleCount(), 1U);
}

} // namespace

} // namespace zvo::test
