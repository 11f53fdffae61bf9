// SPDX-License-Identifier: MIT
// zvo: the command line program. Standard output is data, standard error is talk.
#include "bench.h"
#include "build.h"
#include "common/output.h"
#include "common/progress.h"
#include "common/signals.h"
#include "convert.h"
#include "info.h"
#include "inspect.h"
#include "options.h"
#include "render.h"
#include "voxelize.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <exception>
#include <new>

namespace zvo::cli
{

namespace
{

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
