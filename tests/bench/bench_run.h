// SPDX-License-Identifier: MIT
// Runs zvo-bench as a shell would.
#pragma once

#include "cli/cli_run.h"
#include "cli/run_zvo.h"

#include <string>
#include <vector>

namespace zvo::test
{

/// A folder with cube.glb, and the octree that the library makes of it at a resolution of 32.
class BenchRun : public CliRun
{
protected:
    /// Runs zvo-bench on the tests' device.
    [[nodiscard]] Outcome runAnyhow(std::vector<std::string> arguments) const;

    /// The same; expects success.
    Outcome run(const std::vector<std::string>& arguments) const;

    /// The report of a run that succeeds.
    [[nodiscard]] json reportOf(std::vector<std::string> arguments) const;

    /// Expects a usage or input error of one line.
    void expectError(const std::vector<std::string>& arguments, int exit_code,
                     const std::vector<std::string>& words) const;
};

} // namespace zvo::test
