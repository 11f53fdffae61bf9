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

/// The camera at one time.
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
    /// keys: at least one, at ascending times from 0 on, each with a distance between eye and target and a field of
    /// view inside (0, 180). Throws Error{Usage} for others.
    explicit CameraPath(std::vector<CameraKey> keys);

    /// The camera at a time, with y up. Where eye and target meet on the way, it has the direction of the key before.
    [[nodiscard]] ViewCamera at(double seconds) const;

    /// The time of the last key.
    [[nodiscard]] double seconds() const { return m_keys.back().seconds; }

    [[nodiscard]] const std::vector<CameraKey>& keys() const { return m_keys; }

private:
    std::vector<CameraKey> m_keys;
};

/// Reads the path in a file. Throws Error{Input}, one line that begins with the file.
CameraPath readCameraPath(const std::filesystem::path& file);
CameraPath parseCameraPath(std::string_view text, const std::filesystem::path& file);

/// The text of a file with that path. Reading it gives the same keys, bit for bit.
std::string cameraPathText(const CameraPath& path);

} // namespace zvo
