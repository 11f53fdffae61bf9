// SPDX-License-Identifier: MIT
#include "common/signals.h"

#include "common/progress.h"
#include "io/file/atomic_file.h"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace zvo::cli
{

namespace
{

enum class Watch : int
{
    None,
    Waiting,
    Interrupted,
};
std::atomic<Watch> g_watch = Watch::None;
std::atomic<bool> g_notices_all = false;
static_assert(std::atomic<bool>::is_always_lock_free &&
              std::atomic<Watch>::is_always_lock_free); // so that a signal handler may use it

// Removes half-written files and ends the process at once. Calls only functions that signal handlers may call.
void onSignal(int signal)
{
    constexpr int kSignalExit = 128; // plus the signal's number, as in shells
    Watch waiting = Watch::Waiting;
    if ((signal == SIGINT || g_notices_all) && g_watch.compare_exchange_strong(waiting, Watch::Interrupted))
    {
        return;
    }
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
        if (inherited.sa_handler != SIG_IGN) // ignored under nohup, for example
        {
            sigaction(signal, &action, nullptr);
        }
    }
    std::signal(SIGPIPE, SIG_IGN); // a closed pipe fails the write instead
    std::signal(SIGXFSZ, SIG_IGN); // a file above the size limit fails the write, too
}

InterruptWatch::InterruptWatch(Noticed noticed)
{
    g_notices_all = noticed == Noticed::All;
    g_watch = Watch::Waiting;
}

InterruptWatch::~InterruptWatch()
{
    g_watch = Watch::None;
}

bool InterruptWatch::interrupted() const
{
    return g_watch == Watch::Interrupted;
}

} // namespace zvo::cli
