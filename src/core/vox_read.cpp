// SPDX-License-Identifier: MIT
#include "core/input_error.h"
#include "core/text_cursor.h"
#include "core/tree_build.h"
#include "core/vox_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kModelEdgeMax = 256;
constexpr std::uint64_t kVoxelsMax = std::uint64_t{1} << 28; // that are placed; a model may be placed often
constexpr std::uint32_t kPlacementsMax = 1U << 20;           // visits of nodes
constexpr std::uint32_t kNestingMax = 256;                   // of nodes
constexpr std::int32_t kPlaceMax = 1 << 24;                  // of a translation
constexpr std::uint32_t kEdgeMax = 1U << Grid::kDepthMax;    // of everything
constexpr std::size_t kPaletteSize = 255;

// What a voxel's bytes say: coordinates in its model, and its colour's index.
struct ModelVoxel
{
    std::uint8_t x;
    std::uint8_t y;
    std::uint8_t z;
    std::uint8_t index;
};
static_assert(sizeof(ModelVoxel) == 4);

struct Model
{
    glm::ivec3 size{0};
    std::span<const std::uint8_t> voxels; // ModelVoxel each
};

// A rotation by quarter turns with mirroring, and then a move by whole voxels.
struct Placement
{
    glm::ivec3 axis{0, 1, 2}; // which coordinate becomes the i-th one
    glm::ivec3 sign{1};
    glm::ivec3 move{0};

    // Of points in half voxels: voxels' centres are odd.
    [[nodiscard]] glm::ivec3 operator()(const glm::ivec3& halves) const
    {
        return sign * glm::ivec3(halves[axis.x], halves[axis.y], halves[axis.z]) + 2 * move;
    }

    // inner first.
    [[nodiscard]] Placement after(const Placement& inner) const
    {
        Placement both;
        for (int i = 0; i < 3; ++i)
        {
            both.axis[i] = inner.axis[axis[i]];
            both.sign[i] = sign[i] * inner.sign[axis[i]];
            both.move[i] = sign[i] * inner.move[axis[i]] + move[i];
        }
        return both;
    }
};

struct Node
{
    bool hidden = false;
    std::int32_t layer = -1;
    Placement placement;                // of a transform
    std::vector<std::int32_t> children; // nodes
    std::vector<std::int32_t> models;   // of a shape
};

using Dictionary = std::map<std::string_view, std::string_view>;

/// Reads numbers and texts of a chunk's content.
class Content
{
public:
    Content(std::span<const std::uint8_t> bytes, const std::filesystem::path& name) : m_rest(bytes), m_name(name) {}

    [[nodiscard]] std::size_t restBytes() const { return m_rest.size(); }

    std::span<const std::uint8_t> take(std::uint64_t count)
    {
        if (count > m_rest.size())
        {
            throw inputError(m_name, fmt::format("a chunk ends too early; {}", kCutShort));
        }
        const auto taken = m_rest.first(count);
        m_rest = m_rest.subspan(count);
        return taken;
    }

    std::int32_t number()
    {
        std::int32_t value = 0;
        std::memcpy(&value, take(sizeof(value)).data(), sizeof(value));
        return value;
    }

    // How many bytes of something follow, if they do.
    std::uint32_t size()
    {
        const std::int32_t value = number();
        if (value < 0)
        {
            throw inputError(m_name, fmt::format("a chunk of {} bytes; {}", value, kExportAgain));
        }
        return static_cast<std::uint32_t>(value);
    }

    // How many of something that has bytes_each bytes at least.
    std::uint32_t count(std::uint32_t bytes_each)
    {
        const std::int32_t value = number();
        if (value < 0 || static_cast<std::uint32_t>(value) > m_rest.size() / bytes_each)
        {
            throw inputError(
                m_name, fmt::format("a chunk announces {} items and has no room for them; {}", value, kExportAgain));
        }
        return static_cast<std::uint32_t>(value);
    }

