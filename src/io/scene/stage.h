// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/animation.h"
#include "core/scene/motion.h"
#include "core/scene/scene.h"
#include "io/scene/load_scene.h"
#include "io/scene/stage_file.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zvo
{

/// An object, or those parts of one, that move.
struct Mover
{
    std::string name;
    Scene scene;           // at rest, as its file has it; without cameras
    glm::dmat4 place{1.0}; // of the scene before the motion; affine
    Motion motion;
    bool deforms = false; // animations of the scene move or bend parts of it: placeAt() does not tell all
};

/// A scene in which something may move. Its time runs from 0 to seconds, where everything begins anew.
struct Stage
{
    Scene fixed; // all that never moves, in its place
    std::vector<Mover> movers;
    double seconds = 4.0; // above 0
    double frames_per_second = 30.0;
    std::optional<std::uint32_t> grid_depth;
    std::optional<Bounds> grid_bounds;
    std::optional<StageCamera> camera;
    MergeRule merge = MergeRule::Average;
    std::vector<std::filesystem::path> files; // that were read
    std::vector<std::string> warnings;        // what was left out while loading, one line each
};

struct StageOptions
{
    std::optional<std::filesystem::path> scenes_folder; // where else the files of objects may lie
    std::string scenes_folder_name = "scenes_folder";   // as whoever can choose it knows it, for messages
    LoadOptions load = {};                              // of a file that is no scene file
};

/// Loads a scene file and what it names, or any other file as stageOf does. The files of objects are looked for in the
/// scene file's folder, then in scenes_folder, and lie in one of them or below, after all links. Throws Error{Input},
/// one line: what is wrong with the scene file is named by its path in the JSON.
Stage loadStage(const std::filesystem::path& path, const StageOptions& options = {});

/// A stage of one scene: its animated instances are a mover, the others stand still, at rest. It lasts as long as the
/// longest animation. Where nothing is animated there are no movers.
Stage stageOf(Scene scene, const std::string& name);

/// The stage's time of a frame, from 0 to below seconds. Where a stage is a whole number of frames long, frames that
/// show the same have exactly the same time.
double frameTime(const Stage& stage, std::uint64_t frame);

/// seconds, from 0 on, as a time from 0 to below the stage's end.
double loopedTime(const Stage& stage, double seconds);

/// Where the mover's scene is at a time of the stage: comes before its instances' transforms. Affine; to be rounded
/// to single precision once, after the product with an instance's transform.
glm::dmat4 placeAt(const Mover& mover, double seconds);

/// The pose of the mover's scene at a time of the stage: its motion after its animations.
Pose moverPose(const Mover& mover, double seconds);

/// Everything at a time of the stage, as one scene: first what is fixed, then each mover in its pose, in order. What a
/// full rebuild voxelizes. Throws as posedScene().
Scene stageAt(const Stage& stage, double seconds);
Scene stageAt(Stage&& stage, double seconds);

/// A box around everything at all times; of a mover that deforms, at 64 times at least, and at every frame where there
/// are at most 256.
Bounds stageBounds(const Stage& stage);

} // namespace zvo
