// SPDX-License-Identifier: MIT
#include "io/scene/scene_file.h"

#include "io/file/json_cursor.h"
#include "io/scene/place.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

namespace zvo
{

namespace
{

constexpr std::size_t kObjectsMax = 4096;
constexpr double kSecondsMax = 1e6;
constexpr double kFramesPerSecondMax = 1e4;
constexpr double kDefaultFov = 45.0; // degrees
// Of half the angle; nearer to a half turn, rounding would decide the direction.
constexpr double kHalfTurnCosine = 1e-9;

double readSeconds(const JsonCursor& seconds)
{
    return seconds.positive(kSecondsMax);
}

double readTurnsPerSecond(const JsonCursor& orbit, double scene_seconds)
{
    const auto turns = orbit.find("turns");
    const auto degrees = orbit.find("degrees_per_second");
    if (turns.has_value() == degrees.has_value())
    {
        throw orbit.error(turns ? "has both turns and degrees_per_second; expected one of them"
                                : "has neither turns nor degrees_per_second; expected one of them");
    }
    return turns ? turns->number() / scene_seconds : degrees->number() / kDegreesOfTurn;
}

OrbitMotion readOrbit(const JsonCursor& orbit, const glm::dvec3& home, double scene_seconds)
{
    orbit.allowKeys({"centre", "axis", "turns", "degrees_per_second", "circles", "spins"});
    OrbitMotion motion;
    motion.center = orbit.valueOr("centre", &JsonCursor::vector, home);
    motion.axis = orbit.valueOr("axis", &JsonCursor::direction, motion.axis);
    motion.turns_per_second = readTurnsPerSecond(orbit, scene_seconds);
    motion.home = home;
    motion.circles = orbit.valueOr("circles", &JsonCursor::flag, true);
    motion.spins = orbit.valueOr("spins", &JsonCursor::flag, true);
    if (!motion.circles && !motion.spins)
    {
        throw orbit.error("neither circles nor spins; expected one of them to be true");
    }
    return motion;
}

LineMotion readLine(const JsonCursor& line, double scene_seconds)
{
    line.allowKeys({"from", "to", "seconds", "repeat"});
    const auto repeat = line.find("repeat");
    LineMotion motion;
    motion.from = line.at("from").vector();
    motion.to = line.at("to").vector();
    motion.seconds = line.valueOr("seconds", readSeconds, scene_seconds);
    motion.returns = repeat && repeat->oneOf({"loop", "ping-pong"}) == 1;
    return motion;
}

/// The elements of an array that has one for each key; none if it is missing.
std::vector<JsonCursor> readKeyed(const JsonCursor& keys, std::string_view name, std::size_t key_count)
{
    const auto array = keys.find(name);
    if (!array)
    {
        return {};
    }
    std::vector<JsonCursor> items = array->items();
    if (items.size() != key_count)
    {
        throw array->error(fmt::format("has {} items, but there are {} times", items.size(), key_count));
    }
    return items;
}

glm::dquat quaternionOf(const Rotation& rotation)
{
    const double half = std::numbers::pi * (rotation.turns - std::round(rotation.turns));
    return {std::cos(half), std::sin(half) * rotation.axis};
}

KeyMotion readKeys(const JsonCursor& keys, double scene_seconds)
{
    keys.allowKeys({"times", "translations", "rotations", "scales"});
    KeyMotion motion;
    for (const JsonCursor& time : keys.at("times").items())
    {
        const double seconds = time.number();
        const bool ascends = motion.times.empty() || seconds > motion.times.back();
        if (seconds < 0.0 || seconds > scene_seconds || !ascends)
        {
            throw time.mismatch(fmt::format("ascending times from 0 to the scene's length, {} seconds", scene_seconds));
        }
        motion.times.push_back(seconds);
    }
    if (motion.times.empty())
    {
        throw keys.at("times").error("is empty; expected a time at least");
    }
    for (const JsonCursor& translation : readKeyed(keys, "translations", motion.times.size()))
    {
        motion.translations.push_back(translation.vector());
    }
    for (const JsonCursor& rotation : readKeyed(keys, "rotations", motion.times.size()))
    {
        const glm::dquat turned = quaternionOf(readRotation(rotation));
        if (!motion.rotations.empty() && std::abs(glm::dot(motion.rotations.back(), turned)) < kHalfTurnCosine)
        {
            throw rotation.error("is half a turn from the key before it, either way around; expected a key between");
        }
        motion.rotations.push_back(turned);
    }
    for (const JsonCursor& scale : readKeyed(keys, "scales", motion.times.size()))
    {
        motion.scales.push_back(readScale(scale));
    }
    if (motion.translations.empty() && motion.rotations.empty() && motion.scales.empty())
    {
        throw keys.error("moves nothing; expected translations, rotations or scales");
    }
    return motion;
}

Motion readMotion(const JsonCursor& motion, const glm::dvec3& home, double scene_seconds)
{
    motion.allowKeys({"orbit", "line", "keys"});
    const auto orbit = motion.find("orbit");
    const auto line = motion.find("line");
    const auto keys = motion.find("keys");
    if (orbit.has_value() + line.has_value() + keys.has_value() != 1)
    {
        throw motion.error("is not one motion; expected one of orbit, line, keys");
    }
    if (orbit)
    {
        return readOrbit(*orbit, home, scene_seconds);
    }
    return line ? Motion(readLine(*line, scene_seconds)) : Motion(readKeys(*keys, scene_seconds));
}

std::optional<bool> readIsDynamic(const JsonCursor& object)
{
    const auto is_static = object.find("static");
    const auto is_dynamic = object.find("dynamic");
    if (is_static && is_dynamic)
    {
        throw is_dynamic->error("stands beside static; expected one of them");
    }
    if (!is_static && !is_dynamic)
    {
        return std::nullopt;
    }
    return is_static ? !is_static->flag() : is_dynamic->flag();
}

AnimationChoice readAnimation(const JsonCursor& animation)
{
    if (animation.isText())
    {
        return animation.text();
    }
    if (!animation.isNumber())
    {
        throw animation.mismatch("the name of an animation of the file, or its number, from 0 on");
    }
    return animation.whole(0, UINT32_MAX);
}

// How an object is merged: not as the others, or as what carves.
void readCarving(const JsonCursor& json, SceneFileObject& object)
{
    const auto merge = json.find("merge");
    const auto fill = json.find("fill");
    if (merge)
    {
        static_cast<void>(merge->oneOf({"carve"}));
        if (object.is_dynamic == false)
        {
            throw merge->error("carves by an object that is static; expected dynamic");
        }
        object.carves = true;
        object.is_dynamic = true;
        object.fill = Fill::Solid;
    }
    if (fill)
    {
        if (!object.carves)
        {
            throw fill->error("fills an object that does not carve; expected merge beside it");
        }
        object.fill = static_cast<Fill>(fill->oneOf({"none", "solid", "parity"}));
    }
}

SceneFileObject readObject(const JsonCursor& json, double scene_seconds)
{
    json.allowKeys({"name", "file", "static", "dynamic", "up", "place", "motion", "animation", "merge", "fill"});
    SceneFileObject object;
    object.where = json.where();
    object.file = json.at("file").text();
    object.name = json.valueOr("name", &JsonCursor::text, std::filesystem::path(object.file).stem().string());
    object.up = json.valueOr("up", readUpAxis, UpAxis::Y);
    const auto placed = json.valueOr("place", readPlace, Place());
    object.transform = placed.transform(object.up);
    object.is_dynamic = readIsDynamic(json);
    if (const auto motion = json.find("motion"))
    {
        if (object.is_dynamic == false)
        {
            throw motion->error("moves an object that is static; expected dynamic");
        }
        object.motion = readMotion(*motion, placed.translation, scene_seconds);
        object.is_dynamic = true;
    }
    if (const auto animation = json.find("animation"))
    {
        if (object.is_dynamic == false)
        {
            throw animation->error("plays in an object that is static; expected dynamic");
        }
        object.animation = readAnimation(*animation);
    }
    readCarving(json, object);
    return object;
}

glm::vec3 readCorner(const JsonCursor& corner)
{
    return glm::vec3(corner.vector());
}

void readGrid(const JsonCursor& grid, SceneFile& file)
{
    grid.allowKeys({"depth", "bounds"});
    if (const auto depth = grid.find("depth"))
    {
        file.grid_depth = depth->whole(1, Grid::kDepthMax);
    }
    if (const auto bounds = grid.find("bounds"))
    {
        bounds->allowKeys({"min", "max"});
        const Bounds box = {readCorner(bounds->at("min")), readCorner(bounds->at("max"))};
        if (box.empty() || box.min == box.max)
        {
            throw bounds->error("has no extent; expected a max that is nowhere below min, and not min itself");
        }
        file.grid_bounds = box;
    }
}

SceneFileCamera readCamera(const JsonCursor& camera)
{
    if (camera.isText())
    {
        return camera.text();
    }
    camera.allowKeys({"eye", "target", "fov"});
    const auto fov = camera.valueOr("fov", &JsonCursor::number, kDefaultFov);
    const glm::dvec3 eye = camera.at("eye").vector();
    const glm::dvec3 target = camera.at("target").vector();
    try
    {
        return ViewCamera::lookAt(eye, target, glm::radians(fov));
    }
    catch (const Error& failure)
    {
        throw camera.error(fmt::format("makes no picture: {}", failure.what()));
    }
}

} // namespace

SceneFile parseSceneFile(std::string_view content, const std::filesystem::path& path)
{
    const nlohmann::json document = parseJsonStrictly(content, path);
    const JsonCursor root(document, path);
    root.allowKeys({"about", "objects", "seconds", "frames_per_second", "grid", "camera", "merge"});
    SceneFile file;
    if (const auto about = root.find("about"))
    {
        static_cast<void>(about->text());
    }
    file.seconds = root.valueOr("seconds", readSeconds, file.seconds);
    if (const auto rate = root.find("frames_per_second"))
    {
        file.frames_per_second = rate->positive(kFramesPerSecondMax);
    }
    const JsonCursor objects = root.at("objects");
    for (const JsonCursor& object : objects.items())
    {
        file.objects.push_back(readObject(object, file.seconds));
    }
    if (file.objects.empty() || file.objects.size() > kObjectsMax)
    {
        throw objects.error(fmt::format("has {} objects; expected 1 to {}", file.objects.size(), kObjectsMax));
    }
    if (const auto grid = root.find("grid"))
    {
        readGrid(*grid, file);
    }
    file.camera = root.valueOr("camera", readCamera, file.camera);
    if (const auto merge = root.find("merge"))
    {
        constexpr std::array kRules = {MergeRule::Average, MergeRule::DynamicWins, MergeRule::StaticWins};
        file.merge = kRules.at(merge->oneOf({"average", "dynamic", "static"}));
    }
    return file;
}

} // namespace zvo