    std::string_view text()
    {
        const auto bytes = take(count(1));
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    Dictionary dictionary()
    {
        Dictionary entries;
        constexpr std::uint32_t kEntryBytesMin = 8;
        for (std::uint32_t rest = count(kEntryBytesMin); rest != 0; --rest)
        {
            const std::string_view key = text();
            entries[key] = text();
        }
        return entries;
    }

private:
    std::span<const std::uint8_t> m_rest;
    const std::filesystem::path& m_name;
};

bool isHidden(const Dictionary& attributes)
{
    const auto hidden = attributes.find("_hidden");
    return hidden != attributes.end() && hidden->second == "1";
}

// MagicaVoxel's colours where a file has none: a cube of 6 levels a channel without black, then ramps.
std::array<std::uint32_t, kPaletteSize> defaultPalette()
{
    constexpr std::array<std::uint32_t, 10> kRamp = {238, 221, 187, 170, 136, 119, 85, 68, 34, 17};
    constexpr std::uint32_t kLevelStep = 51;
    std::array<std::uint32_t, kPaletteSize> palette{};
    std::size_t next = 0;
    for (; next < 215; ++next)
    {
        const auto i = static_cast<std::uint32_t>(next);
        palette[next] =
            (255 - kLevelStep * (i / 36)) | (255 - kLevelStep * (i / 6 % 6)) << 8 | (255 - kLevelStep * (i % 6)) << 16;
    }
    for (const std::uint32_t channels : {1U, 1U << 8, 1U << 16, 1U | 1U << 8 | 1U << 16})
    {
        for (const std::uint32_t value : kRamp)
        {
            palette[next++] = value * channels;
        }
    }
    return palette;
}

/// Reads one file.
class Reader
{
public:
    explicit Reader(const std::filesystem::path& name) : m_name(name), m_palette(defaultPalette()) {}

    VoxVoxels read(std::span<const std::uint8_t> bytes)
    {
        readChunks(bytes);
        placeAll();
        return finish();
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw inputError(m_name, what); }

    void readChunks(std::span<const std::uint8_t> bytes)
    {
        Content file(bytes, m_name);
        constexpr std::string_view kMagic = "VOX ";
        if (bytes.size() < 8 || nameOf(file.take(4)) != kMagic)
        {
            fail("not a MagicaVoxel file: it does not begin with \"VOX \"");
        }
        const std::int32_t version = file.number();
        if (version < 150 || version >= 300)
        {
            fail(fmt::format("version {} of the format; those from 150 to 299 can be read", version));
        }
        if (nameOf(file.take(4)) != "MAIN")
        {
            fail(fmt::format("its first chunk is not MAIN; {}", kExportAgain));
        }
        const std::uint32_t content_bytes = file.size();
        const std::uint32_t children_bytes = file.size();
        file.take(content_bytes);
        Content children(file.take(children_bytes), m_name);
        while (children.restBytes() != 0)
        {
            const std::string_view id = nameOf(children.take(4));
            const std::uint32_t bytes_here = children.size();
            const std::uint32_t bytes_below = children.size();
            Content content(children.take(bytes_here), m_name);
            children.take(bytes_below);
            readChunk(id, content);
        }
        if (m_size)
        {
            fail(fmt::format("a model has a size and no voxels; {}", kExportAgain));
        }
    }

