// SPDX-License-Identifier: MIT
#pragma once

#include "common/scene_options.h"
#include "core/scene/scene.h"
#include "tree.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace zvo::python
{

/// A picture whose colours lie on a mesh: width * height pixels, rows from the top.
struct Picture
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::span<const std::uint8_t> rgba; // [4 * width * height] sRGB with straight alpha
};

/// The arrays of a mesh, or of points.
struct Mesh
{
    std::span<const glm::vec3> positions;  // [vertices]
    std::span<const glm::uvec3> triangles; // vertices; each is one of positions
    bool is_points = false;                // each vertex is a point; there are no triangles
    std::span<const glm::vec3> normals;    // [vertices] any length, or 0; or none
    std::span<const glm::vec4> colors;     // [vertices] linear; or none
    std::span<const glm::vec2> uvs;        // [vertices] v = 0 at the top row; or none
    Picture texture;                       // with uvs; or none
};

/// Makes the scene of a mesh, whose arrays are copied.
Scene sceneOf(const Mesh& mesh);

/// Voxelizes a scene on the device of that name. Tells of warnings. Throws Error.
std::unique_ptr<Tree> voxelize(const std::string& device, Scene scene, const cli::VoxelOptions& options);

/// Reads the files that options name, as one scene, and voxelizes it, or reads the tree that a file holds. Throws
/// Error.
std::unique_ptr<Tree> load(const std::string& device, const cli::VoxelOptions& options);

} // namespace zvo::python
