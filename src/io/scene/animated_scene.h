// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/animation.h"
#include "core/scene/motion.h"
#include "core/scene/scene.h"
#include "io/scene/load_scene.h"
#include "io/scene/scene_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// An object, or those parts of one, that move.
struct DynamicObject
{
    std::string name;
    Scene scene;               // at rest, as its file has it; without cameras
    glm::dmat4 transform{1.0}; // of the scene before the motion; affine
    Motion motion;
    bool deforms = false; // animations of the scene move or bend parts of it: transformAt() does not tell all
};

/// A scene in which something may move. Its time runs from 0 to seconds, where everything begins anew.
struct AnimatedScene
{
    Scene fixed; // all that never moves, in the world
    std::vector<DynamicObject> objects;
    double seconds = 4.0; // above 0
    double frames_per_second = 30.0;
    std::optional<std::uint32_t> grid_depth;
    std::optional<Bounds> grid_bounds;
    std::optional<SceneFileCamera> camera;
    MergeRule merge = MergeRule::Average;
    std::vector<std::filesystem::path> files; // that were read
    std::vector<std::string> warnings;        // what was left out while loading, one line each
};

struct AnimatedSceneOptions
{
    std::optional<std::filesystem::path> scenes_folder; // where else the files of objects may lie
    std::string scenes_folder_name = "scenes_folder";   // as whoever can choose it knows it, for messages
    LoadOptions load = {};                              // of a file that is no scene file
};

/// Loads a scene file and what it names, or any other file as animatedSceneOf does. The files of objects are looked for
/// in the scene file's folder, then in scenes_folder, and lie in one of them or below, after all links. Throws
/// Error{Input}, one line: what is wrong with the scene file is named by its path in the JSON.
AnimatedScene loadAnimatedScene(const std::filesystem::path& path, const AnimatedSceneOptions& options = {});

/// One scene as an animated scene: its animated instances are a dynamic object, the others stand still, at rest. It
/// lasts as long as the longest animation. Where nothing is animated there are no dynamic objects.
AnimatedScene animatedSceneOf(Scene scene, const std::string& name);

/// The animated scene's time of a frame, from 0 to below seconds. Where an animated scene is a whole number of frames
/// long, frames that show the same have exactly the same time.
double frameTime(const AnimatedScene& animated, std::uint64_t frame);

/// seconds, from 0 on, as a time from 0 to below the animated scene's end.
double loopedTime(const AnimatedScene& animated, double seconds);

/// The transform of the dynamic object's scene at a time of the animated scene: comes before its instances' transforms.
/// Affine; to be rounded to single precision once, after the product with an instance's transform.
glm::dmat4 transformAt(const DynamicObject& object, double seconds);

/// The pose of the dynamic object's scene at a time of the animated scene: its motion after its animations.
Pose poseAt(const DynamicObject& object, double seconds);

/// Everything at a time of the animated scene, as one scene: first what is fixed, then each dynamic object in its pose,
/// in order. What a full rebuild voxelizes. Throws as posedScene().
Scene sceneAt(const AnimatedScene& animated, double seconds);
Scene sceneAt(AnimatedScene&& animated, double seconds);

/// A box around everything at all times; of a dynamic object that deforms, at 64 times at least, and at every frame
/// where there are at most 256.
Bounds boundsOverTime(const AnimatedScene& animated);

} // namespace zvo
