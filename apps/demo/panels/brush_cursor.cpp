// SPDX-License-Identifier: MIT
#include "demo/panels/brush_cursor.h"

#include "demo/input/pointer_ray.h"
#include "demo/world/hit_face.h"

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

// The side of a box to which step leads, or its middle plane across `axis` where offset is 0.
Line square(const glm::dvec3& center, glm::length_t axis, double half, double offset)
{
    glm::dvec3 x(0.0);
    glm::dvec3 y(0.0);
    glm::dvec3 normal(0.0);
    x[(axis + 1) % 3] = half;
    y[(axis + 2) % 3] = half;
    normal[axis] = offset;
    return {center + normal - x - y, center + normal + x - y, center + normal + x + y, center + normal - x + y};
}

glm::length_t axisOf(const glm::ivec3& step)
{
    return step.x != 0 ? 0 : step.y != 0 ? 1 : 2;
}

void drawBox(const PointerView& view, const glm::dvec3& center, double half, ImU32 color)
{
    for (glm::length_t axis = 0; axis < 3; ++axis)
    {
        for (const double side : {-half, half})
        {
            drawClosed(view, square(center, axis, half, side), color, 1.0F);
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

void drawBrush(const PointerView& view, const Grid& grid, const ToolState& tool, const BrushPlace& place)
{
    constexpr ImU32 kFaceColor = IM_COL32(255, 220, 90, 255);
    const bool has_color = tool.action != BrushAction::Carve;
    const ImU32 color = has_color ? ImGui::ColorConvertFloat4ToU32({tool.color[0], tool.color[1], tool.color[2], 1.0F})
                                  : IM_COL32(255, 255, 255, 255);
    const glm::ivec3 voxel = tool.action == BrushAction::Fill ? place.voxel + place.step : place.voxel;
    const glm::dvec3 center = voxelCenter(grid, voxel);
    const double half = (tool.radius + 0.5) * double{grid.voxel_size};
    if (tool.shape == BrushShape::Box)
    {
        drawBox(view, center, half, color);
    }
    else
    {
        drawSphere(view, center, half, place.step, color);
    }
    if (place.step != glm::ivec3(0))
    {
        const double half_voxel = 0.5 * double{grid.voxel_size};
        const glm::length_t axis = axisOf(place.step);
        drawClosed(view, square(voxelCenter(grid, place.voxel), axis, half_voxel, half_voxel * place.step[axis]),
                   kFaceColor, 1.5F);
    }
}

} // namespace zvo::demo
