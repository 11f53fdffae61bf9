// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/tree_export.h"
#include "common/tree_input.h"
#include "common/words.h"
#include "core/base/input_error.h"
#include "core/base/kernels.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <memory>
#include <span>
#include <string>
#include <utility>

namespace zvo::cli
{

void convert(const ConvertOptions& options)
{
    const std::string format = treeFormatFor(options.output.path, options.format);
    checkPaths(options.output, std::span(&options.file, 1));
    Output output(options.output.path, options.output.overwrite);
    if (!isTreeFile(options.file))
    {
        throw inputError(options.file, "neither a .zvo nor a .vox file; zvo build makes .zvo files of scenes");
    }
    Progress progress(2);
    progress.begin("loading");
    std::shared_ptr<vk::HeadlessDevice> device; // only for what needs one
    const auto needDevice = [&]() -> vk::HeadlessDevice&
    {
        device = device ? device : openDevice(options.device);
        return *device;
    };
    TreeData tree = loadTree(options.file, needDevice, options.strict);
    if (format == "zvo" && tree.structure != options.structure)
    {
        if (tree.structure == TreeStructure::Svdag)
        {
            throw Error(ErrorCode::Usage, fmt::format("{} is a DAG, which cannot become an octree again; leave "
                                                      "--structure out",
                                                      options.file.string()));
        }
        tree = compressTree(needDevice(), std::move(tree));
    }
    progress.begin("writing");
    writeTree(tree, format, output, options.strict);
    if (device)
    {
        checkValidation(*device);
    }
    output.finish();
    tellRun(fmt::format("{} of {}^3", counted(tree.occupiedCount(), "voxel"), tree.grid.resolution()));
}

} // namespace zvo::cli
