// SPDX-License-Identifier: MIT
// The contents of scene files (*.scene.json), whose schema is in docs/input.md. io/scene/animated_scene.h loads the
// files that they name.
#pragma once

#include "core/scene/animation.h"
#include "core/scene/camera.h"
#include "core/scene/motion.h"
#include "io/scene/load_scene.h"
#include "zvo/types.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace zvo
{

/// An object in a scene file.
struct SceneFileObject
{
    std::string where; // its path in the JSON, for messages: objects[1]
    std::string name;  // by default the file's, without its extension
    std::string file;  // as written
    UpAxis up = UpAxis::Y;
    glm::dmat4 transform{1.0}; // of the object's scene, whose up axis is y already; affine
    Motion motion;
    std::optional<AnimationChoice> animation; // the file's animation that plays; not given: the first
    std::optional<bool> is_dynamic;           // not given: dynamic if it moves, is animated or carves
    bool carves = false;
    Fill fill = Fill::None; // if it carves
};

/// The camera of a scene file: a camera of a static object by its name, "auto", "close", or numbers.
using SceneFileCamera = std::variant<std::string, ViewCamera>;

/// What a scene file says of the whole scene.
struct SceneSettings
{
    double seconds = 4.0; // until everything begins anew; above 0
    double frames_per_second = 30.0;
    std::optional<std::uint32_t> grid_depth;
    std::optional<Bounds> grid_bounds; // as Grid::withCorner takes them
    std::optional<SceneFileCamera> camera;
    MergeRule merge = MergeRule::Average;
};

struct SceneFile : SceneSettings
{
    std::vector<SceneFileObject> objects;
};

/// The content of a scene file; path is for messages. Throws Error{Input}: one line that names file, path in the JSON,
/// what is there and what is expected.
SceneFile parseSceneFile(std::string_view content, const std::filesystem::path& path);

} // namespace zvo
