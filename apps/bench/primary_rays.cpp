// SPDX-License-Identifier: MIT
#include "bench/primary_rays.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace zvo::cli
{

namespace
{

constexpr std::size_t kBatchRays = 4096; // taken by a thread at a time

PrimaryRay rayOf(const TraceCamera& camera, glm::ivec2 pixel, glm::ivec2 size)
{
    const glm::vec2 n(2 * pixel + 1 - size);
    const gpu::CameraRays& rays = camera.rays;
    const glm::vec3 offset = n.x * rays.half_pixel_x + n.y * rays.half_pixel_y;
    return camera.orthographic ? PrimaryRay{rays.origin + offset, rays.forward}
                               : PrimaryRay{rays.origin, rays.forward + offset};
}

} // namespace

std::vector<PrimaryRay> primaryRays(const TraceCamera& camera, std::uint32_t width, std::uint32_t height)
{
    constexpr int kBlock = 4; // pixels per edge
    const glm::ivec2 size(width, height);
    std::vector<PrimaryRay> rays;
    rays.reserve(std::size_t{width} * height);
    for (int top = 0; top < size.y; top += kBlock)
    {
        for (int left = 0; left < size.x; left += kBlock)
        {
            for (int y = top; y < std::min(top + kBlock, size.y); ++y)
            {
                for (int x = left; x < std::min(left + kBlock, size.x); ++x)
                {
                    rays.push_back(rayOf(camera, {x, y}, size));
                }
            }
        }
    }
    return rays;
}

void forEachBatch(std::span<const PrimaryRay> rays,
                  const std::function<void(std::size_t first, std::span<const PrimaryRay> batch)>& work)
{
    std::atomic<std::size_t> next = 0;
    const auto takeBatches = [&]
    {
        for (std::size_t first = next.fetch_add(kBatchRays); first < rays.size(); first = next.fetch_add(kBatchRays))
        {
            work(first, rays.subspan(first, std::min(kBatchRays, rays.size() - first)));
        }
    };
    std::vector<std::jthread> threads(std::max(1U, std::thread::hardware_concurrency()));
    std::ranges::generate(threads, [&] { return std::jthread(takeBatches); });
}

} // namespace zvo::cli
