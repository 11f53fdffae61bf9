// SPDX-License-Identifier: MIT
#include "io/voxel/glb_write.h"

#include "core/base/morton.h"
#include "core/base/srgb.h"
#include "core/tree/colored_voxels.h"
#include "core/tree/lamps.h"
#include "core/tree/tree_build.h"
#include "io/voxel/write_bytes.h"
#include "zvo/error.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::uint64_t kVerticesOfQuad = 4;
constexpr std::uint64_t kIndicesOfQuad = 6;

// One side of voxels: its axis, and whether it faces upwards along it. u and v are the next two axes.
struct Side
{
    int axis;
    bool upper;

    [[nodiscard]] int u() const { return (axis + 1) % 3; }
    [[nodiscard]] int v() const { return (axis + 2) % 3; }
};

// A rectangle of faces of one colour, in the lower or upper plane of a layer of cells.
struct Quad
{
    Side side;
    std::uint32_t layer;
    std::uint32_t u;
    std::uint32_t v;
    std::uint32_t width; // along u
    std::uint32_t height;
    std::uint32_t color;
    std::uint32_t material;
};

// A face of one voxel. Its key sorts by layer, row and column.
struct Face
{
    std::uint64_t key;
    std::uint32_t color;
    std::uint32_t material; // 0: without light; otherwise that of a lamp

    static constexpr std::uint32_t kBits = 20;

    static std::uint64_t keyOf(std::uint32_t layer, std::uint32_t v, std::uint32_t u)
    {
        return std::uint64_t{layer} << (2 * kBits) | std::uint64_t{v} << kBits | u;
    }
    [[nodiscard]] std::uint32_t layer() const { return static_cast<std::uint32_t>(key >> (2 * kBits)); }
    [[nodiscard]] std::uint32_t v() const { return static_cast<std::uint32_t>(key >> kBits) & ((1U << kBits) - 1); }
    [[nodiscard]] std::uint32_t u() const { return static_cast<std::uint32_t>(key) & ((1U << kBits) - 1); }
};

std::vector<Face> facesOf(const TreeData& tree, const Lamps& lamps, const Side& side)
{
    std::vector<Face> faces;
    forEachColoredVoxel(tree,
                        [&](std::uint64_t code, std::uint32_t color, std::uint32_t light)
                        {
                            const glm::ivec3 cell(cellOfCode(code));
                            const std::uint32_t material = light == kNoLight ? 0U : lamps.of_light[light] + 1U;
                            glm::ivec3 neighbor = cell;
                            neighbor[side.axis] += side.upper ? 1 : -1;
                            if (!hasVoxel(tree, neighbor))
                            {
                                faces.push_back({Face::keyOf(static_cast<std::uint32_t>(cell[side.axis]),
                                                             static_cast<std::uint32_t>(cell[side.v()]),
                                                             static_cast<std::uint32_t>(cell[side.u()])),
                                                 color, material});
                            }
                        });
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
    return faces;
}

// Joins faces to runs in a row, and runs to rectangles with equal ones of the row before.
void addQuads(const std::vector<Face>& faces, const Side& side, std::vector<Quad>& quads)
{
    std::vector<std::size_t> open;      // [by u] quads that end in the previous row
    std::vector<std::size_t> next_open; // [by u] quads that end in this row
    std::size_t candidate = 0;          // in open
    std::uint64_t current = UINT64_MAX; // layer and row
    for (std::size_t i = 0; i < faces.size();)
    {
        const Face& first = faces[i];
        const std::uint64_t here = first.key >> Face::kBits;
        if (here != current)
        {
            const bool continues = current != UINT64_MAX && here == current + 1 && first.v() != 0;
            open = continues ? std::move(next_open) : std::vector<std::size_t>();
            next_open.clear();
            candidate = 0;
            current = here;
        }
        std::uint32_t width = 1;
        for (++i; i < faces.size() && faces[i].key == first.key + width && faces[i].color == first.color &&
                  faces[i].material == first.material;
             ++i)
        {
            ++width;
        }
        while (candidate < open.size() && quads[open[candidate]].u < first.u())
        {
            ++candidate;
        }
        const bool grows = candidate < open.size() && quads[open[candidate]].u == first.u() &&
                           quads[open[candidate]].width == width && quads[open[candidate]].color == first.color &&
                           quads[open[candidate]].material == first.material;
        if (grows)
        {
            ++quads[open[candidate]].height;
            next_open.push_back(open[candidate]);
        }
        else
        {
            next_open.push_back(quads.size());
            quads.push_back({side, first.layer(), first.u(), first.v(), width, 1, first.color, first.material});
        }
    }
}

