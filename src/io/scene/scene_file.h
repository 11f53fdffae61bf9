// SPDX-License-Identifier: MIT
// Scene files (*.scene.json) as they are written: docs/input.md has their schema. io/scene/animated_scene.h loads what
// they name.
#pragma once

#include "core/scene/animation.h"
#include "core/scene/camera.h"
#include "core/scene/motion.h"
#include "core/update/merge_rule.h"
#include "io/scene/load_scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace zvo
{

/// What a scene file says of one object.
struct SceneFileObject
{
    std::string where; // its path in the JSON, for messages: objects[1]
    std::string name;  // by default the file's, without its extension
    std::string file;  // as written
    UpAxis up = UpAxis::Y;
    glm::dmat4 transform{1.0}; // of the scene in the file, its up axis turned already; affine
    Motion motion;
    std::optional<AnimationChoice> animation; // of the file; not said: the first
    std::optional<bool> is_dynamic;           // not said: where it moves or is animated
};

/// A camera: one of the static objects' by its name, auto, close, or numbers.
using SceneFileCamera = std::variant<std::string, ViewCamera>;

struct SceneFile
{
    std::vector<SceneFileObject> objects;
    double seconds = 4.0; // until everything begins anew
    double frames_per_second = 30.0;
    std::optional<std::uint32_t> grid_depth;
    std::optional<Bounds> grid_bounds; // as Grid::withCorner takes them
    std::optional<SceneFileCamera> camera;
    MergeRule merge = MergeRule::Average;
};

/// The content of a scene file; path is for messages. Throws Error{Input}: one line that names file, path in the JSON,
/// what is there and what is expected.
SceneFile parseSceneFile(std::string_view content, const std::filesystem::path& path);

} // namespace zvo
