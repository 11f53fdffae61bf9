// SPDX-License-Identifier: MIT
#include "core/trace/trace_passes.h"

#include <algorithm>
#include <cmath>

namespace zvo
{

bool isEmpty(const DeviceTree& tree)
{
    return tree.node_count == 0;
}

bool usesAttributes(const DeviceTree& tree, const TraceOptions& options)
{
    return tree.hasAttributes() && (!options.hasDetail() || tree.hasNodeAttributes());
}

bool showsAttributes(const TraceOptions& options)
{
    switch (options.view)
    {
    case View::Color:
    case View::Albedo:
    case View::Normal:
    case View::Bricks:
    case View::Origin:
        return true;
    case View::Depth:
    case View::Level:
    case View::Iterations:
    case View::Voxel:
        break;
    }
    return false;
}

AttributeFormat formatToRead(const DeviceTree& tree, const TraceOptions& options)
{
    return usesAttributes(tree, options) ? tree.attributeFormat() : AttributeFormat::None;
}

std::uint32_t roundsFor(const DeviceTree& tree, const TraceOptions& options)
{
    const std::uint64_t iterations = std::uint64_t{4} * tree.grid.resolution() + gpu::kTraceRoundsMax * 16;
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(divideUp(iterations, options.iterations_max), gpu::kTraceRoundsMax));
}

gpu::vec2 detailOf(const TraceOptions& options, const TraceCamera* camera)
{
    gpu::vec2 detail(0.0F);
    if (options.detail_level != UINT32_MAX)
    {
        detail.y = std::ldexp(1.0F, -2 * static_cast<int>(std::min(options.detail_level, gpu::kNodeLevelsMax)));
    }
    if (camera != nullptr)
    {
        const float width = 2.0F * glm::length(camera->rays.half_pixel_x) * options.detail_pixels;
        float& part = camera->orthographic ? detail.y : detail.x;
        part = std::max(part, width);
    }
    return detail;
}

gpu::ConstPtr<gpu::uint> readLength(vk::AnyPass& pass, const RayListLength* length)
{
    return length == nullptr
               ? gpu::ConstPtr<gpu::uint>{}
               : gpu::ConstPtr<gpu::uint>{pass.read(length->buffer).address + length->word * sizeof(gpu::uint)};
}

bool needsLight(const TraceOptions& options)
{
    return options.view == View::Color && (options.shadows || options.occlusion_rays != 0);
}

} // namespace zvo
