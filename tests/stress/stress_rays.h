// SPDX-License-Identifier: MIT
// Rays that are difficult for a traversal.
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
    bool invalid = false; // must miss: a number is NaN or infinite, or an inverse direction too small
    bool far = false;     // so far away that many planes coincide by rounding
};

/// A ray of any direction, from inside the cube or around it, or towards it from up to 10^5 cubes away.
StressRay randomRay(Random& random);

/// A ray through a corner or an edge of a voxel: from anywhere, from other corners, from 10^5 voxels or 10^5 cubes
/// away; parallel to an axis or a plane, or almost; with zeros of both signs; with ties of two or three planes all
/// along; from inside of voxels; with very long or very short directions. One in sixteen has NaN, infinite or vanishing
/// numbers. resolution: of the root cube; codes: occupied voxels.
StressRay aimedRay(Random& random, std::uint32_t resolution, const test::Codes& codes);

/// A ray from a voxel's corner or centre, or anywhere between, in the whole voxels from low to high. Half of the rays
/// have directions with exact ties. resolution: of the root cube.
StressRay rayFromInside(Random& random, std::uint32_t resolution, const glm::vec3& low, const glm::vec3& high);

} // namespace zvo::stress
