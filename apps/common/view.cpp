// SPDX-License-Identifier: MIT
#include "common/view.h"

#include "common/names.h"
#include "common/parse.h"
#include "common/words.h"
#include "core/scene/main_bounds.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr float kDefaultFov = 45.0F; // degrees
// Of the framing camera's distance: about two thirds of the rays hit a single object.
constexpr double kCloseDistance = 0.42;
constexpr double kOrthographicFill = 0.92; // of the picture

using Standard = ViewCamera (*)(const Bounds& subject, double aspect);

ViewCamera closeUp(const Bounds& subject, double aspect)
{
    ViewCamera camera = ViewCamera::framing(subject, aspect);
    const glm::dvec3 center = 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max));
    camera.position = center + kCloseDistance * (camera.position - center);
    return camera;
}

template <int x, int y, int z> ViewCamera along(const Bounds& subject, double aspect)
{
    return ViewCamera::framing(subject, aspect, {x, y, z});
}

// The front is at the lower edge of the picture.
ViewCamera top(const Bounds& subject, double aspect)
{
    ViewCamera camera = along<0, -1, 0>(subject, aspect);
    camera.right = {1.0, 0.0, 0.0};
    camera.up = {0.0, 0.0, -1.0};
    return camera;
}

// Parallel rays, along which the three axes are equally long in the picture.
ViewCamera isometric(const Bounds& subject, double aspect)
{
    const glm::dvec3 center = 0.5 * (glm::dvec3(subject.min) + glm::dvec3(subject.max));
    const glm::dvec3 half = 0.5 * (glm::dvec3(subject.max) - glm::dvec3(subject.min));
    ViewCamera camera = ViewCamera::lookAt(center + 2.0 * std::max(glm::length(half), 1e-30) * glm::dvec3(1.0), center,
                                           glm::radians(double{kDefaultFov}));
    const double half_width = glm::dot(glm::abs(camera.right), half);
    const double half_height = glm::dot(glm::abs(camera.up), half);
    camera.orthographic = true;
    camera.half_height = std::max({half_height, half_width / aspect, 1e-30}) / kOrthographicFill;
    return camera;
}

constexpr auto kStandardCameras = std::to_array<Named<Standard>>({
    {"auto", [](const Bounds& subject, double aspect) { return ViewCamera::framing(subject, aspect); }},
    {"close", closeUp},
    {"front", along<0, 0, -1>},
    {"back", along<0, 0, 1>},
    {"left", along<1, 0, 0>},
    {"right", along<-1, 0, 0>},
    {"top", top},
    {"iso", isometric},
});

Error noSuchCamera(const std::string& wanted, const Scene& scene)
{
    std::vector<std::string> names;
    for (const Named<Standard>& camera : kStandardCameras)
    {
        names.emplace_back(camera.name);
    }
    std::vector<std::string> own;
    for (const Camera& camera : scene.cameras)
    {
        names.push_back(camera.name);
        if (!camera.name.empty())
        {
            own.push_back(fmt::format("\"{}\"", camera.name));
        }
    }
    const std::string has = own.empty() ? "names no cameras" : fmt::format("has {}", fmt::join(own, ", "));
    return {ErrorCode::Usage, fmt::format("{}: there is no such camera{}; the scene {}; {} and six finite "
                                          "numbers ex,ey,ez,tx,ty,tz always work",
                                          wanted, suggestion(wanted, names), has, standardCameras())};
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

std::string standardCameras()
{
    return listOf(kStandardCameras);
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
    const auto* const standard = findNamed(kStandardCameras, wanted.empty() ? "auto" : wanted);
    if (standard != kStandardCameras.end())
    {
        return standard->value(subject, aspect);
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
