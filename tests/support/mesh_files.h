// SPDX-License-Identifier: MIT
// A mesh as files of several formats.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace zvo::test
{

struct FileMesh
{
    std::vector<glm::vec3> positions;
    std::vector<std::array<std::uint8_t, 3>> colors; // sRGB, or none
    std::vector<glm::uvec3> triangles;
};

template <typename T> void appendBytes(std::string& file, T value, bool big_endian = false)
{
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    file.append(big_endian ? std::string(bytes.rbegin(), bytes.rend()) : std::string(bytes.begin(), bytes.end()));
}

inline std::string asObj(const FileMesh& mesh)
{
    std::string file = "# a mesh\no mesh\n";
    for (const glm::vec3& p : mesh.positions)
    {
        file += fmt::format("v {:.9f} {:.9f} {:.9f}\n", p.x, p.y, p.z);
    }
    for (const glm::uvec3& t : mesh.triangles)
    {
        file += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    }
    return file;
}

enum class PlyEncoding
{
    Text,
    LittleEndian,
    BigEndian
};

inline std::string asPly(const FileMesh& mesh, PlyEncoding encoding)
{
    constexpr std::array kNames = {"ascii", "binary_little_endian", "binary_big_endian"};
    const bool big = encoding == PlyEncoding::BigEndian;
    const bool text = encoding == PlyEncoding::Text;
    const bool colored = !mesh.colors.empty();
    std::string file = fmt::format(
        "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{}"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        kNames[static_cast<std::size_t>(encoding)], mesh.positions.size(),
        colored ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "", mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    {
        const glm::vec3& p = mesh.positions[i];
        if (text)
        {
            file += fmt::format("{:.9f} {:.9f} {:.9f}", p.x, p.y, p.z);
        }
        for (int c = 0; c < 3 && !text; ++c)
        {
            appendBytes(file, p[c], big);
        }
        for (std::size_t c = 0; c < 3 && colored; ++c)
        {
            file += text ? fmt::format(" {}", mesh.colors[i][c]) : std::string(1, static_cast<char>(mesh.colors[i][c]));
        }
        file += text ? "\n" : "";
    }
    for (const glm::uvec3& t : mesh.triangles)
    {
        file += text ? fmt::format("3 {} {} {}\n", t.x, t.y, t.z) : std::string(1, '\3');
        for (int c = 0; c < 3 && !text; ++c)
        {
            appendBytes(file, static_cast<std::int32_t>(t[c]), big);
        }
    }
    return file;
}

inline std::string asTextStl(const FileMesh& mesh)
{
    std::string file = "solid mesh\n";
    for (const glm::uvec3& t : mesh.triangles)
    {
        file += "facet normal 0 0 0\nouter loop\n";
        for (int c = 0; c < 3; ++c)
        {
            const glm::vec3& p = mesh.positions[t[c]];
            file += fmt::format("vertex {:.9f} {:.9f} {:.9f}\n", p.x, p.y, p.z);
        }
        file += "endloop\nendfacet\n";
    }
    return file + "endsolid mesh\n";
}

inline std::string asBinaryStl(const FileMesh& mesh)
{
    std::string file(80, ' ');
    appendBytes(file, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const glm::uvec3& t : mesh.triangles)
    {
        file.append(12, '\0'); // no normal
        for (int c = 0; c < 3; ++c)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                appendBytes(file, mesh.positions[t[c]][axis]);
            }
        }
        file.append(2, '\0');
    }
    return file;
}

/// A bent sheet with corners at multiples of 1/64, which every format holds exactly.
inline FileMesh bentSheet(std::uint32_t edge)
{
    FileMesh mesh;
    for (std::uint32_t y = 0; y <= edge; ++y)
    {
        for (std::uint32_t x = 0; x <= edge; ++x)
        {
            const std::uint32_t height = (x * x * 7 + y * 13 + x * y * 3) % 97;
            mesh.positions.emplace_back(glm::vec3(x * 24, height, y * 21) / 64.0F - glm::vec3(1.5F, -0.25F, 3.0F));
        }
    }
    for (std::uint32_t y = 0; y < edge; ++y)
    {
        for (std::uint32_t x = 0; x < edge; ++x)
        {
            const std::uint32_t corner = y * (edge + 1) + x;
            mesh.triangles.emplace_back(corner, corner + edge + 1, corner + 1);
            mesh.triangles.emplace_back(corner + 1, corner + edge + 1, corner + edge + 2);
        }
    }
    return mesh;
}

} // namespace zvo::test
