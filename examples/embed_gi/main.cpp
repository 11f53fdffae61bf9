// SPDX-License-Identifier: MIT
// A host that rasterizes, lit by zvo: its meshes are voxels, too, zvo caches light on their faces, and the host's
// fragment shader (mesh.frag) looks it up. A ring moves through a room with a lamp; light and shadows follow.
//
//     embed_gi before.ppm after.ppm      while the ring stands still, and after it has moved
#include "common/camera.h"
#include "common/mesh_pass.h"
#include "common/start.h"
#include "embed_gi/mesh.frag.h"
#include "embed_gi/mesh.vert.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <utility>

namespace
{

constexpr VkExtent2D kSize = {320, 200};
constexpr double kAspect = 1.6;
constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr std::uint32_t kStill = 128;    // frames before the ring moves
constexpr std::uint32_t kMoves = 24;     // frames in which it does
constexpr zvo::Vec3 kLamp = {17, 13, 9}; // radiance
constexpr float kEmissionScale = 17;     // of all that is in the tree

// Push constants of mesh.vert and mesh.frag, in scalar layout.
struct Push
{
    zvo::Mat4 to_clip{};
    zvo::Vec3 place{}; // of the mesh
    float mirror = 0;
    std::uint64_t tree = 0;
    std::uint64_t light = 0;
    zvo::Vec3 eye{};
    std::uint32_t frame = 0;
    zvo::Vec3 emission{};
    std::uint32_t unused = 0;
};

zvo::Mat4 placeOfRing(std::uint32_t frame)
{
    const std::uint32_t moved = frame < kStill ? 0 : std::min(frame + 1 - kStill, kMoves);
    zvo::Mat4 place = zvo::kIdentity;
    std::ranges::copy(zvo::Vec3{0.45F, 0.4F - 0.04F * static_cast<float>(moved), 0.35F}, place.begin() + 12);
    return place;
}

void embed(const host::Options& options)
{
    VkPhysicalDeviceDynamicRenderingFeatures rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES;
    rendering.dynamicRendering = VK_TRUE;
    const host::Start start(options, &rendering);
    const host::Device& device = start.device();
    zvo::Context context(start.contextInfo());
    std::uint64_t frame = 0;

    // What stands still, as voxels: the room, and a lamp that emits light.
    const host::Mesh room = host::room();
    const host::Mesh lamp = host::box({-0.3F, 0.95F, -0.2F}, {0.3F, 1, 0.4F}, {255, 255, 255, 255});
    const host::Mesh ring = host::ring({0, 0, 0}, 0.3F, 0.125F, {90, 120, 230, 255});
    const host::ZvoModel model({{room}, {lamp, kLamp}}, kEmissionScale);
    zvo::Tree fixed = host::buildTree(device, context, model.info(), 6, frame);

    const host::Image color(device, kColorFormat, kSize,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const host::Image depth(device, VK_FORMAT_D32_SFLOAT, kSize, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    const host::MeshPass room_pass(device, room, kMeshVert, kMeshFrag, kColorFormat, sizeof(Push));
    const host::MeshPass lamp_pass(device, lamp, kMeshVert, kMeshFrag, kColorFormat, sizeof(Push));
    const host::MeshPass ring_pass(device, ring, kMeshVert, kMeshFrag, kColorFormat, sizeof(Push));

    const auto camera = zvo::CameraInfo::lookAt({0.25, 0.125, 3.875}, {0, 0, 0}, 40 * (std::numbers::pi / 180));
    Push push;
    push.to_clip = host::narrowed(host::reversedViewProjection(camera, kAspect, 0.125));
    push.eye = {0.25F, 0.125F, 3.875F};
    const auto draw = [&](VkCommandBuffer commands, const host::MeshPass& pass, const zvo::Mat4& place,
                          const zvo::Vec3& emission, float mirror)
    {
        std::copy_n(place.begin() + 12, 3, push.place.begin());
        push.emission = emission;
        push.mirror = mirror;
        const bool is_first = &pass == &room_pass;
        color.barrier(commands, is_first ? host::Edge() : host::MeshPass::kColor, host::MeshPass::kColor);
        depth.barrier(commands, is_first ? host::Edge() : host::MeshPass::kDepth, host::MeshPass::kDepth);
        pass.draw(commands, color, depth, kSize, std::as_bytes(std::span(&push, 1)),
                  is_first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD);
    };
    // Rays of the same camera, on a coarse grid, find the faces that are seen.
    zvo::RadianceCache light(context, {.width = kSize.width / 2, .height = kSize.height / 2});
    std::optional<zvo::Environment> outside;
    std::optional<zvo::DynamicTree> tree;
    zvo::DynamicObjectId object = 0;
    VkCommandBuffer commands = device.makeCommands();
    for (std::uint32_t i = 0; i < kStill + kMoves; ++i)
    {
        const zvo::Mat4 place = placeOfRing(i);
        device.begin(commands);
        {
            // The fragment shader of the frame before has read tree and light; that of this one sees what is recorded.
            zvo::Recorder recorder(context, commands, ++frame, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
            if (!tree)
            {
                outside.emplace(recorder);
                outside->setSun({.irradiance = {0, 0, 0}});
                tree.emplace(recorder, std::move(fixed), zvo::DynamicTreeInfo{.emission_scale = kEmissionScale});
                const host::ZvoModel mover({{ring}}, kEmissionScale);
                object = tree->addObject(recorder, zvo::Model(recorder, mover.info()), place);
            }
            if (i == 0 || place != placeOfRing(i - 1) || tree->needsUpdate())
            {
                tree->setTransform(object, place);
                tree->update(recorder);
            }
            light.update(recorder, *tree, *outside, camera);
            recorder.makeVisible(VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
        }
        const bool is_kept = i + 1 == kStill || i + 1 == kStill + kMoves; // a renderer draws each frame
        if (is_kept)
        {
            push.tree = tree->address();
            push.light = light.address();
            push.frame = i;
            draw(commands, room_pass, zvo::kIdentity, {}, 0);
            draw(commands, lamp_pass, zvo::kIdentity, kLamp, 0);
            draw(commands, ring_pass, place, {}, 0.25F);
            color.barrier(commands, host::MeshPass::kColor, host::Image::kRead);
            color.readBack(commands);
        }
        device.submitAndWait(commands);
        context.frameDone(frame);
        if (is_kept)
        {
            color.savePpm(options.arguments[i < kStill ? 0 : 1]);
        }
    }
    std::printf("%.0f faces with light, %.1f MB\n", static_cast<double>(light.stats().faces),
                1e-6 * static_cast<double>(light.bytes()));
}

} // namespace

int main(int count, char** arguments)
{
    return host::run(count, arguments, "BEFORE AFTER", 2, embed);
}
