// SPDX-License-Identifier: MIT
#include "demo/panels/brush_cursor.h"

#include "demo/input/pointer_ray.h"
#include "demo/world/hit_face.h"
#include "demo/world/mirror.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace zvo::demo
{

namespace
{

constexpr int kCirclePoints = 64;

using Line = std::vector<glm::dvec3>; // in world space

// Draws a closed line, dark around bright so that it shows on any picture. Parts behind the camera are left out.
void drawClosed(const PointerView& view, const Line& line, ImU32 color, float width)
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    std::vector<ImVec2> points;
    for (const glm::dvec3& point : line)
    {
        if (const std::optional<glm::dvec2> at = pointOf(view.camera, point, view.size))
        {
            points.emplace_back(static_cast<float>(at->x), static_cast<float>(at->y));
        }
    }
    const ImDrawFlags flags = points.size() == line.size() ? ImDrawFlags_Closed : ImDrawFlags_None;
    list.AddPolyline(points.data(), static_cast<int>(points.size()), IM_COL32(0, 0, 0, 160), flags, width + 2);
    list.AddPolyline(points.data(), static_cast<int>(points.size()), color, flags, width);
}

Line circle(const glm::dvec3& center, const glm::dvec3& x, const glm::dvec3& y)
{
    Line line;
    for (int i = 0; i < kCirclePoints; ++i)
    {
        const double angle = 2 * std::numbers::pi * i / kCirclePoints;
        line.push_back(center + std::cos(angle) * x + std::sin(angle) * y);
    }
    return line;
}

// The rim of a sphere as the camera sees it.
Line rim(const ViewCamera& camera, const glm::dvec3& center, double radius)
{
    if (camera.orthographic)
    {
        return circle(center, radius * camera.right, radius * camera.up);
    }
    const glm::dvec3 away = center - camera.position;
    const double distance = glm::length(away);
    if (distance <= radius)
    {
        return {};
    }
    const double nearer = radius * radius / distance; // from the centre to the plane of the rim
    const glm::dvec3 axis = away / distance;
    const glm::dvec3 x = glm::normalize(glm::cross(axis, camera.up));
    const double rim_radius = std::sqrt(radius * radius - nearer * nearer);
    return circle(center - nearer * axis, rim_radius * x, rim_radius * glm::cross(x, axis));
}

// A rectangle across `axis` with half the size `half`, at that distance from the centre.
Line rectangle(const glm::dvec3& center, glm::length_t axis, const glm::dvec3& half, double offset)
{
    const glm::length_t first = (axis + 1) % 3;
    const glm::length_t second = (axis + 2) % 3;
    glm::dvec3 x(0.0);
    glm::dvec3 y(0.0);
    glm::dvec3 normal(0.0);
    x[first] = half[first];
    y[second] = half[second];
    normal[axis] = offset;
    return {center + normal - x - y, center + normal + x - y, center + normal + x + y, center + normal - x + y};
}

glm::length_t axisOf(const glm::ivec3& step)
{
    return step.x != 0 ? 0 : step.y != 0 ? 1 : 2;
}

void drawBox(const PointerView& view, const glm::dvec3& center, const glm::dvec3& half, ImU32 color)
{
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        for (const double side : {-half[axis], half[axis]})
        {
            drawClosed(view, rectangle(center, axis, half, side), color, 1.0F);
        }
    }
}

void drawSphere(const PointerView& view, const glm::dvec3& center, double radius, const glm::ivec3& step, ImU32 color)
{
    drawClosed(view, rim(view.camera, center, radius), color, 1.5F);
    glm::dvec3 x(0.0);
    glm::dvec3 y(0.0);
    x[(axisOf(step) + 1) % 3] = radius;
    y[(axisOf(step) + 2) % 3] = radius;
    drawClosed(view, circle(center, x, y), color, 1.0F);
}

} // namespace

