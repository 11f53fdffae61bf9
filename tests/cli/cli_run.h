// SPDX-License-Identifier: MIT
#pragma once

#include "cli/cli_folder.h"
#include "core/base/grid.h"
#include "core/base/kernels.h"
#include "core/scene/scene.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "vk/headless.h"

#include <cstdint>
#include <string>
#include <vector>

namespace zvo::test
{

/// A folder with cube.glb, and the octree that the library makes of it at a resolution of 32.
class CliRun : public CliFolder
{
protected:
    static constexpr std::uint32_t kDepth = 5;

    CliRun() : m_scene(loadGltf(m_dir.path() / "cube.glb")), m_grid(Grid::around(m_scene.bounds(), kDepth)) {}

    BuildResult build(const Grid& grid)
    {
        return buildOctree(device(), uploadScene(device(), m_scene, true), grid, {});
    }

    static vk::HeadlessDevice& device() { return sharedDevice(zvoKernels()); }

    Scene m_scene;
    Grid m_grid;
};

/// The test fails for each field that value lacks: "path type", where [] stands for the first element of an array.
void expectFields(const json& value, const std::vector<std::string>& expected);

} // namespace zvo::test
