// SPDX-License-Identifier: MIT
#include "run_command_line.h"

#include "build.h"
#include "common/output.h"
#include "common/run_program.h"
#include "convert.h"
#include "info.h"
#include "inspect.h"
#include "options.h"
#include "render.h"
#include "voxelize.h"

#include <string>
#include <variant>

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
};

} // namespace

int runCommandLine(int argc, const char* const* argv)
{
    return runProgram([&] { std::visit(Run{}, parseCommandLine(argc, argv)); });
}

} // namespace zvo::cli
