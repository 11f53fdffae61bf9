// SPDX-License-Identifier: MIT
#include "core/base/morton.h"
#include "io/voxel/quantize.h"
#include "io/voxel/vox_file.h"
#include "zvo/error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>

namespace zvo
{

namespace
{

static_assert(std::endian::native == std::endian::little); // numbers are written as they are in memory

constexpr std::uint32_t kBlockBits = 8; // models of 256^3
constexpr std::uint32_t kPaletteSize = 255;
constexpr std::uint32_t kVersion = 200;
constexpr std::uint64_t kChunkHeaderBytes = 12;
constexpr std::uint64_t kSizeMax = INT32_MAX;

std::uint32_t colorOf(const TreeData& tree, std::size_t voxel)
{
    return tree.hasAttributes() ? tree.voxelAttribute(voxel).color & (kColorCount - 1) : kPlainColor;
}

// Converts zvo's coordinates to MagicaVoxel's.
glm::ivec3 turned(const glm::uvec3& cell)
{
    const glm::ivec3 c(cell);
    return {c.x, -1 - c.z, c.y};
}

// The voxels of one block, which are neighbours in Morton order.
struct Model
{
    std::uint64_t voxel_count = 0;
    glm::ivec3 min{INT32_MAX}; // MagicaVoxel's coordinates
    glm::ivec3 max{INT32_MIN}; // inclusive

    [[nodiscard]] glm::ivec3 size() const { return max - min + 1; }
};

// Collects the bytes of chunks, little-endian.
class Writer
{
public:
    void number(std::int64_t value) { append(static_cast<std::int32_t>(value)); }
    void name(const char* id) { add(id, 4); }
    void text(const std::string& value)
    {
        number(static_cast<std::int64_t>(value.size()));
        add(value.data(), value.size());
    }
    template <typename T> void append(const T& value) { add(&value, sizeof(value)); }

    // Writes a chunk without children.
    void chunk(const char* id, const Writer& content)
    {
        name(id);
        number(static_cast<std::int64_t>(content.m_bytes.size()));
        number(0);
        add(content.m_bytes.data(), content.m_bytes.size());
    }

    [[nodiscard]] const std::vector<std::byte>& bytes() const { return m_bytes; }
    void clear() { m_bytes.clear(); }

private:
    void add(const void* data, std::size_t size)
    {
        const std::size_t end = m_bytes.size();
        m_bytes.resize(end + size);
        std::memcpy(m_bytes.data() + end, data, size);
    }

    std::vector<std::byte> m_bytes;
};

// Writes a transform node above another node.
void addTransform(Writer& writer, std::int32_t id, std::int32_t child, std::int32_t layer,
                  const std::string& translation)
{
    Writer content;
    content.number(id);
    content.number(0); // attributes
    content.number(child);
    content.number(-1); // reserved
    content.number(layer);
    content.number(1); // frames
    content.number(translation.empty() ? 0 : 1);
    if (!translation.empty())
    {
        content.text("_t");
        content.text(translation);
    }
    writer.chunk("nTRN", content);
}

// The scene graph: root, group, and for each model a transform and a shape.
Writer sceneGraph(const std::vector<Model>& models)
{
    constexpr std::int32_t kFirstTransform = 2;
    Writer writer;
    addTransform(writer, 0, 1, -1, "");
    Writer group;
    group.number(1);
    group.number(0);
    group.number(static_cast<std::int64_t>(models.size()));
    for (std::size_t i = 0; i < models.size(); ++i)
    {
        group.number(kFirstTransform + 2 * static_cast<std::int64_t>(i));
    }
    writer.chunk("nGRP", group);
    for (std::size_t i = 0; i < models.size(); ++i)
    {
        const auto transform = kFirstTransform + 2 * static_cast<std::int32_t>(i);
        const glm::ivec3 middle = models[i].min + models[i].size() / 2;
        addTransform(writer, transform, transform + 1, 0, fmt::format("{} {} {}", middle.x, middle.y, middle.z));
        Writer shape;
        shape.number(transform + 1);
        shape.number(0);
        shape.number(1);
        shape.number(static_cast<std::int64_t>(i));
        shape.number(0);
        writer.chunk("nSHP", shape);
    }
    return writer;
}

Writer paletteChunk(const Palette& palette)
{
    constexpr std::uint32_t kOpaque = 0xff000000U;
    Writer content;
    for (std::size_t i = 0; i <= kPaletteSize; ++i) // 256 are written; the last one has no index
    {
        content.append(i < palette.colors.size() ? palette.colors[i] | kOpaque : std::uint32_t{0});
    }
    Writer writer;
    writer.chunk("RGBA", content);
    return writer;
}

} // namespace

void writeVox(const TreeData& tree, const std::function<void(std::span<const std::byte>)>& write)
{
    std::vector<Model> models;
    std::vector<std::uint32_t> counts(kColorCount);
    std::uint64_t last_block = UINT64_MAX;
    std::size_t voxel = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     if (code >> (3 * kBlockBits) != last_block)
                     {
                         models.emplace_back();
                         last_block = code >> (3 * kBlockBits);
                     }
                     Model& model = models.back();
                     const glm::ivec3 position = turned(cellOfCode(code));
                     ++model.voxel_count;
                     model.min = glm::min(model.min, position);
                     model.max = glm::max(model.max, position);
                     ++counts[colorOf(tree, voxel++)];
                 });
    const Palette palette = quantize(counts, kPaletteSize);
    const Writer graph = sceneGraph(models);
    const Writer colors = paletteChunk(palette);
    constexpr std::uint64_t kModelBytes = kChunkHeaderBytes + 12 + kChunkHeaderBytes + 4; // SIZE, and the head of XYZI
    const std::uint64_t children_bytes = models.size() * kModelBytes + std::uint64_t{4} * tree.voxel_count +
                                         graph.bytes().size() + colors.bytes().size();
    if (children_bytes > kSizeMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} voxels in {} models make {} bytes, more than a .vox file can "
                                                  "hold (2 GiB); take a lower resolution",
                                                  tree.voxel_count, models.size(), children_bytes));
    }

    Writer writer;
    writer.name("VOX ");
    writer.number(kVersion);
    writer.name("MAIN");
    writer.number(0);
    writer.number(static_cast<std::int64_t>(children_bytes));
    constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
    std::size_t model = 0;
    std::uint64_t rest = 0; // voxels of the current model still to come
    voxel = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     if (rest == 0)
                     {
                         Writer size;
                         const glm::ivec3 edges = models[model].size();
                         size.append(edges);
                         writer.chunk("SIZE", size);
                         rest = models[model++].voxel_count;
                         writer.name("XYZI");
                         writer.number(static_cast<std::int64_t>(4 + 4 * rest));
                         writer.number(0);
                         writer.number(static_cast<std::int64_t>(rest));
                     }
                     --rest;
                     const glm::ivec3 position = turned(cellOfCode(code)) - models[model - 1].min;
                     const std::uint32_t index = palette.indices[colorOf(tree, voxel++)] + 1U;
                     writer.append(static_cast<std::uint32_t>(position.x) |
                                   static_cast<std::uint32_t>(position.y) << 8 |
                                   static_cast<std::uint32_t>(position.z) << 16 | index << 24);
                     if (writer.bytes().size() >= kPieceBytes)
                     {
                         write(writer.bytes());
                         writer.clear();
                     }
                 });
    write(writer.bytes());
    write(graph.bytes());
    write(colors.bytes());
}

} // namespace zvo
