// SPDX-License-Identifier: MIT
// zvo-demo: the window.
#include "common/output.h"
#include "common/progress.h"
#include "common/run_program.h"
#include "common/signals.h"
#include "demo/app/app.h"
#include "demo/app/options.h"

#include <chrono>
#include <string>
#include <variant>

int main(int argc, char** argv)
{
    const auto start = std::chrono::steady_clock::now();
    zvo::cli::nameProgram("zvo-demo");
    zvo::cli::installSignalHandlers();
    return zvo::cli::runProgram(
        [&]
        {
            const auto command = zvo::demo::parseCommandLine(argc, argv);
            if (const auto* const text = std::get_if<std::string>(&command))
            {
                zvo::cli::Output("-", true).write(*text);
                return;
            }
            zvo::demo::App(std::get<zvo::demo::DemoOptions>(command), start).run();
        });
}
