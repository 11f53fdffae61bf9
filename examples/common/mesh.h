// SPDX-License-Identifier: MIT
// Meshes as a host that rasterizes has them, and what zvo takes.
#pragma once

#include "zvo/model.h"

#include <array>
#include <cstdint>
#include <filesystem>
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

} // namespace host
