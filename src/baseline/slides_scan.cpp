// SPDX-License-Identifier: MIT
#include "baseline/slides_scan.h"

#include "core/base/divide_up.h"

namespace zvo::baseline
{

static_assert(gpu::kSlidesBlock == gpu::kSlidesGroup * gpu::kSlidesItems);

std::uint64_t partialCount(std::uint64_t count)
{
    return divideUp(count, gpu::kSlidesBlock);
}

void scanPartials(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& partials, std::uint64_t count,
                  const TotalPlace& total)
{
    vk::Pass pass = graph.addPass(gpu::baseline::SlidesScanTop{});
    const gpu::SlidesScanTopParams params = {pass.readWrite(partials), total(pass), static_cast<std::uint32_t>(count)};
    pass.dispatch(gpu::kSlidesGroup, params);
}

void scanValues(vk::FrameGraph& graph, vk::BufferOf<gpu::uint>& values, std::uint64_t count,
                vk::BufferOf<gpu::uint>& partials, const TotalPlace& total)
{
    const std::uint64_t threads = divideUp(count, gpu::kSlidesItems);
    {
        vk::Pass pass = graph.addPass(gpu::baseline::SlidesScanSums{});
        const gpu::SlidesScanParams params = {pass.readWrite(values), pass.readWrite(partials),
                                              static_cast<std::uint32_t>(count)};
        pass.dispatch(threads, params);
    }
    scanPartials(graph, partials, partialCount(count), total);
    vk::Pass pass = graph.addPass(gpu::baseline::SlidesScanApply{});
    const gpu::SlidesScanParams params = {pass.readWrite(values), pass.readWrite(partials),
                                          static_cast<std::uint32_t>(count)};
    pass.dispatch(threads, params);
}

} // namespace zvo::baseline
