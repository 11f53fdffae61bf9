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
        const glm::vec2 up = uv * glm::vec2(texture.scale) + glm::vec2(texture.offset);
        moved.emplace_back(up.x, 1.0F - up.y);
    }
    return moved;
}

} // namespace

void MtlFiles::read(std::string_view names)
{
    if (!m_names.emplace(names).second || readFileNamed(std::string(names)))
    {
        return;
    }
    TextCursor words(names);
    for (std::string name(words.word()); !name.empty(); name = words.word())
    {
        if (!readFileNamed(name))
        {
            m_all_found = false;
            m_scene.warn(fmt::format("colours left out: {}: {}", names, kNotBeside));
        }
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
    TextCursor lines(asText(content));
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
    constexpr std::pair<std::string_view, MtlTexture MtlMaterial::*> kTextures[] = {
        {"map_kd", &MtlMaterial::color_texture},
        {"map_ke", &MtlMaterial::emission_texture},
        {"map_d", &MtlMaterial::cut_out}};
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
    else if (keyword == "d" || keyword == "tr")
    {
        (keyword == "d" ? material.opacity : material.transparency) = readFraction(line, words);
    }
    for (const auto& [name, texture] : kTextures)
    {
        if (keyword == name)
        {
            material.*texture = readTexture(words, file);
        }
    }
}

/// Three numbers, or one for all three. Nothing, with a warning, for anything else.
std::optional<glm::vec3> MtlFiles::readColor(std::string_view line, TextCursor words)
{
    glm::vec3 color(0.0F);
    int count = 0;
    for (auto word = words.word(); !word.empty() && count < 3; word = words.word())
    {
        const float number = parseSingle(word).value_or(-1.0F);
        count = number >= 0.0F && std::isfinite(number) ? count + 1 : 4; // 4: no colour
        color[std::min(count, 3) - 1] = number;
    }
    if (count != 1 && count != 3)
    {
        m_scene.warn("colours left out that are not three numbers of at least 0: ", line);
        return std::nullopt;
    }
    return count == 1 ? glm::vec3(color.x) : color;
}

/// A number from 0 to 1, which "-halo" may precede. Nothing, with a warning, for anything else.
std::optional<float> MtlFiles::readFraction(std::string_view line, TextCursor words)
{
    const std::string_view first = words.word();
    const std::optional<float> number = parseSingle(first == "-halo" ? words.word() : first);
    if (!number || std::isnan(*number))
    {
        m_scene.warn("transparency left out that is no number: ", line);
        return std::nullopt;
    }
    return std::clamp(*number, 0.0F, 1.0F);
}

/// The name stands behind the options. "-s", "-o" and "-t" have up to three numbers.
MtlTexture MtlFiles::readTexture(TextCursor words, const std::filesystem::path& file)
{
    MtlTexture texture{.named_in = file};
    TextCursor rest = words;
    for (auto option = words.word(); option.starts_with('-'); rest = words, option = words.word())
    {
        const bool is_vector = option == "-s" || option == "-o" || option == "-t";
        glm::vec3 ignored(0.0F);
        auto* const numbers = option == "-s" ? &texture.scale : option == "-o" ? &texture.offset : &ignored;
        TextCursor ahead = words;
        for (int i = 0; is_vector && i < 3; ++i, words = ahead)
        {
            const std::optional<float> number = parseSingle(ahead.word());
            if (!number)
            {
                break;
            }
            (*numbers)[i] = *number;
        }
        const std::string_view value = is_vector ? "" : words.word();
        texture.wrap = option == "-clamp" && value == "on" ? WrapMode::ClampToEdge : texture.wrap;
        if (option == "-mm")
        {
            words.word();
        }
        if (option == "-t" || option == "-mm")
        {
            m_scene.warn(fmt::format("option {} of textures left out; bake it into the picture", option));
        }
    }
    texture.name = rest.rest();
    return texture;
}

void MtlFiles::add(Primitive primitive, const std::string& name)
{
    const auto found = m_materials.find(name);
    if (found == m_materials.end() && !name.empty() && m_all_found)
    {
        m_scene.warn("colours left out, as no material file has the material ", name);
    }
    const MtlMaterial source = found == m_materials.end() ? MtlMaterial() : found->second;
    const MtlTexture& color = source.color_texture;
    const MtlTexture& emission = source.emission_texture;
    Material material;
    // MeshLab and 3ds Max write "Tr 1" where they mean opaque; nobody exports what cannot be seen.
    const float transparency = source.transparency.value_or(0.0F);
    const float opacity = source.opacity.value_or(transparency < 1.0F ? 1.0F - transparency : 1.0F);
    // Black would hide the texture, even one that cannot be used, which exporters do not mean.
    const bool is_hidden = !color.name.empty() && source.color == glm::vec3(0.0F);
    material.base_color = glm::vec4(is_hidden ? glm::vec3(1.0F) : source.color, opacity);
    material.alpha_mode = opacity < 1.0F ? AlphaMode::Blend : AlphaMode::Opaque;
    material.base_color_texture = m_scene.addTexture(color.name, color.named_in, color.wrap);
    material.emission = source.emission.value_or(glm::vec3(emission.name.empty() ? 0.0F : 1.0F));
    if (material.emission != glm::vec3(0.0F))
    {
        material.emission_texture = m_scene.addTexture(emission.name, emission.named_in, emission.wrap);
    }
    if (!source.cut_out.name.empty() && source.cut_out.name == color.name)
    {
        material.alpha_mode = AlphaMode::Mask; // taken from the colour texture's own alpha
    }
    else if (!source.cut_out.name.empty())
    {
        m_scene.warn("textures of transparency (map_d) left out; put them into the alpha of the colour textures");
    }
    const bool has_both = !color.name.empty() && !emission.name.empty();
    if (has_both && (color.scale != emission.scale || color.offset != emission.offset))
    {
        primitive.emission_uvs = placed(primitive.uvs, emission);
    }
    primitive.uvs = placed(primitive.uvs, color.name.empty() ? emission : color);
    m_scene.add(std::move(primitive), std::move(material), name.empty() ? "default" : name);
}

} // namespace zvo
