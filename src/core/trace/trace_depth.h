// SPDX-License-Identifier: MIT
// The depth of a picture in a host's own convention, so that the host can composite it with what it draws.
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
    float miss = 1.0F; // in [0, 1], the depth of rays that hit nothing: 0 where depth is reversed

    /// Takes the rows of a matrix that is multiplied with column vectors on its right.
    static ClipDepth of(const glm::dmat4& view_projection, float miss);
};

/// Records the passes that fill depth [width * height], rows from the top left, from buffers.hits, after tracePrimary()
/// with the same camera. The depth of a pixel is that of the point where its ray enters its voxel (or the node at which
/// a level of detail ends the ray), and clip.miss where the ray hits nothing. Points nearer than the near plane, as
/// when the camera is inside a voxel, get the near plane's depth, and points beyond the far plane the far plane's. So
/// all values lie in [0, 1].
///
/// A pass evaluates clip coordinates along each ray, with coefficients that the host has computed in double precision
/// from clip, grid and the camera's rays. If clip belongs to the same view, a value differs from the exact depth of the
/// traced point by at most 2^-19 far / (far - near); where depth is reversed and the far plane infinite, by at most
/// 2^-19 of itself. docs/image-targets.md tells how far the traced point itself is off.
///
/// Throws Error{Usage} when depth has fewer elements, when clip has numbers that are not finite, or when its miss lies
/// outside of [0, 1]; then nothing is recorded. Cost: one fill, and the pixels of live tiles.
void traceDepth(vk::FrameGraph& graph, const Grid& grid, const TraceCamera& camera, const ClipDepth& clip,
                const TraceBuffers& buffers, vk::BufferOf<float>& depth);

} // namespace zvo
