// SPDX-License-Identifier: MIT
#include "common/view.h"

#include "common/names.h"
#include "common/parse.h"
#include "core/scene/main_bounds.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr float kDefaultFov = 45.0F; // degrees
// Of the framing camera's distance: about two thirds of the rays hit a single object.
constexpr double kCloseDistance = 0.42;

Error noSuchCamera(const std::string& wanted, const Scene& scene)
{
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras)
    {
        names.push_back(fmt::format("\"{}\"", camera.name));
    }
    const std::string has = names.empty() ? "has no cameras" : fmt::format("has {}", fmt::join(names, ", "));
    return {ErrorCode::Usage, fmt::format("--camera {}: there is no such camera; the scene {}; auto, close and six "
                                          "finite numbers ex,ey,ez,tx,ty,tz always work",
                                          wanted, has)};
}

} // namespace

ViewCamera cameraOfNumbers(const std::vector<float>& v)
{
    if (v.size() != 6 && v.size() != 7)
    {
        throw Error(ErrorCode::Usage, fmt::format("--camera: expected ex,ey,ez,tx,ty,tz or ex,ey,ez,tx,ty,tz,fov, but "
                                                  "there are {} numbers",
                                                  v.size()));
    }
    const float fov = v.size() == 7 ? v[6] : kDefaultFov;
    return ViewCamera::lookAt({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, glm::radians(double{fov}));
}

std::string viewHelp()
{
    std::string names;
    for (const Named<View>& named : kViews)
    {
        const char* const before = &named == &kViews.back() ? " or " : names.empty() ? "" : ", ";
        names += fmt::format("{}{}{}", before, named.name, named.value == View::Level ? " (of --detail)" : "");
    }
    return names + " (default color)";
}

Bounds subjectOf(const Bounds& scene, const Grid& grid)
{
    const float edge = grid.voxel_size * static_cast<float>(grid.resolution());
    const Bounds cube = {grid.origin, grid.origin + edge};
    const Bounds common = {glm::max(cube.min, scene.min), glm::min(cube.max, scene.max)};
    return common.empty() ? cube : common;
}

Bounds subjectOf(const AnimatedScene& scene, const Bounds& bounds, const Grid& grid)
{
    return subjectOf(scene.objects.empty() ? mainBounds(scene.fixed) : bounds, grid);
}

ViewCamera chooseCamera(const std::string& wanted, const Scene& scene, const Bounds& subject, double aspect)
{
    const auto named = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                    [&](const Camera& camera) { return wanted.empty() || camera.name == wanted; });
    if (named != scene.cameras.end())
    {
        return ViewCamera::of(*named);
    }
    if (wanted.empty() || wanted == "auto")
    {
        return ViewCamera::framing(subject, aspect);
    }
    if (wanted == "close")
    {
        ViewCamera camera = ViewCamera::framing(subject, aspect);
        const glm::dvec3 center = 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max));
        camera.position = center + kCloseDistance * (camera.position - center);
        return camera;
    }
    if (const auto numbers = tryParseFloats(wanted))
    {
        return cameraOfNumbers(*numbers);
    }
    throw noSuchCamera(wanted, scene);
}

ViewCamera chooseCamera(const std::string& wanted, const AnimatedScene& animated, const Bounds& subject, double aspect)
{
    if (!wanted.empty() || !animated.camera)
    {
        return chooseCamera(wanted, animated.fixed, subject, aspect);
    }
    const auto* const view = std::get_if<ViewCamera>(&*animated.camera);
    return view != nullptr ? *view
                           : chooseCamera(std::get<std::string>(*animated.camera), animated.fixed, subject, aspect);
}
} // namespace zvo::cli
