// SPDX-License-Identifier: MIT
// What the tests of the API show, and the same pictures by the engine alone.
#pragma once

#include "core/base/kernels.h"
#include "core/scene/camera.h"
#include "core/trace/trace.h"
#include "core/upload/gpu_scene.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/embedding_host.h"
#include "support/host_model.h"
#include "support/materials_scene.h"
#include "support/scenes.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace zvo::test
{

inline constexpr float kExtent = 10.0F; // of the scene

inline const Scene& apiScene()
{
    static const Scene scene = materialsScene(kExtent, 40);
    return scene;
}

/// All of [-2, 14]^3.
inline GridInfo apiGrid(std::uint32_t depth = 6)
{
    return {{-2, -2, -2}, 16.0F / static_cast<float>(1U << depth), depth};
}

inline CameraInfo apiCamera()
{
    return CameraInfo::lookAt({22, 17, 25}, {5, 5, 5}, 0.6);
}

inline std::vector<std::uint32_t> pictureOf(vk::HeadlessDevice& device, const DeviceTree& tree, View view)
{
    NodePaths paths(device.device(), tree.isDag());
    TraceBuffers buffers(device.device(), EmbeddingHost::kWidth, EmbeddingHost::kHeight);
    const ViewCamera camera = ViewCamera::lookAt({22, 17, 25}, {5, 5, 5}, 0.6);
    TraceOptions options;
    options.view = view;
    device.run(
        [&](vk::FrameGraph& graph)
        {
            buildNodePaths(graph, tree, paths);
            trace(graph, tree, paths, traceCamera(camera, tree.grid, buffers.height), options, buffers);
        });
    return device.download(buffers.image);
}

/// The engine's own octree of the scene, on another device.
inline DeviceTree engineOctree(vk::HeadlessDevice& device, const Scene& scene, const GridInfo& info)
{
    const Grid grid = {{info.origin[0], info.origin[1], info.origin[2]}, info.voxel_size, info.depth};
    return buildOctree(device, uploadScene(device, scene, true), grid, {}).octree;
}

inline Mat4 movedBy(float x, float y, float z)
{
    Mat4 result = kIdentity;
    result[12] = x;
    result[13] = y;
    result[14] = z;
    return result;
}

} // namespace zvo::test
