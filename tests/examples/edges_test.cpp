// SPDX-License-Identifier: MIT
// The barriers before and after zvo's work on a host's images are the host's. With both, the layers report nothing;
// without one of them, they do.
#include "api/api_scene.h"
#include "support/embedding_host.h"

#include <gtest/gtest.h>

#include <ostream>

namespace zvo
{
namespace
{

enum class LeftOut
{
    Nothing,
    BeforeColor,
    BehindColor,
    BeforeDepth,
    BehindDepth
};

std::ostream& operator<<(std::ostream& stream, LeftOut what)
{
    constexpr const char* kNames[] = {"Nothing", "BeforeColor", "BehindColor", "BeforeDepth", "BehindDepth"};
    return stream << kNames[static_cast<int>(what)];
}

class ImageEdges : public testing::TestWithParam<LeftOut>
{
};

TEST_P(ImageEdges, TheLayersSpeakWhereOneIsMissing)
{
    if (!test::hasValidationLayer())
    {
        GTEST_SKIP() << "needs the validation layer";
    }
    constexpr VkFormat kColor = VK_FORMAT_R8G8B8A8_UNORM;
    constexpr VkFormat kDepth = VK_FORMAT_R32_SFLOAT; // any queue that computes may copy to it
    test::HostOptions options;
    options.validation = true;
    options.message_counter = nullptr; // messages are expected here
    test::EmbeddingHost host(options);
    const test::HostModel description(test::boxScene(glm::vec3(2), glm::vec3(6)));
    const Tree tree = host.build(host.upload(description.info()), {.grid = test::apiGrid(4)});
    Tracer tracer(host.context, host.kWidth, host.kHeight, kColor);
    test::TargetImage color(host.device, kColor, host.kWidth, host.kHeight);
    test::TargetImage depth(host.device, kDepth, host.kWidth, host.kHeight);
    DepthTarget depth_target;
    depth_target.image = depth.target();
    depth_target.view_projection[15] = 1; // depth 0 everywhere
    EXPECT_EQ(host.device.messageCount(), 0U);
    host.frame(
        [&](Recorder& recorder, VkCommandBuffer commands)
        {
            if (GetParam() != LeftOut::BeforeColor)
            {
                color.beginCopies(commands);
            }
            if (GetParam() != LeftOut::BeforeDepth)
            {
                depth.beginCopies(commands);
            }
            tracer.trace(recorder, tree, test::apiCamera(), {}, color.target(), &depth_target);
            color.read(commands, GetParam() == LeftOut::BehindColor);
            depth.read(commands, GetParam() == LeftOut::BehindDepth);
        });
    EXPECT_EQ(host.device.messageCount() != 0, GetParam() != LeftOut::Nothing);
}

INSTANTIATE_TEST_SUITE_P(All, ImageEdges,
                         testing::Values(LeftOut::Nothing, LeftOut::BeforeColor, LeftOut::BehindColor,
                                         LeftOut::BeforeDepth, LeftOut::BehindDepth),
                         testing::PrintToStringParamName());

} // namespace
} // namespace zvo
