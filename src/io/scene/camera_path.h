// SPDX-License-Identifier: MIT
// Flights of a camera, as JSON files (docs/input.md):
//
//     {"schema": "zvo.camera_path/1", "keys": [
//         {"time": 0, "eye": [4, 2, 5], "target": [0, 1, 0], "fov": 60},
//         {"time": 2.5, "eye": [1, 2, 5], "target": [0, 1, 0]}]}
#pragma once

#include "core/scene/camera.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace zvo
{

/// Where the camera is at a time.
struct CameraKey
{
    double seconds = 0;
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    double fov_degrees = 45; // vertical

    bool operator==(const CameraKey&) const = default;
};

/// A flight past keys: eye, target and field of view each along a cubic curve through those of the keys, whose tangents
/// are those of the chords between neighbours (E. Catmull, R. Rom, A Class of Local Interpolating Splines, 1974, for
/// keys at any times). Before the first key and after the last one the camera stands still.
class CameraPath
{
public:
    /// At least one key, at times that go up, from 0 on, each with an eye and a target apart and a field of view inside
    /// (0, 180). Throws Error{Usage} for others.
    explicit CameraPath(std::vector<CameraKey> keys);

    /// The camera at a time, with y up; with the direction of the key before where eye and target meet on the way.
    [[nodiscard]] ViewCamera at(double seconds) const;

    /// Until the last key.
    [[nodiscard]] double seconds() const { return m_keys.back().seconds; }

    [[nodiscard]] const std::vector<CameraKey>& keys() const { return m_keys; }

private:
    std::vector<CameraKey> m_keys;
};

/// The path in a file. Throws Error{Input}, one line that begins with the file.
CameraPath readCameraPath(const std::filesystem::path& file);
CameraPath parseCameraPath(std::string_view text, const std::filesystem::path& file);

/// A file with that path: read again, it has the same keys, bit for bit.
std::string cameraPathText(const CameraPath& path);

} // namespace zvo
