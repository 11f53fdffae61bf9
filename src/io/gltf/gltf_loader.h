// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/scene.h"
#include "io/image/image_io.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace zvo
{

/// The triangles, materials and cameras of the default scene of a glTF 2.0 file (.gltf or .glb) at rest, in the pose of
/// its nodes, and the nodes, skins, morph targets and animations that move them (core/scene/animation.h applies them).
/// A mesh that several nodes show is stored once; only materials and images that a triangle uses are loaded. What is
/// left out is listed in Scene::warnings, what the scene lacks at rest in Scene::rest_warnings. Throws Error{Input},
/// one line with the path, for a file that is missing, broken or requires an unsupported extension. After: Khronos
/// Group, glTF 2.0 Specification, version 2.0.1, 2021.
Scene loadGltf(const std::filesystem::path& path);

/// The same for content in memory. Other files are looked for beside path.
Scene loadGltf(const std::filesystem::path& path, std::vector<std::uint8_t> content,
               ImageDecoding decoding = ImageDecoding::WhenLoaded);

} // namespace zvo
