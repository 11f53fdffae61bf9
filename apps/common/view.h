// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "io/scene/animated_scene.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::cli
{

/// Part of a scene's bounds that lies in grid, or all of grid where there is none: what a picture is about.
Bounds subjectOf(const Bounds& scene, const Grid& grid);

/// The camera that wanted names: "ex,ey,ez,tx,ty,tz[,fov]", a camera of scene, "auto", which fits subject into the
/// picture, or "close", which is less than half as far from its centre; empty: the scene's first camera, or as auto.
/// Throws Error{Usage} where there is no such camera.
ViewCamera chooseCamera(const std::string& wanted, const Scene& scene, const Bounds& subject, double aspect);

/// The same of an animated scene, whose own camera comes before the first one of what is fixed in it.
ViewCamera chooseCamera(const std::string& wanted, const AnimatedScene& animated, const Bounds& subject, double aspect);

/// A camera by eye, target and, if it is there, vertical field of view in degrees. Throws Error{Usage} where they are
/// not six or seven numbers, or make no camera.
ViewCamera cameraOfNumbers(const std::vector<float>& numbers);

/// The view of that name. Throws Error{Usage} that lists the names.
View viewOf(std::string_view option, std::string_view name);

/// All views with the names that viewOf() takes.
struct NamedView
{
    std::string_view name;
    View view;
};
std::span<const NamedView> allViews();

/// What --help says of --view.
std::string viewHelp();

} // namespace zvo::cli
