// SPDX-License-Identifier: MIT
// The same mesh in every format gives the same voxels, bit for bit.
#include "cli_scene.h"
#include "run_zvo.h"
#include "support/mesh_files.h"

#include <gtest/gtest.h>

namespace zvo::test
{

namespace
{

std::vector<std::uint8_t> asGlb(const FileMesh& mesh)
{
    std::vector<float> positions;
    for (const glm::vec3& p : mesh.positions)
    {
        positions.insert(positions.end(), {p.x, p.y, p.z});
    }
    std::vector<std::uint32_t> indices;
    for (const glm::uvec3& t : mesh.triangles)
    {
        indices.insert(indices.end(), {t.x, t.y, t.z});
    }
    GltfBuilder builder;
    const std::size_t position_accessor = builder.addPositions(positions);
    builder.addMeshNode({{"attributes", {{"POSITION", position_accessor}}},
                         {"indices", builder.addAccessor("SCALAR", kU32, indices.size(), indices)}});
    return builder.glb();
}

/// The Morton codes that zvo voxelize writes. If it fails, the test fails, and there are none.
std::string codesOf(const TempDir& dir, std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "voxelize");
    arguments.insert(arguments.end(), {"-o", "out.morton", "-f", "--resolution", "64"});
    const Outcome outcome = runZvo(dir.path(), arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? contentOf(dir.path() / "out.morton") : "";
}

TEST(CliFormats, OneMeshGivesTheSameVoxelsInEveryFormat)
{
    const TempDir dir;
    const FileMesh mesh = bentSheet(12);
    dir.write("mesh.glb", asGlb(mesh));
    dir.write("mesh.obj", asObj(mesh));
    dir.write("text.ply", asPly(mesh, PlyEncoding::Text));
    dir.write("little.ply", asPly(mesh, PlyEncoding::LittleEndian));
    dir.write("text.stl", asTextStl(mesh));
    dir.write("binary.stl", asBinaryStl(mesh));
    const std::string codes = codesOf(dir, {"mesh.glb"});
    EXPECT_GT(codes.size(), 8 * 1000U);
    for (const char* name : {"mesh.obj", "text.ply", "little.ply", "text.stl", "binary.stl"})
    {
        EXPECT_EQ(codesOf(dir, {name}), codes) << name;
    }
    EXPECT_EQ(codesOf(dir, {"mesh.obj", "text.stl", "mesh.glb"}), codes); // three copies of the sheet
}

TEST(CliFormats, UpAndScaleMoveTheFilesNotTheVoxels)
{
    const TempDir dir;
    const FileMesh mesh = bentSheet(12);
    FileMesh lying = mesh; // with z up
    for (glm::vec3& p : lying.positions)
    {
        p = glm::vec3(p.x, -p.z, p.y);
    }
    FileMesh millimeters = mesh; // larger by a power of two, so that nothing is rounded
    for (glm::vec3& p : millimeters.positions)
    {
        p *= 1024.0F;
    }
    dir.write("mesh.glb", asGlb(mesh));
    dir.write("lying.stl", asBinaryStl(lying));
    dir.write("millimetres.ply", asPly(millimeters, PlyEncoding::LittleEndian));
    const std::string bounds = "--bounds=-2,-2,-4,6,6,4";
    const std::string codes = codesOf(dir, {"mesh.glb", bounds});
    EXPECT_EQ(codesOf(dir, {"lying.stl", "--up", "z", bounds}), codes);
    EXPECT_NE(codesOf(dir, {"lying.stl", bounds}), codes);
    EXPECT_NE(codesOf(dir, {"lying.stl", "--up=-z", bounds}), codes);
    EXPECT_EQ(codesOf(dir, {"millimetres.ply", "--scale", "0.0009765625", bounds}), codes);
    EXPECT_EQ(codesOf(dir, {"millimetres.ply"}), codesOf(dir, {"mesh.glb"})); // the grid grows with the mesh
}

TEST(CliFormats, RenderTakesSeveralFormatsAndUp)
{
    const TempDir dir;
    dir.write("cube.glb", coloredCube().glb());
    dir.write("mesh.obj", asObj(bentSheet(3)));
    const Outcome outcome = runZvo(dir.path(), {"render", "cube.glb", "mesh.obj", "-o", "a.png", "--resolution", "32",
                                                "--size", "32x32", "--up", "-y", "--scale", "2"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "30 triangles")) << outcome.err;
}

TEST(CliFormats, WrongUpAndScaleAreUsageErrors)
{
    const TempDir dir;
    dir.write("cube.glb", coloredCube().glb());
    const auto expectUsage = [&](const std::string& argument, const std::string& word)
    {
        const Outcome outcome = runZvo(dir.path(), {"voxelize", "cube.glb", "-o", "a.ply", argument});
        EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
        EXPECT_TRUE(contains(outcome.err, word)) << outcome.err;
    };
    expectUsage("--up=w", "x, y, z, -x, -y or -z");
    expectUsage("--up=Z", "x, y, z");
    expectUsage("--scale=0", "above 0");
    expectUsage("--scale=-1", "above 0");
    expectUsage("--scale=1e30x", "above 0");
}

} // namespace

} // namespace zvo::test
