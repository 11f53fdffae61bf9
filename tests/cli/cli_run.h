// SPDX-License-Identifier: MIT
#pragma once

#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "core/base/grid.h"
#include "core/base/kernels.h"
#include "core/scene/scene.h"
#include "core/tree/device_tree.h"
#include "core/upload/gpu_scene.h"
#include "io/gltf/gltf_loader.h"
#include "runtime/trees.h"
#include "support/device.h"
#include "support/temp_dir.h"
#include "vk/headless.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace zvo::test
{

/// A folder with cube.glb, and the octree that the library makes of it at a resolution of 32.
class CliRun : public testing::Test
{
protected:
    static constexpr std::uint32_t kDepth = 5;

    void SetUp() override
    {
        m_scene = loadGltf(m_dir.write("cube.glb", coloredCube().glb()));
        m_grid = Grid::around(m_scene.bounds(), kDepth);
    }

    // Runs zvo and expects success.
    Outcome run(const std::vector<std::string>& arguments)
    {
        const Outcome outcome = runZvo(m_dir.path(), arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err.find_first_of("\r\033"), std::string::npos) << "a progress bar on what is no terminal";
        return outcome;
    }

    BuildResult build(const Grid& grid)
    {
        return buildOctree(device(), uploadScene(device(), m_scene, true), grid, {});
    }

    static vk::HeadlessDevice& device() { return sharedDevice(zvoKernels()); }

    [[nodiscard]] std::string file(const std::string& name) const { return contentOf(m_dir.path() / name); }

    [[nodiscard]] std::vector<std::uint64_t> mortonFile(const std::string& name) const
    {
        const std::string bytes = file(name);
        std::vector<std::uint64_t> codes(bytes.size() / sizeof(std::uint64_t));
        std::memcpy(codes.data(), bytes.data(), codes.size() * sizeof(std::uint64_t));
        EXPECT_EQ(bytes.size() % sizeof(std::uint64_t), 0U);
        return codes;
    }

    TempDir m_dir;
    Scene m_scene;
    Grid m_grid;
};

/// The test fails for each field that value lacks: "path type", where [] stands for the first element of an array.
void expectFields(const json& value, const std::vector<std::string>& expected);

} // namespace zvo::test
