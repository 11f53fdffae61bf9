// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace zvo
{

/// The most instances that a file may have. Each instance becomes a draw on the device.
inline constexpr std::uint64_t kInstancesMax = std::uint64_t{1} << 24U;

/// The bytes that all arrays and pictures of a scene may take: half of this machine's memory, because a second copy is
/// needed on the way to the device.
std::uint64_t sceneBytesMax();

/// The size of a file's scene. Floating point, as a file may announce any 64-bit number.
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

/// The rest of sceneBytesMax(), for files whose size becomes known only while they are read.
class SceneBytesLeft
{
public:
    explicit SceneBytesLeft(const std::filesystem::path& path) : m_path(path) {}

    /// Subtracts the bytes of something that is about to be allocated. Throws Error{Input} where too few are left.
    void take(std::uint64_t bytes);

private:
    const std::filesystem::path& m_path;
    std::uint64_t m_left = sceneBytesMax();
};

} // namespace zvo
