// SPDX-License-Identifier: MIT
// zvo-demo: the window.
#include "common/output.h"
#include "common/progress.h"
#include "common/signals.h"
#include "demo/app.h"
#include "demo/options.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <new>

namespace zvo::demo
{

namespace
{

int fail(ErrorCode code, std::string_view what)
{
    cli::talk(fmt::format("error: {}", what));
    return static_cast<int>(code);
}

int run(int argc, const char* const* argv)
{
    const auto start = std::chrono::steady_clock::now();
    try
    {
        const auto command = parseCommandLine(argc, argv);
        if (const auto* const text = std::get_if<std::string>(&command))
        {
            cli::Output("-", true).write(*text);
            return 0;
        }
        App(std::get<DemoOptions>(command), start).run();
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

} // namespace zvo::demo

int main(int argc, char** argv)
{
    zvo::cli::nameProgram("zvo-demo");
    zvo::cli::installSignalHandlers();
    return zvo::demo::run(argc, argv);
}
