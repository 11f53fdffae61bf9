// SPDX-License-Identifier: MIT
// What the tests of the thesis and of Crassin and Green share.
#pragma once

#include "baseline/crassin_green_build.h"
#include "baseline/pointer_tree.h"
#include "baseline/thesis_build.h"
#include "baseline/thesis_voxelize.h"
#include "core/scene/camera.h"
#include "runtime/trees.h"
#include "vk/headless.h"
#include "zvo/types.h"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace zvo::test
{

/// The device that these tests share, with the kernels of zvo and of the baselines.
vk::HeadlessDevice& baselineDevice();

/// Cells of a box that a thread tests: few enough for software devices, also where kernels have the forms of GPUs.
/// Kernels that the validation layers instrument (ZVO_TEST_VALIDATION=2) have more loops, and would need 60.
inline constexpr std::uint32_t kCellsPerPart = 1300;

/// How the thesis makes an octree.
struct ThesisWay
{
    Coverage coverage = Coverage::Conservative;
    baseline::ThesisTarget target = baseline::ThesisTarget::Occupancy;
    baseline::TileNumbering numbering = baseline::TileNumbering::Scan;
    bool bounds = false; // visit the cells between the codes that occur alone
    std::uint32_t cells_per_part = kCellsPerPart;
};

/// The dense cells of a scene.
struct DenseCells
{
    baseline::ThesisCells cells;
    baseline::CodeRange range;
};
DenseCells cellsOf(const PosedGpuScene& scene, const Grid& grid, const ThesisWay& way);

/// The octree of a scene as the thesis makes it.
baseline::PointerOctree thesisOctree(const PosedGpuScene& scene, const Grid& grid, const ThesisWay& way);

/// The octree of a scene as Crassin and Green make it, of fragments that the thesis's walk finds.
baseline::PointerOctree crassinGreenOctree(const GpuScene& scene, const Grid& grid, Coverage coverage);

/// Expects that two ascending lists of Morton codes are equal.
void expectSameCodes(std::span<const std::uint64_t> codes, std::span<const std::uint64_t> expected);

/// Expects that the ray of every pixel hits the same voxel of each octree, at the same time and face, bit for bit, and
/// that some of them hit.
void expectSameHits(std::initializer_list<const baseline::PointerOctree*> octrees, const DeviceTree& expected,
                    const std::vector<ViewCamera>& cameras);

/// Cameras outside of a scene, inside, and an orthographic one.
std::vector<ViewCamera> fewCameras(const Bounds& bounds);

} // namespace zvo::test
