// SPDX-License-Identifier: MIT
// zvo-demo: the window.
#include "common/progress.h"
#include "common/run_program.h"
#include "common/signals.h"
#include "demo/app/app.h"
#include "demo/app/options.h"

#include <chrono>

int main(int argc, char** argv)
{
    const auto start = std::chrono::steady_clock::now();
    zvo::cli::nameProgram("zvo-demo");
    zvo::cli::installSignalHandlers();
    return zvo::cli::runProgram(
        [&]
        {
            if (const auto options = zvo::demo::parseCommandLine(argc, argv))
            {
                zvo::demo::App(*options, start).run();
            }
        });
}
