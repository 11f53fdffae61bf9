// SPDX-License-Identifier: MIT
#include "bench/bench_run.h"

#include "support/places.h"

#include <algorithm>
#include <array>
#include <utility>

namespace zvo::test
{

Outcome BenchRun::runAnyhow(std::vector<std::string> arguments) const
{
    constexpr std::array kWithoutDevice = {"report", "--help", "--version"};
    const bool measures =
        std::ranges::find_first_of(arguments, kWithoutDevice) == arguments.end() && !arguments.empty();
    std::vector<std::string> command = measures ? onTestDevice(std::move(arguments)) : std::move(arguments);
    command.insert(command.begin(), "zvo-bench");
    return ZvoProcess(placeOf(ZVO_BENCH_PROGRAM, "bin/zvo-bench"), m_dir.path(), std::move(command), {}).wait();
}

Outcome BenchRun::run(const std::vector<std::string>& arguments) const
{
    const Outcome outcome = runAnyhow(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find_first_of("\r\033"), std::string::npos) << "a progress bar on what is no terminal";
    return outcome;
}

json BenchRun::reportOf(std::vector<std::string> arguments) const
{
    arguments.insert(arguments.end(), {"--json", "-"});
    return json::parse(run(arguments).out);
}

void BenchRun::expectError(const std::vector<std::string>& arguments, int exit_code,
                           const std::vector<std::string>& words) const
{
    expectErrorLine(runAnyhow(arguments), exit_code, words, "zvo-bench");
}

} // namespace zvo::test
