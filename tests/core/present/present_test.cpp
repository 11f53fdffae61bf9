// SPDX-License-Identifier: MIT
// Pictures in another size.
#include "core/present/present.h"
#include "support/engine_device.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace zvo
{
namespace
{

using test::device;

TEST(ScalePicture, EveryPixelIsTheOneInWhichItsCenterLies)
{
    const std::vector<PictureSize> sizes = {{1, 1}, {3, 2}, {16, 9}, {67, 41}, {130, 1}, {1, 130}, {160, 90}};
    for (const PictureSize& from : sizes)
    {
        std::vector<gpu::uint> pixels(std::size_t{from.width} * from.height);
        std::iota(pixels.begin(), pixels.end(), 1000);
        const vk::BufferOf<gpu::uint> source = device().makeBuffer<gpu::uint>("picture", pixels);
        for (const PictureSize& to : sizes)
        {
            SCOPED_TRACE(testing::Message()
                         << from.width << "x" << from.height << " to " << to.width << "x" << to.height);
            vk::BufferOf<gpu::uint> target(device().device(), "scaled", std::uint64_t{to.width} * to.height);
            device().run([&](vk::FrameGraph& graph) { scalePicture(graph, source, from, target, to); });
            const std::vector<gpu::uint> scaled = device().download(target);
            for (std::uint32_t y = 0; y < to.height; ++y)
            {
                for (std::uint32_t x = 0; x < to.width; ++x)
                {
                    // Pixel centres in double precision. These quotients are exact, or far enough from a whole number.
                    const auto column = static_cast<std::uint32_t>((x + 0.5) * from.width / to.width);
                    const auto row = static_cast<std::uint32_t>((y + 0.5) * from.height / to.height);
                    ASSERT_EQ(scaled[y * to.width + x], pixels[row * from.width + column]) << x << ", " << y;
                }
            }
        }
    }
}

TEST(ScalePicture, TheLongestEdgesDoNotOverflow)
{
    constexpr std::uint32_t kEdge = 16384; // kImageEdgeMax
    std::vector<gpu::uint> pixels(kEdge);
    std::iota(pixels.begin(), pixels.end(), 0);
    const vk::BufferOf<gpu::uint> source = device().makeBuffer<gpu::uint>("picture", pixels);
    vk::BufferOf<gpu::uint> target(device().device(), "scaled", kEdge);
    for (const bool tall : {false, true})
    {
        const PictureSize size = tall ? PictureSize{1, kEdge} : PictureSize{kEdge, 1};
        device().run([&](vk::FrameGraph& graph) { scalePicture(graph, source, size, target, size); });
        ASSERT_EQ(device().download(target), pixels);
    }
}

} // namespace
} // namespace zvo
