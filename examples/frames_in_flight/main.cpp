// SPDX-License-Identifier: MIT
// A ring flies through a knot, with several frames in flight: the host records frame after frame and waits for none but
// the one whose command buffer and image it is about to use again. A timeline semaphore counts frames, and its values
// are zvo's frame numbers.
//
//     frames_in_flight pictures-       writes pictures-22.ppm, pictures-23.ppm and pictures-24.ppm, the last frames
//
// They are what a static tree of both, made at once, looks like: the same bytes.
#include "common/start.h"
#include "common/timeline.h"

#include <array>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace
{

constexpr VkExtent2D kSize = {320, 200};
constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;
constexpr std::uint64_t kInFlight = 3;
constexpr std::uint64_t kFrames = 24;
constexpr host::Edge kZvoWrites = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};

// What belongs to one frame in flight.
struct Slot
{
    explicit Slot(const host::Device& device)
        : commands(device.makeCommands()),
          image(device, kFormat, kSize, VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT)
    {
    }

    VkCommandBuffer commands;
    host::Image image;
};

// Where the ring is in a frame: on its way down.
zvo::Mat4 placeOfRing(std::uint64_t i)
{
    zvo::Mat4 place = zvo::kIdentity;
    place[13] = 1.0F - static_cast<float>(i) / 16.0F;
    return place;
}

void embed(const host::Options& options)
{
    // Timeline semaphores are a feature of the host's. In a chain with VkPhysicalDeviceVulkan12Features,
    // patchFeatures() sets what zvo needs in that struct, as Vulkan wants it.
    VkPhysicalDeviceVulkan12Features vulkan12{};
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan12.timelineSemaphore = VK_TRUE;
    const host::Start start(options, &vulkan12);
    const host::Device& device = start.device();
    zvo::Context context(start.contextInfo());
    std::uint64_t frame = 0;

    // What stands still. Sums are kept, so that a voxel that it shares with the ring gets the mean of both.
    zvo::Tree knot = host::buildTree(device, context, host::knot(), 7, frame, true);

    const host::Timeline timeline(device, frame); // the frames of the build are done
    std::array<Slot, kInFlight> slots = {Slot(device), Slot(device), Slot(device)};
    zvo::Tracer tracer(context, kSize.width, kSize.height, kFormat);
    const auto camera = zvo::CameraInfo::lookAt({1.5, 2, 3.5}, {0, 0, 0}, 26 * (std::numbers::pi / 180));
    std::optional<zvo::DynamicTree> tree;
    zvo::DynamicObjectId ring = 0;
    int failed_count = 0;

    for (std::uint64_t i = 1; i <= kFrames; ++i)
    {
        // The slot's last frame must be done before its command buffer is recorded anew and its image is read: that is
        // kInFlight frames ago, and the device has the frames since then to work on meanwhile.
        Slot& slot = slots[++frame % kInFlight];
        if (i > kInFlight)
        {
            timeline.wait(frame - kInFlight);
        }
        // What zvo keeps for frames that are done is free. Not a wait: a number that the device has reached.
        context.frameDone(timeline.value());

        device.begin(slot.commands);
        {
            zvo::Recorder recorder(context, slot.commands, frame);
            if (!tree)
            {
                zvo::DynamicTreeInfo info;
                info.merge = zvo::MergeRule::Average;
                info.frames_in_flight = kInFlight;
                tree.emplace(recorder, std::move(knot), info);
                const host::ZvoMesh mesh(host::ring({0, 0, 0}, 0.5F, 0.125F, {240, 240, 240, 255}));
                const zvo::MeshInfo mesh_info = mesh.info();
                zvo::ModelInfo model_info;
                model_info.meshes = {&mesh_info, 1};
                ring = tree->addObject(recorder, zvo::Model(recorder, model_info), placeOfRing(i));
            }
            tree->setTransform(ring, placeOfRing(i));
            tree->update(recorder);
            // Nothing reads the image any more, the host has waited for it: no source for the first barrier.
            slot.image.barrier(slot.commands, {}, kZvoWrites);
            tracer.trace(recorder, *tree, camera, {}, {slot.image.handle(), kFormat, kZvoWrites.layout});
            slot.image.barrier(slot.commands, kZvoWrites, host::Image::kRead);
            slot.image.readBack(slot.commands);
        }
        timeline.submit(slot.commands, frame);

        // An update for which something was too small is reported when its frame is done. Until the next one, which has
        // more, the tree shows the last one that was complete.
        for (const zvo::UpdateStats& stats : tree->takeUpdates())
        {
            failed_count += stats.failed ? 1 : 0;
        }
    }

    // The end is the only time that all frames are waited for.
    timeline.wait(frame);
    context.frameDone(frame);
    for (std::uint64_t i = kFrames - kInFlight + 1; i <= kFrames; ++i)
    {
        slots[(frame - kFrames + i) % kInFlight].image.savePpm(options.arguments[0] + std::to_string(i) + ".ppm");
    }
    std::printf("updates that had too little room, and the next one had more: %d\n", failed_count);
}

} // namespace

int main(int count, char** arguments)
{
    return host::run(count, arguments, "PREFIX", 1, embed);
}
