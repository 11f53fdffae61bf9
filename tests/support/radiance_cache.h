// SPDX-License-Identifier: MIT
// The radiance cache, and pictures of it, on the device that the tests of a binary share.
#pragma once

#include "core/frame/frame_renderer.h"
#include "support/path_pictures.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace zvo::test
{

/// A face: its voxel's cell, and the number of its normal as in LightBrick::exposed.
struct FaceName
{
    glm::uvec3 cell{0U};
    std::uint32_t normal = 0;

    bool operator<(const FaceName& other) const
    {
        return std::tie(cell.z, cell.y, cell.x, normal) <
               std::tie(other.cell.z, other.cell.y, other.cell.x, other.normal);
    }
};

/// The light of a face.
struct FaceLight
{
    glm::dvec3 radiance{0.0}; // of a white face
    std::uint32_t samples = 0;
    glm::uvec2 words{0U}; // as the device has it
};

/// All faces of a table, or all bricks of a level, read without the code of the kernels. Cells are those of the level.
std::map<FaceName, FaceLight> facesOf(std::span<const gpu::CachedFace> table, std::uint32_t level = 0);
std::map<FaceName, FaceLight> facesOf(DeviceRadianceCache& cache, std::uint32_t level = 0);

/// Options of a picture by the radiance cache.
FrameOptions cachedOptions(const RadianceOptions& radiance = {}, CacheView kind = CacheView::Faces);

/// Runs frames of a tracer, which has a size.
void runFrames(FrameRenderer& tracer, const DeviceTree& tree, DeviceEnvironment& environment, const ViewCamera& view,
               std::uint32_t count, const RadianceOptions& options, CacheView kind = CacheView::Faces);

/// The mean of a tracer's picture. Expects that no ray was given up.
PathPicture pictureOf(FrameRenderer& tracer);

/// The mean of the last `frames` frames after `settle` frames, in a picture of edge * edge pixels.
PathPicture settledPicture(FrameRenderer& tracer, const DeviceTree& tree, DeviceEnvironment& environment,
                           const ViewCamera& view, std::uint32_t edge, std::uint32_t settle, std::uint32_t frames,
                           const RadianceOptions& options = {}, CacheView kind = CacheView::Faces);

} // namespace zvo::test
