// SPDX-License-Identifier: MIT
// Pictures by zvo's own kernels, to which those by a host's kernels are compared.
#pragma once

#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "core/tree/device_tree.h"
#include "support/pictures.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace zvo::test
{

/// The structs of tests/glsl/picture.glsl.
struct HostFrame
{
    static constexpr gpu::uint kWidth = 53;
    static constexpr gpu::uint kHeight = 41;

    gpu::CameraRays camera;
    gpu::uint orthographic = 0;
    gpu::uint width = kWidth;
    gpu::uint height = kHeight;
    glm::mat4 view_projection{1.0F};
    gpu::vec2 detail{0.0F};
};

struct HostPixel
{
    gpu::Hit hit;
    gpu::uint albedo;
    gpu::uint normal;
    gpu::vec3 emission;
    gpu::vec3 position;
    gpu::vec3 face_normal;
    gpu::vec3 middle;
    float edge;
    float depth;
    gpu::uint is_voxel;
    gpu::uint is_inside;
    gpu::uint is_dynamic;
};

/// Emission of voxels, read on the host.
class VoxelEmission
{
public:
    explicit VoxelEmission(const DeviceTree& octree);

    [[nodiscard]] glm::dvec3 of(std::uint32_t voxel) const;

private:
    std::vector<gpu::uvec2> m_words;
    std::vector<gpu::uint> m_values;
    float m_scale;
};

/// A kernel of a host.
struct HostVariant
{
    const char* kernel;
    bool by_levels = false; // specialized for the number of levels of one tree
};

/// The pictures of a tree by zvo's own kernels, to which the host's are compared.
class ZvoPicture
{
public:
    ZvoPicture(const DeviceTree& tree, const ViewCamera& view, TraceOptions options = {});

    [[nodiscard]] std::uint32_t hitCount() const { return test::hitCount(m_albedo); }

    /// Expects that the host's picture is the same at every pixel.
    void expectSame(const HostVariant& variant) const;

private:
    [[nodiscard]] Picture take(TraceOptions options, View view) const;
    void expectSamePixel(const HostPixel& pixel, std::size_t i) const;

    const DeviceTree& m_tree;
    ViewCamera m_view;
    TraceCamera m_camera;
    HostFrame m_frame;
    Picture m_albedo;
    Picture m_normals;
    Picture m_origins;
    VoxelEmission m_emission;
};

} // namespace zvo::test
