// SPDX-License-Identifier: MIT
// zvo: the command line program. Data goes to standard output, messages to standard error.
#include "common/signals.h"
#include "run_command_line.h"

int main(int argc, char** argv)
{
    zvo::cli::installSignalHandlers();
    return zvo::cli::runCommandLine(argc, argv);
}
