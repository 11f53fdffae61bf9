// SPDX-License-Identifier: MIT
#include "common/mesh.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace host
{

namespace
{

static_assert(std::endian::native == std::endian::little); // of what writePly() writes

// A closed surface over a torus of count_u * count_v vertices.
template <typename MakeVertex> Mesh closedSurface(std::uint32_t count_u, std::uint32_t count_v, MakeVertex makeVertex)
{
    Mesh mesh;
    for (std::uint32_t u = 0; u < count_u; ++u)
    {
        for (std::uint32_t v = 0; v < count_v; ++v)
        {
            mesh.vertices.push_back(makeVertex(u, v));
            const std::uint32_t next_u = (u + 1) % count_u;
            const std::uint32_t next_v = (v + 1) % count_v;
            const std::array<std::uint32_t, 4> corners = {u * count_v + v, next_u * count_v + v,
                                                          next_u * count_v + next_v, u * count_v + next_v};
            mesh.triangles.push_back({corners[0], corners[1], corners[2]});
            mesh.triangles.push_back({corners[0], corners[2], corners[3]});
        }
    }
    return mesh;
}

using Double3 = std::array<double, 3>;

Double3 knotCurve(double t)
{
    const double radius = (2.0 + std::cos(3.0 * t)) / 3.4;
    return {radius * std::cos(2.0 * t), radius * std::sin(2.0 * t), -std::sin(3.0 * t) / 3.4};
}

Double3 normalized(const Double3& v)
{
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
}

Double3 cross(const Double3& a, const Double3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::array<float, 3> rounded(const Double3& v)
{
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

// IEC 61966-2-1.
float linearOf(std::uint8_t code)
{
    const double value = code / 255.0;
    return static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
}

template <typename T> void append(std::vector<char>& bytes, const T& value)
{
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

} // namespace

Mesh knot()
{
    constexpr std::uint32_t kAlong = 240;
    constexpr std::uint32_t kAround = 24;
    constexpr double kRadius = 0.16;
    constexpr double kStep = 1e-4; // of the curve's derivative
    return closedSurface(kAlong, kAround,
                         [](std::uint32_t u, std::uint32_t v)
                         {
                             const double t = 2.0 * std::numbers::pi * u / kAlong;
                             const double angle = 2.0 * std::numbers::pi * v / kAround;
                             const Double3 at = knotCurve(t);
                             const Double3 ahead = knotCurve(t + kStep);
                             const Double3 tangent = normalized({ahead[0] - at[0], ahead[1] - at[1], ahead[2] - at[2]});
                             const Double3 side = normalized(cross(tangent, {0, 0, 1}));
                             const Double3 up = cross(side, tangent);
                             Double3 normal{};
                             Double3 position{};
                             for (std::size_t axis = 0; axis < 3; ++axis)
                             {
                                 normal[axis] = std::cos(angle) * side[axis] + std::sin(angle) * up[axis];
                                 position[axis] = at[axis] + kRadius * normal[axis];
                             }
                             const auto shade = static_cast<std::uint8_t>(60 + 190 * u / kAlong);
                             const bool is_stripe = (u / 6 + v / 4) % 2 == 0;
                             return Vertex{rounded(position), rounded(normal),
                                           is_stripe ? std::array<std::uint8_t, 4>{230, shade, 60, 255}
                                                     : std::array<std::uint8_t, 4>{40, 110, shade, 255}};
                         });
}

Mesh ring(const std::array<float, 3>& center, float radius, float thickness, const std::array<std::uint8_t, 4>& color)
{
    constexpr std::uint32_t kAlong = 96;
    constexpr std::uint32_t kAround = 24;
    return closedSurface(kAlong, kAround,
                         [&](std::uint32_t u, std::uint32_t v)
                         {
                             const double longitude = 2.0 * std::numbers::pi * u / kAlong;
                             const double angle = 2.0 * std::numbers::pi * v / kAround;
                             const Double3 normal = {std::cos(angle) * std::cos(longitude), std::sin(angle),
                                                     std::cos(angle) * std::sin(longitude)};
                             const Double3 outward = {std::cos(longitude), 0, std::sin(longitude)};
                             Double3 position{};
                             for (std::size_t axis = 0; axis < 3; ++axis)
                             {
                                 position[axis] = center[axis] + radius * outward[axis] + thickness * normal[axis];
                             }
                             return Vertex{rounded(position), rounded(normal), color};
                         });
}

Mesh box(const std::array<float, 3>& low, const std::array<float, 3>& high, const std::array<std::uint8_t, 4>& color)
{
    Mesh mesh;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        for (const bool is_high : {false, true})
        {
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (std::size_t corner = 0; corner < 4; ++corner)
            {
                Vertex vertex{low, {0, 0, 0}, color};
                vertex.normal[axis] = is_high ? 1.0F : -1.0F;
                const std::array<bool, 3> takes_high = {is_high, corner % 2 != 0, corner / 2 != 0};
                for (std::size_t i = 0; i < 3; ++i)
                {
                    const std::size_t at = (axis + i) % 3;
                    vertex.position[at] = takes_high[i] ? high[at] : low[at];
                }
                mesh.vertices.push_back(vertex);
            }
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangles.push_back({first + 1, first + 3, first + 2});
        }
    }
    return mesh;
}

Mesh room()
{
    constexpr float kOut = 1.0625F; // outside of the walls
    constexpr std::array<std::uint8_t, 4> kWhite = {220, 220, 220, 255};
    Mesh mesh;
    const auto add = [&](const Mesh& part)
    {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const auto& [a, b, c] : part.triangles)
        {
            mesh.triangles.push_back({first + a, first + b, first + c});
        }
    };
    add(box({-kOut, -kOut, -kOut}, {kOut, -1, 1}, kWhite));
    add(box({-kOut, 1, -kOut}, {kOut, kOut, 1}, kWhite));
    add(box({-kOut, -1, -kOut}, {kOut, 1, -1}, kWhite));
    add(box({-kOut, -1, -1}, {-1, 1, 1}, {210, 50, 40, 255}));
    add(box({1, -1, -1}, {kOut, 1, 1}, {60, 180, 70, 255}));
    add(box({-0.65F, -1, -0.7F}, {-0.05F, 0.2F, -0.15F}, kWhite));
    return mesh;
}

void writePly(const Mesh& mesh, const std::filesystem::path& path)
{
    std::vector<char> bytes;
    for (const Vertex& vertex : mesh.vertices)
    {
        append(bytes, vertex.position);
        append(bytes, vertex.normal);
        append(bytes, vertex.color);
    }
    for (const auto& triangle : mesh.triangles)
    {
        append(bytes, std::uint8_t{3});
        append(bytes, triangle);
    }
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z"
            "\nproperty float nx\nproperty float ny\nproperty float nz"
            "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha"
            "\nelement face "
         << mesh.triangles.size() << "\nproperty list uchar uint vertex_indices\nend_header\n";
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush())
    {
        throw std::runtime_error("cannot write " + path.string());
    }
}

ZvoMesh::ZvoMesh(const Mesh& mesh) : m_triangles(mesh.triangles)
{
    for (const Vertex& vertex : mesh.vertices)
    {
        const auto& [x, y, z] = vertex.normal;
        m_positions.push_back(vertex.position);
        m_normals.push_back(rounded(normalized({x, y, z})));
        m_colors.push_back({linearOf(vertex.color[0]), linearOf(vertex.color[1]), linearOf(vertex.color[2]),
                            static_cast<float>(vertex.color[3] / 255.0)});
    }
}

zvo::MeshInfo ZvoMesh::info() const
{
    zvo::MeshInfo info;
    info.positions = m_positions;
    info.normals = m_normals;
    info.colors = m_colors;
    info.triangles = m_triangles;
    return info;
}

ZvoModel::ZvoModel(std::initializer_list<Part> parts, float emission_scale)
{
    m_parts.reserve(parts.size()); // so that they stay where they are
    for (const Part& part : parts)
    {
        m_parts.emplace_back(part.mesh);
        m_meshes.push_back(m_parts.back().info());
        m_meshes.back().material = static_cast<std::uint32_t>(m_materials.size());
        m_materials.emplace_back();
        m_materials.back().emission = part.emission;
    }
    m_info.meshes = m_meshes;
    m_info.materials = m_materials;
    m_info.emission_scale = emission_scale;
}

} // namespace host
