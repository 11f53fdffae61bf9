// SPDX-License-Identifier: MIT
#include "glsl/zvo_picture.h"

#include "core/trace/trace_passes.h"
#include "glsl/host_device.h"
#include "glsl/host_trees.h"
#include "support/trace_rays.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

namespace zvo::test
{
namespace
{

constexpr double kNear = 0.01; // for cameras with depth

struct PicturePush
{
    gpu::ConstPtr<gpu::TreeTable> tree;
    gpu::ConstPtr<HostFrame> frame;
    gpu::Ptr<HostPixel> pixels;
};

std::vector<HostPixel> hostPicture(const DeviceTree& tree, const char* kernel, const vk::Specialization& constants,
                                   const HostFrame& frame)
{
    const vk::BufferOf<gpu::TreeTable> table = tableOf(tree);
    const vk::BufferOf<HostFrame> frames = deviceOfHosts().makeBuffer<HostFrame>("frame", std::vector{frame});
    vk::BufferOf<HostPixel> pixels(deviceOfHosts().device(), "pixels",
                                   std::uint64_t{HostFrame::kWidth} * HostFrame::kHeight);
    deviceOfHosts().run(
        [&](vk::FrameGraph& graph)
        {
            vk::UntypedPass pass = graph.addPass(kernel, constants);
            readTree(pass, tree);
            const PicturePush push = {pass.read(table), pass.read(frames), pass.write(pixels)};
            pass.dispatch(pixels.count(), push);
        });
    return deviceOfHosts().download(pixels);
}

// A matrix with reversed depth for the camera of view: 1 at kNear, 0 at infinity.
glm::mat4 reversedDepth(const ViewCamera& view)
{
    glm::mat4 projection(0.0F);
    projection[0][0] = 1.0F;
    projection[1][1] = -1.0F;
    projection[2][3] = -1.0F;
    projection[3][2] = static_cast<float>(kNear);
    return projection * glm::mat4(glm::lookAt(view.position, view.position + view.forward, view.up));
}

// Compares the pixel's point with the ray in double precision and the cell's box.
void expectPosition(const HostPixel& pixel, const Grid& grid, const TraceCamera& camera, std::size_t i)
{
    const DeviceHit hit = *unpack(pixel.hit);
    const double edge = static_cast<double>(grid.voxel_size) * std::ldexp(1.0, 2 * int(grid.nodeLevels() - hit.level));
    const glm::dvec3 low = glm::dvec3(grid.origin) + edge * glm::dvec3(hit.cell);
    const glm::dvec2 n(2.0 * static_cast<double>(i % HostFrame::kWidth) + 1.0 - HostFrame::kWidth,
                       2.0 * static_cast<double>(i / HostFrame::kWidth) + 1.0 - HostFrame::kHeight);
    const glm::dvec3 offset = n.x * glm::dvec3(camera.rays.half_pixel_x) + n.y * glm::dvec3(camera.rays.half_pixel_y);
    const glm::dvec3 direction = glm::dvec3(camera.rays.forward) + (camera.orthographic ? glm::dvec3(0.0) : offset);
    const glm::dvec3 from = glm::dvec3(camera.rays.origin) + (camera.orthographic ? offset : glm::dvec3(0.0));
    const double unit = static_cast<double>(grid.voxel_size) * grid.rootResolution();
    const glm::dvec3 point = glm::dvec3(grid.origin) + unit * (from - 1.0 + static_cast<double>(hit.t) * direction);
    const double far = glm::length(from) + std::abs(static_cast<double>(hit.t)) * glm::length(direction);
    const double margin = 4e-7 * unit * (1.0 + far);
    const glm::dvec3 position(pixel.position);
    for (int axis = 0; axis < 3; ++axis)
    {
        ASSERT_GE(position[axis], low[axis] - 1e-6 * unit) << i;
        ASSERT_LE(position[axis], low[axis] + edge + 1e-6 * unit) << i;
        ASSERT_NEAR(position[axis], point[axis], margin) << i;
        ASSERT_NEAR(static_cast<double>(pixel.middle[axis]), low[axis] + 0.5 * edge, 1e-6 * unit) << i;
        ASSERT_EQ(pixel.face_normal[axis] != 0.0F,
                  hit.face == gpu::kFaceInside ? direction[axis] != 0.0 : int(hit.face) == axis)
            << i;
        if (int(hit.face) == axis)
        {
            const double face = low[axis] + (direction[axis] > 0.0 ? 0.0 : edge);
            ASSERT_NEAR(position[axis], face, 1e-7 * unit) << i;
            ASSERT_EQ(pixel.face_normal[axis], direction[axis] > 0.0 ? -1.0F : 1.0F) << i;
        }
    }
    ASSERT_NEAR(static_cast<double>(pixel.edge), edge, 1e-6 * edge) << i;
}

} // namespace

VoxelEmission::VoxelEmission(const DeviceTree& octree)
    : m_words(deviceOfHosts().download(octree.emission_words)), m_values(deviceOfHosts().download(octree.emission)),
      m_scale(octree.emission_scale)
{
}

glm::dvec3 VoxelEmission::of(std::uint32_t voxel) const
{
    if (m_words.empty() || (m_words.at(voxel / 32).x >> voxel % 32 & 1U) == 0)
    {
        return glm::dvec3(0.0);
    }
    const gpu::uvec2 word = m_words.at(voxel / 32);
    const gpu::uint value =
        m_values.at(word.y + static_cast<std::uint32_t>(std::popcount(word.x & ((1U << voxel % 32) - 1))));
    const glm::dvec3 mantissa(value & 511U, value >> 9 & 511U, value >> 18 & 511U);
    return static_cast<double>(m_scale) * std::ldexp(1.0, static_cast<int>(value >> 27) - 24) * mantissa;
}

ZvoPicture::ZvoPicture(const DeviceTree& tree, const ViewCamera& view, TraceOptions options)
    : m_tree(tree), m_view(view), m_camera(traceCamera(view, tree.grid, HostFrame::kHeight)),
      m_albedo(take(options, View::Albedo)), m_normals(take(options, View::Normal)),
      m_origins(take(options, View::Origin)), m_emission(tree)
{
    m_frame.camera = m_camera.rays;
    m_frame.orthographic = m_camera.orthographic ? 1 : 0;
    m_frame.view_projection = reversedDepth(view);
    m_frame.detail = detailOf(options, &m_camera);
}

void ZvoPicture::expectSame(const HostVariant& variant) const
{
    SCOPED_TRACE(variant.kernel);
    const vk::Specialization constants = variant.by_levels
                                             ? vk::Specialization{m_tree.grid.nodeLevels(), m_tree.entriesPerWord()}
                                             : vk::Specialization{};
    const std::vector<HostPixel> pixels = hostPicture(m_tree, variant.kernel, constants, m_frame);
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
        ASSERT_NO_FATAL_FAILURE(expectSamePixel(pixels[i], i));
    }
}

