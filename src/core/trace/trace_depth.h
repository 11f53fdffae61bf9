// SPDX-License-Identifier: MIT
// The depth of a picture in a host's own convention, to composite it with what the host draws.
#pragma once

#include "core/trace/trace.h"

#include <glm/glm.hpp>

namespace zvo
{

/// How a host maps points of world space to depth: dot(z, p) / dot(w, p) for p = (x, y, z, 1).
struct ClipDepth
{
    glm::dvec4 z{0.0}; // rows of the matrix from world space to clip space, in Vulkan's convention: depth in [0, 1]
    glm::dvec4 w{0.0};
    float miss = 1.0F; // in [0, 1], for rays that hit nothing: the far end's depth, 0 where depth is reversed

    /// The rows of a matrix that column vectors are multiplied with from the right.
    static ClipDepth of(const glm::dmat4& view_projection, float miss);
};

/// Records the passes that make depth[width * height] of buffers.hits, rows from the top left, after tracePrimary()
/// with the same camera: for each pixel the depth of the point where its ray enters its voxel (or node, where a level
/// of detail ends the ray), clip.miss where it hits nothing. Points nearer than the near plane, as when the camera is
/// inside a voxel, have the depth of that plane, those beyond the far one its; so all values lie in [0, 1].
///
/// Clip coordinates are taken along each ray by numbers that are made in double precision of clip, grid and the
/// camera's rays as they were traced. Where clip belongs to the same view, a value differs from the exact depth of the
/// traced point by at most 2^-19 far / (far - near), of itself where depth is reversed and the far plane infinite; what
/// the point itself is off by: docs/image-targets.md.
///
/// Throws Error{Usage} when depth has fewer elements, or clip has numbers that are not finite or a miss outside of
/// [0, 1]; then nothing is recorded. Cost: one fill, and pixels of live tiles.
void traceDepth(vk::FrameGraph& graph, const Grid& grid, const TraceCamera& camera, const ClipDepth& clip,
                const TraceBuffers& buffers, vk::BufferOf<float>& depth);

} // namespace zvo
