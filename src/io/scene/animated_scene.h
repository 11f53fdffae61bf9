// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/animation.h"
#include "core/scene/motion.h"
#include "core/scene/scene.h"
#include "io/scene/load_scene.h"
#include "io/scene/scene_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// A moving object, or the moving parts of an object.
struct DynamicObject
{
    std::string name;
    std::shared_ptr<const Scene> scene; // at rest, as its file has it; without cameras. Objects of a file share it
    glm::dmat4 transform{1.0};          // of the scene before the motion; affine
    Motion motion;
    bool deforms = false; // animations of the scene move or bend parts of it, besides transformAt()
    bool carves = false;  // takes its voxels away; is no part of sceneAt() and boundsOverTime()
    Fill fill = Fill::None;
};

/// A scene in which objects may move. Its time runs from 0 to `seconds`; then everything begins anew.
struct AnimatedScene : SceneSettings
{
    Scene fixed; // everything that never moves, in world space
    std::vector<DynamicObject> objects;
    std::vector<std::filesystem::path> files; // that were read
    std::vector<std::string> warnings;        // what was left out while loading, one line each
};

struct AnimatedSceneOptions
{
    std::optional<std::filesystem::path> scenes_folder; // where else the files of objects may lie
    std::string scenes_folder_name = "scenes_folder";   // as whoever can choose it knows it, for messages
    LoadOptions load = {}; // of a file that is no scene file; of the files of objects all but `up` and `scale`
};

/// Loads a scene file and the files that it names, or any other file as animatedSceneOf() does. The files of objects
/// are looked for in the scene file's folder, then in scenes_folder; they must lie in one of these or below, after all
/// links. Throws Error{Input}, one line that names a wrong value in the scene file by its path in the JSON.
AnimatedScene loadAnimatedScene(const std::filesystem::path& path, const AnimatedSceneOptions& options = {});

/// Makes one scene an animated scene: its animated instances become a dynamic object, the others stand still, at rest.
/// It lasts as long as the longest animation. A scene without animation gives no dynamic objects.
AnimatedScene animatedSceneOf(Scene scene, const std::string& name);

/// The time of a frame in the animated scene: from 0 to below its `seconds`. If the scene is a whole number of frames
/// long, frames that show the same have exactly the same time.
double frameTime(const AnimatedScene& animated, std::uint64_t frame);

/// Maps any time from 0 on into the animated scene's period: from 0 to below its end.
double loopedTime(const AnimatedScene& animated, double seconds);

/// The transform of the dynamic object's scene at a time of the animated scene: comes before its instances' transforms.
/// Affine; to be rounded to single precision once, after the product with an instance's transform.
glm::dmat4 transformAt(const DynamicObject& object, double seconds);

/// The pose of the dynamic object's scene at a time of the animated scene: the object's motion, applied after its
/// animations.
Pose poseAt(const DynamicObject& object, double seconds);

/// The whole animated scene at a time as one scene: first the fixed part, then each dynamic object in its pose, in
/// order, but those that carve. This is what a full rebuild voxelizes. Throws as posedScene().
Scene sceneAt(const AnimatedScene& animated, double seconds);
Scene sceneAt(AnimatedScene&& animated, double seconds);

/// A box around everything at all times. A dynamic object that deforms is evaluated at 64 times at least, and at every
/// frame if there are at most 256 frames.
Bounds boundsOverTime(const AnimatedScene& animated);

} // namespace zvo
