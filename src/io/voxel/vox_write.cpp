// SPDX-License-Identifier: MIT
#include "core/base/morton.h"
#include "io/voxel/quantize.h"
#include "io/voxel/vox_file.h"
#include "zvo/error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <iterator>

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

// The models of a tree, and how often each colour occurs.
struct Contents
{
    std::vector<Model> models;
    std::vector<std::uint32_t> color_counts = std::vector<std::uint32_t>(kColorCount);
};

Contents contentsOf(const TreeData& tree)
{
    Contents contents;
    std::uint64_t last_block = UINT64_MAX;
    std::size_t voxel = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     if (code >> (3 * kBlockBits) != last_block)
                     {
                         contents.models.emplace_back();
                         last_block = code >> (3 * kBlockBits);
                     }
                     Model& model = contents.models.back();
                     const glm::ivec3 position = turned(cellOfCode(code));
                     ++model.voxel_count;
                     model.min = glm::min(model.min, position);
                     model.max = glm::max(model.max, position);
                     ++contents.color_counts[colorOf(tree, voxel++)];
                 });
    return contents;
}

// The chunk with a model's size, and the head of the one with its voxels.
void addModelHead(Writer& writer, const Model& model)
{
    Writer size;
    size.append(model.size());
    writer.chunk("SIZE", size);
    writer.name("XYZI");
    writer.number(static_cast<std::int64_t>(4 + 4 * model.voxel_count));
    writer.number(0);
    writer.number(static_cast<std::int64_t>(model.voxel_count));
}

} // namespace

void writeVox(const TreeData& tree, const std::function<void(std::span<const std::byte>)>& write)
{
    const auto [models, color_counts] = contentsOf(tree);
    const Palette palette = quantize(color_counts, kPaletteSize);
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
    auto next_model = models.begin();
    std::uint64_t rest = 0; // voxels of the current model
    std::size_t voxel = 0;
    forEachVoxel(tree,
                 [&](std::uint64_t code)
                 {
                     if (rest == 0)
                     {
                         addModelHead(writer, *next_model);
                         rest = next_model++->voxel_count;
                     }
                     --rest;
                     const glm::ivec3 position = turned(cellOfCode(code)) - std::prev(next_model)->min;
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
