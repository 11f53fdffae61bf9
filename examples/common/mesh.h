// SPDX-License-Identifier: MIT
// Meshes as a host that rasterizes has them, and what zvo takes.
#pragma once

#include "zvo/model.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <vector>

namespace host
{

struct Vertex
{
    std::array<float, 3> position;
    std::array<float, 3> normal;
    std::array<std::uint8_t, 4> color; // sRGB codes
};

struct Mesh
{
    std::vector<Vertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A striped trefoil knot, 2 units wide.
Mesh knot();

/// A ring of one colour that lies flat.
Mesh ring(const std::array<float, 3>& center, float radius, float thickness, const std::array<std::uint8_t, 4>& color);

/// A box of one colour.
Mesh box(const std::array<float, 3>& low, const std::array<float, 3>& high, const std::array<std::uint8_t, 4>& color);

/// A room around [-1, 1]^3 that is open towards +z, with a red wall, a green one and a block.
Mesh room();

/// A binary PLY file, which `zvo render` takes.
void writePly(const Mesh& mesh, const std::filesystem::path& path);

/// A mesh as zvo takes it: one array for each attribute, normals of length 1, linear colours.
class ZvoMesh
{
public:
    explicit ZvoMesh(const Mesh& mesh);

    /// Points to this ZvoMesh, which need not live longer than the call that gets it.
    [[nodiscard]] zvo::MeshInfo info() const;

private:
    std::vector<zvo::Vec3> m_positions;
    std::vector<zvo::Vec3> m_normals;
    std::vector<zvo::Vec4> m_colors;
    std::vector<std::array<std::uint32_t, 3>> m_triangles;
};

/// Meshes as zvo takes them, some of which emit light.
class ZvoModel
{
public:
    struct Part
    {
        const Mesh& mesh;
        zvo::Vec3 emission = {0, 0, 0}; // radiance
    };

    /// emission_scale: common to all models of a tree.
    ZvoModel(std::initializer_list<Part> parts, float emission_scale);
    ZvoModel(const ZvoModel&) = delete;
    ZvoModel& operator=(const ZvoModel&) = delete;

    /// Points to this ZvoModel.
    [[nodiscard]] const zvo::ModelInfo& info() const { return m_info; }

private:
    std::vector<ZvoMesh> m_parts;
    std::vector<zvo::MeshInfo> m_meshes;
    std::vector<zvo::MaterialInfo> m_materials;
    zvo::ModelInfo m_info;
};

} // namespace host
