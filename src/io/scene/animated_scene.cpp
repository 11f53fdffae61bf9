// SPDX-License-Identifier: MIT
#include "io/scene/animated_scene.h"

#include "core/base/finite.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::size_t kSweepParts = 64;
constexpr double kSamplesMin = 64.0; // of an animation
constexpr double kSamplesMax = 256.0;
constexpr double kFrameCountTolerance = 1e-9; // relative
constexpr double kRoundingMargin = 1e-6;      // of the largest coordinate: a few units in the last place

/// The finite positions of a scene that triangles use.
class Points
{
public:
    explicit Points(const Scene& scene) : m_scene(scene), m_used(scene.primitives.size())
    {
        for (std::size_t i = 0; i < scene.primitives.size(); ++i)
        {
            const Primitive& primitive = scene.primitives[i];
            std::vector<bool> is_used(primitive.positions.size(), false);
            for (const glm::uvec3& triangle : primitive.triangles)
            {
                for (const std::uint32_t vertex : {triangle.x, triangle.y, triangle.z})
                {
                    if (!is_used[vertex])
                    {
                        is_used[vertex] = true;
                        m_used[i].push_back(primitive.positions[vertex]);
                    }
                }
            }
        }
    }

    template <typename See> void forEach(const glm::dmat4& to_world, const See& see) const
    {
        for (const Instance& instance : m_scene.instances)
        {
            const glm::mat4 transform(to_world * glm::dmat4(instance.transform));
            for (const glm::vec3& position : m_used[instance.primitive])
            {
                const glm::vec3 point = transformPoint(transform, position);
                if (isFinite(point))
                {
                    see(point);
                }
            }
        }
    }

private:
    const Scene& m_scene;
    std::vector<std::vector<glm::vec3>> m_used; // of each primitive
};

void extend(Bounds& bounds, const Bounds& other)
{
    bounds.min = glm::min(bounds.min, other.min);
    bounds.max = glm::max(bounds.max, other.max);
}

/// The bounds of a scene that moves only as a whole.
Bounds sweptBounds(const Scene& scene, const glm::dmat4& to_world, const Motion& motion, double seconds)
{
    const Points points(scene);
    const MotionSweep sweep = sweepOf(motion, seconds, kSweepParts);
    double distance = 0.0;
    points.forEach(to_world, [&](const glm::vec3& point)
                   { distance = std::max(distance, glm::length(glm::dvec3(point) - sweep.pivot)); });
    Bounds bounds;
    for (const glm::dmat4& moved : sweep.transforms)
    {
        points.forEach(moved * to_world, [&](const glm::vec3& point) { bounds.extend(point); });
    }
    if (bounds.empty())
    {
        return bounds;
    }
    const glm::vec3 reach = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
    const double largest = std::max({reach.x, reach.y, reach.z});
    const auto margin =
        static_cast<float>(sweep.stray + sweep.stray_per_distance * distance + kRoundingMargin * largest);
    return {bounds.min - margin, bounds.max + margin};
}

Bounds boundsOfObject(const DynamicObject& object, const AnimatedScene& animated)
{
    if (!object.deforms && std::holds_alternative<std::monostate>(object.motion))
    {
        return posedScene(*object.scene, poseAt(object, 0.0)).bounds();
    }
    if (!object.deforms)
    {
        return sweptBounds(posedScene(*object.scene, poseAt(*object.scene, 0.0)), object.transform, object.motion,
                           animated.seconds);
    }
    Bounds bounds;
    // Takes every frame, unless there are very many.
    const double count =
        std::clamp(std::round(animated.seconds * animated.frames_per_second), kSamplesMin, kSamplesMax);
    for (double sample = 0.0; sample < count; ++sample)
    {
        const double seconds = animated.seconds * sample / count;
        extend(bounds, posedScene(*object.scene, poseAt(object, seconds)).bounds());
    }
    return bounds;
}

Scene withObjects(Scene scene, const std::vector<DynamicObject>& objects, double seconds)
{
    for (const DynamicObject& object : objects)
    {
        if (!object.carves)
        {
            scene.append(posedScene(*object.scene, poseAt(object, seconds)));
        }
    }
    return scene;
}

} // namespace

double frameTime(const AnimatedScene& animated, std::uint64_t frame)
{
    const double frame_count = animated.seconds * animated.frames_per_second;
    const double whole = std::round(frame_count);
    if (whole >= 1.0 && std::abs(frame_count - whole) <= kFrameCountTolerance * whole)
    {
        return static_cast<double>(frame % static_cast<std::uint64_t>(whole)) / animated.frames_per_second;
    }
    return loopedTime(animated, static_cast<double>(frame) / animated.frames_per_second);
}

double loopedTime(const AnimatedScene& animated, double seconds)
{
    return std::fmod(seconds, animated.seconds);
}

glm::dmat4 transformAt(const DynamicObject& object, double seconds)
{
    return motionAt(object.motion, seconds) * object.transform;
}

Pose poseAt(const DynamicObject& object, double seconds)
{
    return poseAt(*object.scene, seconds, transformAt(object, seconds));
}

Scene sceneAt(const AnimatedScene& animated, double seconds)
{
    return withObjects(Scene(animated.fixed), animated.objects, seconds);
}

Scene sceneAt(AnimatedScene&& animated, double seconds)
{
    return withObjects(std::move(animated.fixed), animated.objects, seconds);
}

Bounds boundsOverTime(const AnimatedScene& animated)
{
    Bounds bounds = animated.fixed.bounds();
    for (const DynamicObject& object : animated.objects)
    {
        if (!object.carves)
        {
            extend(bounds, boundsOfObject(object, animated));
        }
    }
    return bounds;
}

} // namespace zvo
