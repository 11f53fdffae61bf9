// SPDX-License-Identifier: MIT
#pragma once

#include "core/base/grid.h"
#include "core/scene/rig.h"
#include "zvo/types.h"

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// Frees what malloc() has allocated.
struct FreePixels
{
    void operator()(std::uint8_t* pixels) const { std::free(pixels); }
};

/// The bytes of a picture, as decoders leave them.
using Pixels = std::unique_ptr<std::uint8_t[], FreePixels>;

/// A picture: width * height * 4 bytes, rows from the top, RGBA with straight alpha, colour sRGB encoded.
struct Image
{
    std::string name;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;      // the bytes; empty where decode makes them
    std::function<Pixels()> decode = {}; // makes the bytes, anew in each call, in any thread; throws Error{Input}
};

/// An image, and how texture coordinates outside of it are treated.
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
    bool double_sided = true;  // whether a rasterizer shows back faces; voxels have no sides
};

/// A list of triangles, or of points, with one material. Each vertex array is either empty or as long as positions.
struct Primitive
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; // unit length, or 0 where a vertex has none; empty: flat shading from the triangles
                                    // (of posed scenes, see DeformedVertices)
    std::vector<glm::vec2> uvs;     // texture coordinates, v = 0 at the top row
    std::vector<glm::vec2> emission_uvs; // of the emission's texture; empty: uvs
    std::vector<glm::vec4> colors;       // linear, multiplies the base colour
    std::vector<glm::uvec3> triangles;   // vertex indices, all < positions.size()
    std::uint32_t material = 0;          // index into Scene::materials
    bool is_points = false; // each triangle is a point, three times the same vertex; a point has the voxel it lies in

    // What can deform the primitive. At rest its vertices are those above.
    std::vector<glm::u16vec4> joints; // indices into Skin::joints of any skin that an instance of the primitive names
    std::vector<glm::vec4> weights;   // [as joints] weights of the joints: from 0 to 1, their sum is 1
    std::vector<MorphTarget> morph_targets;
};

/// One occurrence of a primitive in the world.
struct Instance
{
    std::uint32_t primitive = 0; // index into Scene::primitives
    glm::mat4 transform{1.0F};   // object to world at rest, affine: the last row is (0, 0, 0, 1)
    std::uint32_t node = kNone;  // index into Scene::nodes: the instance moves with it and takes its morph weights
    std::uint32_t skin = kNone;  // index into Scene::skins; only where the primitive has joints
    glm::mat4 in_node{1.0F};     // object to the node's space, affine
    glm::ivec3 point_shift{0};   // of points, in half voxels along the grid's axes: -127 to 127
};

struct Camera
{
    std::string name;
    glm::mat4 transform{1.0F}; // camera to world; the camera looks along -z, with y up
    bool orthographic = false;
    float vertical_fov = 0.8F; // radians; perspective
    float half_height = 1.0F;  // world units; orthographic
};

/// Triangles with materials, placed in the world: the form into which all formats of files are brought.
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
    std::vector<std::string> warnings; // what was left out while loading, one line each

    /// Number of triangles; those of a primitive count once for each instance.
    [[nodiscard]] std::uint64_t triangleCount() const;

    /// The box around all transformed vertices that a triangle uses and that are finite, computed in single precision
    /// as in the voxelizer.
    [[nodiscard]] Bounds bounds() const;

    /// Appends everything in other, with its indices shifted.
    void append(Scene&& other);
};

/// Transforms a point with the voxelizer's order of operations, each rounded to single precision: every component is
/// ((m00 * x + m01 * y) + m02 * z) + m03.
glm::vec3 transformPoint(const glm::mat4& transform, const glm::vec3& point);

} // namespace zvo
