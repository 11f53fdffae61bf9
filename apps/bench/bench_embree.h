// SPDX-License-Identifier: MIT
// Traces the same rays by Embree (Wald et al., Embree: A Kernel Framework for Efficient CPU Ray Tracing, 2014), for
// comparison.
#pragma once

#include "bench/primary_rays.h"
#include "core/base/grid.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace zvo::cli
{

/// What it took to trace rays once.
struct EmbreeRun
{
    double seconds = 0; // of the wall clock
    std::uint64_t hit_count = 0;
};

/// Embree's tree.
class EmbreeScene
{
public:
    /// Each voxel is a user primitive with an exact slab test. codes: Morton codes of the voxels. Throws Error{Memory}.
    static EmbreeScene ofVoxels(const Grid& grid, std::span<const std::uint64_t> codes);

    /// The scene's triangles, which are all opaque; each instance has its own copy of them. Throws Error{Memory}.
    static EmbreeScene ofTriangles(const Grid& grid, const Scene& scene);

    EmbreeScene(EmbreeScene&& other) noexcept;
    ~EmbreeScene();

    /// Traces rays once on all processors, width at a time: 1, 8 or 16. Neighbours in the list should be neighbours in
    /// the picture.
    EmbreeRun trace(std::span<const PrimaryRay> rays, unsigned width) const;

    /// 8 or 16, whichever is faster for these rays. Traces them four times.
    [[nodiscard]] unsigned fasterWidth(std::span<const PrimaryRay> rays) const;

private:
    struct Tree;
    explicit EmbreeScene(std::unique_ptr<Tree> tree);

    std::unique_ptr<Tree> m_tree;
};

struct EmbreeResult
{
    double mrays_per_s = 0;        // median of the runs, in packets of 8 or of 16 rays, whichever is faster
    double single_mrays_per_s = 0; // ray by ray, one run
    std::uint64_t hit_count = 0;   // rays that hit something
};

/// Traces rays run_count times after a warm-up.
EmbreeResult measureEmbree(const EmbreeScene& scene, std::span<const PrimaryRay> rays, std::uint32_t run_count);

} // namespace zvo::cli
