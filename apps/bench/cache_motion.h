// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"
#include "common/progress.h"
#include "common/report.h"
#include "io/scene/animated_scene.h"
#include "vk/headless.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace zvo::cli
{

inline constexpr std::uint32_t kLightFrames = 256;  // of light before pictures, whether something moves or not
inline constexpr std::uint32_t kRunFrames = 60;     // the last of them, in which it moves
inline constexpr std::uint32_t kFlickerFrames = 32; // the last of them, in which flicker is measured
inline constexpr std::uint32_t kLingers = 16;       // the last of them, whose light may linger
inline constexpr double kNearChange = 0.05;         // of light, where what moves counts
inline constexpr double kCalmChange = 0.02;         // of light, where it does not

/// The mean relative error of a picture of one frame of the radiance cache: over all pixels, and where what moves
/// counts.
struct MotionError
{
    std::uint32_t frames = 0; // since what moves stands
    double all = 0;
    std::optional<double> near; // nothing where no pixel counts
    double flip = 0;
    std::optional<double> lag; // mean relative difference from the still picture, likewise; of itself, with other noise
};

/// A scene file's name, and what it holds.
struct MovingScene
{
    std::string name;
    AnimatedScene animated;
};

/// How the radiance cache follows what moves: at a place to which it came, beside one at which it always was.
struct MotionResult
{
    std::string scene;
    std::uint32_t resolution = 0;
    std::string light;
    double near_share = 0; // of the pixels: there the light is other with what moves than without
    double calm_share = 0; // of the pixels: there it is the same
    MotionError still;
    std::vector<MotionError> after;
    std::optional<double> flicker_still; // of calm pixels
    std::optional<double> flicker_moving;
};

/// Loads scene files. Throws Error{Input}, also where nothing moves.
std::vector<MovingScene> loadMovingScenes(const BenchCacheOptions& options,
                                          std::span<const std::filesystem::path> paths);

/// How many results measureMotion() gives, at most.
std::size_t motionCount(const BenchCacheOptions& options, std::span<const MovingScene> scenes);

/// Measures scenes by day, and at night if they have voxels that give off light. depth: where options have none. Throws
/// Error.
std::vector<MotionResult> measureMotion(vk::HeadlessDevice& device, const BenchCacheOptions& options,
                                        std::span<const MovingScene> scenes, std::uint32_t depth, Progress& progress);

/// What the results are, and tables of them.
std::string motionText(std::span<const MotionResult> results);

Json motionJson(std::span<const MotionResult> results);

} // namespace zvo::cli
