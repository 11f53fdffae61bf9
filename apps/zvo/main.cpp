// SPDX-License-Identifier: MIT
// zvo: the command line program. Standard output is data, standard error is talk.
#include "bench.h"
#include "build.h"
#include "convert.h"
#include "core/atomic_file.h"
#include "info.h"
#include "inspect.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "render.h"
#include "voxelize.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <csignal>
#include <exception>
#include <new>
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

struct Run
{
    void operator()(const std::string& text) const { Output("-", true).write(text); }
    void operator()(const RenderOptions& options) const { render(options); }
    void operator()(const VoxelizeOptions& options) const { voxelize(options); }
    void operator()(const BuildFileOptions& options) const { buildFile(options); }
    void operator()(const InspectOptions& options) const { inspect(options); }
    void operator()(const ValidateOptions& options) const { validate(options); }
    void operator()(const ConvertOptions& options) const { convert(options); }
    void operator()(const InfoOptions& options) const { info(options); }
    void operator()(const BenchOptions& options) const { bench(options); }
};

int fail(ErrorCode code, std::string_view what)
{
    talk(fmt::format("error: {}", what));
    return static_cast<int>(code);
}

int run(int argc, const char* const* argv)
{
    try
    {
        std::visit(Run{}, parseCommandLine(argc, argv));
        return 0;
    }
    catch (const Error& error)
    {
        return fail(error.code(), error.what());
    }
    catch (const std::bad_alloc&)
    {
        return fail(ErrorCode::Memory, "the host's memory does not suffice; lower the resolution");
    }
    catch (const std::exception& error)
    {
        return fail(ErrorCode::Other, error.what());
    }
}

} // namespace

} // namespace zvo::cli

int main(int argc, char** argv)
{
    zvo::cli::installSignalHandlers();
    return zvo::cli::run(argc, argv);
}