    static std::string_view nameOf(std::span<const std::uint8_t> bytes)
    {
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    void readChunk(std::string_view id, Content& content)
    {
        if (id == "SIZE")
        {
            readSize(content);
        }
        else if (id == "XYZI")
        {
            readModel(content);
        }
        else if (id == "RGBA")
        {
            readPalette(content);
        }
        else if (id == "LAYR")
        {
            const std::int32_t layer = content.number();
            if (isHidden(content.dictionary()))
            {
                m_hidden_layers.insert(layer);
            }
        }
        else if (id == "nTRN" || id == "nGRP" || id == "nSHP")
        {
            readNode(id, content);
        }
    }

    void readSize(Content& content)
    {
        glm::ivec3 size;
        for (int i = 0; i < 3; ++i)
        {
            size[i] = content.number();
            if (size[i] < 1 || size[i] > static_cast<std::int32_t>(kModelEdgeMax))
            {
                fail(fmt::format("a model {} voxels wide, where 1 to {} are possible; {}", size[i], kModelEdgeMax,
                                 kExportAgain));
            }
        }
        if (m_size)
        {
            fail(fmt::format("a model has a size and no voxels; {}", kExportAgain));
        }
        m_size = size;
    }

    void readModel(Content& content)
    {
        if (!m_size)
        {
            fail(fmt::format("a model has voxels and no size; {}", kExportAgain));
        }
        const std::uint32_t count = content.count(sizeof(ModelVoxel));
        const Model model = {*m_size, content.take(std::uint64_t{count} * sizeof(ModelVoxel))};
        m_size.reset();
        for (std::uint32_t i = 0; i < count; ++i)
        {
            const ModelVoxel voxel = voxelOf(model, i);
            if (voxel.x >= model.size.x || voxel.y >= model.size.y || voxel.z >= model.size.z)
            {
                fail(fmt::format("voxel {} of model {} is at ({}, {}, {}), outside of its {} x {} x {}; {}", i,
                                 m_models.size(), voxel.x, voxel.y, voxel.z, model.size.x, model.size.y, model.size.z,
                                 kExportAgain));
            }
        }
        m_models.push_back(model);
    }

    static ModelVoxel voxelOf(const Model& model, std::size_t index)
    {
        ModelVoxel voxel{};
        std::memcpy(&voxel, model.voxels.data() + index * sizeof(voxel), sizeof(voxel));
        return voxel;
    }

    void readPalette(Content& content)
    {
        for (std::uint32_t& color : m_palette)
        {
            color = static_cast<std::uint32_t>(content.number()) & 0xffffffU; // the alpha says nothing
        }
    }

    void readNode(std::string_view id, Content& content)
    {
        const std::int32_t number = content.number();
        Node node;
        node.hidden = isHidden(content.dictionary());
        if (id == "nTRN")
        {
            node.children.push_back(content.number());
            content.number(); // reserved
            node.layer = content.number();
            constexpr std::uint32_t kFrameBytesMin = 4;
            if (content.count(kFrameBytesMin) != 0)
            {
                node.placement = placementOf(content.dictionary()); // of the first frame
            }
        }
        else if (id == "nGRP")
        {
            for (std::uint32_t rest = content.count(4); rest != 0; --rest)
            {
                node.children.push_back(content.number());
            }
        }
        else
        {
            constexpr std::uint32_t kModelBytesMin = 8;
            if (content.count(kModelBytesMin) != 0)
            {
                node.models.push_back(content.number()); // of the first frame
            }
        }
        if (!m_nodes.emplace(number, std::move(node)).second)
        {
            fail(fmt::format("two nodes have the number {}; {}", number, kExportAgain));
        }
    }

    Placement placementOf(const Dictionary& frame) const
    {
        Placement placement;
        if (const auto rotation = frame.find("_r"); rotation != frame.end())
        {
            const auto bits = parseNumber<std::uint32_t>(rotation->second);
            const std::uint32_t first = bits.value_or(0) & 3U;
            const std::uint32_t second = bits.value_or(0) >> 2 & 3U;
            if (!bits || first == 3 || second == 3 || first == second)
            {
                fail(fmt::format("a rotation \"{}\" that is none; {}", rotation->second, kExportAgain));
            }
            placement.axis = glm::ivec3(first, second, 3 - first - second);
            placement.sign = 1 - 2 * glm::ivec3(*bits >> 4 & 1U, *bits >> 5 & 1U, *bits >> 6 & 1U);
        }
        if (const auto move = frame.find("_t"); move != frame.end())
        {
            TextCursor words(move->second);
            for (int i = 0; i < 3; ++i)
            {
                const auto value = parseNumber<std::int32_t>(words.word());
                if (!value || std::abs(std::int64_t{*value}) > kPlaceMax)
                {
                    fail(fmt::format("a place \"{}\" that is none; {}", move->second, kExportAgain));
                }
                placement.move[i] = *value;
            }
        }
        return placement;
    }

    void placeAll()
    {
        if (m_nodes.empty())
        {
            if (!m_models.empty())
            {
                Placement from_corner;
                from_corner.move = m_models.front().size / 2;
                place(m_models.front(), from_corner);
            }
            if (m_models.size() > 1)
            {
                m_result.warnings.push_back(
                    fmt::format("{}: {} models without places: frames of an animation; the first one is taken",
                                m_name.string(), m_models.size()));
            }
            return;
        }
        struct Visit
        {
            std::int32_t node;
            std::uint32_t nesting;
            Placement placement;
        };
        std::vector<Visit> visits = {{0, 0, {}}};
        for (std::uint32_t count = 0; !visits.empty(); ++count)
        {
            const Visit visit = visits.back();
            visits.pop_back();
            const auto found = m_nodes.find(visit.node);
            if (found == m_nodes.end())
            {
                fail(fmt::format("node {} is named and not there; {}", visit.node, kExportAgain));
            }
            if (visit.nesting > kNestingMax || count > kPlacementsMax)
            {
                fail(fmt::format("its nodes go round in a circle, or are nested too deeply; {}", kExportAgain));
            }
            const Node& node = found->second;
            if (node.hidden || m_hidden_layers.contains(node.layer))
            {
                continue;
            }
            const Placement placement = checked(visit.placement.after(node.placement));
            for (const std::int32_t model : node.models)
            {
                if (model < 0 || static_cast<std::size_t>(model) >= m_models.size())
                {
                    fail(fmt::format("model {} is named and not there; {}", model, kExportAgain));
                }
                place(m_models[static_cast<std::size_t>(model)], placement);
            }
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) // the first one next
            {
                visits.push_back({*child, visit.nesting + 1, placement});
            }
        }
    }

