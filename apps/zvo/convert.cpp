// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/tree_input.h"
#include "core/base/input_error.h"
#include "core/base/kernels.h"
#include "core/file/zvo_file.h"
#include "io/voxel/glb_write.h"
#include "io/voxel/nvdb_write.h"
#include "io/voxel/vox_file.h"
#include "runtime/trees.h"
#include "tree_export.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace zvo::cli
{

namespace
{

constexpr std::array<std::string_view, 6> kFormats = {"ply", "vox", "morton", "glb", "nvdb", "zvo"};

std::string formatOf(const ConvertOptions& options)
{
    if (!options.format.empty())
    {
        return options.format;
    }
    const std::string extension = extensionOf(options.output.path);
    const std::string format = extension.empty() ? extension : extension.substr(1);
    if (std::find(kFormats.begin(), kFormats.end(), format) == kFormats.end())
    {
        throw Error(ErrorCode::Usage, fmt::format("-o {}: the format is not clear; name it .{}, or say --format",
                                                  options.output.path, fmt::join(kFormats, ", .")));
    }
    return format;
}

void writeTree(const TreeData& tree, const std::string& format, Output& output)
{
    const auto write = [&output](std::span<const std::byte> bytes) { output.write(bytes); };
    if (format == "ply")
    {
        writePly(tree, output);
    }
    else if (format == "morton")
    {
        writeMorton(tree, output);
    }
    else if (format == "vox")
    {
        writeVox(tree, write);
    }
    else if (format == "glb")
    {
        writeGlb(tree, write);
    }
    else if (format == "nvdb")
    {
        writeNvdb(tree, write);
    }
    else
    {
        writeZvo(tree, write);
    }
}

} // namespace

void convert(const ConvertOptions& options)
{
    const std::string format = formatOf(options);
    checkPaths(options.output, std::span(&options.file, 1));
    Output output(options.output.path, options.output.overwrite);
    const bool is_vox = isVoxFile(options.file);
    if (!is_vox && !isZvoFile(options.file))
    {
        throw inputError(options.file, "neither a .zvo nor a .vox file; zvo build makes .zvo files of scenes");
    }
    Progress progress(2);
    progress.begin("loading");
    std::shared_ptr<vk::HeadlessDevice> device; // only for what needs one
    const auto needDevice = [&]
    {
        if (!device)
        {
            device = openDevice(options.device);
        }
    };
    if (is_vox)
    {
        needDevice();
    }
    TreeData tree = is_vox ? loadVox(options.file, *device) : readZvo(options.file).tree;
    if (format == "zvo" && tree.structure != options.structure)
    {
        if (tree.structure == TreeStructure::Svdag)
        {
            throw Error(ErrorCode::Usage, fmt::format("{} is a DAG, which cannot become an octree again; leave "
                                                      "--structure out",
                                                      options.file.string()));
        }
        needDevice();
        tree = compressTree(*device, std::move(tree));
    }
    progress.begin("writing");
    writeTree(tree, format, output);
    if (device)
    {
        checkValidation(*device);
    }
    output.finish();
    talk(fmt::format("{} voxels of {}^3", tree.voxel_count, tree.grid.resolution()));
}

} // namespace zvo::cli