Picture ZvoPicture::take(TraceOptions options, View view) const
{
    options.view = view;
    return takePicture(deviceOfHosts(), m_tree, m_camera, HostFrame::kWidth, HostFrame::kHeight, options);
}

void ZvoPicture::expectSamePixel(const HostPixel& pixel, std::size_t i) const
{
    const gpu::Hit& hit = m_albedo.hits[i];
    ASSERT_EQ(pixel.hit.index == gpu::kHitMiss, hit.index == gpu::kHitMiss) << i;
    if (hit.index == gpu::kHitMiss)
    {
        return;
    }
    ASSERT_EQ(std::bit_cast<std::uint32_t>(pixel.hit.t), std::bit_cast<std::uint32_t>(hit.t)) << i;
    ASSERT_EQ(pixel.hit.where, hit.where) << i;
    if (m_tree.hasAttributes() || !m_tree.isDag())
    {
        ASSERT_EQ(pixel.hit.index, hit.index) << i;
    }
    ASSERT_EQ(pixel.albedo, m_albedo.image[i]) << i;
    ASSERT_EQ(pixel.normal, m_normals.image[i]) << i;
    const DeviceHit met = *unpack(hit);
    ASSERT_EQ(pixel.is_voxel != 0, met.level == m_tree.grid.nodeLevels()) << i;
    ASSERT_EQ(pixel.is_inside != 0, met.face == gpu::kFaceInside) << i;
    const bool is_gray = (m_origins.image[i] & 255U) == (m_origins.image[i] >> 16 & 255U);
    ASSERT_EQ(pixel.is_dynamic != 0, !is_gray) << i;
    const bool may_emit = m_tree.hasAttributes() && pixel.is_voxel != 0;
    const glm::dvec3 radiance = may_emit ? m_emission.of(hit.index) : glm::dvec3(0.0);
    for (int channel = 0; channel < 3; ++channel)
    {
        ASSERT_NEAR(static_cast<double>(pixel.emission[channel]), radiance[channel], 1e-4 * radiance[channel]) << i;
    }
    ASSERT_NO_FATAL_FAILURE(expectPosition(pixel, m_tree.grid, m_camera, i));
    const double distance = glm::dot(glm::dvec3(pixel.position) - m_view.position, m_view.forward);
    const double reach = glm::length(m_view.position) + distance; // single precision rounds these lengths
    if (distance > 1e-4 * reach)
    {
        const double depth = kNear / distance;
        ASSERT_NEAR(static_cast<double>(pixel.depth), depth, depth * 1e-6 * (4.0 + reach / distance)) << i;
    }
}

} // namespace zvo::test
