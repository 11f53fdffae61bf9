// SPDX-License-Identifier: MIT
#pragma once

#include "cli/cli_scene.h"
#include "cli/run_zvo.h"
#include "core/base/read_file.h"
#include "io/image/hdr_image_io.h"
#include "io/image/image_io.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace zvo::test
{

/// A folder with cube.glb, in which zvo runs.
class CliFolder : public testing::Test
{
protected:
    CliFolder() { m_dir.write("cube.glb", coloredCube().glb()); }

    /// Runs zvo. Expects success.
    Outcome run(const CommandLine& arguments) const
    {
        const Outcome outcome = runZvo(m_dir.path(), arguments);
        EXPECT_EQ(outcome.exit_code, 0) << testing::PrintToString(arguments) << ": " << outcome.err;
        EXPECT_EQ(outcome.err.find_first_of("\r\033"), std::string::npos) << "a progress bar on what is no terminal";
        return outcome;
    }

    /// What a run prints that succeeds.
    json printedBy(const CommandLine& arguments) const { return json::parse(run(arguments).out); }

    /// Expects that a run fails with exit_code and one line that has each of words.
    void expectError(const CommandLine& arguments, int exit_code, const std::vector<std::string>& words) const
    {
        SCOPED_TRACE(testing::PrintToString(arguments));
        expectErrorLine(runZvo(m_dir.path(), arguments), exit_code, words);
    }

    [[nodiscard]] std::string file(const std::string& name) const { return contentOf(m_dir.path() / name); }
    [[nodiscard]] json jsonFile(const std::string& name) const { return json::parse(file(name)); }

    /// The pixels of a picture.
    [[nodiscard]] Image pixels(const std::string& name) const
    {
        return decodeImage(readFile(m_dir.path() / name), name, name);
    }

    /// The texels of a picture of radiance, all of which are numbers.
    [[nodiscard]] std::vector<glm::vec3> radiance(const std::string& name) const
    {
        std::vector<std::string> warnings;
        const HdrImage image = decodeHdrImage(readFile(m_dir.path() / name), name, warnings);
        EXPECT_FALSE(!warnings.empty() && contains(warnings.front(), "no number")) << warnings.front();
        return image.texels;
    }

    /// The numbers in a .morton file.
    [[nodiscard]] std::vector<std::uint64_t> codes(const std::string& name) const
    {
        const std::string bytes = file(name);
        std::vector<std::uint64_t> codes(bytes.size() / sizeof(std::uint64_t));
        std::memcpy(codes.data(), bytes.data(), codes.size() * sizeof(std::uint64_t));
        EXPECT_EQ(bytes.size() % sizeof(std::uint64_t), 0U);
        return codes;
    }

    TempDir m_dir;
};

/// A grid of a report, as --grid takes it.
inline std::string gridText(const json& grid)
{
    return grid["origin"][0].dump() + "," + grid["origin"][1].dump() + "," + grid["origin"][2].dump() + "," +
           grid["voxel_size"].dump();
}

} // namespace zvo::test
