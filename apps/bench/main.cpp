// SPDX-License-Identifier: MIT
// zvo-bench: the program that measures. Data goes to standard output, messages to standard error.
#include "bench/bench_balance.h"
#include "bench/bench_baselines.h"
#include "bench/bench_build.h"
#include "bench/bench_denoise.h"
#include "bench/bench_dynamic.h"
#include "bench/bench_edit.h"
#include "bench/bench_kept.h"
#include "bench/bench_options.h"
#include "bench/bench_path.h"
#include "bench/bench_rays.h"
#include "bench/bench_report.h"
#include "bench/bench_tune.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/run_program.h"
#include "common/signals.h"

#include <string>
#include <variant>

namespace zvo::cli
{

namespace
{

struct Run
{
    void operator()(const std::string& text) const { Output("-", true).write(text); }
    void operator()(const BenchBuildOptions& options) const { benchBuild(options); }
    void operator()(const BenchRaysOptions& options) const { benchRays(options); }
    void operator()(const BenchDynamicOptions& options) const { benchDynamic(options); }
    void operator()(const BenchEditOptions& options) const { benchEdit(options); }
    void operator()(const BenchPathOptions& options) const { benchPath(options); }
    void operator()(const BenchKeptOptions& options) const { benchKept(options); }
    void operator()(const BenchDenoiseOptions& options) const { benchDenoise(options); }
    void operator()(const BenchBaselinesOptions& options) const { benchBaselines(options); }
    void operator()(const BenchBalanceOptions& options) const { benchBalance(options); }
    void operator()(const BenchTuneOptions& options) const { benchTune(options); }
    void operator()(const BenchReportOptions& options) const { benchReport(options); }
};

} // namespace

} // namespace zvo::cli

int main(int argc, char** argv)
{
    zvo::cli::nameProgram("zvo-bench");
    zvo::cli::installSignalHandlers();
    return zvo::cli::runProgram([&] { std::visit(zvo::cli::Run{}, zvo::cli::parseBenchCommandLine(argc, argv)); });
}