std::optional<BrushPlace> brushPlace(const PointerView& view, const Grid& grid, const InspectedPixel& found)
{
    if (found.report.hit == 0 || found.report.level != grid.nodeLevels())
    {
        return std::nullopt;
    }
    BrushPlace place = {glm::ivec3(found.report.cell), {}};
    place.step = stepAcross(view.camera, grid, place.voxel, found.report.face);
    if (place.step == glm::ivec3(0))
    {
        return place;
    }
    const glm::length_t axis = axisOf(place.step);
    const double size = grid.voxel_size;
    const glm::dvec3 on_face = voxelCenter(grid, place.voxel) + 0.5 * size * glm::dvec3(place.step);
    const PointerRay ray = pointerRay(view.camera, view.pointer, view.size);
    const double t = (on_face[axis] - ray.origin[axis]) / ray.direction[axis];
    if (std::isfinite(t) && t > 0)
    {
        const glm::dvec3 inside = ray.origin + t * ray.direction - 0.5 * size * glm::dvec3(place.step);
        const glm::dvec3 cell = glm::floor((inside - glm::dvec3(grid.origin)) / size);
        const glm::dvec3 moved = glm::abs(cell - glm::dvec3(place.voxel));
        if (glm::max(moved.x, glm::max(moved.y, moved.z)) < grid.resolution())
        {
            place.voxel = glm::ivec3(cell);
        }
    }
    return place;
}

void drawVoxelBox(const PointerView& view, const Grid& grid, const VoxelBox& box)
{
    const glm::dvec3 center = 0.5 * (voxelCenter(grid, box.lo) + voxelCenter(grid, box.hi));
    drawBox(view, center, 0.5 * double{grid.voxel_size} * glm::dvec3(box.size()), IM_COL32(255, 255, 255, 255));
}

void drawMirror(const PointerView& view, const Grid& grid, const Mirror& mirror)
{
    const glm::dvec3 half(0.5 * grid.resolution() * double{grid.voxel_size});
    const glm::dvec3 middle = glm::dvec3(grid.origin) + half;
    const glm::dvec3 at =
        glm::dvec3(grid.origin) + 0.5 * double{grid.voxel_size} * (glm::dvec3(mirror.sum(grid)) + 1.0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        if (mirror.axes[static_cast<std::size_t>(axis)])
        {
            drawClosed(view, rectangle(middle, axis, half, at[axis] - middle[axis]), IM_COL32(120, 200, 255, 255),
                       1.0F);
        }
    }
}

void drawFace(const PointerView& view, const Grid& grid, const BrushPlace& place)
{
    constexpr ImU32 kFaceColor = IM_COL32(255, 220, 90, 255);
    if (place.step != glm::ivec3(0))
    {
        const double half = 0.5 * double{grid.voxel_size};
        const glm::length_t axis = axisOf(place.step);
        drawClosed(view, rectangle(voxelCenter(grid, place.voxel), axis, glm::dvec3(half), half * place.step[axis]),
                   kFaceColor, 1.5F);
    }
}

void drawBrush(const PointerView& view, const Grid& grid, const ToolState& tool, const BrushPlace& place)
{
    drawFace(view, grid, place);
    if (tool.form == BrushForm::Flood)
    {
        return;
    }
    const bool has_color = tool.action != BrushAction::Carve;
    const ImU32 color = has_color ? ImGui::ColorConvertFloat4ToU32({tool.color[0], tool.color[1], tool.color[2], 1.0F})
                                  : IM_COL32(255, 255, 255, 255);
    const glm::ivec3 voxel = tool.action == BrushAction::Fill ? place.voxel + place.step : place.voxel;
    const double half = (tool.radius + 0.5) * double{grid.voxel_size};
    for (const glm::ivec3& image : imagesOf(voxel, tool.mirror, grid))
    {
        const glm::dvec3 center = voxelCenter(grid, image);
        if (tool.shape == BrushShape::Box || tool.form == BrushForm::Box)
        {
            drawBox(view, center, glm::dvec3(half), color);
        }
        else
        {
            drawSphere(view, center, half, place.step, color);
        }
    }
}

} // namespace zvo::demo
