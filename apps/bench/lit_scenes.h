// SPDX-License-Identifier: MIT
#pragma once

#include "bench/bench_options.h"
#include "core/light/environment.h"
#include "core/scene/camera.h"
#include "core/tree/device_tree.h"
#include "vk/headless.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::cli
{

/// A tree, seen from one place, by one light.
struct LitScene
{
    std::string name;
    const DeviceTree& tree;
    ViewCamera view;
    std::string_view light_name; // "day" or "night"
    DeviceEnvironment& light;
};

/// The light of a scene of that name by day, a sun and the simple sky, or at night, none from outside.
DeviceEnvironment lightFor(vk::HeadlessDevice& device, std::string_view scene, bool by_day);

/// Builds the scenes of a benchmark at each depth, and calls visit for each of them by day,
/// and at night, if it has voxels that give off light. Where options name no camera, Sponza is seen from inside.
/// depths: where options have none. Throws Error.
void forEachLitScene(vk::HeadlessDevice& device, const LitBenchOptions& options,
                     const std::vector<std::uint32_t>& depths, double aspect,
                     const std::function<void(LitScene&)>& visit);

/// How often that calls visit, at most.
std::size_t litSceneCount(const LitBenchOptions& options, const std::vector<std::uint32_t>& depths);

} // namespace zvo::cli
