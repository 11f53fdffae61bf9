// SPDX-License-Identifier: MIT
#include "common/signals.h"

#include "common/progress.h"
#include "io/file/atomic_file.h"

#include <csignal>
#include <unistd.h>

namespace zvo::cli
{

namespace
{

// Ends the process at once, without half-written files. Calls only what a signal handler may call.
void onSignal(int signal)
{
    constexpr int kSignalExit = 128; // plus the signal's number, as shells have it
    removePendingFiles();
    clearProgressBar();
    ::_exit(kSignalExit + signal);
}

} // namespace

void installSignalHandlers()
{
    struct sigaction action = {};
    action.sa_handler = onSignal;
    sigfillset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        struct sigaction inherited = {};
        sigaction(signal, nullptr, &inherited);
        if (inherited.sa_handler != SIG_IGN) // as under nohup
        {
            sigaction(signal, &action, nullptr);
        }
    }
    std::signal(SIGPIPE, SIG_IGN); // a closed pipe is an error of the write
    std::signal(SIGXFSZ, SIG_IGN); // and so is a file that grows too big
}

} // namespace zvo::cli
