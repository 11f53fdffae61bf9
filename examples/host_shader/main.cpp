// SPDX-License-Identifier: MIT
// The host traces zvo's voxels in a shader of its own (shade.comp), for what zvo's pictures do not show: the tree is an
// address that goes into push constants, like any buffer of the host's.
//
//     host_shader albedo.ppm normals.ppm
//
// This one shows what zvo's pictures do show, so that they can be compared: the bytes are those of
//
//     zvo render knot.ply -o albedo.png --view albedo --resolution 128 --size 320x200 --camera 1.5,2,3.5,0,0,0,26
//
// and of --view normal.
#include "common/image_kernel.h"
#include "common/start.h"
#include "host_shader/shade.comp.h"

#include <numbers>

namespace
{

constexpr VkExtent2D kSize = {320, 200};

// Push constants of shade.comp, in scalar layout.
struct Push
{
    std::uint64_t tree;
    zvo::CameraRays camera;
    std::uint32_t shows_normals;
    std::uint32_t unused;
};

void embed(const host::Options& options)
{
    // The features that zvo/trace.glsl takes are among those that zvo needs anyway.
    const host::Start start(options);
    const host::Device& device = start.device();
    zvo::Context context(start.contextInfo());
    std::uint64_t frame = 0;
    const zvo::Tree tree = host::buildTree(device, context, host::knot(), 7, frame);

    const host::Image image(device, VK_FORMAT_R8G8B8A8_UNORM, kSize,
                            VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const host::ImageKernel kernel(device, kShadeComp, image, sizeof(Push));

    // zvo's rays for a camera, made in double precision. A shader may make its own: docs/host-glsl.md.
    const auto camera = zvo::CameraInfo::lookAt({1.5, 2, 3.5}, {0, 0, 0}, 26 * (std::numbers::pi / 180));
    Push push{};
    push.tree = tree.address();
    push.camera = zvo::cameraRays(camera, tree.info().grid, kSize.width, kSize.height);

    VkCommandBuffer commands = device.makeCommands();
    for (std::uint32_t picture = 0; picture < 2; ++picture)
    {
        device.begin(commands);
        {
            // What zvo wrote becomes visible to the host's shaders. readers: what zvo writes to trees in this frame or
            // later waits until shaders of these stages, in frames before, have read. This tree never changes; a
            // DynamicTree does.
            zvo::Recorder recorder(context, commands, ++frame, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
            recorder.makeVisible(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
        }
        push.shows_normals = picture;
        image.barrier(commands, {}, host::ImageKernel::kWrites);
        kernel.run(commands, kSize, std::as_bytes(std::span(&push, 1)));
        image.barrier(commands, host::ImageKernel::kWrites, host::Image::kRead);
        image.readBack(commands);
        device.submitAndWait(commands);
        context.frameDone(frame);
        image.savePpm(options.arguments[picture]);
    }
}

} // namespace

int main(int count, char** arguments)
{
    return host::run(count, arguments, "ALBEDO NORMALS", 2, embed);
}
