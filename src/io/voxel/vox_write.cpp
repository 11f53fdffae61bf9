// SPDX-License-Identifier: MIT
#include "core/base/color_word.h"
#include "core/base/morton.h"
#include "core/tree/colored_voxels.h"
#include "core/tree/lamps.h"
#include "io/voxel/quantize.h"
#include "io/voxel/vox_file.h"
#include "io/voxel/write_bytes.h"
#include "zvo/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::uint32_t kBlockBits = 8; // models of 256^3
constexpr std::uint32_t kPaletteSize = 255;
constexpr std::int64_t kLampsMin = 32; // indices of the palette that lamps may take in any case
constexpr std::int64_t kLampsMax = 128;
constexpr std::uint32_t kVersion = 200;
constexpr std::uint64_t kChunkHeaderBytes = 12;
constexpr std::uint64_t kSizeMax = INT32_MAX;

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

// Collects the bytes of chunks.
class Writer : public ByteCollector
{
public:
    void number(std::int64_t value) { add(static_cast<std::int32_t>(value)); }
    void text(std::string_view value)
    {
        number(static_cast<std::int64_t>(value.size()));
        addText(value);
    }

    // Writes a chunk without children.
    void chunk(const char* id, const Writer& content)
    {
        addText(id);
        number(static_cast<std::int64_t>(content.bytes().size()));
        number(0);
        append(content.bytes());
    }
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

// The palette: colours of voxels, then those of lamps, which have materials.
Writer paletteChunks(const Palette& palette, const std::vector<Lamp>& lamps)
{
    Writer content;
    for (std::size_t i = 0; i <= kPaletteSize; ++i) // 256 are written; the last one has no index
    {
        const std::size_t lamp = i - palette.colors.size();
        content.add(i < palette.colors.size() ? palette.colors[i] | kOpaque
                    : lamp < lamps.size()     ? lamps[lamp].color | kOpaque
                                              : std::uint32_t{0});
    }
    Writer writer;
    writer.chunk("RGBA", content);
    for (std::size_t i = 0; i < lamps.size(); ++i)
    {
        // As MagicaVoxel has it: a fraction, and steps of power, which are tenfold (readVoxScene).
        const double power = std::max(std::ceil(std::log10(lamps[i].strength)), 0.0F);
        Writer material;
        material.number(static_cast<std::int64_t>(palette.colors.size() + i + 1));
        material.number(3);
        for (const std::string& word : {std::string("_type"), std::string("_emit"), std::string("_emit"),
                                        fmt::format("{}", lamps[i].strength / std::pow(10.0, power)),
                                        std::string("_flux"), fmt::format("{}", power)})
        {
            material.text(word);
        }
        writer.chunk("MATL", material);
    }
    return writer;
}

// The models of a tree, and how often each colour of voxels without light occurs.
struct Contents
{
    std::vector<Model> models;
    std::vector<std::uint32_t> color_counts = std::vector<std::uint32_t>(kColorCount);
};

Contents contentsOf(const TreeData& tree)
{
    Contents contents;
    std::uint64_t last_block = UINT64_MAX;
    forEachColoredVoxel(tree,
                        [&](std::uint64_t code, std::uint32_t color, std::uint32_t light)
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
                            contents.color_counts[color] += light == kNoLight ? 1 : 0;
                        });
    return contents;
}

// The chunk with a model's size, and the head of the one with its voxels.
void addModelHead(Writer& writer, const Model& model)
{
    Writer size;
    size.add(model.size());
    writer.chunk("SIZE", size);
    writer.addText("XYZI");
    writer.number(static_cast<std::int64_t>(4 + 4 * model.voxel_count));
    writer.number(0);
    writer.number(static_cast<std::int64_t>(model.voxel_count));
}

} // namespace

void writeVox(const TreeData& tree, const WriteBytes& write)
{
    const auto [models, color_counts] = contentsOf(tree);
    const auto used = std::count_if(color_counts.begin(), color_counts.end(), [](auto count) { return count != 0; });
    const auto room = std::clamp<std::int64_t>(kPaletteSize - used, kLampsMin, kLampsMax);
    const Lamps lamps = lampsOf(tree, static_cast<std::size_t>(room));
    const Palette palette = quantize(color_counts, static_cast<std::uint32_t>(kPaletteSize - lamps.lamps.size()));
    const Writer graph = sceneGraph(models);
    const Writer colors = paletteChunks(palette, lamps.lamps);
    constexpr std::uint64_t kModelBytes = kChunkHeaderBytes + 12 + kChunkHeaderBytes + 4; // SIZE, and the head of XYZI
    const std::uint64_t children_bytes =
        models.size() * kModelBytes + 4 * tree.occupiedCount() + graph.bytes().size() + colors.bytes().size();
    if (children_bytes > kSizeMax)
    {
        throw Error(ErrorCode::Usage, fmt::format("{} voxels in {} models make {} bytes, more than a .vox file can "
                                                  "hold (2 GiB); take a lower resolution",
                                                  tree.occupiedCount(), models.size(), children_bytes));
    }

    Writer writer;
    writer.addText("VOX ");
    writer.number(kVersion);
    writer.addText("MAIN");
    writer.number(0);
    writer.number(static_cast<std::int64_t>(children_bytes));
    auto next_model = models.begin();
    std::uint64_t rest = 0; // voxels of the current model
    forEachColoredVoxel(tree,
                        [&](std::uint64_t code, std::uint32_t color, std::uint32_t light)
                        {
                            if (rest == 0)
                            {
                                addModelHead(writer, *next_model);
                                rest = next_model++->voxel_count;
                            }
                            --rest;
                            const glm::ivec3 position = turned(cellOfCode(code)) - std::prev(next_model)->min;
                            const std::size_t index = light == kNoLight ? palette.indices[color]
                                                                        : palette.colors.size() + lamps.of_light[light];
                            writer.add(std::array<std::uint8_t, 4>{
                                static_cast<std::uint8_t>(position.x), static_cast<std::uint8_t>(position.y),
                                static_cast<std::uint8_t>(position.z), static_cast<std::uint8_t>(index + 1)});
                            writer.passOn(write);
                        });
    write(writer.bytes());
    write(graph.bytes());
    write(colors.bytes());
}

} // namespace zvo
