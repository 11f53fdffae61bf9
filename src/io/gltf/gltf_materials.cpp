// SPDX-License-Identifier: MIT
#include "io/gltf/gltf_materials.h"

#include "core/scene/scene_size.h"
#include "io/gltf/gltf_uri.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace zvo
{

namespace
{

constexpr const char* kSpecularGlossinessName = "KHR_materials_pbrSpecularGlossiness";

/// Converts a factor to single precision; it must be finite and at least 0.
float toFactor(const GltfDocument& document, double value, const std::string& where)
{
    if (value < 0.0 || value > static_cast<double>(std::numeric_limits<float>::max()))
    {
        throw document.error(
            fmt::format("{} is {}, not in the range from 0 to 3.4e38; {}", where, value, kExportAgain));
    }
    return static_cast<float>(value);
}

AlphaMode toAlphaMode(const GltfDocument& document, const std::string& mode, const std::string& where)
{
    if (mode == "OPAQUE")
    {
        return AlphaMode::Opaque;
    }
    if (mode == "MASK")
    {
        return AlphaMode::Mask;
    }
    if (mode == "BLEND")
    {
        return AlphaMode::Blend;
    }
    throw document.error(
        fmt::format("{}.alphaMode is \"{}\", not OPAQUE, MASK or BLEND; {}", where, mode, kExportAgain));
}

WrapMode toWrapMode(const GltfDocument& document, int mode, const std::string& where)
{
    switch (mode)
    {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
        return WrapMode::Repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return WrapMode::MirroredRepeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return WrapMode::ClampToEdge;
    default:
        throw document.error(fmt::format("{} is {}, which is no wrapping mode; {}", where, mode, kExportAgain));
    }
}

double emissiveStrength(const tinygltf::Material& material)
{
    const auto extension = material.extensions.find("KHR_materials_emissive_strength");
    if (extension == material.extensions.end() || !extension->second.Has("emissiveStrength"))
    {
        return 1.0;
    }
    return extension->second.Get("emissiveStrength").GetNumberAsDouble();
}

/// Takes the diffuse colour of KHR_materials_pbrSpecularGlossiness as the base colour. Metals, which have only a
/// specular colour, become dark.
void useSpecularGlossiness(tinygltf::Material& material)
{
    const auto extension = material.extensions.find(kSpecularGlossinessName);
    if (extension == material.extensions.end())
    {
        return;
    }
    const tinygltf::Value& source = extension->second;
    tinygltf::PbrMetallicRoughness diffuse;
    for (int i = 0; i < 4 && source.Has("diffuseFactor"); ++i)
    {
        diffuse.baseColorFactor[i] = source.Get("diffuseFactor").Get(i).GetNumberAsDouble();
    }
    if (source.Has("diffuseTexture"))
    {
        const tinygltf::Value& texture = source.Get("diffuseTexture");
        diffuse.baseColorTexture.index = texture.Get("index").GetNumberAsInt();
        diffuse.baseColorTexture.texCoord = texture.Has("texCoord") ? texture.Get("texCoord").GetNumberAsInt() : 0;
        if (texture.Has("extensions"))
        {
            for (const std::string& name : texture.Get("extensions").Keys())
            {
                diffuse.baseColorTexture.extensions[name] = texture.Get("extensions").Get(name);
            }
        }
    }
    material.pbrMetallicRoughness = diffuse;
}

/// The image of a texture, or -1 if it has none that can be read.
int imageOf(const tinygltf::Texture& texture)
{
    const auto extension = texture.extensions.find("EXT_texture_webp");
    const bool has_webp = extension != texture.extensions.end() && extension->second.Has("source");
    return has_webp ? extension->second.Get("source").GetNumberAsInt() : texture.source;
}

/// Where the bytes of an image can be read again; otherwise, a copy of them.
EncodedImage encodedImage(const GltfDocument& document, const GltfImageSource& source,
                          std::span<const std::uint8_t> encoded)
{
    if (source.buffer_view < 0 && !isDataUri(source.uri))
    {
        return {document.fileOf(source.uri, "uri"), 0, encoded.size()};
    }
    if (const std::optional<std::uint64_t> offset = document.offsetInFile(encoded))
    {
        return {document.path, *offset, encoded.size()};
    }
    return {.file = {}, .bytes = std::make_shared<std::vector<std::uint8_t>>(encoded.begin(), encoded.end())};
}

glm::dvec2 toVec2(const tinygltf::Value& value, const std::string& name, double missing)
{
    if (!value.Has(name))
    {
        return glm::dvec2(missing);
    }
    const tinygltf::Value& array = value.Get(name);
    return {array.Get(0).GetNumberAsDouble(), array.Get(1).GetNumberAsDouble()};
}

/// The texture coordinates that a texture reads. The rotation is counter-clockwise when v points up, so it is clockwise
/// in (u, v), as in the examples and the test model of KHR_texture_transform.
GltfUvSource uvSource(const tinygltf::TextureInfo& info)
{
    GltfUvSource source;
    source.set = info.texCoord;
    const auto extension = info.extensions.find("KHR_texture_transform");
    if (extension != info.extensions.end())
    {
        const tinygltf::Value& transform = extension->second;
        const glm::dvec2 scale = toVec2(transform, "scale", 1.0);
        const double angle = transform.Has("rotation") ? transform.Get("rotation").GetNumberAsDouble() : 0.0;
        source.along_u = scale.x * glm::dvec2(std::cos(angle), -std::sin(angle));
        source.along_v = scale.y * glm::dvec2(std::sin(angle), std::cos(angle));
        source.offset = toVec2(transform, "offset", 0.0);
        source.set = transform.Has("texCoord") ? transform.Get("texCoord").GetNumberAsInt() : source.set;
    }
    return source;
}

} // namespace

GltfMaterials::GltfMaterials(const GltfDocument& document, Scene& scene, GltfWarnings& warnings, ImageDecoding decoding)
    : m_document(document), m_scene(scene), m_warnings(warnings), m_decoding(decoding),
      m_image_bytes_left(sceneBytesMax())
{
}

const GltfMaterial& GltfMaterials::get(int material)
{
    const auto known = m_materials.find(material);
    return known != m_materials.end() ? known->second : m_materials.emplace(material, load(material)).first->second;
}

GltfMaterial GltfMaterials::load(int index)
{
    const std::string where = fmt::format("materials[{}]", index);
    m_document.use(where);
    tinygltf::Material source = index < 0 ? tinygltf::Material() : m_document.model.materials[index];
    const bool is_diffuse = source.extensions.contains(kSpecularGlossinessName);
    if (!is_diffuse)
    {
        m_document.use(where + ".pbrMetallicRoughness");
    }
    useSpecularGlossiness(source);
    const std::string factor_name = is_diffuse ? ".diffuseFactor" : ".pbrMetallicRoughness.baseColorFactor";
    const std::string texture_name = is_diffuse ? ".diffuseTexture" : ".pbrMetallicRoughness.baseColorTexture";
    const auto factor = [&](double value, const std::string& name)
    { return toFactor(m_document, value, where + name); };
    Material material;
    material.name = index < 0 ? "default" : source.name;
    material.alpha_mode = toAlphaMode(m_document, source.alphaMode, where);
    material.double_sided = source.doubleSided;
    material.alpha_cutoff = factor(source.alphaCutoff, ".alphaCutoff");
    for (int i = 0; i < 4; ++i)
    {
        const double value = source.pbrMetallicRoughness.baseColorFactor[i];
        material.base_color[i] = factor(value, factor_name);
    }
    for (int i = 0; i < 3 && !source.emissiveFactor.empty(); ++i)
    {
        material.emission[i] = factor(source.emissiveFactor[i] * emissiveStrength(source), ".emissiveFactor");
    }

    if (std::any_of(source.emissiveFactor.begin(), source.emissiveFactor.end(), [](double f) { return f != 0.0; }))
    {
        m_document.use(where + ".emissiveTexture");
        m_document.use(where + ".extensions.KHR_materials_emissive_strength");
    }

    GltfMaterial loaded;
    const tinygltf::TextureInfo& base_color = source.pbrMetallicRoughness.baseColorTexture;
    if (base_color.index >= 0)
    {
        material.base_color_texture = texture(base_color.index, where + texture_name);
        loaded.uvs = material.base_color_texture ? std::optional(uvSource(base_color)) : std::nullopt;
    }
    if (source.emissiveTexture.index >= 0 && material.emission != glm::vec3(0.0F))
    {
        const GltfUvSource uvs = uvSource(source.emissiveTexture);
        material.emission_texture = texture(source.emissiveTexture.index, where + ".emissiveTexture");
        if (material.emission_texture && !loaded.uvs)
        {
            loaded.uvs = uvs;
        }
        else if (material.emission_texture && *loaded.uvs != uvs)
        {
            loaded.emission_uvs = uvs;
        }
    }
    loaded.index = static_cast<std::uint32_t>(m_scene.materials.size());
    m_scene.materials.push_back(material);
    return loaded;
}

std::optional<std::uint32_t> GltfMaterials::texture(int index, const std::string& where)
{
    const auto known = m_textures.find(index);
    if (known != m_textures.end())
    {
        return known->second;
    }
    m_document.use(fmt::format("textures[{}]", index));
    const tinygltf::Texture& source = m_document.model.textures[index];
    const int source_image = imageOf(source);
    if (source_image < 0)
    {
        const std::string other =
            source.extensions.empty() ? "" : fmt::format(", but one of {}", source.extensions.begin()->first);
        m_warnings.add(fmt::format("texture left out: it has no PNG, JPEG or WebP image{}; export it with one", other),
                       where);
        return std::nullopt;
    }
    const std::optional<std::uint32_t> usable = usableImage(source_image, where);
    if (!usable)
    {
        return std::nullopt;
    }
    Texture texture;
    texture.image = *usable;
    if (source.sampler >= 0)
    {
        const tinygltf::Sampler& sampler = m_document.model.samplers[source.sampler];
        const std::string sampler_name = fmt::format("samplers[{}]", source.sampler);
        m_document.use(sampler_name);
        texture.wrap_u = toWrapMode(m_document, sampler.wrapS, sampler_name + ".wrapS");
        texture.wrap_v = toWrapMode(m_document, sampler.wrapT, sampler_name + ".wrapT");
    }
    const auto added = static_cast<std::uint32_t>(m_scene.textures.size());
    m_scene.textures.push_back(texture);
    m_textures.emplace(index, added);
    return added;
}

/// Index into Scene::images, or nothing, with a warning for each texture, if the image cannot be used.
std::optional<std::uint32_t> GltfMaterials::usableImage(int index, const std::string& where)
{
    const auto leaveOut = [&](const std::string& reason) { m_warnings.add("texture left out: " + reason, where); };
    const auto known = m_unusable_images.find(index);
    if (known != m_unusable_images.end())
    {
        leaveOut(known->second);
        return std::nullopt;
    }
    try
    {
        m_document.use(fmt::format("images[{}]", index));
        return image(index);
    }
    catch (const Error& failure)
    {
        if (failure.code() != ErrorCode::Input)
        {
            throw;
        }
        leaveOut(m_unusable_images.emplace(index, m_document.reason(failure)).first->second);
        return std::nullopt;
    }
}

std::uint32_t GltfMaterials::image(int index)
{
    const auto known = m_images.find(index);
    if (known != m_images.end())
    {
        return known->second;
    }
    const GltfImageSource& source = m_document.images[index];
    const std::string property = fmt::format("images[{}]", index);
    std::vector<std::uint8_t> storage; // for data outside of the buffers
    std::span<const std::uint8_t> encoded;
    if (source.buffer_view >= 0)
    {
        encoded = m_document.bufferView(source.buffer_view);
    }
    else if (!source.uri.empty())
    {
        storage = m_document.readUri(source.uri, property + ".uri");
        encoded = storage;
    }
    else
    {
        throw m_document.error(fmt::format("{} has neither a URI nor a buffer view; {}", property, kExportAgain));
    }
    const bool has_file = !source.uri.empty() && source.uri.find(':') == std::string::npos;
    const std::string file = has_file ? source.uri : property;
    try
    {
        const std::string name = source.name.empty() ? file : source.name;
        const std::string where = property + " (" + file + ")";
        m_scene.images.push_back(m_decoding == ImageDecoding::WhenLoaded
                                     ? decodeImage(encoded, name, where, m_image_bytes_left)
                                     : deferImage(encoded, encodedImage(m_document, source, encoded), name, where,
                                                  m_document.path, m_image_bytes_left));
        m_image_bytes_left -= m_scene.images.back().rgba.size();
    }
    catch (const Error& failure)
    {
        throw m_document.error(failure.what());
    }
    const auto added = static_cast<std::uint32_t>(m_scene.images.size() - 1);
    m_images.emplace(index, added);
    return added;
}

} // namespace zvo
