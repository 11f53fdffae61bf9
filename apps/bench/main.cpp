// SPDX-License-Identifier: MIT
// zvo-bench: the program that measures. Data goes to standard output, messages to standard error.
#include "bench/bench_options.h"
#include "common/progress.h"
#include "common/run_program.h"
#include "common/signals.h"

int main(int argc, char** argv)
{
    zvo::cli::nameProgram("zvo-bench");
    zvo::cli::installSignalHandlers();
    return zvo::cli::runProgram([&] { zvo::cli::runBenchCommandLine(argc, argv); });
}