    [[nodiscard]] Placement checked(const Placement& placement) const
    {
        for (int i = 0; i < 3; ++i)
        {
            if (std::abs(placement.move[i]) > kPlaceMax)
            {
                fail(fmt::format("a model lies {} voxels away; {}", placement.move[i], kExportAgain));
            }
        }
        return placement;
    }

    // A model turns around the corner of the voxel in its middle.
    void place(const Model& model, const Placement& placement)
    {
        const std::size_t count = model.voxels.size() / sizeof(ModelVoxel);
        if (m_cells.size() + count > kVoxelsMax)
        {
            fail(fmt::format("more than {} voxels; take a part of the scene", kVoxelsMax));
        }
        for (std::size_t i = 0; i < count; ++i)
        {
            const ModelVoxel voxel = voxelOf(model, i);
            if (voxel.index == 0)
            {
                continue;
            }
            const glm::ivec3 local = glm::ivec3(voxel.x, voxel.y, voxel.z) - model.size / 2;
            const glm::ivec3 halves = placement(2 * local + 1);
            const glm::ivec3 cell((halves.x - 1) / 2, (halves.z - 1) / 2, -1 - (halves.y - 1) / 2);
            m_cells.push_back({cell, m_palette[voxel.index - 1U]});
        }
    }

    VoxVoxels finish()
    {
        glm::ivec3 corner(0);
        glm::ivec3 end(1);
        for (const Cell& cell : m_cells)
        {
            corner = glm::min(corner, cell.place);
            end = glm::max(end, cell.place + 1);
        }
        const glm::uvec3 extent(end - corner);
        const std::uint32_t edge = std::max({extent.x, extent.y, extent.z, 2U});
        if (edge > kEdgeMax)
        {
            fail(fmt::format("it is {} voxels wide, more than the {} that are possible", edge, kEdgeMax));
        }
        m_result.grid = {glm::vec3(corner), 1.0F, static_cast<std::uint32_t>(std::bit_width(edge - 1))};
        std::vector<std::pair<std::uint64_t, std::uint32_t>> voxels;
        voxels.reserve(m_cells.size());
        for (const Cell& cell : m_cells)
        {
            voxels.emplace_back(codeOfCell(glm::uvec3(cell.place - corner)), cell.color);
        }
        m_cells = {};
        const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
        std::stable_sort(voxels.begin(), voxels.end(), before);
        for (std::size_t i = 0; i < voxels.size(); ++i)
        {
            if (i + 1 == voxels.size() || voxels[i + 1].first != voxels[i].first) // the last one of its place
            {
                m_result.codes.push_back(voxels[i].first);
                m_result.colors.push_back(voxels[i].second);
            }
        }
        return std::move(m_result);
    }

    struct Cell
    {
        glm::ivec3 place;
        std::uint32_t color;
    };

    const std::filesystem::path& m_name;
    std::array<std::uint32_t, kPaletteSize> m_palette;
    std::optional<glm::ivec3> m_size; // of the model whose voxels come next
    std::vector<Model> m_models;
    std::map<std::int32_t, Node> m_nodes;
    std::set<std::int32_t> m_hidden_layers;
    std::vector<Cell> m_cells;
    VoxVoxels m_result;
};

} // namespace

VoxVoxels readVox(std::span<const std::uint8_t> bytes, const std::filesystem::path& name)
{
    return Reader(name).read(bytes);
}

} // namespace zvo
