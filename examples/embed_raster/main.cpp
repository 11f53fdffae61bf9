// SPDX-License-Identifier: MIT
// Voxels among what the host rasterizes: zvo writes a picture and its depth into the host's images, then the host draws
// a mesh into both, and the depth test decides which of the two a pixel shows.
//
//     embed_raster picture.ppm
//
// Where no mesh is, the picture is the bytes of
//
//     zvo render knot.ply -o picture.png --resolution 128 --size 320x200 --camera 1.5,2,3.5,0,0,0,26
#include "common/camera.h"
#include "common/mesh_pass.h"
#include "common/start.h"
#include "embed_raster/mesh.frag.h"
#include "embed_raster/mesh.vert.h"

#include <numbers>

namespace
{

constexpr VkExtent2D kSize = {320, 200};
constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
constexpr double kNear = 0.125; // world units

constexpr host::Edge kZvoWrites = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

void embed(const host::Options& options)
{
    // What the host enables for itself: patchFeatures() leaves it as it is, and puts zvo's before it.
    VkPhysicalDeviceDynamicRenderingFeatures rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES;
    rendering.dynamicRendering = VK_TRUE;
    const host::Start start(options, &rendering);
    const host::Device& device = start.device();
    zvo::Context context(start.contextInfo());
    std::uint64_t frame = 0;
    const zvo::Tree tree = host::buildTree(device, context, host::knot(), 7, frame);

    // The images are the targets of both. zvo copies to them: TRANSFER_DST is all that it asks for. Copies to depth
    // images take a queue that draws, too.
    const host::Image color(device, kColorFormat, kSize,
                            VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const host::Image depth(device, kDepthFormat, kSize,
                            VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    const host::Mesh ring = host::ring({0, 0, 0}, 0.75F, 0.125F, {255, 0, 255, 255});
    const host::MeshPass mesh_pass(device, ring, kMeshVert, kMeshFrag, kColorFormat, sizeof(zvo::Mat4));

    // One camera, told in two ways. zvo makes its rays of CameraInfo; depth is what this very matrix makes of the
    // points that they hit, in double precision. Reversed depth keeps its precision far away: a miss is infinitely far,
    // 0.
    const auto camera = zvo::CameraInfo::lookAt({1.5, 2, 3.5}, {0, 0, 0}, 26 * (std::numbers::pi / 180));
    zvo::DepthTarget depth_target;
    depth_target.image = {depth.handle(), kDepthFormat, kZvoWrites.layout};
    depth_target.view_projection =
        host::reversedViewProjection(camera, static_cast<double>(kSize.width) / kSize.height, kNear);
    depth_target.miss = 0;
    const zvo::Mat4 to_clip = host::narrowed(depth_target.view_projection);

    zvo::Tracer tracer(context, kSize.width, kSize.height, kColorFormat);
    VkCommandBuffer commands = device.makeCommands();
    device.begin(commands);
    color.barrier(commands, {}, kZvoWrites);
    depth.barrier(commands, {}, kZvoWrites);
    {
        zvo::Recorder recorder(context, commands, ++frame);
        tracer.trace(recorder, tree, camera, {}, {color.handle(), kColorFormat, kZvoWrites.layout}, &depth_target);
    }
    // From zvo's copies to the mesh's attachments: the images' other edges.
    color.barrier(commands, kZvoWrites, host::MeshPass::kColor);
    depth.barrier(commands, kZvoWrites, host::MeshPass::kDepth);
    mesh_pass.draw(commands, color, depth, kSize, std::as_bytes(std::span(to_clip)));
    color.barrier(commands, host::MeshPass::kColor, host::Image::kRead);
    color.readBack(commands);
    device.submitAndWait(commands);
    context.frameDone(frame);
    color.savePpm(options.arguments[0]);
}

} // namespace

int main(int count, char** arguments)
{
    return host::run(count, arguments, "PICTURE", 1, embed);
}
