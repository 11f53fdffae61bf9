// SPDX-License-Identifier: MIT
// Rays that are hard on a traversal.
#pragma once

#include "oracle/trace.h"
#include "shared/trace.h"
#include "support/trace_octrees.h"

#include <cstdint>
#include <random>

namespace zvo::stress
{

using Random = std::mt19937_64;

struct StressRay
{
    oracle::Ray ray;
    float t_max = 0.0F;
    gpu::Ray device;
    bool invalid = false; // has to miss: a number is NaN or infinite, or an inverse direction too small
    bool far = false;     // so far away that many planes fall together
};

/// Rays from anywhere in anywhere's direction: inside the cube, around it, and from up to 10^5 cubes away towards it.
StressRay randomRay(Random& random);

/// Rays through corners and edges of voxels: from anywhere, from other corners, from 10^5 voxels and from 10^5 cubes
/// away, parallel to an axis or a plane, with zeros of both signs, with ties of two and three planes all along, almost
/// parallel to a plane, from inside of voxels, very long and very short directions; one in sixteen with NaN, infinite
/// or vanishing numbers. resolution: of the root cube; codes: occupied voxels.
StressRay aimedRay(Random& random, std::uint32_t resolution, const test::Codes& codes);

/// Rays from voxel corners and centres and from anywhere between, at whole voxels from low to high, half of them in
/// directions with exact ties. resolution: of the root cube.
StressRay rayFromInside(Random& random, std::uint32_t resolution, const glm::vec3& low, const glm::vec3& high);

} // namespace zvo::stress
