// SPDX-License-Identifier: MIT
// A path-traced picture that gets better from frame to frame: each frame adds a sample to each pixel, and the host's
// image gets the picture so far.
//
//     progressive picture.ppm 8    eight frames
//
// The picture is the bytes of
//
//     zvo render knot.ply -o picture.png --resolution 128 --size 320x200 --camera 1.5,2,3.5,0,0,0,26
//         --integrator path --spp 8
#include "common/start.h"

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

namespace
{

constexpr VkExtent2D kSize = {320, 200};
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr host::Edge kZvoWrites = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

std::uint32_t sampleCountOf(const std::string& text)
{
    std::uint32_t count = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, count);
    if (failure != std::errc() || stop != end || count == 0)
    {
        throw std::runtime_error("SAMPLES is a whole number from 1 to 4294967295, not " + text);
    }
    return count;
}

void embed(const host::Options& options)
{
    const std::uint32_t sample_count = sampleCountOf(options.arguments[1]);
    const host::Start start(options);
    const host::Device& device = start.device();
    zvo::Context context(start.contextInfo());
    std::uint64_t frame = 0;
    const zvo::Tree knot = host::buildTree(device, context, host::knot(), 7, frame);

    VkCommandBuffer commands = device.makeCommands();
    const host::Image image(device, kFormat, kSize, VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    zvo::Tracer tracer(context, kSize.width, kSize.height, kFormat);
    std::optional<zvo::Environment> light;
    const auto camera = zvo::CameraInfo::lookAt({1.5, 2, 3.5}, {0, 0, 0}, 26 * (std::numbers::pi / 180));

    // A renderer goes on for ever. It need not know whether the camera has moved: zvo looks, and begins anew.
    while (tracer.sampleCount() < sample_count)
    {
        device.begin(commands);
        {
            zvo::Recorder recorder(context, commands, ++frame);
            if (!light)
            {
                light.emplace(recorder); // the simple sky and a sun
            }
            image.barrier(commands, {}, kZvoWrites); // the image is written whole: the sums are zvo's
            tracer.tracePaths(recorder, knot, *light, camera, {}, {image.handle(), kFormat, kZvoWrites.layout});
            image.barrier(commands, kZvoWrites, host::Image::kRead);
            image.readBack(commands);
        }
        device.submitAndWait(commands);
        context.frameDone(frame);
    }
    image.savePpm(options.arguments[0]);
    std::printf("%u samples of each pixel\n", tracer.sampleCount());
}

} // namespace

int main(int count, char** arguments)
{
    return host::run(count, arguments, "PICTURE SAMPLES", 2, embed);
}
