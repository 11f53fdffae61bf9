// SPDX-License-Identifier: MIT
#pragma once

#include "zvo/context.h"
#include "zvo/export.h"
#include "zvo/types.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace zvo
{

inline constexpr std::uint32_t kNoTexture = ZVO_NO_TEXTURE;

/// A picture: width * height * 4 bytes, rows from the top, RGBA with straight alpha, colour sRGB encoded.
struct TextureInfo
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::span<const std::uint8_t> rgba;
    WrapMode wrap_u = WrapMode::Repeat;
    WrapMode wrap_v = WrapMode::Repeat;
};

struct MaterialInfo
{
    Vec4 base_color = {1, 1, 1, 1}; // linear
    std::uint32_t base_color_texture = kNoTexture;
    Vec3 emission = {0, 0, 0}; // linear radiance
    std::uint32_t emission_texture = kNoTexture;
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5F; // AlphaMode::Mask
};

/// A list of triangles with one material.
struct MeshInfo
{
    std::span<const Vec3> positions;                         // [vertices]
    std::span<const Vec3> normals;                           // [vertices] unit length; or none: flat shading
    std::span<const Vec2> uvs;                               // [vertices] v = 0 at the top row; or none
    std::span<const Vec4> colors;                            // [vertices] linear, multiply the base colour; or none
    std::span<const std::array<std::uint32_t, 3>> triangles; // vertices
    std::uint32_t material = 0;
};

/// One occurrence of a mesh.
struct InstanceInfo
{
    std::uint32_t mesh = 0;
    Mat4 transform = kIdentity; // to the model's space
};

/// What a model is made of. Everything is copied: the arrays are not needed after the call.
struct ModelInfo
{
    std::span<const MeshInfo> meshes;
    std::span<const InstanceInfo> instances; // none: each mesh once, as it is
    std::span<const MaterialInfo> materials; // none: a white one
    std::span<const TextureInfo> textures;

    bool attributes = true; // false: only what alpha needs is uploaded, and its trees have no attributes
    /// The emission that is stored as the fraction 1. Models that are voxelized into one tree need the same scale;
    /// emission beyond it is cut off. None: the emission of the brightest material.
    std::optional<float> emission_scale = std::nullopt;
};

/// Triangles with materials in device memory: the source of trees, and what moves in dynamic trees. Copies of a Model
/// refer to the same data.
class ZVO_API Model
{
public:
    /// Records the upload. Until the frame is done, staging buffers take as much memory again. Throws Error{Usage} for
    /// indices and enumerations out of range, arrays of unequal length, transforms that are not finite and affine, and
    /// an emission scale that is negative or not finite; Error{Memory}; and Error{Input} for more than 2^32 - 1 of
    /// anything that has a 32-bit number. First and last stage: ALL_TRANSFER; zvo orders its own later uses.
    Model(Recorder& recorder, const ModelInfo& info);
    ~Model();
    Model(const Model&);
    Model& operator=(const Model&);

    /// Number of triangles; those of a mesh count once for each instance.
    [[nodiscard]] std::uint64_t triangleCount() const;

    /// The model's emission scale; 0: nothing emits light.
    [[nodiscard]] float emissionScale() const;

    /// The smallest grid around the model, centred on it.
    [[nodiscard]] GridInfo gridAround(std::uint32_t depth) const;

    struct Impl;
    [[nodiscard]] const std::shared_ptr<Impl>& impl() const { return m_impl; } // only for the library

private:
    std::shared_ptr<Impl> m_impl;
};

} // namespace zvo
