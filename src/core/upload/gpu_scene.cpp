// SPDX-License-Identifier: MIT
#include "core/upload/gpu_scene.h"

#include "core/upload/draws.h"
#include "core/upload/fixed_uv.h"
#include "core/upload/texture_levels.h"
#include "core/upload/texture_pool.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <vector>

namespace zvo
{

namespace
{

std::uint32_t toFraction(float value)
{
    const double clamped = value > 0.0F ? std::min(static_cast<double>(value), 1.0) : 0.0; // NaN becomes 0
    return static_cast<std::uint32_t>(std::lround(clamped * gpu::kFractionOne));
}

gpu::uvec2 packFractions(const glm::vec4& v)
{
    return {toFraction(v.r) | toFraction(v.g) << 16, toFraction(v.b) | toFraction(v.a) << 16};
}

std::uint32_t wrapOf(WrapMode mode)
{
    switch (mode)
    {
    case WrapMode::Repeat:
        return gpu::kWrapRepeat;
    case WrapMode::MirroredRepeat:
        return gpu::kWrapMirror;
    case WrapMode::ClampToEdge:
        return gpu::kWrapClamp;
    }
    return gpu::kWrapRepeat;
}

std::uint32_t alphaModeOf(AlphaMode mode)
{
    switch (mode)
    {
    case AlphaMode::Opaque:
        return gpu::kAlphaOpaque;
    case AlphaMode::Mask:
        return gpu::kAlphaMask;
    case AlphaMode::Blend:
        return gpu::kAlphaBlend;
    }
    return gpu::kAlphaOpaque;
}

bool emits(const Material& material)
{
    return std::max({material.emission.r, material.emission.g, material.emission.b}) > 0.0F;
}

// The host's copies of the buffers while they are put together.
struct Staging
{
    std::vector<gpu::Draw> draws;
    std::vector<gpu::uvec3> triangles;
    std::vector<gpu::vec3> positions;
    std::vector<gpu::vec3> normals;
    std::vector<gpu::ivec2> uvs;
    std::vector<gpu::uvec2> colors;
    std::vector<gpu::Material> materials;
    std::vector<gpu::TextureInfo> textures;
    TexturePool pool;
    std::array<std::vector<gpu::Chunk>, gpu::kClassCount> whole_chunks;
    std::array<std::vector<gpu::Chunk>, gpu::kClassCount> single_chunks;
};

void addPrimitive(Staging& staging, const Primitive& primitive)
{
    staging.triangles.insert(staging.triangles.end(), primitive.triangles.begin(), primitive.triangles.end());
    staging.positions.insert(staging.positions.end(), primitive.positions.begin(), primitive.positions.end());
    staging.normals.insert(staging.normals.end(), primitive.normals.begin(), primitive.normals.end());
    for (const auto* uvs : {&primitive.uvs, &primitive.emission_uvs})
    {
        std::ranges::transform(*uvs, std::back_inserter(staging.uvs), toFixedUv);
    }
    for (const glm::vec4& color : primitive.colors)
    {
        staging.colors.push_back(packFractions(color));
    }
}

// Textures that nothing needs get no texels: their materials do without them.
std::vector<bool> neededTextures(const Scene& scene, bool attributes)
{
    std::vector<bool> is_shown(scene.materials.size(), false); // on an instance
    for (const Instance& instance : scene.instances)
    {
        is_shown[scene.primitives[instance.primitive].material] = true;
    }
    std::vector<bool> needed(scene.textures.size(), false);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
    {
        if (!is_shown[i])
        {
            continue;
        }
        const Material& material = scene.materials[i];
        if (material.base_color_texture && (attributes || material.alpha_mode != AlphaMode::Opaque))
        {
            needed[*material.base_color_texture] = true;
        }
        if (material.emission_texture && attributes && emits(material))
        {
            needed[*material.emission_texture] = true;
        }
    }
    return needed;
}

void addTextures(Staging& staging, const Scene& scene, const std::vector<bool>& needed, const TextureOptions& options)
{
    const std::vector<std::uint32_t> least_levels = options.grid
                                                        ? leastLevels(scene, needed, *options.grid, options.coverage)
                                                        : std::vector<std::uint32_t>(scene.images.size(), 0);
    std::vector<TexturePool::Place> places(scene.images.size());
    for (std::size_t i = 0; i < scene.textures.size(); ++i)
    {
        const Texture& texture = scene.textures[i];
        TexturePool::Place& place = places[texture.image];
        if (needed[i] && place.first_level == gpu::kAbsent)
        {
            place = staging.pool.add(scene.images[texture.image], least_levels[texture.image]);
        }
        staging.textures.push_back(
            {place.first_level, place.level_range, wrapOf(texture.wrap_u), wrapOf(texture.wrap_v)});
    }
}

void addMaterial(Staging& staging, const Material& material, const std::vector<bool>& needed, float emission_scale)
{
    const auto textureOf = [&](const std::optional<std::uint32_t>& texture)
    { return texture && needed[*texture] ? *texture : gpu::kAbsent; };
    const float scale = emission_scale > 0.0F ? emission_scale : 1.0F;
    gpu::Material result{};
    result.base_color = packFractions(material.base_color);
    result.emission = packFractions({material.emission / scale, 0.0F});
    result.base_texture = textureOf(material.base_color_texture);
    result.emission_texture = textureOf(material.emission_texture);
    result.alpha_mode = alphaModeOf(material.alpha_mode);
    result.alpha_cutoff = material.alpha_cutoff > 1.0F ? gpu::kUvOne : toFraction(material.alpha_cutoff);
    staging.materials.push_back(result);
}

MaterialClass classOf(const gpu::Material& material)
{
    if (material.alpha_mode != gpu::kAlphaOpaque)
    {
        return MaterialClass::Alpha;
    }
    const bool textured = material.base_texture != gpu::kAbsent || material.emission_texture != gpu::kAbsent;
    return textured ? MaterialClass::Textured : MaterialClass::Plain;
}

double triangleArea(const Primitive& primitive, const glm::dmat3& linear)
{
    double area = 0;
    for (const glm::uvec3& triangle : primitive.triangles)
    {
        const glm::dvec3 a = primitive.positions[triangle.x];
        const glm::dvec3 b = primitive.positions[triangle.y];
        const glm::dvec3 c = primitive.positions[triangle.z];
        const double size = glm::length(glm::cross(linear * (b - a), linear * (c - a))) / 2;
        area += std::isfinite(size) ? size : 0.0;
    }
    return area;
}

void addChunks(Staging& staging, std::uint32_t draw_number)
{
    const gpu::Draw& draw = staging.draws[draw_number];
    const auto material_class = static_cast<std::size_t>(classOf(staging.materials[draw.material]));
    const bool shares = draw.triangle_count < gpu::kSingleTriangles;
    std::vector<gpu::Chunk>& chunks =
        shares ? staging.single_chunks[material_class] : staging.whole_chunks[material_class];
    const std::uint32_t step = shares ? 1 : gpu::kChunkTriangles;
    for (std::uint64_t first = 0; first < draw.triangle_count; first += step)
    {
        chunks.push_back({draw_number, static_cast<std::uint32_t>(first)});
    }
    checkedCount(chunks.size() * step, "triangles");
}

template <typename T> vk::BufferOf<T> upload(vk::Uploader& device, const char* name, const std::vector<T>& values)
{
    return device.makeBuffer(name, std::span<const T>(values));
}

template <typename... T> std::uint64_t bytesOf(const std::vector<T>&... values)
{
    return (std::uint64_t{0} + ... + std::as_bytes(std::span(values)).size());
}

std::vector<std::uint32_t> packBytes(const std::vector<std::uint8_t>& bytes)
{
    std::vector<std::uint32_t> words(bytes.size() / 4);
    for (std::size_t i = 0; i < bytes.size(); ++i)
    {
        words[i / 4] |= std::uint32_t{bytes[i]} << (8 * (i % 4));
    }
    return words;
}

// Adds the tables of colours, and then scene.view, the table of all buffers. All others must be there.
void addTables(vk::Uploader& device, GpuScene& scene)
{
    const auto& to_linear = srgbToLinearTable();
    scene.srgb_to_linear = device.makeBuffer("scene/srgb_to_linear", std::span<const gpu::uint>(to_linear));
    scene.linear_to_srgb = upload(device, "scene/linear_to_srgb", packBytes(linearToSrgbTable()));
    const gpu::SceneView view = sceneView(scene);
    scene.view = device.makeBuffer("scene/view", std::span<const gpu::SceneView>(&view, 1));
}

} // namespace

float brightestEmission(const Scene& scene)
{
    float brightest = 0.0F;
    for (const Material& material : scene.materials)
    {
        brightest = std::max({brightest, material.emission.r, material.emission.g, material.emission.b});
    }
    return brightest;
}

GpuScene uploadScene(vk::Uploader& device, const Scene& scene, bool attributes, std::optional<float> emission_scale,
                     const TextureOptions& texture_options)
{
    GpuScene result;
    result.has_attributes = attributes;
    result.texture_grid = texture_options.grid;
    result.emission_scale = emission_scale ? *emission_scale : brightestEmission(scene);

    Staging staging;
    const std::vector<bool> needed = neededTextures(scene, attributes);
    addTextures(staging, scene, needed, texture_options);
    for (const Material& material : scene.materials)
    {
        addMaterial(staging, material, needed, result.emission_scale);
    }
    staging.draws = makeDraws(scene);
    for (const Primitive& primitive : scene.primitives)
    {
        addPrimitive(staging, primitive);
    }
    checkedCount(scene.instances.size(), "instances");
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
    {
        const Instance& instance = scene.instances[i];
        const Primitive& primitive = scene.primitives[instance.primitive];
        addChunks(staging, static_cast<std::uint32_t>(i));
        result.triangle_count += primitive.triangles.size();
        result.surface_area += triangleArea(primitive, glm::dmat3(instance.transform));
    }

    device.device().memory().require(bytesOf(staging.draws, staging.triangles, staging.positions, staging.normals,
                                             staging.uvs, staging.colors, staging.materials, staging.textures,
                                             staging.pool.levels(), staging.whole_chunks[0], staging.whole_chunks[1],
                                             staging.whole_chunks[2], staging.single_chunks[0],
                                             staging.single_chunks[1], staging.single_chunks[2]) +
                                         staging.pool.texelCount() * sizeof(gpu::uint) + sizeof(srgbToLinearTable()) +
                                         linearToSrgbTable().size() + sizeof(gpu::SceneView),
                                     "the scene");
    staging.pool.checkSize(device.device());
    static_assert(gpu::kClassCount == 3);
    result.draws = upload(device, "scene/draws", staging.draws);
    result.triangles = upload(device, "scene/triangles", staging.triangles);
    result.positions = upload(device, "scene/positions", staging.positions);
    result.normals = upload(device, "scene/normals", staging.normals);
    result.uvs = upload(device, "scene/uvs", staging.uvs);
    result.colors = upload(device, "scene/colors", staging.colors);
    result.materials = upload(device, "scene/materials", staging.materials);
    result.textures = upload(device, "scene/textures", staging.textures);
    result.levels = upload(device, "scene/texture_levels", staging.pool.levels());
    result.texels = staging.pool.upload(device, texture_options.progress, result.warnings);
    for (std::size_t i = 0; i < result.chunks.size(); ++i)
    {
        result.chunks[i] = {upload(device, "scene/chunks", staging.whole_chunks[i]),
                            upload(device, "scene/single_chunks", staging.single_chunks[i])};
    }
    addTables(device, result);
    return result;
}

GpuScene uploadColorTables(vk::Uploader& device)
{
    GpuScene tables;
    addTables(device, tables);
    return tables;
}

MaterialClass GpuScene::highestClass() const
{
    const auto exists = [this](MaterialClass material_class) { return chunksOf(material_class).workgroups() != 0; };
    return exists(MaterialClass::Alpha)      ? MaterialClass::Alpha
           : exists(MaterialClass::Textured) ? MaterialClass::Textured
                                             : MaterialClass::Plain;
}

gpu::SceneView sceneView(const GpuScene& scene)
{
    gpu::SceneView view{};
    view.draws = {scene.draws.address()};
    view.triangles = {scene.triangles.address()};
    view.positions = {scene.positions.address()};
    view.normals = {scene.normals.address()};
    view.uvs = {scene.uvs.address()};
    view.colors = {scene.colors.address()};
    view.materials = {scene.materials.address()};
    view.textures = {scene.textures.address()};
    view.levels = {scene.levels.address()};
    view.texels = {scene.texels.address()};
    view.srgb_to_linear = {scene.srgb_to_linear.address()};
    view.linear_to_srgb = {scene.linear_to_srgb.address()};
    return view;
}

gpu::ConstPtr<gpu::SceneView> readColorTables(vk::AnyPass& pass, const GpuScene& scene)
{
    pass.reach("linear_to_srgb", scene.linear_to_srgb);
    pass.reach("srgb_to_linear", scene.srgb_to_linear);
    return pass.read(scene.view);
}

} // namespace zvo
