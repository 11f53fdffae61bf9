// SPDX-License-Identifier: MIT
// App: edits of many voxels at once: floods, and what is copied, pasted, moved and deleted.
#include "demo/app/app.h"

#include "common/progress.h"
#include "common/words.h"
#include "core/edit/voxel_clip.h"
#include "core/tree/rgb9e5.h"
#include "demo/world/mirror.h"

#include <fmt/format.h>

#include <array>
#include <exception>
#include <variant>
#include <vector>

namespace zvo::demo
{

namespace
{

constexpr int kFloodReach = 80; // voxels from the seed along each axis

VoxelBox wholeGrid(const Grid& grid)
{
    return {glm::ivec3(0), glm::ivec3(grid.resolution()) - 1};
}

Brush carved(const VoxelBox& box)
{
    return {.shape = BrushShape::Box, .center = box.lo, .span = box.hi - box.lo};
}

// The brush that places a clip; it does nothing where the grid has none of its voxels.
std::vector<Brush> placed(const VoxelClip& clip, const glm::ivec3& at, const Grid& grid)
{
    const std::shared_ptr<const Stamp> stamp = clip.stampAt(at, grid);
    return stamp == nullptr ? std::vector<Brush>() : std::vector{Brush{.action = BrushAction::Fill, .stamp = stamp}};
}

// What a flood reaches, as the brush makes it look.
VoxelClip painted(const Flood& flood, const Brush& brush, float emission_scale)
{
    const bool emits = brush.emission != glm::vec3(0.0F);
    const std::uint32_t color = brush.color | (emits ? gpu::kAttributeEmissive << 24U : 0U);
    const std::uint32_t emission = emits ? encodeRgb9e5(brush.emission / emission_scale) : 0U;
    VoxelClip painted(flood.reached.size());
    glm::ivec3 cell(0);
    for (cell.z = 0; cell.z < painted.size().z; ++cell.z)
    {
        for (cell.y = 0; cell.y < painted.size().y; ++cell.y)
        {
            for (cell.x = 0; cell.x < painted.size().x; ++cell.x)
            {
                if (const std::optional<ClipVoxel>& voxel = flood.voxels.at(flood.reached.lo + cell))
                {
                    painted.set(cell, ClipVoxel{{color, voxel->look.normal}, emission});
                }
            }
        }
    }
    return painted;
}

} // namespace

// At a frame's begin. What was requested before an order is recorded first, so that the order finds it.
void App::carryOutOrders()
{
    while (const std::optional<EditOrder> order = m_editor.nextOrder())
    {
        try
        {
            if (!isMakingAWorld() && m_world->scene.canEdit())
            {
                finishAll();
                m_world->scene.settle(worldSeconds());
                std::visit([this](const auto& kind) { carryOut(kind); }, *order);
            }
        }
        catch (const std::exception& error)
        {
            cli::talkError(error);
        }
        m_editor.orderDone(*m_world);
    }
}

void App::carryOut(const FloodOrder& order)
{
    const Grid& grid = m_world->scene.tree().grid;
    const float emission_scale = m_world->scene.tree().emission_scale;
    const auto tolerance = static_cast<std::uint32_t>(order.tool.tolerance);
    std::vector<Brush> brushes;
    std::size_t count = 0;
    bool is_cut_off = false;
    for (const glm::ivec3& seed : imagesOf(order.seed, order.tool.mirror, grid))
    {
        const VoxelBox box = VoxelBox{seed - kFloodReach, seed + kFloodReach}.within(wholeGrid(grid));
        if (!box.contains(seed))
        {
            continue;
        }
        const Flood flood = floodFrom(m_world->scene.copyVoxels(box), seed - box.lo, tolerance);
        const VoxelBox reached = flood.reached.movedBy(box.lo);
        count += flood.voxels.voxelCount();
        is_cut_off = is_cut_off || glm::any(glm::equal(reached.lo, seed - kFloodReach)) ||
                     glm::any(glm::equal(reached.hi, seed + kFloodReach));
        for (Brush brush : placed(painted(flood, order.tool.brushAt(seed), emission_scale), reached.lo, grid))
        {
            brush.action = order.tool.action == BrushAction::Carve ? BrushAction::Carve : BrushAction::Fill;
            brushes.push_back(brush);
        }
    }
    m_editor.requestStroke(brushes, {}, *m_world);
    const std::string end =
        is_cut_off ? fmt::format("; there are more, but a flood reaches {} voxels at most", kFloodReach) : "";
    note(count == 0 ? "there is no voxel of what stands still" : cli::counted(count, "voxel") + end);
}

void App::carryOut(const CopyOrder& order)
{
    if (order.box.volume() > VoxelClip::kCellsMax)
    {
        return note(
            fmt::format("too large a box to copy: {} cells of at most {}", order.box.volume(), VoxelClip::kCellsMax));
    }
    m_clip = m_world->scene.copyVoxels(order.box);
    note(cli::counted(m_clip.voxelCount(), "voxel") + (order.cuts ? " cut; Ctrl+V pastes" : " copied; Ctrl+V pastes"));
    if (order.cuts)
    {
        const Brush carve = carved(order.box);
        m_editor.requestStroke({&carve, 1}, m_editor.state.mirror, *m_world);
    }
}

// On the face that is seen, with the clip's middle above the voxel.
void App::carryOut(const PasteOrder& order)
{
    if (m_clip.voxelCount() == 0)
    {
        return note("nothing is copied: select a box, and press Ctrl+C");
    }
    const Grid& grid = m_world->scene.tree().grid;
    const glm::ivec3& size = m_clip.size();
    glm::ivec3 lo = order.voxel - size / 2;
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        lo[axis] = order.step[axis] > 0   ? order.voxel[axis] + 1
                   : order.step[axis] < 0 ? order.voxel[axis] - size[axis]
                                          : lo[axis];
    }
    const std::vector<Brush> brushes = placed(m_clip, lo, grid);
    m_editor.requestStroke(brushes, m_editor.state.mirror, *m_world);
    m_editor.state.selection = VoxelBox{lo, lo + size - 1};
    note(brushes.empty() ? "the grid ends there" : cli::counted(m_clip.voxelCount(), "voxel") + " pasted");
}

