// SPDX-License-Identifier: MIT
// The same mesh in every format gives the same voxels, bit for bit.
#include "cli/cli_folder.h"
#include "core/base/morton.h"
#include "support/mesh_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <vector>

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

constexpr int kResolution = 64;

class CliFormats : public CliFolder
{
protected:
    /// The Morton codes that zvo voxelize writes. If it fails, the test fails, and there are none.
    [[nodiscard]] std::string codesOf(const std::string& arguments) const
    {
        std::filesystem::remove(m_dir.path() / "out.morton");
        run("voxelize -o out.morton --resolution " + std::to_string(kResolution) + ' ' + arguments);
        return file("out.morton");
    }
};

TEST_F(CliFormats, OneMeshGivesTheSameVoxelsInEveryFormat)
{
    const FileMesh mesh = bentSheet(12);
    m_dir.write("mesh.glb", asGlb(mesh));
    m_dir.write("mesh.obj", asObj(mesh));
    m_dir.write("text.ply", asPly(mesh, PlyEncoding::Text));
    m_dir.write("little.ply", asPly(mesh, PlyEncoding::LittleEndian));
    m_dir.write("text.stl", asTextStl(mesh));
    m_dir.write("binary.stl", asBinaryStl(mesh));
    const std::string codes = codesOf("mesh.glb");
    EXPECT_GT(codes.size(), 8 * 1000U);
    for (const char* name : {"mesh.obj", "text.ply", "little.ply", "text.stl", "binary.stl"})
    {
        EXPECT_EQ(codesOf(name), codes) << name;
    }
    EXPECT_EQ(codesOf("mesh.obj text.stl mesh.glb"), codes); // three copies of the sheet
}

TEST_F(CliFormats, PointsOfTextBecomeCubesOfVoxels)
{
    m_dir.write("cloud.xyz", std::string_view("# a cloud\n4.5 5.5 6.5 255 0 0\n20.5 9.5 0.5 0 255 0\n"));
    const Outcome outcome = run("voxelize cloud.xyz -o cloud.morton --grid 0,0,0,1 --resolution 32 --point-size 3");
    EXPECT_TRUE(contains(outcome.err, "45 voxels of 32^3 from 54 points")) << outcome.err;
    std::vector<std::uint64_t> expected;
    for (int i = 0; i < 27; ++i)
    {
        const glm::ivec3 cell(i % 3, i / 3 % 3, i / 9);
        expected.push_back(codeOfCell(glm::uvec3(cell + glm::ivec3(3, 4, 5))));
        if (cell.z != 0) // the grid ends there
        {
            expected.push_back(codeOfCell(glm::uvec3(cell + glm::ivec3(19, 8, -1))));
        }
    }
    std::ranges::sort(expected);
    EXPECT_EQ(codes("cloud.morton"), expected);
    expectError("voxelize cloud.xyz -o a.morton --point-size 17", 2, {"--point-size", "16"});
    m_dir.write("odd.xyz", std::string_view("0 0 0\nnan 0 0\n2 1 inf\n9 9 9\n"));
    EXPECT_TRUE(contains(run("voxelize odd.xyz -o odd.morton").err, "warning: 2 of 4 points left out (nonfinite)\n"));
}

TEST_F(CliFormats, EmissionThatIsLeftOutIsNamed)
{
    m_dir.write("lamp.mtl", std::string_view("newmtl lamp\nKe 1 1 1\n"));
    m_dir.write("lamp.obj", std::string_view("mtllib lamp.mtl\nusemtl lamp\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    const Outcome outcome = run("voxelize lamp.obj -o a.ply --resolution 4");
    EXPECT_TRUE(contains(outcome.err, "warning: the emission of 10 voxels left out")) << outcome.err;
    expectError("voxelize lamp.obj -o b.ply --resolution 4 --strict", 3, {"emission of 10 voxels", "--strict"});
}

TEST_F(CliFormats, UpAndScaleMoveTheFilesNotTheVoxels)
{
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
    m_dir.write("mesh.glb", asGlb(mesh));
    m_dir.write("lying.stl", asBinaryStl(lying));
    m_dir.write("millimetres.ply", asPly(millimeters, PlyEncoding::LittleEndian));
    const std::string bounds = " --bounds=-2,-2,-4,6,6,4 ";
    const std::string codes = codesOf("mesh.glb" + bounds);
    EXPECT_EQ(codesOf("lying.stl --up z" + bounds), codes);
    EXPECT_NE(codesOf("lying.stl" + bounds), codes);
    EXPECT_NE(codesOf("lying.stl --up=-z" + bounds), codes);
    EXPECT_EQ(codesOf("millimetres.ply --scale 0.0009765625" + bounds), codes);
    EXPECT_EQ(codesOf("millimetres.ply"), codesOf("mesh.glb")); // the grid grows with the mesh
}

TEST_F(CliFormats, RenderTakesSeveralFormatsAndUp)
{
    m_dir.write("mesh.obj", asObj(bentSheet(3)));
    const std::string told =
        run("render cube.glb mesh.obj -o a.png --resolution 32 --size 32x32 --up -y --scale 2").err;
    EXPECT_TRUE(contains(told, "30 triangles")) << told;
}

// The layer of voxels below the scene, whose voxels stay as they are.
TEST_F(CliFormats, GroundIsADiscBelowTheScene)
{
    const auto voxelsOf = [&](const std::string& options)
    {
        const std::string codes = codesOf("cube.glb" + options);
        std::vector<std::uint64_t> voxels(codes.size() / sizeof(std::uint64_t));
        std::memcpy(voxels.data(), codes.data(), codes.size());
        return voxels;
    };
    const auto isGround = [](std::uint64_t code) { return cellOfCode(code).y == 0; };
    const std::vector<std::uint64_t> both = voxelsOf(" --ground");
    const auto ground = static_cast<double>(std::ranges::count_if(both, isGround));
    const double radius = kResolution - 1;
    EXPECT_NEAR(ground, std::numbers::pi * radius * radius, 8.0 * radius) << "within a voxel of its edge";
    EXPECT_NEAR(static_cast<double>(both.size()) - ground, static_cast<double>(voxelsOf("").size()), 0.2 * ground);
    expectError("voxelize cube.glb -o a.ply --ground --resolution 131072", 2, {"--ground", "65536"});
}

TEST_F(CliFormats, WrongUpAndScaleAreUsageErrors)
{
    const std::string voxelize = "voxelize cube.glb -o a.ply ";
    expectError(voxelize + "--up=w", 2, {"x, y, z, -x, -y or -z"});
    expectError(voxelize + "--up=Z", 2, {"x, y, z"});
    expectError(voxelize + "--scale=0", 2, {"above 0"});
    expectError(voxelize + "--scale=-1", 2, {"above 0"});
    expectError(voxelize + "--scale=1e30x", 2, {"above 0"});
}

} // namespace

} // namespace zvo::test
