// SPDX-License-Identifier: MIT
// Messages and exit codes of zvo-bench when something is wrong.
#include "bench/bench_run.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace zvo::test
{
namespace
{

const std::vector<WrongUse>& wrongUses()
{
    static const std::vector<WrongUse> uses = {
        {"NoCommand", 2, {}, {"command", "build, rays, dynamic", "balance, tune or report", "zvo-bench --help"}},
        {"UnknownCommand", 2, {"denoize"}, {"no command or option denoize"}},
        {"ResolutionTooHigh", 2, {"build", "cube.glb", "--resolutions", "64,262144"}, {"262144", "131072"}},
        {"TuningOfNothing", 2, {"rays", "cube.glb", "--tuning", "rows=3"}, {"--tuning rows=3", "block-lanes"}},
        {"TuningOfTune", 2, {"tune", "--tuning", "block-lanes=32"}, {"--tuning", "zvo-bench tune --help"}},
        {"TuneOfTwoScenes", 2, {"tune", "cube.glb", "again.glb"}, {"SCENE", "more than once", "zvo-bench tune --help"}},
        {"TuneOfTwoResolutions", 2, {"tune", "cube.glb", "--resolution", "8,16"}, {"8,16", "power of two"}},
        {"CameraOfBuild", 2, {"build", "cube.glb", "--camera", "close"}, {"--camera", "zvo-bench build --help"}},
        {"SizeOfRays", 2, {"rays", "cube.glb", "--size", "8x8"}, {"--size"}},
        {"UnknownKindOfRays", 2, {"rays", "cube.glb", "--kinds", "shadow,far"}, {"--kinds", "far", "bounces"}},
        {"EnvironmentOfRays", 2, {"rays", "cube.glb", "--environment", "sky.exr"}, {"--environment"}},
        {"StructureOfBuild", 2, {"build", "cube.glb", "--structure", "svdag"}, {"--structure"}},
        {"PassesOfBalance", 2, {"balance", "--passes"}, {"--passes"}},
        {"RunsOfDenoise", 2, {"denoise", "cube.glb", "--runs", "2"}, {"--runs"}},
        {"UpOfDynamic", 2, {"dynamic", "test.scene.json", "--up", "z"}, {"--up"}},
        {"TargetsOfBuild", 2, {"build", "cube.glb", "--targets", "targets.json"}, {"--targets"}},
        {"SceneFileOfBuild", 2, {"build", "test.scene.json"}, {"test.scene.json", "dynamic"}},
        {"SceneFileOfDenoise", 2, {"denoise", "test.scene.json"}, {"test.scene.json", "dynamic"}},
        {"DynamicWithoutScene", 2, {"dynamic"}, {"SCENE", "required", "zvo-bench dynamic --help"}},
        {"ReportWithoutFile", 2, {"report"}, {"FILE", "required"}},
        {"MissingFolder", 3, {"edit", "--scenes", "absent"}, {"absent", "folder"}},
        {"MissingFile", 3, {"path", "absent.glb"}, {"absent.glb"}},
        {"ReportOfAScene", 3, {"report", "cube.glb"}, {"cube.glb", "zvo.bench"}},
        {"ReportOfMissingFile", 3, {"report", "absent.json"}, {"absent.json"}},
        {"ReportExists", 4, {"build", "cube.glb", "--json", "cube.glb"}, {"cube.glb", "-f"}},
    };
    return uses;
}

class BenchError : public BenchRun, public testing::WithParamInterface<WrongUse>
{
};

INSTANTIATE_TEST_SUITE_P(Bench, BenchError, testing::ValuesIn(wrongUses()),
                         [](const auto& use) { return std::string(use.param.name); });

TEST_P(BenchError, IsOneLineAndAnExitCodeAndLeavesNothingBehind)
{
    m_dir.write("test.scene.json", std::string_view(R"({"objects": [{"file": "cube.glb"}]})"));
    const std::vector<std::string> before = filesIn(m_dir.path());
    expectError(GetParam().arguments, GetParam().exit_code, GetParam().words);
    EXPECT_EQ(filesIn(m_dir.path()), before);
}

} // namespace
} // namespace zvo::test
