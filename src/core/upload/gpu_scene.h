// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/divide_up.h"
#include "core/base/grid.h"
#include "core/scene/scene.h"
#include "shared/scene.h"
#include "vk/device.h"
#include "vk/frame_graph.h"
#include "vk/uploader.h"
#include "voxelize/voxelize.h"
#include "zvo/types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// What the materials of a draw need. Kernels have a variant for each class.
enum class MaterialClass : std::uint32_t
{
    Plain = gpu::kClassPlain,
    Textured = gpu::kClassTextured,
    Alpha = gpu::kClassAlpha
};

inline constexpr std::array kMaterialClasses = {MaterialClass::Plain, MaterialClass::Textured, MaterialClass::Alpha};
static_assert(kMaterialClasses.size() == gpu::kClassCount);

/// The triangles of a material class as workgroups take them.
struct TriangleChunks
{
    vk::BufferOf<gpu::Chunk> whole;  // for a workgroup each
    vk::BufferOf<gpu::Chunk> single; // of draws with few triangles: of one triangle, for a thread each

    /// The workgroups that take them, whole chunks first.
    [[nodiscard]] std::uint64_t workgroups() const
    {
        return whole.count() + divideUp(single.count(), gpu::kChunkTriangles);
    }
};

/// A scene in device memory; shaders/shared/scene.h documents the layout. Nothing changes it after the upload.
struct GpuScene
{
    vk::BufferOf<gpu::Draw> draws;           // [instances]
    vk::BufferOf<gpu::uvec3> triangles;      // [triangles of all primitives]
    vk::BufferOf<gpu::vec3> positions;       // [vertices]
    vk::BufferOf<gpu::vec3> normals;         // [vertices of primitives that have them]
    vk::BufferOf<gpu::ivec2> uvs;            // likewise; of a primitive those of its emission come last
    vk::BufferOf<gpu::uvec2> colors;         // likewise
    vk::BufferOf<gpu::Material> materials;   // [materials]
    vk::BufferOf<gpu::TextureInfo> textures; // [textures]
    vk::BufferOf<gpu::TextureLevel> levels;  // [levels of all images]
    vk::BufferOf<gpu::uint> texels;          // [texels of all levels]
    vk::BufferOf<gpu::uint> srgb_to_linear;  // [256]
    vk::BufferOf<gpu::uint> linear_to_srgb;  // [16384]
    vk::BufferOf<gpu::SceneView> view;       // [1]

    std::array<TriangleChunks, gpu::kClassCount> chunks; // of the draws of each MaterialClass

    std::vector<std::string> warnings; // of images that do not decode, one line each: their textures are white
    std::optional<Grid> texture_grid;  // the one for whose voxels the textures have their levels; nothing: any
    bool has_attributes = false;       // the textures for colour and emission were uploaded
    std::uint64_t triangle_count = 0;  // those of a primitive count once for each instance
    double surface_area = 0;           // world units squared
    float emission_scale = 0;          // the emission that the fraction 1 stands for; 0: nothing emits light

    [[nodiscard]] const TriangleChunks& chunksOf(MaterialClass material_class) const
    {
        return chunks[static_cast<std::size_t>(material_class)];
    }

    /// The highest class of its draws. Kernels of that class serve the others, too.
    [[nodiscard]] MaterialClass highestClass() const;
};

/// The largest emission of any material of scene; 0 if nothing emits light.
float brightestEmission(const Scene& scene);

/// How uploadScene() stores textures.
struct TextureOptions
{
    /// The grid on which the scene is voxelized, at rest: levels that none of its triangles samples there are not
    /// stored. By default all levels are.
    std::optional<Grid> grid = std::nullopt;
    Coverage coverage = Coverage::Conservative; // on that grid
    std::function<void(double)> progress = {};  // is called while images are decoded, with the fraction that is done
};

/// Uploads scene through `device`, whose uploads take effect as vk/uploader.h says. attributes: false uploads only the
/// textures that alpha needs. emission_scale: by default the scene's own brightestEmission(). Scenes that are voxelized
/// into one octree need the same scale, the largest brightestEmission() of them all; emission beyond the scale is cut
/// off. Images that the scene leaves encoded are decoded here; one that does not decode becomes white
/// (GpuScene::warnings). Throws, before it decodes any, Error{Memory} when the device's budget does not suffice, and
/// Error{Input} for more than 2^32 - 1 of anything that has a 32-bit number.
GpuScene uploadScene(vk::Uploader& device, const Scene& scene, bool attributes,
                     std::optional<float> emission_scale = std::nullopt, const TextureOptions& textures = {});

/// A scene without triangles: only the tables that readColorTables() reads.
GpuScene uploadColorTables(vk::Uploader& device);

/// The table of the addresses of scene's buffers.
gpu::SceneView sceneView(const GpuScene& scene);

/// Declares that pass reads the tables of colours, which shaders/lib/attribute.glsl uses. Returns the address of the
/// scene's table of buffers.
gpu::ConstPtr<gpu::SceneView> readColorTables(vk::AnyPass& pass, const GpuScene& scene);

} // namespace zvo
