// SPDX-License-Identifier: MIT
#include "support/algebra_compare.h"

#include "core/base/morton.h"
#include "core/file/tree_check.h"
#include "core/tree/tree_data.h"
#include "runtime/tree_algebra.h"
#include "runtime/trees.h"
#include "support/fill_compare.h"
#include "support/tree_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace zvo::test
{

namespace
{

using Random = std::mt19937;

std::uint32_t below(Random& random, std::uint32_t end)
{
    return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(random);
}

struct Look
{
    gpu::Attribute attribute{};
    std::uint32_t emission = 0;
};

// A tree as a dense grid, with the attributes of the voxels that have some.
struct Dense
{
    std::uint32_t edge = 0;
    bool filled = false;
    std::vector<bool> cells;
    std::map<std::size_t, Look> looks;

    [[nodiscard]] std::size_t numberOf(const glm::ivec3& at) const
    {
        return static_cast<std::size_t>(at.x) +
               edge * (static_cast<std::size_t>(at.y) + edge * static_cast<std::size_t>(at.z));
    }
    [[nodiscard]] glm::ivec3 cellOf(std::size_t number) const
    {
        return {static_cast<int>(number % edge), static_cast<int>(number / edge % edge),
                static_cast<int>(number / edge / edge)};
    }
    [[nodiscard]] bool contains(const glm::ivec3& at) const
    {
        const int end = static_cast<int>(edge);
        return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < end && at.y < end && at.z < end;
    }
};

Dense denseOf(const TreeData& tree)
{
    Dense dense;
    dense.edge = tree.grid.resolution();
    dense.filled = tree.isFilled();
    dense.cells.resize(std::size_t{dense.edge} * dense.edge * dense.edge);
    std::size_t voxel = 0;
    std::size_t emissive = 0;
    forEachCell(tree,
                [&](std::uint64_t code, bool on_surface)
                {
                    const std::size_t number = dense.numberOf(glm::ivec3(cellOfCode(code)));
                    dense.cells[number] = true;
                    if (on_surface && tree.hasAttributes())
                    {
                        Look look{tree.voxel_attributes[voxel], 0};
                        if ((look.attribute.color >> 24 & gpu::kAttributeEmissive) != 0)
                        {
                            look.emission = tree.emission[emissive++];
                        }
                        dense.looks[number] = look;
                    }
                    voxel += on_surface ? 1 : 0;
                });
    return dense;
}

std::vector<glm::ivec3> directions(bool corners)
{
    std::vector<glm::ivec3> result;
    for (int z = -1; z <= 1; ++z)
    {
        for (int y = -1; y <= 1; ++y)
        {
            for (int x = -1; x <= 1; ++x)
            {
                const int steps = x * x + y * y + z * z;
                if (steps == 1 || (corners && steps > 1))
                {
                    result.emplace_back(x, y, z);
                }
            }
        }
    }
    return result;
}

std::vector<bool> spread(const Dense& a, const std::vector<bool>& cells, bool corners, bool erodes)
{
    std::vector<bool> result = cells;
    for (std::size_t number = 0; number < cells.size(); ++number)
    {
        for (const glm::ivec3& direction : directions(corners))
        {
            const glm::ivec3 at = a.cellOf(number) + direction;
            if (a.contains(at) && cells[a.numberOf(at)] != erodes)
            {
                result[number] = !erodes;
            }
        }
    }
    return result;
}

// The component of each cell whose value is `value`, and their sizes.
struct DenseComponents
{
    std::vector<std::uint32_t> of;
    std::vector<std::uint64_t> sizes{0}; // component 0 stands for none
    std::vector<bool> reaches_out{false};
};

DenseComponents componentsOf(const Dense& a, bool value, bool corners)
{
    DenseComponents found;
    found.of.resize(a.cells.size());
    const std::vector<glm::ivec3> steps = directions(corners);
    for (std::size_t first = 0; first < a.cells.size(); ++first)
    {
        if (a.cells[first] != value || found.of[first] != 0)
        {
            continue;
        }
        const auto label = static_cast<std::uint32_t>(found.sizes.size());
        found.sizes.push_back(0);
        found.reaches_out.push_back(false);
        std::vector<std::size_t> open = {first};
        found.of[first] = label;
        while (!open.empty())
        {
            const std::size_t number = open.back();
            open.pop_back();
            ++found.sizes.back();
            for (const glm::ivec3& step : steps)
            {
                const glm::ivec3 at = a.cellOf(number) + step;
                if (!a.contains(at))
                {
                    found.reaches_out.back() = true;
                    continue;
                }
                const std::size_t beside = a.numberOf(at);
                if (a.cells[beside] == value && found.of[beside] == 0)
                {
                    found.of[beside] = label;
                    open.push_back(beside);
                }
            }
        }
    }
    return found;
}

// Boxes and single voxels, some along the sides of bricks and of the grid.
TreeData randomBoxes(Random& random, std::uint32_t depth, bool attributes)
{
    const std::uint32_t edge = 1U << depth;
    std::set<std::uint64_t> codes;
    for (std::uint32_t i = below(random, 6); i > 0; --i)
    {
        const std::uint32_t step = std::array{1U, 4U, 8U, 16U}.at(below(random, 4));
        const std::uint32_t count = std::max(edge / step, 1U);
        const glm::uvec3 lo(below(random, count) * step, below(random, count) * step, below(random, count) * step);
        const std::uint32_t most = 1 + below(random, edge);
        const glm::uvec3 hi =
            glm::min(lo + glm::uvec3(1 + below(random, most), 1 + below(random, most), 1 + below(random, most)),
                     glm::uvec3(edge));
        const bool hollow = below(random, 2) == 0;
        for (std::uint32_t z = lo.z; z < hi.z; ++z)
        {
            for (std::uint32_t y = lo.y; y < hi.y; ++y)
            {
                for (std::uint32_t x = lo.x; x < hi.x; ++x)
                {
                    const bool is_shell =
                        x == lo.x || y == lo.y || z == lo.z || x + 1 == hi.x || y + 1 == hi.y || z + 1 == hi.z;
                    if (!hollow || is_shell)
                    {
                        codes.insert(codeOfCell({x, y, z}));
                    }
                }
            }
        }
    }
    for (std::uint32_t i = below(random, 2) * below(random, 2 * edge * edge); i > 0; --i)
    {
        codes.insert(codeOfCell({below(random, edge), below(random, edge), below(random, edge)}));
    }
    TreeData tree = octreeOf(std::vector<std::uint64_t>(codes.begin(), codes.end()), depth);
    if (attributes && !codes.empty())
    {
        addAttributes(tree);
    }
    return tree;
}

DeviceTree randomTree(vk::HeadlessDevice& device, Random& random, std::uint32_t depth, bool attributes)
{
    if (below(random, 2) == 0)
    {
        return uploadTree(device, randomBoxes(random, depth, attributes));
    }
    const Grid grid = {glm::vec3(0), 1.0F, depth};
    const GpuScene scene = uploadScene(device, tetrahedra(random, grid), attributes);
    return std::move(buildOctree(device, scene, grid,
                                 {.attributes = attributes, .fill = below(random, 4) == 0 ? Fill::None : Fill::Solid})
                         .octree);
}

struct Expected
{
    std::vector<bool> cells;
    bool filled = false;
    std::vector<bool> exposed = {}; // voxels that were beside an empty one after an earlier step; or empty
};

// Whether a voxel is beside an empty one.
bool isExposed(const Dense& a, const std::vector<bool>& cells, std::size_t number)
{
    return std::ranges::any_of(directions(false),
                               [&](const glm::ivec3& step)
                               {
                                   const glm::ivec3 at = a.cellOf(number) + step;
                                   return a.contains(at) && !cells[a.numberOf(at)];
                               });
}

// Compares what has attributes, and these as far as an operand has them.
std::string compareLooks(const Dense& actual, const Dense& a, const Dense* b, const Expected& expected)
{
    for (std::size_t number = 0; number < actual.cells.size(); ++number)
    {
        if (!actual.cells[number])
        {
            continue;
        }
        const auto in_a = a.looks.find(number);
        const bool known_a = in_a != a.looks.end();
        const bool known_b = b != nullptr && b->looks.contains(number);
        const bool is_exposed = !expected.filled || isExposed(actual, expected.cells, number) ||
                                (!expected.exposed.empty() && expected.exposed[number]);
        const auto found = actual.looks.find(number);
        if ((found != actual.looks.end()) != (known_a || known_b || is_exposed))
        {
            return fmt::format("voxel {}: attributes where none are wanted, or none where they are", number);
        }
        if (!known_a && !known_b)
        {
            if (found != actual.looks.end() && (found->second.attribute.color >> 24) != 0)
            {
                return fmt::format("voxel {}: a new one has flags", number);
            }
            continue;
        }
        const Look& wanted = known_a ? in_a->second : b->looks.at(number);
        const Look& look = found->second;
        if (look.attribute.color != wanted.attribute.color || look.attribute.normal != wanted.attribute.normal ||
            look.emission != wanted.emission)
        {
            return fmt::format("voxel {}: other attributes", number);
        }
    }
    return {};
}

std::string compareResult(vk::HeadlessDevice& device, const DeviceTree& result, const Dense& a, const Dense* b,
                          const Expected& expected, bool attributes)
{
    const TreeData tree = downloadTree(device, result);
    if (tree.nodes.empty())
    {
        return std::ranges::find(expected.cells, true) == expected.cells.end() ? "" : "the result is empty";
    }
    if (const auto fault = checkTree(tree))
    {
        return "the tree is not sound: " + *fault;
    }
    const Dense actual = denseOf(tree);
    for (std::size_t number = 0; number < expected.cells.size(); ++number)
    {
        if (actual.cells[number] != expected.cells[number])
        {
            const glm::ivec3 at = actual.cellOf(number);
            return fmt::format("voxel {} {} {}: {} in place of {}", at.x, at.y, at.z, actual.cells[number] ? 1 : 0,
                               expected.cells[number] ? 1 : 0);
        }
    }
    const auto count = static_cast<std::uint64_t>(std::ranges::count(expected.cells, true));
    if (result.occupiedCount() != count)
    {
        return fmt::format("{} voxels are counted, there are {}", result.occupiedCount(), count);
    }
    return attributes ? compareLooks(actual, a, b, expected) : "";
}

} // namespace

std::string compareAlgebra(vk::HeadlessDevice& device, std::mt19937& random, std::uint32_t depth)
{
    const bool attributes = below(random, 4) != 0;
    const bool corners = below(random, 2) == 0;
    const DeviceTree tree_a = randomTree(device, random, depth, attributes);
    const Dense a = denseOf(downloadTree(device, tree_a));
    const std::uint32_t kind = below(random, 9);
    std::string what;
    DeviceTree result;
    Expected expected = {std::vector<bool>(a.cells.size()), a.filled};
    std::optional<Dense> b;
    if (kind < 3)
    {
        constexpr std::array<TreeOperation, 3> kOperations = {TreeOperation::Unite, TreeOperation::Intersect,
                                                              TreeOperation::Subtract};
        const TreeOperation operation = kOperations.at(kind);
        what = std::array{"union", "intersection", "difference"}.at(kind);
        const DeviceTree tree_b = randomTree(device, random, depth, attributes);
        b = denseOf(downloadTree(device, tree_b));
        for (std::size_t i = 0; i < a.cells.size(); ++i)
        {
            expected.cells[i] = operation == TreeOperation::Unite       ? a.cells[i] || b->cells[i]
                                : operation == TreeOperation::Intersect ? a.cells[i] && b->cells[i]
                                                                        : a.cells[i] && !b->cells[i];
        }
        expected.filled = operation == TreeOperation::Unite       ? a.filled || b->filled
                          : operation == TreeOperation::Intersect ? a.filled && b->filled
                                                                  : a.filled;
        result = applyAlgebra(device, {.operation = operation}, tree_a, &tree_b);
        if (operation == TreeOperation::Subtract)
        {
            b.reset(); // gives no attributes
        }
    }
    else if (kind < 5)
    {
        const bool erodes = kind == 4;
        what = erodes ? "erosion" : "dilation";
        const std::uint32_t steps = 1 + below(random, 2);
        expected.cells = a.cells;
        for (std::uint32_t i = 0; i < steps; ++i)
        {
            expected.exposed.resize(a.cells.size());
            for (std::size_t number = 0; i != 0 && number < a.cells.size(); ++number)
            {
                expected.exposed[number] = expected.cells[number] && isExposed(a, expected.cells, number);
            }
            expected.cells = spread(a, expected.cells, corners, erodes);
        }
        result = applyAlgebra(
            device,
            {.operation = erodes ? TreeOperation::Erode : TreeOperation::Dilate, .corners = corners, .voxels = steps},
            tree_a);
    }
    else if (kind < 7)
    {
        const bool largest = kind == 5;
        what = largest ? "the largest component" : "components from a size on";
        const Components components = findComponents(device, tree_a, corners);
        const DenseComponents dense = componentsOf(a, true, corners);
        std::vector<std::uint64_t> sizes;
        for (const ComponentSize& component : components.list)
        {
            sizes.push_back(component.voxels);
            const glm::ivec3 at(component.voxel[0], component.voxel[1], component.voxel[2]);
            if (!a.contains(at) || dense.sizes[dense.of[a.numberOf(at)]] != component.voxels)
            {
                return what + ": a component's voxel is of another one";
            }
        }
        std::vector<std::uint64_t> wanted(dense.sizes.begin() + 1, dense.sizes.end());
        std::ranges::sort(wanted, std::greater());
        if (sizes != wanted)
        {
            return fmt::format("{} components in place of {}, or other sizes", sizes.size(), wanted.size());
        }
        const std::uint64_t least = 1 + below(random, 60);
        std::uint32_t kept = 0;
        if (largest && !components.list.empty())
        {
            const auto& at = components.list.front().voxel;
            kept = dense.of[a.numberOf(glm::ivec3(at[0], at[1], at[2]))];
        }
        for (std::size_t i = 0; i < a.cells.size(); ++i)
        {
            expected.cells[i] = a.cells[i] && (largest ? dense.of[i] == kept : dense.sizes[dense.of[i]] >= least);
        }
        result = applyAlgebra(
            device,
            {.operation = TreeOperation::Keep, .corners = corners, .largest = largest ? 1U : 0U, .least_voxels = least},
            tree_a);
    }
    else
    {
        what = "what is enclosed";
        const DenseComponents space = componentsOf(a, false, false);
        for (std::size_t i = 0; i < a.cells.size(); ++i)
        {
            expected.cells[i] = a.cells[i] || !space.reaches_out[space.of[i]];
        }
        expected.filled = true;
        result = applyAlgebra(device, {.operation = TreeOperation::Enclose}, tree_a);
    }
    const std::string difference = compareResult(device, result, a, b ? &*b : nullptr, expected, attributes);
    return difference.empty() ? difference
                              : fmt::format("{} ({}{}{}): {}", what, attributes ? "attributes" : "bare",
                                            a.filled ? ", filled" : "", corners ? ", corners" : "", difference);
}

} // namespace zvo::test
