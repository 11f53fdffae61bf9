// SPDX-License-Identifier: MIT
// The fragments of a scene, after docs/voxelization.md.
#pragma once

#include "core/scene/scene.h"
#include "oracle/coverage.h"
#include "oracle/texture.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace zvo::oracle
{

/// How many triangles were dropped, by reason; reasons that did not occur are absent.
using Dropped = std::map<std::string, std::uint64_t>;

/// One triangle's share of one voxel.
struct Fragment
{
    std::uint64_t code = 0;             // 64-bit Morton code of the voxel
    std::array<std::uint32_t, 3> color; // linear, fractions of 65535
};

/// Barycentric weights of a voxel: those of its column along the triangle's major axis. They add up to 65536.
std::array<std::uint32_t, 3> fragmentWeights(const Triangle& triangle, const glm::uvec3& voxel);

/// Rank in 0 .. 63 of a voxel in the 4x4x4 ordered dither.
std::uint32_t ditherRank(const glm::uvec3& voxel);

/// Whether a fragment of this alpha (a fraction of 65535) exists.
bool alphaPasses(const Material& material, std::uint32_t alpha, const glm::uvec3& voxel);

/// Walks the triangles of a scene's instances, numbered in order. The scene must outlive it.
class FragmentWalker
{
public:
    FragmentWalker(const Scene& scene, const Grid& grid, Coverage coverage);

    /// Number of triangles, once for each instance.
    [[nodiscard]] std::uint64_t triangleCount() const { return m_first_triangle.back(); }

    /// Calls sink for each existing fragment of the triangles first to last - 1, and counts dropped triangles. Thread
    /// safe.
    void walk(std::uint64_t first, std::uint64_t last, const std::function<void(const Fragment&)>& sink,
              Dropped& dropped) const;

private:
    void walkTriangle(const Instance& instance, const glm::uvec3& indices,
                      const std::function<void(const Fragment&)>& sink, Dropped& dropped) const;

    const Scene& m_scene;
    Grid m_grid;
    Coverage m_coverage;
    std::vector<std::uint64_t> m_first_triangle; // [instances + 1]
    std::map<std::uint32_t, MipChain> m_mips;    // by image; only of images that base colours use
};

/// Splits 0 .. count - 1 among threads: work(thread, first, last), with thread < threadCount().
std::uint32_t threadCount();
void forEachChunk(std::uint64_t count,
                  const std::function<void(std::uint32_t thread, std::uint64_t first, std::uint64_t last)>& work);

} // namespace zvo::oracle
