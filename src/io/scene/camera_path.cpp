// SPDX-License-Identifier: MIT
#include "io/scene/camera_path.h"

#include "core/base/read_file.h"
#include "io/file/json_cursor.h"
#include "zvo/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace zvo
{

namespace
{

constexpr const char* kSchema = "zvo.camera_path/1";
constexpr double kPathSecondsMax = 1e6;
constexpr double kFovMax = 180; // degrees, not reached

// The reason why keys make no path, or nothing if they do.
std::optional<std::string> faultOf(const std::vector<CameraKey>& keys)
{
    if (keys.empty())
    {
        return "a camera path needs a key";
    }
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
        const CameraKey& key = keys[i];
        if (!(key.seconds >= 0 && key.seconds <= kPathSecondsMax) || (i != 0 && !(key.seconds > keys[i - 1].seconds)))
        {
            return fmt::format("the times of a camera path's keys must go up, from 0 to {} seconds", kPathSecondsMax);
        }
        if (!(key.fov_degrees > 0 && key.fov_degrees < kFovMax))
        {
            return "the camera's field of view must be more than 0 and less than 180 degrees";
        }
        const double distance = glm::length(key.target - key.eye);
        if (!(distance > 0) || !std::isfinite(distance))
        {
            return "the camera's eye and target must be two different points";
        }
    }
    return std::nullopt;
}

// Function that returns the interpolated value of a key.
template <typename Value> using ValueOf = Value (*)(const CameraKey&);

// The tangent at key i: the slope between its neighbours, or between it and its only neighbour at an end.
template <typename Value> Value tangentAt(const std::vector<CameraKey>& keys, std::size_t i, ValueOf<Value> valueOf)
{
    const std::size_t before = i == 0 ? i : i - 1;
    const std::size_t after = std::min(i + 1, keys.size() - 1);
    return (valueOf(keys[after]) - valueOf(keys[before])) / (keys[after].seconds - keys[before].seconds);
}

// The value between key i (t = 0) and the next one (t = 1).
template <typename Value>
Value between(const std::vector<CameraKey>& keys, std::size_t i, double t, ValueOf<Value> valueOf)
{
    const double seconds = keys[i + 1].seconds - keys[i].seconds;
    const Value leaving = seconds * tangentAt(keys, i, valueOf);
    const Value arriving = seconds * tangentAt(keys, i + 1, valueOf);
    const double u = 1 - t;
    return (1 + 2 * t) * u * u * valueOf(keys[i]) + t * u * u * leaving + t * t * (3 - 2 * t) * valueOf(keys[i + 1]) -
           t * t * u * arriving;
}

ViewCamera cameraOf(const CameraKey& key)
{
    return ViewCamera::lookAt(key.eye, key.target, glm::radians(key.fov_degrees));
}

} // namespace

CameraPath::CameraPath(std::vector<CameraKey> keys) : m_keys(std::move(keys))
{
    if (const std::optional<std::string> fault = faultOf(m_keys))
    {
        throw Error(ErrorCode::Usage, *fault);
    }
}

ViewCamera CameraPath::at(double seconds) const
{
    const auto after = std::ranges::upper_bound(m_keys, seconds, {}, &CameraKey::seconds);
    if (after == m_keys.begin() || !(seconds < m_keys.back().seconds))
    {
        return cameraOf(after == m_keys.begin() ? m_keys.front() : m_keys.back());
    }
    const auto i = static_cast<std::size_t>(after - m_keys.begin()) - 1;
    const double t = (seconds - m_keys[i].seconds) / (m_keys[i + 1].seconds - m_keys[i].seconds);
    CameraKey key;
    key.eye = between<glm::dvec3>(m_keys, i, t, [](const CameraKey& k) { return k.eye; });
    key.target = between<glm::dvec3>(m_keys, i, t, [](const CameraKey& k) { return k.target; });
    key.fov_degrees = between<double>(m_keys, i, t, [](const CameraKey& k) { return k.fov_degrees; });
    // Curves may overshoot the keys' values.
    const auto [low, high] = std::minmax(m_keys[i].fov_degrees, m_keys[i + 1].fov_degrees);
    key.fov_degrees = std::clamp(key.fov_degrees, low, high);
    if (key.eye == key.target)
    {
        key.target = key.eye + m_keys[i].target - m_keys[i].eye;
    }
    return cameraOf(key);
}

CameraPath parseCameraPath(std::string_view text, const std::filesystem::path& file)
{
    const nlohmann::json document = parseJsonStrictly(text, file);
    const JsonCursor path(document, file);
    path.allowKeys({"schema", "keys"});
    static_cast<void>(path.at("schema").oneOf({kSchema}));
    const JsonCursor list = path.at("keys");
    std::vector<CameraKey> keys;
    for (const JsonCursor& item : list.items())
    {
        item.allowKeys({"time", "eye", "target", "fov"});
        CameraKey& key = keys.emplace_back();
        key.seconds = item.at("time").number();
        key.eye = item.at("eye").vector();
        key.target = item.at("target").vector();
        const auto readFov = [](const JsonCursor& fov) { return fov.positive(kFovMax); };
        key.fov_degrees = item.valueOr("fov", readFov, key.fov_degrees);
    }
    if (const std::optional<std::string> fault = faultOf(keys))
    {
        throw list.error(*fault);
    }
    return CameraPath(std::move(keys));
}

CameraPath readCameraPath(const std::filesystem::path& file)
{
    const std::vector<std::uint8_t> bytes = readFile(file);
    return parseCameraPath(asText(bytes), file);
}

std::string cameraPathText(const CameraPath& path)
{
    std::string text = fmt::format("{{\"schema\": \"{}\", \"keys\": [", kSchema);
    for (const CameraKey& key : path.keys())
    {
        text += fmt::format("{}\n{{\"time\": {}, \"eye\": [{}, {}, {}], \"target\": [{}, {}, {}], \"fov\": {}}}",
                            &key == path.keys().data() ? "" : ",", key.seconds, key.eye.x, key.eye.y, key.eye.z,
                            key.target.x, key.target.y, key.target.z, key.fov_degrees);
    }
    return text + "\n]}\n";
}

} // namespace zvo
