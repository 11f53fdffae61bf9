// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace zvo
{

/// The most instances (a primitive with a transform) of a file; each is a draw on the device.
inline constexpr std::uint64_t kInstancesMax = std::uint64_t{1} << 24U;

/// Bytes that all the arrays of a scene, and all its pictures, may take: half of this machine's memory, as the other
/// half holds them once more on their way to the device.
std::uint64_t sceneBytesMax();

/// What a file comes down to. Floating point, as a file may announce any 64-bit number.
struct SceneSize
{
    double instance_count = 0;
    double triangle_count = 0;
    double vertex_count = 0; // of the largest primitive
    double bytes = 0;        // of all arrays
};

/// Throws Error{Input} for more than kInstancesMax instances, more triangles or vertices than 32-bit numbers count, or
/// arrays of more than sceneBytesMax().
void checkSceneSize(const std::filesystem::path& path, const SceneSize& size);

/// What is left of sceneBytesMax() while a file is read whose size shows only then.
class SceneBytesLeft
{
public:
    explicit SceneBytesLeft(const std::filesystem::path& path) : m_path(path) {}

    /// Counts bytes that are about to be held. Throws Error{Input} where they are too many.
    void take(std::uint64_t bytes);

private:
    const std::filesystem::path& m_path;
    std::uint64_t m_left = sceneBytesMax();
};

} // namespace zvo
