// SPDX-License-Identifier: MIT
#include "core/present/present.h"

#include "core/base/divide_up.h"
#include "present/present.h"

namespace zvo
{

void scalePicture(vk::FrameGraph& graph, const vk::BufferOf<gpu::uint>& from, PictureSize from_size,
                  vk::BufferOf<gpu::uint>& to, PictureSize to_size)
{
    vk::Pass pass = graph.addPass(gpu::present::Scale{});
    pass.dispatch(std::uint64_t{to_size.width} * divideUp(to_size.height, gpu::kScaleRows),
                  {.from = pass.read(from),
                   .to = pass.write(to),
                   .from_size = {from_size.width, from_size.height},
                   .to_size = {to_size.width, to_size.height}});
}

} // namespace zvo
