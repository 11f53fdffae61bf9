// SPDX-License-Identifier: MIT
#pragma once

#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "io/scene/animated_scene.h"

#include <string>
#include <vector>

namespace zvo::cli
{

/// What a picture should show: the part of a scene's bounds that lies in grid, or all of grid where there is no such
/// part.
Bounds subjectOf(const Bounds& scene, const Grid& grid);

/// The same for a scene with the given bounds over its time, without far outliers (mainBounds()) where nothing moves.
Bounds subjectOf(const AnimatedScene& scene, const Bounds& bounds, const Grid& grid);

/// The camera that `wanted` names: "ex,ey,ez,tx,ty,tz[,fov]", the name of a camera of scene, or a name of
/// standardCameras(): "auto" fits subject into the picture, "close" is less than half as far from subject's centre;
/// "front", "back", "left", "right" and "top" fit it from +z, -z, -x, +x and +y, and "iso" without perspective from
/// (1, 1, 1). Empty: the scene's first camera, else as "auto". Throws Error{Usage} if there is no such camera.
ViewCamera chooseCamera(const std::string& wanted, const Scene& scene, const Bounds& subject, double aspect);

/// The same for an animated scene, whose own camera is preferred to the first camera of its fixed part.
ViewCamera chooseCamera(const std::string& wanted, const AnimatedScene& animated, const Bounds& subject, double aspect);

/// The names of cameras that every scene has: "auto, close, ...".
std::string standardCameras();

/// A camera from eye, target and, if given, vertical field of view in degrees. Throws Error{Usage} for anything but six
/// or seven numbers, and for numbers that make no camera.
ViewCamera cameraOfNumbers(const std::vector<float>& numbers);

/// The text of --help about --view.
std::string viewHelp();

} // namespace zvo::cli