void App::carryOut(const MoveOrder& order)
{
    if (order.box.volume() > VoxelClip::kCellsMax)
    {
        return note(
            fmt::format("too large a box to move: {} cells of at most {}", order.box.volume(), VoxelClip::kCellsMax));
    }
    const Grid& grid = m_world->scene.tree().grid;
    const VoxelBox target = order.box.movedBy(order.by);
    for (const Brush& image : imagesOf(carved(target), m_editor.state.mirror, grid))
    {
        if (image.box().within(wholeGrid(grid)) != image.box())
        {
            return note("the grid ends there: nothing is moved");
        }
    }
    const VoxelClip clip = m_world->scene.copyVoxels(order.box);
    std::vector<Brush> brushes = {carved(order.box)};
    for (const Brush& brush : placed(clip, target.lo, grid))
    {
        brushes.push_back(brush);
    }
    m_editor.requestStroke(brushes, m_editor.state.mirror, *m_world);
    m_editor.state.selection = target;
    note(cli::counted(clip.voxelCount(), "voxel") + " moved");
}

void App::carryOut(const DeleteOrder& order)
{
    const Brush carve = carved(order.box);
    m_editor.requestStroke({&carve, 1}, m_editor.state.mirror, *m_world);
}

// Keys for the selected box.
void App::editSelection(Action action)
{
    const std::optional<VoxelBox>& box = m_editor.state.selection;
    if (!box || !m_world->scene.canEdit())
    {
        return note("nothing is selected: T, then drag over voxels");
    }
    if (action == Action::Delete)
    {
        m_editor.order(DeleteOrder{*box});
    }
    else
    {
        m_editor.order(CopyOrder{*box, action == Action::Cut});
    }
}

} // namespace zvo::demo
