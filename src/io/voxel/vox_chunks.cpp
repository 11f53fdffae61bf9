// SPDX-License-Identifier: MIT
#include "io/voxel/vox_chunks.h"

#include "core/base/color_word.h"
#include "core/base/input_error.h"
#include "core/base/read_file.h"
#include "io/file/text_cursor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::uint32_t kModelEdgeMax = 256;

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

    // Reads a number of bytes, and checks that so many follow.
    std::uint32_t size()
    {
        const std::int32_t value = number();
        if (value < 0)
        {
            throw inputError(m_name, fmt::format("a chunk of {} bytes; {}", value, kExportAgain));
        }
        return static_cast<std::uint32_t>(value);
    }

    // Reads a number of items of at least bytes_each bytes, and checks that so many follow.
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

    std::string_view text() { return asText(take(count(1))); }

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

// MagicaVoxel's palette for files without one: a cube of 6 levels a channel without black, then ramps.
std::array<std::uint32_t, kVoxPaletteSize> defaultPalette()
{
    constexpr std::array<std::uint32_t, 10> kRamp = {238, 221, 187, 170, 136, 119, 85, 68, 34, 17};
    constexpr std::uint32_t kLevelStep = 51;
    std::array<std::uint32_t, kVoxPaletteSize> palette{};
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

/// Reads the chunks of one file.
class ChunkReader
{
public:
    explicit ChunkReader(const std::filesystem::path& name) : m_name(name) { m_scene.palette = defaultPalette(); }

    VoxScene read(std::span<const std::uint8_t> bytes)
    {
        readChunks(bytes);
        return std::move(m_scene);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw inputError(m_name, what); }

    void readChunks(std::span<const std::uint8_t> bytes)
    {
        Content file(bytes, m_name);
        constexpr std::string_view kMagic = "VOX ";
        if (bytes.size() < 8 || asText(file.take(4)) != kMagic)
        {
            fail("not a MagicaVoxel file: it does not begin with \"VOX \"");
        }
        const std::int32_t version = file.number();
        if (version < 150 || version >= 300)
        {
            fail(fmt::format("version {} of the format; those from 150 to 299 can be read", version));
        }
        if (asText(file.take(4)) != "MAIN")
        {
            fail(fmt::format("its first chunk is not MAIN; {}", kExportAgain));
        }
        const std::uint32_t content_bytes = file.size();
        const std::uint32_t children_bytes = file.size();
        file.take(content_bytes);
        Content children(file.take(children_bytes), m_name);
        while (children.restBytes() != 0)
        {
            const std::string_view id = asText(children.take(4));
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
        else if (id == "TDCZ")
        {
            fail("its voxels are a chunk TDCZ, the compressed format of Teardown, which is not read");
        }
        else if (id == "MATT" || id == "MATL")
        {
            id == "MATT" ? readOldMaterial(content) : readMaterial(content);
        }
        else if (id == "LAYR")
        {
            const std::int32_t layer = content.number();
            if (isHidden(content.dictionary()))
            {
                m_scene.hidden_layers.insert(layer);
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
        const std::uint32_t count = content.count(sizeof(VoxModelVoxel));
        const VoxModel model = {*m_size, content.take(std::uint64_t{count} * sizeof(VoxModelVoxel))};
        m_size.reset();
        for (std::uint32_t i = 0; i < count; ++i)
        {
            const VoxModelVoxel voxel = model.voxel(i);
            if (voxel.x >= model.size.x || voxel.y >= model.size.y || voxel.z >= model.size.z)
            {
                fail(fmt::format("voxel {} of model {} is at ({}, {}, {}), outside of its {} x {} x {}; {}", i,
                                 m_scene.models.size(), voxel.x, voxel.y, voxel.z, model.size.x, model.size.y,
                                 model.size.z, kExportAgain));
            }
        }
        m_scene.models.push_back(model);
    }

    void readPalette(Content& content)
    {
        for (std::uint32_t& color : m_scene.palette)
        {
            color = static_cast<std::uint32_t>(content.number()) & kColorMask; // the alpha has no meaning
        }
    }

    // Materials before version 0.99.
    void readOldMaterial(Content& content)
    {
        constexpr std::array<const char*, 4> kTypes = {"_diffuse", "_metal", "_glass", "_emit"};
        const std::int32_t index = content.number();
        const auto type = static_cast<std::uint32_t>(content.number());
        const float weight = std::bit_cast<float>(content.number());
        setMaterial(index, type < kTypes.size() ? kTypes[type] : "_unknown",
                    weight >= 0.0F ? std::min(weight, 1.0F) : 1.0F);
    }

    void setMaterial(std::int32_t index, std::string_view type, float emission)
    {
        if (index < 1 || index > static_cast<std::int32_t>(kVoxPaletteSize))
        {
            return;
        }
        const auto place = static_cast<std::size_t>(index) - 1;
        m_scene.emission[place] = type == "_emit" ? emission : 0.0F;
        m_scene.kinds[place] = type == "_emit" || type == "_diffuse" ? "" : type.substr(type.starts_with('_') ? 1 : 0);
    }

    // Of materials only the light that they give off is read. The format says what `_emit` and `_flux` are called in
    // MagicaVoxel, emission and power, but not what they are: a step of power counts as ten times the light.
    void readMaterial(Content& content)
    {
        const std::int32_t index = content.number();
        const Dictionary material = content.dictionary();
        constexpr float kMost = 100.0F; // what is more is no emission that can be chosen
        constexpr float kMostPower = 8.0F;
        const auto value = [&](std::string_view key, float otherwise, float most)
        {
            const auto entry = material.find(key);
            const std::optional<float> said =
                entry == material.end() ? std::nullopt : parseNumber<float>(entry->second);
            return said && *said >= 0.0F ? std::min(*said, most) : otherwise;
        };
        const std::string kind(material.contains("_type") ? material.at("_type") : "_diffuse");
        const bool is_rough = kind != "_emit" && kind != "_diffuse" && material.contains("_rough");
        setMaterial(index, is_rough ? kind + " with roughness" : kind,
                    value("_emit", value("_weight", 1.0F, kMost), kMost) *
                        std::pow(10.0F, value("_flux", 0.0F, kMostPower)));
    }

    void readNode(std::string_view id, Content& content)
    {
        const std::int32_t number = content.number();
        VoxNode node;
        node.hidden = isHidden(content.dictionary());
        if (id == "nTRN")
        {
            node.children.push_back(content.number());
            content.number(); // reserved
            node.layer = content.number();
            constexpr std::uint32_t kFrameBytesMin = 4;
            if (hasFrame(content.count(kFrameBytesMin)))
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
            if (hasFrame(content.count(kModelBytesMin)))
            {
                node.models.push_back(content.number()); // of the first frame
            }
        }
        if (!m_scene.nodes.emplace(number, std::move(node)).second)
        {
            fail(fmt::format("two nodes have the number {}; {}", number, kExportAgain));
        }
    }

    bool hasFrame(std::uint32_t count)
    {
        m_scene.has_frames = m_scene.has_frames || count > 1;
        return count != 0;
    }

    VoxPlacement placementOf(const Dictionary& frame) const
    {
        VoxPlacement placement;
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
                if (!value || std::abs(std::int64_t{*value}) > kVoxTranslationMax)
                {
                    fail(fmt::format("a place \"{}\" that is none; {}", move->second, kExportAgain));
                }
                placement.move[i] = *value;
            }
        }
        return placement;
    }

    const std::filesystem::path& m_name;
    std::optional<glm::ivec3> m_size; // of the model whose voxels follow
    VoxScene m_scene;
};

} // namespace

VoxScene readVoxScene(std::span<const std::uint8_t> bytes, const std::filesystem::path& name)
{
    return ChunkReader(name).read(bytes);
}

} // namespace zvo
