// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/rig.h"
#include "zvo/types.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// A decoded picture: width * height * 4 bytes, rows from the top, RGBA with straight alpha, colour sRGB encoded.
struct Image
{
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;
};

/// An image and how coordinates outside of it are taken.
struct Texture
{
    std::uint32_t image = 0; // index into Scene::images
    WrapMode wrap_u = WrapMode::Repeat;
    WrapMode wrap_v = WrapMode::Repeat;
};

struct Material
{
    std::string name;
    glm::vec4 base_color{1.0F};                      // linear
    std::optional<std::uint32_t> base_color_texture; // index into Scene::textures
    glm::vec3 emission{0.0F};                        // linear radiance: factor times strength
    std::optional<std::uint32_t> emission_texture;   // multiplies emission
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5F; // AlphaMode::Mask
};

/// A triangle list with one material. All vertex arrays are either empty or as long as positions.
struct Primitive
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // unit length, or 0 where a vertex has none; empty: flat shading from the triangles
                                    // (of posed scenes, see DeformedVertices)
    std::vector<glm::vec2> uvs;     // texture coordinates, v = 0 at the top row
    std::vector<glm::vec4> colors;  // linear, multiplies the base colour
    std::vector<glm::uvec3> triangles; // vertex indices, all < positions.size()
    std::uint32_t material = 0;        // index into Scene::materials

    // What deforms it; at rest it stands as the arrays above say.
    std::vector<glm::u16vec4> joints; // indices into Skin::joints of each skin that an instance of it names
    std::vector<glm::vec4> weights;   // of joints: from 0 to 1, their sum is 1; as long as joints
    std::vector<MorphTarget> morph_targets;
};

/// One appearance of a primitive in the world.
struct Instance
{
    std::uint32_t primitive = 0; // index into Scene::primitives
    glm::mat4 transform{1.0F};   // object to world at rest, affine: the last row is (0, 0, 0, 1)
    std::uint32_t node = kNone;  // index into Scene::nodes: what the transform follows, and whose morph weights count
    std::uint32_t skin = kNone;  // index into Scene::skins; only where the primitive has joints
};

struct Camera
{
    std::string name;
    glm::mat4 transform{1.0F}; // camera to world: looks along -z, y up
    bool orthographic = false;
    float vertical_fov = 0.8F; // radians; perspective
    float half_height = 1.0F;  // world units; orthographic
};

/// Triangles with materials, placed in the world: what a glTF file comes down to.
struct Scene
{
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Material> materials; // at least one when there are primitives
    std::vector<Primitive> primitives;
    std::vector<Instance> instances;
    std::vector<Camera> cameras;
    std::vector<Node> nodes;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<std::string> warnings;      // what was left out while loading, one line each
    std::vector<std::string> rest_warnings; // what else is missing where the scene is used at rest, without a pose

    /// Triangles with instances counted each time.
    [[nodiscard]] std::uint64_t triangleCount() const;

    /// Box around all finite transformed vertices that a triangle uses, in the single precision that the voxelizer
    /// uses.
    [[nodiscard]] Bounds bounds() const;

    /// Adds everything of other, with indices shifted.
    void append(Scene&& other);
};

/// point through transform in the order of operations that the voxelizer uses:
/// ((m00 * x + m01 * y) + m02 * z) + m03 per component, each operation rounded to single precision.
glm::vec3 transformPoint(const glm::mat4& transform, const glm::vec3& point);

} // namespace zvo
