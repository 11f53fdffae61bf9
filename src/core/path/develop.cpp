// SPDX-License-Identifier: MIT
#include "core/path/develop.h"

#include "core/base/divide_up.h"
#include "core/path/strips.h"

#include <algorithm>
#include <array>

namespace zvo
{

namespace
{

float partOf(const SampledPicture& picture)
{
    return 1.0F / static_cast<float>(std::max(picture.sample_count, 1U));
}

} // namespace

void Developer::expose(vk::FrameGraph& graph, const SampledPicture& picture, float factor)
{
    graph.fill(m_brightness, 0);
    {
        vk::Pass pass = graph.addPass(gpu::path::Meter{});
        const gpu::PathMeterParams params = {pass.read(picture.sums), pass.readWrite(m_brightness),
                                             static_cast<std::uint32_t>(picture.sums.count()), partOf(picture)};
        pass.dispatch(divideUp(picture.sums.count(), gpu::kMeterPixels) * gpu::kPathGroup, params);
    }
    vk::Pass pass = graph.addPass(gpu::path::Expose{});
    pass.dispatch(1, {pass.read(m_brightness), pass.write(m_exposure), factor});
}

void Developer::develop(vk::FrameGraph& graph, const SampledPicture& picture, TexelFormat texels,
                        const Exposure& exposure, vk::BufferOf<gpu::uint>& image)
{
    if (exposure.automatic)
    {
        expose(graph, picture, exposure.factor);
    }
    else
    {
        graph.update(m_exposure, 0, std::array{exposure.factor});
    }
    vk::Pass pass = graph.addPass(gpu::path::Develop{.texels = texels});
    pass.dispatch(picture.sums.count(), {.sums = pass.read(picture.sums),
                                         .exposure = pass.read(m_exposure),
                                         .image = pass.write(image),
                                         .width = picture.width,
                                         .height = picture.height,
                                         .sample_part = partOf(picture)});
}

HdrImage pictureOf(std::span<const gpu::PixelSum> sums, std::uint32_t width, std::uint32_t height,
                   std::uint32_t sample_count)
{
    HdrImage picture = {width, height, std::vector<glm::vec3>(sums.size())};
    const float part = 1.0F / static_cast<float>(sample_count);
    forEachPixel(width, height,
                 [&](std::size_t number, std::uint32_t x, std::uint32_t y)
                 { picture.texels[std::size_t{y} * width + x] = part * sums[number].radiance; });
    return picture;
}

} // namespace zvo
