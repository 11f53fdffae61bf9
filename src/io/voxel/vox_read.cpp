// SPDX-License-Identifier: MIT
#include "core/base/input_error.h"
#include "core/base/morton.h"
#include "core/base/srgb.h"
#include "io/voxel/vox_chunks.h"
#include "io/voxel/vox_file.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fmt/format.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace zvo
{

namespace
{

constexpr std::uint64_t kVoxelsMax = std::uint64_t{1} << 28; // in all placements
constexpr std::uint32_t kPlacementsMax = 1U << 20;           // visits of nodes
constexpr std::uint32_t kNestingMax = 256;                   // of nodes
constexpr std::uint32_t kEdgeMax = 1U << Grid::kDepthMax;    // of everything

/// Places the models of one file.
class Placer
{
public:
    Placer(const VoxScene& scene, const std::filesystem::path& name) : m_scene(scene), m_name(name) {}

    VoxVoxels place()
    {
        placeAll();
        return finish();
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw inputError(m_name, what); }

    void placeAll()
    {
        if (m_scene.nodes.empty())
        {
            if (!m_scene.models.empty())
            {
                VoxPlacement from_corner;
                from_corner.move = m_scene.models.front().size / 2;
                place(m_scene.models.front(), from_corner);
            }
            if (m_scene.models.size() > 1)
            {
                m_result.warnings.push_back(
                    fmt::format("{}: {} models without places: frames of an animation; the first one is taken",
                                m_name.string(), m_scene.models.size()));
            }
            return;
        }
        struct Visit
        {
            std::int32_t node;
            std::uint32_t nesting;
            VoxPlacement placement;
        };
        std::vector<Visit> visits = {{0, 0, {}}};
        for (std::uint32_t count = 0; !visits.empty(); ++count)
        {
            const Visit visit = visits.back();
            visits.pop_back();
            const auto found = m_scene.nodes.find(visit.node);
            if (found == m_scene.nodes.end())
            {
                fail(fmt::format("node {} is named and not there; {}", visit.node, kExportAgain));
            }
            if (visit.nesting > kNestingMax || count > kPlacementsMax)
            {
                fail(fmt::format("its nodes go round in a circle, or are nested too deeply; {}", kExportAgain));
            }
            const VoxNode& node = found->second;
            if (node.hidden || m_scene.hidden_layers.contains(node.layer))
            {
                continue;
            }
            const VoxPlacement placement = checked(visit.placement.after(node.placement));
            for (const std::int32_t model : node.models)
            {
                if (model < 0 || static_cast<std::size_t>(model) >= m_scene.models.size())
                {
                    fail(fmt::format("model {} is named and not there; {}", model, kExportAgain));
                }
                place(m_scene.models[static_cast<std::size_t>(model)], placement);
            }
            for (auto child = node.children.rbegin(); child != node.children.rend();
                 ++child) // the first child is visited next
            {
                visits.push_back({*child, visit.nesting + 1, placement});
            }
        }
    }

    [[nodiscard]] VoxPlacement checked(const VoxPlacement& placement) const
    {
        for (int i = 0; i < 3; ++i)
        {
            if (std::abs(placement.move[i]) > kVoxTranslationMax)
            {
                fail(fmt::format("a model lies {} voxels away; {}", placement.move[i], kExportAgain));
            }
        }
        return placement;
    }

    // A model rotates about the corner of the voxel in its middle.
    void place(const VoxModel& model, const VoxPlacement& placement)
    {
        const std::size_t count = model.voxelCount();
        if (m_cells.size() + count > kVoxelsMax)
        {
            fail(fmt::format("more than {} voxels; take a part of the scene", kVoxelsMax));
        }
        for (std::size_t i = 0; i < count; ++i)
        {
            const VoxModelVoxel voxel = model.voxel(i);
            if (voxel.index == 0)
            {
                continue;
            }
            const glm::ivec3 local = glm::ivec3(voxel.x, voxel.y, voxel.z) - model.size / 2;
            const glm::ivec3 halves = placement(2 * local + 1);
            const glm::ivec3 cell((halves.x - 1) / 2, (halves.z - 1) / 2, -1 - (halves.y - 1) / 2);
            m_cells.push_back({cell, voxel.index - 1U});
        }
    }

    void addWarnings(const std::vector<std::pair<std::uint64_t, std::uint32_t>>& voxels)
    {
        std::set<std::string> kinds; // of materials of voxels
        for (const auto& [code, color_index] : voxels)
        {
            kinds.insert(m_scene.kinds[color_index]);
        }
        kinds.erase("");
        const auto warn = [&](const std::string& text)
        { m_result.warnings.emplace_back(inputError(m_name, text).what()); };
        if (!kinds.empty())
        {
            warn(fmt::format("materials of kind {} left out but for their colour", fmt::join(kinds, ", ")));
        }
        if (m_scene.has_frames)
        {
            warn("frames of an animation left out but for the first");
        }
    }

    VoxVoxels finish()
    {
        glm::ivec3 corner(0);
        glm::ivec3 end(1);
        for (const Cell& cell : m_cells)
        {
            corner = glm::min(corner, cell.coordinates);
            end = glm::max(end, cell.coordinates + 1);
        }
        const glm::uvec3 extent(end - corner);
        const std::uint32_t edge = std::max({extent.x, extent.y, extent.z, 2U});
        if (edge > kEdgeMax)
        {
            fail(fmt::format("it is {} voxels wide, more than the {} that are possible", edge, kEdgeMax));
        }
        m_result.grid = {glm::vec3(corner), 1.0F, static_cast<std::uint32_t>(std::bit_width(edge - 1))};
        std::vector<std::pair<std::uint64_t, std::uint32_t>> voxels;
        voxels.reserve(m_cells.size());
        for (const Cell& cell : m_cells)
        {
            voxels.emplace_back(codeOfCell(glm::uvec3(cell.coordinates - corner)), cell.color_index);
        }
        m_cells = {};
        const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
        std::stable_sort(voxels.begin(), voxels.end(), before);
        for (std::size_t i = 0; i < voxels.size(); ++i)
        {
            if (i + 1 == voxels.size() || voxels[i + 1].first != voxels[i].first) // the last voxel of its cell
            {
                m_result.codes.push_back(voxels[i].first);
                m_result.colors.push_back(m_scene.palette[voxels[i].second]);
                m_result.emission.push_back(m_scene.emission[voxels[i].second] *
                                            glm::vec3(linearOf(m_result.colors.back())));
            }
        }
        addWarnings(voxels);
        if (std::ranges::all_of(m_result.emission,
                                [](const glm::vec3& emission) { return emission == glm::vec3(0.0F); }))
        {
            m_result.emission = {};
        }
        return std::move(m_result);
    }

    struct Cell
    {
        glm::ivec3 coordinates;
        std::uint32_t color_index; // in the palette
    };

    const VoxScene& m_scene;
    const std::filesystem::path& m_name;
    std::vector<Cell> m_cells;
    VoxVoxels m_result;
};

} // namespace

VoxVoxels readVox(std::span<const std::uint8_t> bytes, const std::filesystem::path& name)
{
    const VoxScene scene = readVoxScene(bytes, name);
    return Placer(scene, name).place();
}

} // namespace zvo