// Corners counterclockwise, seen from outside.
std::array<glm::vec3, kVerticesOfQuad> cornersOf(const Quad& quad)
{
    std::array<glm::vec3, kVerticesOfQuad> corners{};
    constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, kVerticesOfQuad> kSteps = {
        {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        const auto [du, dv] = kSteps[quad.side.upper ? i : corners.size() - 1 - i];
        corners[i][quad.side.axis] = static_cast<float>(quad.layer + (quad.side.upper ? 1 : 0));
        corners[i][quad.side.u()] = static_cast<float>(quad.u + du * quad.width);
        corners[i][quad.side.v()] = static_cast<float>(quad.v + dv * quad.height);
    }
    return corners;
}

// The colour as linear 16-bit fractions, with alpha 1.
std::array<std::uint16_t, 4> linearColor(std::uint32_t color)
{
    const glm::dvec3 linear = glm::round(65535.0 * linearOf(color));
    return {static_cast<std::uint16_t>(linear.r), static_cast<std::uint16_t>(linear.g),
            static_cast<std::uint16_t>(linear.b), UINT16_MAX};
}

std::string materialOf(const Lamp* lamp)
{
    constexpr const char* kSurface = R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1})";
    if (lamp == nullptr)
    {
        return fmt::format("{}}}", kSurface);
    }
    const float strength = std::max({lamp->radiance.r, lamp->radiance.g, lamp->radiance.b});
    const glm::vec3 factor = lamp->radiance / strength;
    return fmt::format(R"({},"emissiveFactor":[{},{},{}],"extensions":{{"KHR_materials_emissive_strength":)"
                       R"({{"emissiveStrength":{}}}}}}})",
                       kSurface, factor.r, factor.g, factor.b, strength);
}

// The quads of one material, which are neighbours.
using Group = std::span<const Quad>;

std::vector<Group> groupsOf(const std::vector<Quad>& quads)
{
    std::vector<Group> groups;
    for (Group rest = quads; !rest.empty(); rest = rest.subspan(groups.back().size()))
    {
        const auto differs = [&](const Quad& quad) { return quad.material != rest.front().material; };
        groups.push_back(rest.first(static_cast<std::size_t>(std::ranges::find_if(rest, differs) - rest.begin())));
    }
    return groups;
}

