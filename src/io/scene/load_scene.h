// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/image/image_io.h"
#include "io/scene/scene_part.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace zvo
{

/// The axis that points up in a file. It becomes y, and the others turn with it, so that nothing is mirrored.
enum class UpAxis : std::uint32_t
{
    X,
    Y,
    Z,
    MinusX,
    MinusY,
    MinusZ
};

struct LoadOptions
{
    UpAxis up = UpAxis::Y;
    float scale = 1.0F;           // world units of a unit of the file, above 0
    bool every_animation = false; // keeps all animations of a file, for keepAnimation(); otherwise only the first one
    bool bind_pose = false;       // meshes as they were modelled (asModelled())
    bool keep_hulls = false;      // of toon shading (core/scene/hulls.h); otherwise they are left out, with a warning
    bool strict = false;          // refuses files that Scene::warnings would have a line about
    std::uint32_t point_size = 1; // edge of the cube of voxels that a point becomes, up to kPointSizeMax
    ImageDecoding images = ImageDecoding::WhenLoaded; // strict loading decodes them at once
    std::vector<std::string> skip_materials = {};     // patterns of names of materials to leave out (SkippedMaterials)
};

/// Loads several files as one scene, in the order of the paths: glTF 2.0, OBJ, PLY, STL and text with points, told
/// apart by their content where it is clear, otherwise by their extension. Warns of a pattern in skip_materials that no
/// material has. Throws Error{Input}, one line with the path, also for Scene::warnings of files with
/// LoadOptions::strict, and what applyLoadOptions() throws.
Scene loadScene(std::span<const std::filesystem::path> paths, const LoadOptions& options = {});

/// The same, for files that are loaded one by one: skipped takes the place of LoadOptions::skip_materials, and its
/// warnings are left to the caller.
Scene loadScene(std::span<const std::filesystem::path> paths, const LoadOptions& options, SkippedMaterials& skipped);

/// Whether a path names a scene file, NAME.scene.json (io/scene/scene_file.h). loadScene() refuses scene files.
bool isSceneFile(const std::filesystem::path& path);

/// The exact rotation that takes an axis to y.
glm::mat3 rotationToY(UpAxis up);

/// Turns and scales a scene with its cameras. Throws Error{Usage} if it becomes larger than single precision can hold.
void applyLoadOptions(Scene& scene, const LoadOptions& options);

} // namespace zvo
