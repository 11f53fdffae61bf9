// SPDX-License-Identifier: MIT
#include "io/mesh/mtl_files.h"

#include "core/base/read_file.h"
#include "io/file/utf16.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace zvo
{

namespace
{

/// The uvs of v up as a texture reads them, of v down.
std::vector<glm::vec2> placed(const std::vector<glm::vec2>& uvs, const MtlTexture& texture)
{
    std::vector<glm::vec2> moved;
    moved.reserve(uvs.size());
    for (const glm::vec2& uv : uvs)
    {
        const glm::vec2 up = uv * texture.scale + texture.offset;
        moved.emplace_back(up.x, 1.0F - up.y);
    }
    return moved;
}

} // namespace

void MtlFiles::read(std::string_view names)
{
    if (readFileNamed(std::string(names)))
    {
        return;
    }
    std::vector<std::string> missing;
    TextCursor words(names);
    for (std::string name(words.word()); !name.empty(); name = words.word())
    {
        if (!readFileNamed(name))
        {
            missing.push_back(name);
        }
    }
    const std::string name(missing.size() == 1 ? missing.front() : names);
    if (!missing.empty())
    {
        m_all_found = false;
        m_scene.warn(leavesFolder(m_path, name)
                         ? fmt::format("colours left out, as the material file {} leaves the folder; only files in it "
                                       "and below are read; put it there and name it",
                                       name)
                         : fmt::format("colours left out, as there is no material file {}", name));
    }
}

bool MtlFiles::readFileNamed(const std::string& name)
{
    const std::optional<std::filesystem::path> file = findBeside(m_path, m_path, name);
    if (!file || !m_files.insert(*file).second)
    {
        return file.has_value();
    }
    std::vector<std::uint8_t> content = readFile(*file);
    if (auto utf8 = asUtf8(content))
    {
        content = *std::move(utf8);
    }
    MtlMaterial nowhere;
    MtlMaterial* current = &nowhere;
    TextCursor lines({reinterpret_cast<const char*>(content.data()), content.size()});
    while (const std::optional<std::string_view> line = lines.line())
    {
        TextCursor words(*line);
        if (lowered(words.word()) != "newmtl")
        {
            readStatement(*line, *file, *current);
            continue;
        }
        const auto [material, is_new] = m_materials.try_emplace(std::string(words.rest()));
        current = is_new ? &material->second : &nowhere;
    }
    return true;
}

void MtlFiles::readStatement(std::string_view line, const std::filesystem::path& file, MtlMaterial& material)
{
    TextCursor words(line);
    const std::string keyword = lowered(words.word());
    if (keyword == "kd")
    {
        material.color = readColor(line, words).value_or(material.color);
    }
    else if (keyword == "ke")
    {
        material.emission = readColor(line, words);
    }
    else if (keyword == "d")
    {
        material.opacity = readFraction(line, words);
    }
    else if (keyword == "tr")
    {
        material.transparency = readFraction(line, words).value_or(0.0F);
    }
    else if (keyword == "map_kd")
    {
        material.color_texture = readTexture(words, file);
    }
    else if (keyword == "map_ke")
    {
        material.emission_texture = readTexture(words, file);
    }
    else if (keyword == "map_d")
    {
        material.cut_out = readTexture(words, file);
    }
}

/// Three numbers, or one for all three. Nothing, with a warning, for anything else.
std::optional<glm::vec3> MtlFiles::readColor(std::string_view line, TextCursor words)
{
    std::vector<float> numbers;
    for (auto word = words.word(); !word.empty() && numbers.size() < 3; word = words.word())
    {
        numbers.push_back(parseSingle(word).value_or(-1.0F));
    }
    const bool is_valid = std::all_of(numbers.begin(), numbers.end(),
                                      [](float number) { return number >= 0.0F && std::isfinite(number); });
    if (!is_valid || numbers.empty() || numbers.size() == 2)
    {
        m_scene.warn(fmt::format("colour left out: \"{}\" has not three numbers of at least 0", line));
        return std::nullopt;
    }
    return numbers.size() == 1 ? glm::vec3(numbers[0]) : glm::vec3(numbers[0], numbers[1], numbers[2]);
}

/// A number from 0 to 1, which "-halo" may precede. Nothing, with a warning, for anything else.
std::optional<float> MtlFiles::readFraction(std::string_view line, TextCursor words)
{
    const std::string_view first = words.word();
    const std::optional<float> number = parseSingle(first == "-halo" ? words.word() : first);
    if (!number || std::isnan(*number))
    {
        m_scene.warn(fmt::format("transparency left out: \"{}\" has no number", line));
        return std::nullopt;
    }
    return std::clamp(*number, 0.0F, 1.0F);
}

/// The name stands behind the options. "-s", "-o" and "-t" have up to three numbers.
MtlTexture MtlFiles::readTexture(TextCursor words, const std::filesystem::path& file)
{
    MtlTexture texture;
    texture.named_in = file;
    TextCursor rest = words;
    for (auto option = words.word(); option.starts_with('-'); rest = words, option = words.word())
    {
        if (option == "-s" || option == "-o" || option == "-t")
        {
            glm::vec3 ignored(0.0F);
            TextCursor ahead = words;
            for (int i = 0; i < 3; ++i, words = ahead)
            {
                const std::optional<float> number = parseSingle(ahead.word());
                if (!number)
                {
                    break;
                }
                (option == "-t" || i == 2 ? ignored[i]
                 : option == "-s"         ? texture.scale[i]
                                          : texture.offset[i]) = *number;
            }
        }
        else if (option == "-mm")
        {
            words.word();
            words.word();
        }
        else if (const std::string_view value = words.word(); option == "-clamp" && value == "on")
        {
            texture.wrap = WrapMode::ClampToEdge;
        }
        if (option == "-t" || option == "-mm")
        {
            m_scene.warn(fmt::format("option {} of textures left out; bake it into the picture", option));
        }
    }
    texture.name = rest.rest();
    return texture;
}

std::optional<std::uint32_t> MtlFiles::addTexture(const MtlTexture& texture)
{
    return texture.name.empty() ? std::nullopt : m_scene.addTexture(texture.name, texture.named_in, texture.wrap);
}

std::uint32_t MtlFiles::add(const std::string& name)
{
    const auto found = m_materials.find(name);
    if (found == m_materials.end() && !name.empty() && m_all_found)
    {
        m_scene.warn(fmt::format("colours left out, as no material file has the material {}", name));
    }
    static const MtlMaterial kWhite;
    const MtlMaterial& source = found == m_materials.end() ? kWhite : found->second;
    m_added.push_back(&source);
    Material material;
    material.name = name.empty() ? "default" : name;
    // MeshLab and 3ds Max write "Tr 1" where they mean opaque; nobody exports what cannot be seen.
    const float opacity = source.opacity.value_or(source.transparency < 1.0F ? 1.0F - source.transparency : 1.0F);
    // Black would hide the texture, even one that cannot be used, which exporters do not mean.
    const bool is_hidden = !source.color_texture.name.empty() && source.color == glm::vec3(0.0F);
    material.base_color = glm::vec4(is_hidden ? glm::vec3(1.0F) : source.color, opacity);
    material.alpha_mode = opacity < 1.0F ? AlphaMode::Blend : AlphaMode::Opaque;
    material.base_color_texture = addTexture(source.color_texture);
    material.emission = source.emission.value_or(glm::vec3(source.emission_texture.name.empty() ? 0.0F : 1.0F));
    if (material.emission != glm::vec3(0.0F))
    {
        material.emission_texture = addTexture(source.emission_texture);
    }
    if (!source.cut_out.name.empty() && source.cut_out.name == source.color_texture.name)
    {
        material.alpha_mode = AlphaMode::Mask; // taken from the colour texture's own alpha
    }
    else if (!source.cut_out.name.empty())
    {
        m_scene.warn("textures of transparency (map_d) left out; put them into the alpha of the colour textures");
    }
    return m_scene.add(std::move(material));
}

void MtlFiles::placeTextures(Primitive& primitive) const
{
    const MtlTexture& color = m_added[primitive.material]->color_texture;
    const MtlTexture& emission = m_added[primitive.material]->emission_texture;
    const bool has_both = !color.name.empty() && !emission.name.empty();
    if (has_both && (color.scale != emission.scale || color.offset != emission.offset))
    {
        primitive.emission_uvs = placed(primitive.uvs, emission);
    }
    primitive.uvs = placed(primitive.uvs, color.name.empty() ? emission : color);
}

} // namespace zvo
