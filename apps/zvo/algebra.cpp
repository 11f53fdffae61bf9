// SPDX-License-Identifier: MIT
#include "commands.h"

#include "common/output.h"
#include "common/progress.h"
#include "common/session.h"
#include "common/tree_export.h"
#include "common/tree_input.h"
#include "common/words.h"
#include "core/base/input_error.h"
#include "core/tree/rgb9e5.h"
#include "runtime/flatten.h"
#include "runtime/tree_algebra.h"
#include "runtime/trees.h"
#include "zvo/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace zvo::cli
{

namespace
{

constexpr float kSameScale = 1.0F;

// Gives what a tree emits another scale.
void scaleEmission(TreeData& tree, float scale)
{
    const float factor = tree.emission_scale / scale;
    for (gpu::uint& emission : tree.emission)
    {
        emission = factor == kSameScale ? emission : encodeRgb9e5(factor * decodeRgb9e5(emission));
    }
    tree.emission_scale = scale;
}

// Carries out steps one after the other, on an octree in device memory.
class Calculator
{
public:
    Calculator(vk::HeadlessDevice& device, const AlgebraOptions& options)
        : m_device(device), m_options(options), m_corners(options.corners.value_or(true)),
          m_tree(uploadTree(device, octreeIn(options.file)))
    {
    }

    [[nodiscard]] const DeviceTree& tree() const { return m_tree; }

    void run(const AlgebraStep& step)
    {
        switch (step.kind)
        {
        case AlgebraKind::Unite:
            return combine(TreeOperation::Unite, step.file);
        case AlgebraKind::Intersect:
            return combine(TreeOperation::Intersect, step.file);
        case AlgebraKind::Subtract:
            return combine(TreeOperation::Subtract, step.file);
        case AlgebraKind::Dilate:
            return spread(TreeOperation::Dilate, step.number);
        case AlgebraKind::Erode:
            return spread(TreeOperation::Erode, step.number);
        case AlgebraKind::Open:
            spread(TreeOperation::Erode, step.number);
            return spread(TreeOperation::Dilate, step.number);
        case AlgebraKind::Close:
            spread(TreeOperation::Dilate, step.number);
            return spread(TreeOperation::Erode, step.number);
        case AlgebraKind::Enclose:
            return apply({.operation = TreeOperation::Enclose});
        case AlgebraKind::KeepLargest:
            return apply({.operation = TreeOperation::Keep, .corners = m_corners, .largest = step.number});
        case AlgebraKind::KeepFrom:
            return apply({.operation = TreeOperation::Keep, .corners = m_corners, .least_voxels = step.number});
        }
    }

    [[nodiscard]] Components components() const { return findComponents(m_device, m_tree, m_corners); }

private:
    // The octree of a file, without lists or overlays.
    [[nodiscard]] TreeData octreeIn(const std::filesystem::path& file) const
    {
        TreeData tree = loadTree(
            file, [&]() -> vk::HeadlessDevice& { return m_device; }, m_options.strict);
        if (isPacked(tree.attributeFormat()))
        {
            throw inputError(file, "its attributes are packed; algebra takes those of 8 bytes");
        }
        return tree.structure == TreeStructure::Svdag ? flattenTree(m_device, uploadTree(m_device, tree)) : tree;
    }

    void combine(TreeOperation operation, const std::filesystem::path& file)
    {
        TreeData other = octreeIn(file);
        if (other.grid != m_tree.grid)
        {
            throw inputError(file, fmt::format("has another grid than {}: build both with the same --resolution and "
                                               "--bounds",
                                               m_options.file.string()));
        }
        if (!other.emission.empty() && m_tree.emission.count() != 0 && other.emission_scale != m_tree.emission_scale)
        {
            const float scale = std::max(other.emission_scale, m_tree.emission_scale);
            TreeData mine = downloadTree(m_device, m_tree);
            scaleEmission(mine, scale);
            scaleEmission(other, scale);
            m_tree = uploadTree(m_device, mine);
        }
        const DeviceTree second = uploadTree(m_device, other);
        apply({.operation = operation}, &second);
    }

    void spread(TreeOperation operation, std::uint64_t voxels)
    {
        apply({.operation = operation,
               .corners = m_options.corners.value_or(false),
               .voxels = static_cast<std::uint32_t>(voxels)});
    }

    void apply(const AlgebraInfo& info, const DeviceTree* second = nullptr)
    {
        m_tree = applyAlgebra(m_device, info, m_tree, second);
    }

    vk::HeadlessDevice& m_device;
    const AlgebraOptions& m_options;
    bool m_corners; // of components
    DeviceTree m_tree;
};

// The components, the largest first: their voxels, and the coordinates of one of them.
void writeComponents(const Components& components, Output& output)
{
    std::string text = "voxels,x,y,z\n";
    for (const ComponentSize& component : components.list)
    {
        text +=
            fmt::format("{},{},{},{}\n", component.voxels, component.voxel[0], component.voxel[1], component.voxel[2]);
    }
    output.write(text);
    output.finish();
}

std::vector<std::filesystem::path> inputsOf(const AlgebraOptions& options)
{
    std::vector<std::filesystem::path> inputs = {options.file};
    for (const AlgebraStep& step : options.steps)
    {
        if (!step.file.empty())
        {
            inputs.push_back(step.file);
        }
    }
    return inputs;
}

} // namespace

void algebra(const AlgebraOptions& options)
{
    if (options.output.path.empty() && options.components.empty())
    {
        throw Error(ErrorCode::Usage, "nothing to write: --output or --components is required");
    }
    const std::string format = options.output.path.empty() ? "" : treeFormatFor(options.output.path, options.format);
    const std::array outputs = {options.output.path, options.components};
    checkOutputs(outputs, inputsOf(options));
    std::optional<Output> output;
    std::optional<Output> list;
    if (!options.output.path.empty())
    {
        output.emplace(options.output.path, options.output.overwrite);
    }
    if (!options.components.empty())
    {
        list.emplace(options.components, options.output.overwrite);
    }
    Progress progress(3);
    progress.begin("loading");
    const std::shared_ptr<vk::HeadlessDevice> device = openDevice(options.device);
    Calculator calculator(*device, options);
    progress.begin("calculating");
    for (std::size_t i = 0; i < options.steps.size(); ++i)
    {
        calculator.run(options.steps[i]);
        progress.within(static_cast<double>(i + 1) / static_cast<double>(options.steps.size()));
    }
    progress.begin("writing");
    std::size_t component_count = 0;
    if (list)
    {
        const Components components = calculator.components();
        component_count = components.list.size();
        writeComponents(components, *list);
    }
    const DeviceTree& result = calculator.tree();
    if (output)
    {
        TreeData tree = downloadTree(*device, result);
        const TreeStructure structure = options.structure.value_or(TreeStructure::Svdag);
        if (format == "zvo" && structure == TreeStructure::Svdag && !tree.nodes.empty())
        {
            tree = compressTree(*device, std::move(tree));
        }
        writeTree(tree, format, *output, options.strict);
        output->finish();
    }
    checkValidation(*device);
    tellRun(fmt::format("{} of {}^3{}", counted(result.occupiedCount(), "voxel"), result.grid.resolution(),
                        list ? fmt::format(" in {}", counted(component_count, "component")) : ""));
}

} // namespace zvo::cli