// Three accessors: positions, colours and indices. first: how many quads stand before the group.
std::string accessorsOf(const Group& group, std::uint64_t first)
{
    glm::vec3 low(FLT_MAX);
    glm::vec3 high(-FLT_MAX);
    for (const Quad& quad : group)
    {
        for (const glm::vec3& corner : cornersOf(quad))
        {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    const std::uint64_t vertex_count = group.size() * kVerticesOfQuad;
    return fmt::format(
        R"({{"bufferView":0,"byteOffset":{},"componentType":5126,"type":"VEC3","count":{},"min":[{},{},{}],)"
        R"("max":[{},{},{}]}},)"
        R"({{"bufferView":1,"byteOffset":{},"componentType":5123,"normalized":true,"type":"VEC4","count":{}}},)"
        R"({{"bufferView":2,"byteOffset":{},"componentType":5125,"type":"SCALAR","count":{}}})",
        first * kVerticesOfQuad * sizeof(glm::vec3), vertex_count, low.x, low.y, low.z, high.x, high.y, high.z,
        first * kVerticesOfQuad * 4 * sizeof(std::uint16_t), vertex_count,
        first * kIndicesOfQuad * sizeof(std::uint32_t), group.size() * kIndicesOfQuad);
}

std::string documentOf(const TreeData& tree, const std::vector<Group>& groups, std::uint64_t quad_count,
                       const Lamps& lamps)
{
    const std::uint64_t vertex_count = quad_count * kVerticesOfQuad;
    const std::uint64_t position_bytes = vertex_count * sizeof(glm::vec3);
    const std::uint64_t color_bytes = vertex_count * 4 * sizeof(std::uint16_t);
    const std::uint64_t index_bytes = quad_count * kIndicesOfQuad * sizeof(std::uint32_t);
    const Grid& grid = tree.grid;
    std::string json = R"({"asset":{"version":"2.0","generator":"zvo"},"scene":0,"scenes":[{"nodes":[0]}],)";
    json += fmt::format(R"("nodes":[{{"name":"voxels","translation":[{},{},{}],"scale":[{},{},{}]{}}}])", grid.origin.x,
                        grid.origin.y, grid.origin.z, grid.voxel_size, grid.voxel_size, grid.voxel_size,
                        quad_count == 0 ? "" : R"(,"mesh":0)");
    if (quad_count != 0)
    {
        std::vector<std::string> materials;
        std::vector<std::string> primitives;
        std::vector<std::string> accessors;
        std::uint64_t first = 0;
        for (const Group& group : groups)
        {
            const std::size_t i = materials.size();
            const std::uint32_t material = group.front().material;
            primitives.push_back(
                fmt::format(R"({{"attributes":{{"POSITION":{},"COLOR_0":{}}},"indices":{},"material":{}}})", 3 * i,
                            3 * i + 1, 3 * i + 2, i));
            materials.push_back(materialOf(material == 0 ? nullptr : &lamps.lamps[material - 1]));
            accessors.push_back(accessorsOf(group, first));
            first += group.size();
        }
        json += fmt::format(R"({},"meshes":[{{"primitives":[{}]}}],"materials":[{}],"accessors":[{}],)",
                            lamps.lamps.empty() ? "" : R"(,"extensionsUsed":["KHR_materials_emissive_strength"])",
                            fmt::join(primitives, ","), fmt::join(materials, ","), fmt::join(accessors, ","));
        json += fmt::format(R"("bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":{},"target":34962}},)"
                            R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":34962}},)"
                            R"({{"buffer":0,"byteOffset":{},"byteLength":{},"target":34963}}],)",
                            position_bytes, position_bytes, color_bytes, position_bytes + color_bytes, index_bytes);
        json += fmt::format(R"("buffers":[{{"byteLength":{}}}])", position_bytes + color_bytes + index_bytes);
    }
    json += "}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return json;
}

} // namespace

void writeGlb(const TreeData& tree, const WriteBytes& write)
{
    constexpr std::size_t kLampsMax = 255; // a material each
    const Lamps lamps = lampsOf(tree, kLampsMax);
    std::vector<Quad> quads;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const bool upper : {false, true})
        {
            const Side side = {axis, upper};
            addQuads(facesOf(tree, lamps, side), side, quads);
        }
    }
    std::ranges::stable_sort(quads, {}, &Quad::material);
    const std::vector<Group> groups = groupsOf(quads);
    constexpr std::uint64_t kQuadBytes =
        kVerticesOfQuad * (sizeof(glm::vec3) + 4 * sizeof(std::uint16_t)) + kIndicesOfQuad * sizeof(std::uint32_t);
    const std::uint64_t binary_bytes = quads.size() * kQuadBytes;
    const std::string json = documentOf(tree, groups, quads.size(), lamps);
    const std::uint64_t file_bytes = 12 + 8 + json.size() + (quads.empty() ? 0 : 8 + binary_bytes);
    if (file_bytes > UINT32_MAX)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} rectangles make {} bytes, more than a .glb file can hold "
                                                  "(4 GiB); take a lower resolution",
                                                  quads.size(), file_bytes));
    }
    ByteCollector file;
    file.addText("glTF");
    file.add(std::uint32_t{2});
    file.add(static_cast<std::uint32_t>(file_bytes));
    file.add(static_cast<std::uint32_t>(json.size()));
    file.addText("JSON");
    file.addText(json);
    if (!quads.empty())
    {
        file.add(static_cast<std::uint32_t>(binary_bytes));
        file.addText({"BIN\0", 4});
        for (const Quad& quad : quads)
        {
            file.add(cornersOf(quad));
            file.passOn(write);
        }
        for (const Quad& quad : quads)
        {
            const std::array<std::uint16_t, 4> color = linearColor(quad.color);
            file.add(std::array{color, color, color, color});
            file.passOn(write);
        }
        for (const Group& group : groups)
        {
            for (std::uint32_t first = 0; first < group.size() * kVerticesOfQuad; first += kVerticesOfQuad)
            {
                file.add(std::array<std::uint32_t, kIndicesOfQuad>{first, first + 1, first + 2, first, first + 2,
                                                                   first + 3});
                file.passOn(write);
            }
        }
    }
    write(file.bytes());
}

} // namespace zvo
